// What a frame's meshes and materials have, as bits of constants (passes/scene/material_uses.h).
#ifndef PASSES_SHADERS_USES_SHARED_H
#define PASSES_SHADERS_USES_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

// Of `drawn`: kinds of draws.
const uint meshes_drawn = 1u;
const uint particles_drawn = 2u;

// Of `used_attributes`: what vertices of meshes have beside a position.
const uint attribute_normal = 1u << 0;
const uint attribute_tangent = 1u << 1;
const uint attribute_uv0 = 1u << 2;
const uint attribute_uv1 = 1u << 3;
const uint attribute_color = 1u << 4;

// Of `used_properties`: what materials have that others lack.
const uint property_metallic = 1u << 0;
const uint property_emissive = 1u << 1;
const uint property_transmission = 1u << 2;
const uint property_one_side = 1u << 3;
const uint property_both_sides = 1u << 4;

#ifdef __cplusplus
}
#endif
#endif
