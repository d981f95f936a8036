// What light propagation volumes' C++ and shaders share: settings, records, counters.
#ifndef PASSES_INDIRECT_LPV_SHARED_H
#define PASSES_INDIRECT_LPV_SHARED_H
#include "passes/indirect/light_grid.shared.h"
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::indirect {
#endif

// Settings, in the order of their choices in lpv.cpp.
const uint propagation_linear = 0u;       // radiance of a face may be negative: the closed form
const uint propagation_clamped = 1u;      // it may not: adds energy (docs/algorithms/lighting.md 5.4)
const uint propagation_energy_true = 2u;  // clamped, and scaled so that a cell sends what it holds
const uint faces_centre = 0u;             // radiance at the middle of a face
const uint faces_exact = 1u;              // integrated over the face
const uint occlusion_recorded = 0u;       // as the capture's volume says
const uint occlusion_none = 1u;
const uint occlusion_axial = 2u;  // of blockers and portals
const uint taps_all = 0u;
const uint taps_visible = 1u;  // those that no blocker hides from the surface

struct LpvParams {
    uint iterations;  // 0: as the capture's volume says
    uint propagation;
    uint faces;
    uint occlusion;
    uint taps;
    uint map_size;    // texels a side of reflective shadow maps
    float injection;  // cells along the normal of what is injected
    uint irradiance;
};

// Vertices of a reflective shadow map.
struct MapPush {
    mat4 to_clip;  // of view space
};

// A light's maps and the grid that they are injected into.
struct InjectPush {
    GridPlace grid;
    uint light;
    vec2 slopes;       // of a map's sides; 0 for parallel light
    float texel_area;  // of parallel light, square metres across it
    float fixed_one;   // 1 in the fixed point of the grid's sums: a power of two
    float bias;
};

struct ResolvePush {
    GridPlace grid;
    float fixed_one;
};

struct EnergyPush {
    GridPlace grid;
    uint step;
};

struct ApplyPush {
    GridPlace grid;
    float border;  // metres over which the grid fades at its border
};

// The same of a step of propagation, with what each channel's clamped faces are multiplied by, so that the cell sends what it
// holds.
struct StepCell {
    LightCell light;
    vec3 share;
};

// What the image volume_light is given of a grid.
struct HandOnPush {
    GridPlace grid;
    float border;
    uint asks_taps;
    uint irradiance;
    uint number;  // of the grid, and of grids
    uint count;
    uint first_cell;  // the record of its first cell
};

struct LpvCounters {
    uint injected;
    uint guarded;
    uint dropped;
    uint outside;
    uint hidden_taps;
    uint samples;
    uint unfinished;
};

#ifdef __cplusplus
}
#endif
#endif
