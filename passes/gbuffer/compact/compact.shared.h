// What the compact layout's C++ model and its shaders share.
#ifndef PASSES_GBUFFER_COMPACT_SHARED_H
#define PASSES_GBUFFER_COMPACT_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::gbuffer {
#endif

// Steps of an octahedral coordinate from 0 to 1, and of occlusion: 10 bits each.
const float compact_normal_steps = 511.0f;
const float compact_occlusion_steps = 1023.0f;

// What 2 bits can say of a material. Hair keeps its own, because its direction is no normal.
const uint compact_unlit = 0u;
const uint compact_dielectric = 1u;  // read as ggx of metallic 0
const uint compact_metal = 2u;       // read as ggx of metallic 1
const uint compact_hair = 3u;

#ifdef __cplusplus
}
#endif
#endif
