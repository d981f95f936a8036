#include "passes/reference/standard_error.h"

#include <algorithm>
#include <cmath>

#include "passes/reference/difference.h"

namespace strata {

std::optional<StandardError> standard_error(const ReferenceImage& image) {
    if (image.standard_error.empty()) return std::nullopt;
    ErrorSums sums;
    const double channels = std::min(image.channels, 3u);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        if (!decided(image, image, i)) continue;
        const glm::dvec3 error = image.standard_error[i], color(image.texels[i]);  // channels without a meaning are 0
        sums.squares += glm::dot(error, error);
        sums.power += glm::dot(color, color);
        sums.values += channels;
    }
    return StandardError{.rmse = sums.rmse(), .relative = sums.relative()};
}

}  // namespace strata
