// Parameters of every technique with shadow maps: how the maps are looked up, and how casters are drawn into them.
#pragma once

#include "passes/shadow_filter.h"

namespace strata {

/// How the alpha of a masked caster decides about a texel of a shadow map, which has one sample.
enum class CasterMask : std::uint32_t {
    clip,          ///< alpha against the material's cutoff
    mip_coverage,  ///< the same, alpha scaled by mip as the G-buffer's masked=mip_coverage scales it
    dither,        ///< alpha against a dither of 16 steps over 4 x 4 texels: as many texels as alpha says, to 1/32
};

struct ShadowMapParams {
    ShadowFilter filter;            ///< first: rows of ShadowFilter's fields fill it
    std::uint32_t caster_mask = 0;  ///< a CasterMask
};

}  // namespace strata
