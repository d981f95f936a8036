#include "passes/culling/view_planes.h"

#include <algorithm>
#include <array>

#include "capture_format/view.h"

namespace strata {
namespace {

// Inside is dot(normal, p) + distance >= 0; normals are unit.
struct Plane {
    glm::dvec3 normal;
    double distance;
};

// |s x / z + o| <= 1 in front of the eye is s x + (o + 1) z >= 0 and -s x + (1 - o) z >= 0, for x and for y.
std::array<Plane, 5> sides_of(const View& view) {
    const glm::dmat4 p(view.projection);
    const double sx = p[0][0], ox = p[2][0] + double(view.jitter.x);
    const double sy = p[1][1], oy = p[2][1] + double(view.jitter.y);
    const auto side = [](glm::dvec3 n) { return Plane{glm::normalize(n), 0.0}; };
    return {side({sx, 0, ox + 1}), side({-sx, 0, 1 - ox}), side({0, sy, oy + 1}), side({0, -sy, 1 - oy}),
            Plane{{0, 0, 1}, -double(view.near)}};
}

}  // namespace

double reach_into_view(const View& view, const Sphere& sphere) {
    double least = 1e300;
    for (const Plane& side : sides_of(view))
        least = std::min(least, glm::dot(side.normal, sphere.center) + side.distance + sphere.radius);
    return least;
}

double size_with_distance(const Sphere& sphere) { return 1 + glm::length(sphere.center) + sphere.radius; }

}  // namespace strata
