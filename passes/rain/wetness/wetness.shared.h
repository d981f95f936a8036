// What wet surfaces' C++ and their shaders share.
#ifndef PASSES_RAIN_WETNESS_SHARED_H
#define PASSES_RAIN_WETNESS_SHARED_H
#include "passes/rain/rain.shared.h"
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::rain {
#endif

// rain_map_size: 64 << choice texels a side
const uint smallest_map = 64u;
// rain_jitter
const uint jitter_none = 0u;
const uint jitter_world = 1u;
// rain_casters
const uint casters_all = 0u;
const uint casters_fixed = 1u;
// rain_beyond
const uint beyond_open = 0u;
const uint beyond_dry = 1u;

// Side of the cubes of the world that share one set of tap offsets, per meter. Cubes are moved by a share of their side, so that
// no surface at a round coordinate lies between two.
const float noise_cells = 32.0f;
const float noise_shift = 0.37f;

// rain_directions
const uint most_directions = 8u;

// Of a vertical surface, the disc of taps is smaller by this share: all of it must be moved out of what stands above.
const float disc_loss = 0.75f;

// Cosines from all in front to all behind, around 0.
const float grazing_width = 0.04f;

struct RainMapPush {
    mat4 view_to_map;
};

// Where the rain map of one direction lies. Of a view-space point (p, 1): texels along both axes of the map, and depth there, 1
// where the map begins, with the bias.
struct RainRecord {
    vec4 u, v, depth;
    vec3 towards_rain;  // view space, unit
    float texel;        // meters
};

struct RecordPush {
    RainRecord map;
    uint place;
};

struct WetnessPush {
    RainRecord map;  // of the recorded direction; with more directions than that, of the first but for towards_rain
    // The eye's place in the world: whole cubes of 4 m modulo 2^32, and meters from there.
    uvec3 cubes;
    vec3 place;
    // Turns of what moves, counted since time 0: whole ones modulo 2^32, and the rest.
    uint ring_turns;
    float ring_phase;
    uint flow_turns;
    float flow_phase;
    float wetness;
    float intensity;
};

struct WetnessCounters {
    uint looked_up;
    uint sheltered;
    uint partly;
    uint wet;
};

#ifdef __cplusplus
}
#endif
#endif
