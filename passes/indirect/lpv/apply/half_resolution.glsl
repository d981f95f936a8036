// Light that is read of a grid once per 2 x 2 pixels, and taken from there by pixels whose surface is near the one that read it.
#ifndef PASSES_INDIRECT_LPV_HALF_RESOLUTION_GLSL
#define PASSES_INDIRECT_LPV_HALF_RESOLUTION_GLSL
#include "passes/gbuffer/surface_at.glsl"
#include "passes/indirect/lpv/apply/gathered_light.glsl"

const uint no_pixel = 4u;  // of a block without a surface

layout(set = 0, binding = 8) uniform usampler2D chosen_pixels;

ivec2 pixel_of(ivec2 block, uint chosen) { return 2 * block + ivec2(chosen & 1u, chosen >> 1u); }

LitPlace lit_pixel(ivec2 pixel) { return lit_place(surface_at(ivec3(pixel, 0)), uvec2(pixel)); }

#endif
