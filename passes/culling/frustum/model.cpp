// The same test in double: sphere against the sides of the view's pyramid and its near plane, from the projection's terms.
#include <array>
#include <cmath>

#include "passes/culling/frustum/frustum.shared.h"
#include "passes/culling/opaque_draws.h"
#include "passes/culling/visible_image.h"
#include "passes/reference/bounds.h"
#include "passes/technique.h"

namespace strata::culling {

namespace {

// Inside is dot(normal, p) + distance >= 0; normals are unit.
struct Plane {
    glm::dvec3 normal;
    double distance;
};

// |s x / z + o| <= 1 in front of the eye is s x + (o + 1) z >= 0 and -s x + (1 - o) z >= 0, for x and for y.
std::array<Plane, 5> frustum_planes(const View& view) {
    const glm::dmat4 p(view.projection);
    const double sx = p[0][0], ox = p[2][0] + double(view.jitter.x);
    const double sy = p[1][1], oy = p[2][1] + double(view.jitter.y);
    const auto side = [](glm::dvec3 n) { return Plane{glm::normalize(n), 0.0}; };
    return {side({sx, 0, ox + 1}), side({-sx, 0, 1 - ox}), side({0, sy, oy + 1}), side({0, -sy, 1 - oy}),
            Plane{{0, 0, 1}, -double(view.near)}};
}

}  // namespace

ImageSet frustum_model(const StageInput& input, const Settings&) {
    const std::vector<std::uint32_t> draws = opaque_draws(input.frame);
    ReferenceImage visible(visible_width, visible_rows(draws.size()), 1, glm::dvec4(0, 0, 0, 1));
    visible.undecided.assign(visible.texels.size(), false);
    const auto planes = frustum_planes(input.frame.view);
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Sphere sphere = bounding_sphere(input.frame, draws[i]);
        const double size = 1 + glm::length(sphere.center) + sphere.radius;
        const double radius = sphere.radius + double(frustum_slack) * size;
        double depth = 1e300;  // how far the sphere reaches over the plane it reaches over least
        for (const Plane& plane : planes)
            depth = std::min(depth, glm::dot(plane.normal, sphere.center) + plane.distance + radius);
        visible.texels[i] = glm::dvec4(depth >= 0 ? 1 : 0, 0, 0, 1);
        // Device arithmetic on these sums is good to a few 2^-23 of their size.
        visible.undecided[i] = std::abs(depth) < 4e-6 * size;
    }
    return {{"visible", visible}};
}

}  // namespace strata::culling
