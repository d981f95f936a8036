// The view on the device, with what there is one of in a frame.
#ifndef PASSES_SHADERS_SCENE_VIEW_SHARED_H
#define PASSES_SHADERS_SCENE_VIEW_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// What the way through fog is: view depth, or distance from the eye.
const uint fog_by_view_depth = 0u;
const uint fog_by_distance = 1u;

struct ViewRecord {
    mat4 projection;  // view to clip, jitter included; reversed depth, infinite far
    mat3 to_world;    // rotation, view to world (its transpose goes back)
    vec2 ndc_scale;   // P00, P11
    vec2 ndc_offset;  // P20, P21 with jitter: ndc (+y up) = scale * p.xy / p.z + offset
    uvec2 extent;
    uint samples;
    float near;
    float exposure;
    float pre_exposure;  // what all radiance of the scene was multiplied by, and the base color of unlit materials was not
    float white_level;   // radiance of a white surface in the scene's light (passes/scene/pre_exposure.h); 0: no light
    float white;         // of the tone curve
    vec3 background;     // radiance where no surface is
    float fog_density;
    vec3 fog_color;
    uint fog_path;       // fog_by_...
    vec3 sky;            // hemisphere radiance from above (world +y) ...
    vec3 ground;         // ... and below
    uint light_count;    // of lights, the sun first when there is one
    uint shadow_count;   // of shadows
    uint first_emitter;  // of draws, which are emitters from here on
    uint seed;
    uint frame_index;
    float time;
};

#ifdef __cplusplus
}
#endif
#endif
