#include "passes/reference/difference.h"

#include <algorithm>
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
    Difference d;
    double squares = 0, power = 0;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (!decided(got, wanted, i)) continue;
        const glm::dvec3 right(wanted.texels[i]), error = glm::dvec3(got.texels[i]) - right;
        squares += glm::dot(error, error);
        power += glm::dot(right, right);
        d.bias += error.x + error.y + error.z;
        d.worst = std::max({d.worst, std::abs(error.x), std::abs(error.y), std::abs(error.z)});
        ++d.compared;
    }
    const double values = std::max(1.0, 3.0 * double(d.compared));
    d.rmse = std::sqrt(squares / values);
    d.relative = power > 0 ? std::sqrt(squares / power) : d.rmse;
    d.bias /= values;
    return d;
}

}  // namespace strata
