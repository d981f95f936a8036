// Lights on the device, and what stops them.
#ifndef PASSES_SHADERS_SCENE_LIGHTS_SHARED_H
#define PASSES_SHADERS_SCENE_LIGHTS_SHARED_H
#include "passes/shader_interop.h"
#include "passes/shaders/scene/no_index.shared.h"
#ifdef __cplusplus
namespace strata {
#endif

struct LightRecord {
    vec3 position;   // view space
    uint type;       // LightType of capture_format/frame.h; the sun is directional
    vec3 direction;  // where it shines
    float range;
    vec3 intensity;  // W/sr; irradiance when directional
    float source_radius;
    vec3 axis_u;  // with axis_v = cross(direction, axis_u)
    float cos_inner;
    float cos_outer;
    vec2 tan_half;          // of a square spot or a projected picture: half its width and height at unit distance
    vec2 half_extent;       // rectangle; half length of a tube in x
    uint texture;           // projected or emitted, no_index without
    uint features;          // bits of light_features.shared.h that every evaluation of it needs
    uint first_blocker;     // in light_blockers ...
    uint blockers;          // ... how many, at most 32
    uint first_portal;      // in blocker_portals ...
    uint portals;           // ... how many, at most 32
    uint first_clip;        // in clip_planes ...
    uint clips;             // ... how many, at most 6
    uint shadow;            // first slot in shadows, no_index without
    uint shadow_slots;      // cascades of the sun, 1 for spots, 6 for omni
    uint visibility_layer;  // its first layer (sample 0) in the visibility image, no_index without
    uint window;            // RangeWindow of capture_format/frame.h
};

// A rectangle that stops light, in view space: center +- u half_u +- v half_v, v = cross(normal, u).
struct BlockerRecord {
    vec3 normal;
    float half_u;
    vec3 center;
    float half_v;
    vec3 u;
    uint one_sided;  // stops only light from the normal's side
};

// One of the blockers of one light. Bit k of portals: the light's k-th portal is a hole in it.
struct LightBlockerRecord {
    uint blocker;
    uint portals;
};

// A hole, in the (u, v) frame of the blocker it is cut into (a portal through two faces of a wall is two records).
struct BlockerPortalRecord {
    vec2 center;
    vec2 half_extent;
    vec2 turn;     // cosine and sine from the blocker's u to the portal's
    uint blocker;  // index into blockers
};

// Keeps what lies on the side dot(normal, p) + distance >= 0, view space.
struct ClipPlaneRecord {
    vec3 normal;
    float distance;
};

#ifdef __cplusplus
}
#endif
#endif
