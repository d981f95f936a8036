// Layout B' of docs/algorithms/deferred.md 2.1 in double, half floats exact: attributes stored and read back.
#include "passes/gbuffer/z_first/model.h"

#include <algorithm>
#include <cmath>

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {

glm::dvec2 z_first_halves(const glm::dvec3& n) {
    return {nearest_half(n.z), std::copysign(nearest_half((n.x + 1) / 2), n.y < 0 ? -1.0 : 1.0)};
}

glm::dvec3 z_first_normal(const glm::dvec2& q) {
    const double z = q.x, x = 2 * std::abs(q.y) - 1, y = std::sqrt(std::max(0.0, 1 - x * x - z * z));
    return glm::normalize(glm::dvec3(x, std::copysign(y, q.y), z));
}

ImageSet z_first_model(const StageInput& input, const Settings& settings) {
    return half_depth_images(input, settings, [](const glm::dvec3& n) { return z_first_normal(z_first_halves(n)); });
}

}  // namespace strata::gbuffer
