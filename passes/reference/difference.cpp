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

Difference difference(const ReferenceImage& got, const ReferenceImage& wanted) {
    assert(got.width == wanted.width && got.height == wanted.height && got.layers == wanted.layers);
    Difference d;
    ErrorSums sums;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (!decided(got, wanted, i)) continue;
        for (int c = 0; c < 3; ++c) {
            const double error = sums.add(got.texels[i][c], wanted.texels[i][c]);
            d.bias += error;
            d.worst = std::max(d.worst, std::abs(error));
        }
        ++d.compared;
    }
    d.rmse = sums.rmse();
    d.relative = sums.relative();
    d.bias = std::isnan(d.bias) ? HUGE_VAL : d.bias / std::max(1.0, sums.values);  // infinities of both signs
    return d;
}

}  // namespace strata
