#include "passes/indirect/lpv/kept/middles.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/indirect/ways.shared.h"

namespace strata::indirect {
namespace {

/// Meters by which shaders may be wrong about a middle's height over a plane: places are floats relative to an eye.
double rounding(const glm::dvec3& eye, const LightGrid& grid) {
    const glm::dvec3 size = grid.cell * glm::dvec3(grid.cells);
    return 2e-6 * (glm::distance(grid.origin + .5 * size, eye) + glm::length(size));
}

/// Where a blocker's side begins among the middles of a grid's cells: lengths in cells, from the middle of the first.
struct Plane {
    glm::dvec3 center, u, v, normal;
    glm::dvec2 reach;  ///< along u and v, of the cells beside it, too
    double tolerance;
};

/// `rounded`: meters.
Plane plane_of(const Blocker& blocker, const LightGrid& grid, double rounded) {
    constexpr double rounded_cosine = 1e-5;
    const glm::dvec3 u = glm::normalize(glm::dvec3(blocker.u)), normal = glm::normalize(glm::cross(u, glm::dvec3(blocker.v)));
    const double cosine = glm::dot(normal, glm::dvec3(side_of_plane)), within = double(on_plane);
    // A plane that the direction runs along has its begin on one side or on the other.
    const bool has_begin = std::abs(cosine) > rounded_cosine;
    const double begin = !has_begin ? 0 : cosine > 0 ? -within : within;
    return {.center = (blocker.center + begin * normal - grid.origin) / grid.cell - .5,
            .u = u,
            .v = glm::cross(normal, u),
            .normal = normal,
            .reach = glm::dvec2(blocker.half_u, blocker.half_v) / grid.cell + 2.,
            .tolerance = (has_begin ? rounded : within + rounded) / grid.cell};
}

int longest_axis(const glm::dvec3& n) {
    const glm::dvec3 a = glm::abs(n);
    return a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
}

/// Asks of every line of middles along the axis nearest the normal about the one that is nearest to the plane.
bool meets_a_middle(const Plane& plane, const glm::uvec3& cells) {
    const int along = longest_axis(plane.normal), b = (along + 1) % 3, c = (along + 2) % 3;
    glm::dvec3 middle(0);
    for (middle[b] = 0; middle[b] < cells[b]; ++middle[b])
        for (middle[c] = 0; middle[c] < cells[c]; ++middle[c]) {
            middle[along] = plane.center[along];
            middle[along] = std::round(middle[along] - glm::dot(plane.normal, middle - plane.center) / plane.normal[along]);
            const glm::dvec3 offset = middle - plane.center;
            const bool is_beside = std::abs(glm::dot(plane.u, offset)) <= plane.reach.x &&
                                   std::abs(glm::dot(plane.v, offset)) <= plane.reach.y && middle[along] >= 0 &&
                                   middle[along] < cells[along];
            if (is_beside && std::abs(glm::dot(plane.normal, offset)) <= plane.tolerance) return true;
        }
    return false;
}

}  // namespace

bool has_middle_of_either_side(const Frame& frame, const glm::dvec3& eye, const LightGrid& grid) {
    const double rounded = std::max(rounding(eye, grid), rounding(frame.view.origin, grid));
    return std::ranges::any_of(frame.blockers, [&](const Blocker& blocker) {
        return blocker.half_u > 0 && blocker.half_v > 0 && meets_a_middle(plane_of(blocker, grid, rounded), grid.cells);
    });
}

}  // namespace strata::indirect
