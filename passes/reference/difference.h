// How far one image is from another.
#pragma once

#include <span>

#include "passes/error_sums.h"
#include "passes/reference/image.h"

namespace strata {

/// ErrorSums over the color channels of every decided texel. A channel that is NaN in one image alone is infinitely wrong.
struct Difference {
    double rmse = 0;
    double relative = 0;
    double worst = 0;
    double bias = 0;  ///< mean of got - wanted
    std::size_t compared = 0;
};

/// Images of one extent.
Difference difference(const ReferenceImage& got, const ReferenceImage& wanted);

/// The smallest of the ascending values that at least `share` percent of them do not exceed (nearest rank); 0 of none.
double percentile(std::span<const double> ascending, double share);

/// Whether the texel may be compared in both images.
bool decided(const ReferenceImage& got, const ReferenceImage& wanted, std::size_t texel);

}  // namespace strata
