// The definition of error in reports, comparisons and expectations.
#pragma once

namespace strata {

/// got - wanted; 0 where they are equal, infinities and NaN, too; infinite where one of them alone is NaN.
double signed_error(double got, double wanted);

/// Over n values that are judged (of light: its colors):
///     rmse = sqrt(sum (got - wanted)^2 / n),  relative = rmse / sqrt(sum wanted^2 / n), or rmse where that is 0.
struct ErrorSums {
    double squares = 0, power = 0, values = 0;

    /// Gives the error, which counts as signed_error() has it; what is wanted and not finite has no power.
    double add(double got, double wanted);
    double rmse() const;
    double relative() const;
    double reference() const;  ///< root mean square of what was wanted
};

}  // namespace strata
