// Layout B' of docs/algorithms/deferred.md 2.1 in double, half floats exact: attributes stored and read back.
#include "passes/gbuffer/z_first/model.h"

#include <algorithm>
#include <cmath>

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/technique.h"

namespace strata::gbuffer {

glm::dvec2 z_first_halves(const glm::dvec3& n) {
    return {nearest_half(n.z), std::copysign(nearest_half((n.x + 1) / 2), n.y < 0 ? -1.0 : 1.0)};
}

glm::dvec3 z_first_normal(const glm::dvec2& q) {
    const double z = q.x, x = 2 * std::abs(q.y) - 1, y = std::sqrt(std::max(0.0, 1 - x * x - z * z));
    return glm::normalize(glm::dvec3(x, std::copysign(y, q.y), z));
}

ImageSet z_first_model(const StageInput& input, const Settings& settings) {
    const double near = input.frame.view.near;
    return stored_images(input, settings, [near](NearestSurface& s, const SampleAt&) {
        s.point = stored_material(s.point);
        s.point.normal = z_first_normal(z_first_halves(s.point.normal));
        s.point.position.z = half_depth(s.point.position.z, near);
    });
}

}  // namespace strata::gbuffer
