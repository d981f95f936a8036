// Shadow maps on the device.
#ifndef PASSES_SHADERS_SCENE_SHADOWS_SHARED_H
#define PASSES_SHADERS_SCENE_SHADOWS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// One shadow map: a square of a layer of shadow_maps. The buffer has the maps of Allocation::own, then as many of ::need
// (passes/scene/shadow_views.h); slots count from the first of either.
struct ShadowRecord {
    mat4 view_to_map;   // view space to (u, v, depth, w): uv in 0..1 of this map, depth 1 at the light, 0 far
    uint light;         // index into lights
    uint size;          // texels per edge
    float bias;         // meters towards the light
    float range_begin;  // view depth from which this cascade serves
    float range_end;
    float texel;         // world size of a texel at unit distance (spots, omni) or anywhere (sun), meters
    float source_width;  // of the light, meters; of the sun per meter from the caster
    uvec2 offset;        // of its upper left texel in the layer
    uint layer;
};

#ifdef __cplusplus
}
#endif
#endif
