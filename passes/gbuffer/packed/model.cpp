// Layout B of docs/algorithms/deferred.md 2.1 in double, half floats exact: attributes stored and read back.
#include "passes/gbuffer/packed/model.h"

#include <algorithm>
#include <cmath>

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {

glm::dvec2 packed_halves(const glm::dvec3& n) {
    const double x = nearest_half((n.x + 1) / 2);
    return {n.z < 0 ? -x : x, nearest_half((n.y + 1) / 2)};
}

glm::dvec3 packed_normal(const glm::dvec2& q) {
    const glm::dvec2 xy = 2.0 * glm::abs(q) - 1.0;
    const double z = std::sqrt(std::max(0.0, 1 - glm::dot(xy, xy)));
    return glm::normalize(glm::dvec3(xy, std::signbit(q.x) ? -z : z));
}

ImageSet packed_model(const StageInput& input, const Settings& settings) {
    return half_depth_images(input, settings, [](const glm::dvec3& n) { return packed_normal(packed_halves(n)); });
}

}  // namespace strata::gbuffer
