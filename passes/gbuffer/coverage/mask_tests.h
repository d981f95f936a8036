// The methods of coverage.shared.h in double, on recorded frames.
#pragma once

#include <cstdint>

#include "passes/reference/mask_test.h"

namespace strata::gbuffer {

/// Which samples a masked surface covers by a method. Attributes are shaded at the pixel's center, where one decision is made for
/// all samples of the pixel, or at the sample.
MaskTest mask_model(const Frame&, std::uint32_t method, ShadeAt);

/// Of a masked material: by what alpha of a mip is multiplied with masked=mip_coverage.
double mip_scale_model(const Frame&, const Material&, std::uint32_t mip);

}  // namespace strata::gbuffer
