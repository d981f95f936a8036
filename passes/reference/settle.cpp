#include "passes/reference/settle.h"

#include <algorithm>
#include <cmath>

namespace strata {

double settle(const ReferenceImage& got, ReferenceImage& truth) {
    double squared_widths = 0;
    for (auto next = truth.alternatives.begin(); next != truth.alternatives.end();) {
        const std::size_t texel = next->texel;
        glm::dvec4 low = truth.texels[texel], high = low;
        for (; next != truth.alternatives.end() && next->texel == texel; ++next) {
            low = glm::min(low, next->value);
            high = glm::max(high, next->value);
        }
        if (!truth.undecided[texel]) continue;
        truth.undecided[texel] = false;
        const glm::dvec3 width(high - low);
        squared_widths += glm::dot(width, width);
        // A result that is not a number stays as wrong as it can be.
        truth.texels[texel] = glm::max(low, glm::min(high, got.texels[texel]));
    }
    truth.alternatives.clear();
    return std::sqrt(squared_widths / (3 * double(std::max<std::size_t>(1, truth.texels.size()))));
}

std::vector<bool> has_alternatives(const ReferenceImage& image) {
    std::vector<bool> has(image.texels.size());
    for (const Alternative& other : image.alternatives) has[other.texel] = true;
    return has;
}

}  // namespace strata
