#include "passes/reference/standard_error.h"

#include <algorithm>
#include <cmath>

#include "passes/reference/difference.h"

namespace strata {

std::optional<StandardError> standard_error(const ReferenceImage& image) {
    if (image.standard_error.empty()) return std::nullopt;
    double squares = 0, power = 0;
    std::size_t compared = 0;
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        if (!decided(image, image, i)) continue;
        const glm::dvec3 error = image.standard_error[i], color(image.texels[i]);  // channels without a meaning are 0
        squares += glm::dot(error, error);
        power += glm::dot(color, color);
        ++compared;
    }
    const double channels = std::min(image.channels, 3u);
    StandardError expected{.rmse = std::sqrt(squares / std::max(1.0, channels * double(compared)))};
    expected.relative = power > 0 ? std::sqrt(squares / power) : expected.rmse;
    return expected;
}

}  // namespace strata
