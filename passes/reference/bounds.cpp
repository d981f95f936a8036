#include "passes/reference/bounds.h"

#include <algorithm>
#include <limits>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "passes/reference/triangles.h"

namespace strata {

Sphere bounding_sphere(const Frame& frame, std::uint32_t draw) {
    const DrawSpace space = draw_space(frame, draw);
    const std::vector<glm::vec3>& positions = frame.meshes[frame.draws[draw].mesh].positions;
    if (positions.empty()) return {space.offset, 0};
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const glm::vec3& position : positions) {
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    // Half edges in view space: each of the four diagonals is a sum of them, and opposite corners are equally far.
    const glm::dvec3 half = 0.5 * (high - low);
    const glm::dvec3 x = space.linear[0] * half.x, y = space.linear[1] * half.y, z = space.linear[2] * half.z;
    const double radius =
        std::max({glm::length(x + y + z), glm::length(x + y - z), glm::length(x - y + z), glm::length(x - y - z)});
    return {space.linear * (0.5 * (low + high)) + space.offset, radius};
}

}  // namespace strata
