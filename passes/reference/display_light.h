// Radiance as a picture shows it, in double, and how far apart two pictures are.
#pragma once

#include <cstddef>
#include <vector>

#include "passes/reference/image.h"

namespace strata {

/// The tone curve of every texel's color, exposed; what else an undecided texel may be is left out.
ReferenceImage tone_mapped(ReferenceImage radiance, double exposure, double white);

/// Linear display light of 0..1 as sRGB encodes it (IEC 61966-2-1), which is nearly even to the eye; so are the alternatives.
ReferenceImage srgb_encoded(ReferenceImage display);

/// Errors of sRGB-encoded display light.
struct DisplayError {
    double rmse = 0;        ///< of white, over the colors of the compared pixels; infinite where one alone is NaN
    double worst = 0;       ///< of white
    double over_1_255 = 0;  ///< share of the compared pixels of which a color is off by more
    double over_5_255 = 0;
    std::size_t pixels = 0;    ///< compared
    double clipped_share = 0;  ///< of them: what is wanted shows as white or as black, where errors of light do not show
    /// Share of the squared error that the worst thousandth of these pixels has, which is one pixel at least; 0 where the error
    /// is 0 or infinite.
    double concentration = 0;
};

/// Compares linear display light in two images of one extent, pixel by pixel. A pixel shows the mean of the samples that are
/// decided in both; one without any is left out, and so is one that `changed` (one per pixel; empty: all) does not have.
DisplayError display_error(const ReferenceImage& got, const ReferenceImage& wanted, const std::vector<bool>& changed = {});

}  // namespace strata
