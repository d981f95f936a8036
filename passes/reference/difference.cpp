#include "passes/reference/difference.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace strata {

bool decided(const ReferenceImage& got, const ReferenceImage& wanted, std::size_t texel) {
    const auto hangs = [&](const ReferenceImage& image) { return !image.undecided.empty() && image.undecided[texel]; };
    return !hangs(got) && !hangs(wanted);
}

double percentile(std::span<const double> ascending, double share) {
    if (ascending.empty()) return 0;
    const auto rank = static_cast<std::size_t>(std::ceil(share / 100 * double(ascending.size())));
    return ascending[std::clamp<std::size_t>(rank, 1, ascending.size()) - 1];
}

double signed_error(double got, double wanted) {
    if (got == wanted || (std::isnan(got) && std::isnan(wanted))) return 0;
    const double error = got - wanted;
    return std::isnan(error) ? HUGE_VAL : error;
}

Difference difference(const ReferenceImage& got, const ReferenceImage& wanted) {
    assert(got.width == wanted.width && got.height == wanted.height && got.layers == wanted.layers);
    Difference d;
    double squares = 0, power = 0;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (!decided(got, wanted, i)) continue;
        for (int c = 0; c < 3; ++c) {
            const double right = wanted.texels[i][c], error = signed_error(got.texels[i][c], right);
            squares += error * error;
            power += std::isfinite(right) ? right * right : 0;
            d.bias += error;
            d.worst = std::max(d.worst, std::abs(error));
        }
        ++d.compared;
    }
    const double values = std::max(1.0, 3.0 * double(d.compared));
    d.rmse = std::sqrt(squares / values);
    d.relative = power > 0 ? std::sqrt(squares / power) : d.rmse;
    d.bias = std::isnan(d.bias) ? HUGE_VAL : d.bias / values;  // infinities of both signs
    return d;
}

}  // namespace strata
