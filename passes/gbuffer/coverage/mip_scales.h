// Scales of alpha, mip by mip, that leave as much of a masked texture as its finest mip has (Castano, Computing Alpha Mipmaps,
// 2010).
#pragma once

#include <array>

#include "passes/gbuffer/coverage/coverage.shared.h"

namespace strata {

struct Frame;     // capture_format/frame.h
struct Material;  // capture_format/frame/material.h

}  // namespace strata

namespace strata::gbuffer {

/// Of a masked material, finest mip first; mips that the texture lacks repeat its last one. A scale is the cutoff over an alpha
/// midway between the last texel that stays and the first that goes. 1 of the finest mip, and of all where all texels of the
/// finest stay or go. Of several texels with one alpha all stay or all go, whichever is nearer to the finest mip's share.
std::array<float, mask_scale_mips> mip_scales(const Frame&, const Material&);

}  // namespace strata::gbuffer
