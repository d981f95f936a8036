// How far one image is from another.
#pragma once

#include <span>

#include "passes/reference/image.h"

namespace strata {

/// The definition of error in reports, comparisons and expectations, over n values that are judged (of light: its colors):
///     rmse = sqrt(sum (got - wanted)^2 / n),  relative = rmse / sqrt(sum wanted^2 / n), or rmse where that is 0.
struct ErrorSums {
    double squares = 0, power = 0, values = 0;

    /// The error counts as signed_error() has it; what is wanted and not finite has no power.
    void add(double got, double wanted);
    double rmse() const;
    double relative() const;
    double reference() const;  ///< root mean square of what was wanted
};

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

/// got - wanted; 0 where they are equal, infinities and NaN, too; infinite where one of them alone is NaN.
double signed_error(double got, double wanted);

/// The smallest of the ascending values that at least `share` percent of them do not exceed (nearest rank); 0 of none.
double percentile(std::span<const double> ascending, double share);

/// Whether the texel may be compared in both images.
bool decided(const ReferenceImage& got, const ReferenceImage& wanted, std::size_t texel);

}  // namespace strata
