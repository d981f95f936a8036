#include "passes/error_sums.h"

#include <algorithm>
#include <cmath>

namespace strata {

double signed_error(double got, double wanted) {
    if (got == wanted || (std::isnan(got) && std::isnan(wanted))) return 0;
    const double error = got - wanted;
    return std::isnan(error) ? HUGE_VAL : error;
}

double ErrorSums::add(double got, double wanted) {
    const double error = signed_error(got, wanted);
    squares += error * error;
    power += std::isfinite(wanted) ? wanted * wanted : 0;
    ++values;
    return error;
}

double ErrorSums::rmse() const { return std::sqrt(squares / std::max(1.0, values)); }

double ErrorSums::relative() const { return power > 0 ? std::sqrt(squares / power) : rmse(); }

double ErrorSums::reference() const { return std::sqrt(power / std::max(1.0, values)); }

}  // namespace strata
