// Formats and address modes of textures as TextureRecord has them: TextureFormat and AddressMode of a capture.
#ifndef PASSES_SHADERS_TEXTURES_SHARED_H
#define PASSES_SHADERS_TEXTURES_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata {
#endif

const uint texture_rgba8_unorm = 0u;
const uint texture_rgba8_srgb = 1u;
const uint texture_rgba16f = 2u;
const uint texture_rgba32f = 3u;

// Of one direction; the third, mirror, needs no name.
const uint address_repeat = 0u;
const uint address_clamp = 1u;
// TextureRecord::sampling has the modes along u (the lowest two bits) and v, then the filters: a bit each where magnified and
// minified texels are the nearest alone, and MipFilter. Linear filters are 0.
const uint address_clamp_both = address_clamp | address_clamp << 2u;
const uint filter_shift = 4u;
const uint magnifies_nearest = 1u << 4;
const uint minifies_nearest = 1u << 5;
const uint mip_shift = 6u;
const uint mip_linear = 0u;
const uint mip_nearest = 1u;
const uint mip_none = 2u;

#ifdef __cplusplus
}
#endif
#endif
