// Bloom in double, from docs/algorithms/deferred.md 8.6.
#pragma once

#include <array>

#include "passes/lens/lens.shared.h"
#include "passes/reference/image.h"

namespace strata::lens {

/// How wide a glow is and how much of the picture glows: recorded values beside settings.
struct Bloom {
    double strength = 0, threshold = 1;
    double scale = 1;  ///< from radiance to exposed radiance
    double reach = 0;  ///< of the picture's height
};

/// Exposed radiance above the threshold, the mean of each pixel's samples.
ReferenceImage glowing(const ReferenceImage& color, const Bloom&);
/// The mean of the levels of a pyramid over a glowing image, at its own extent. Gain 1.
ReferenceImage pyramid_glow(const ReferenceImage& glowing, std::uint32_t levels);
std::uint32_t pyramid_levels(double reach, std::uint32_t height);

/// X-Ray's weights of a center and of seven taps to each side of it.
std::array<double, 8> xray_taps();
/// What X-Ray's form adds to exposed radiance at a strength of 1.
ReferenceImage xray_glow(const ReferenceImage& color, double scale);

/// The color with the glow added to every sample.
ReferenceImage with_glow(const ReferenceImage& color, const ReferenceImage& glow, const Bloom&);

}  // namespace strata::lens
