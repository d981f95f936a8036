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
// A texture's record has the modes along u (the lowest two bits) and v.
const uint address_clamp_both = address_clamp | address_clamp << 2u;

#ifdef __cplusplus
}
#endif
#endif
