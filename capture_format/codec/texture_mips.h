// Mips of 8-bit textures, made the same way for imported and procedural images.
#pragma once

#include <glm/glm.hpp>

#include "capture_format/frame/texture.h"

namespace strata {

/// All mips, down to one texel, of an rgba8 texture that holds only its finest: a box filter over exactly the area of each
/// texel (odd sizes too), in linear light, alpha unweighted; every mip comes from the unrounded one before it.
Texture with_mips(Texture finest);

/// The mean over all texels of a texture made by with_mips, linear.
glm::vec4 mean_color(const Texture&);

}  // namespace strata
