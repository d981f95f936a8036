// What shading a light or a surface may need, as bits: a light's own, a tile's "feature spectrum", a shader variant's constant
// (docs/algorithms/lighting.md 3.2; Kircher, Rendering Technology in Agents of Mayhem, GDC 2018).
#ifndef PASSES_SHADERS_LIGHT_FEATURES_SHARED_H
#define PASSES_SHADERS_LIGHT_FEATURES_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

const uint feature_blockers = 1u << 0;
const uint feature_portals = 1u << 1;
const uint feature_shadows = 1u << 2;       // a map, filtered by a fixed kernel
const uint feature_soft_shadows = 1u << 3;  // a kernel as wide as the penumbra; shadows is set, too
const uint feature_square_spot = 1u << 4;
const uint feature_round_spot = 1u << 5;
const uint feature_omni = 1u << 6;
const uint feature_tube = 1u << 7;
const uint feature_area = 1u << 8;  // sphere, disc, rectangle
const uint feature_projected_texture = 1u << 9;
const uint feature_darks = 1u << 10;
const uint feature_clip_planes = 1u << 11;
const uint feature_cloth = 1u << 12;
const uint feature_skin = 1u << 13;
const uint feature_hair = 1u << 14;
const uint feature_gi_tap_visibility = 1u << 15;
const uint light_feature_bits = 16u;
const uint every_light_feature = (1u << 16) - 1u;

#ifdef __cplusplus
}
#endif
#endif
