// Parameters of shadows/min_max.
#pragma once

#include "passes/shadows/bounds/build.h"
#include "passes/shadows/min_max/min_max.shared.h"
#include "passes/shadows/shadow_map_params.h"

namespace strata::shadows {

struct MinMaxParams {
    ShadowFilter filter;  ///< first, with caster_mask: the stage's parameters fill them as in ShadowMapParams
    std::uint32_t caster_mask = 0;
    std::uint32_t form = form_overlapping;
    std::uint32_t block = 1;  ///< 2 << block texels per edge
    std::uint32_t verify = 0;
    std::uint32_t class_light = 0;

    /// A kernel of N texels reaches N / 2 from its texel.
    BoundsSettings bounds() const {
        const std::uint32_t reach = 1u << filter.kernel, texels = 2u << block;
        if (form == form_hierarchical) return {.form = BoundsForm::levels, .block = texels, .reach = 0};
        if (form == form_block) return {.form = BoundsForm::extremes, .block = texels, .reach = 0};
        if (form == form_overlapping) return {.form = BoundsForm::extremes, .block = texels, .reach = reach};
        return {.form = form == form_plane ? BoundsForm::planes : BoundsForm::slabs, .block = texels, .reach = reach};
    }
};

}  // namespace strata::shadows
