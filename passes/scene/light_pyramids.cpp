#include "passes/scene/light_pyramids.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "capture_format/view.h"

namespace strata {
namespace {

LightPyramid spot_pyramid(const View& view, const Light& light) {
    const glm::dvec3 along = view.to_view * glm::normalize(glm::dvec3(light.direction));
    glm::dvec3 u = view.to_view * glm::dvec3(light.axis_u);
    // Of a round spot without a picture a capture may say any axis.
    if (glm::length(glm::cross(u, along)) < 1e-3) u = view.to_view * parallel_axes(glm::dvec3(light.direction)).u;
    return {.along = along, .u = glm::normalize(u - along * glm::dot(u, along)), .slopes = pyramid_slopes(light)};
}

LightPyramid face_pyramid(const View& view, const Light& light, int face) {
    const int axis = face / 2;
    glm::dvec3 along(0), u(0);
    along[axis] = face % 2 == 0 ? 1 : -1;
    u[(axis + 1) % 3] = 1;
    return {.along = view.to_view * along, .u = view.to_view * u, .slopes = pyramid_slopes(light)};
}

}  // namespace

glm::dvec2 pyramid_slopes(const Light& light) {
    if (!is_spot(light.type)) return {1, 1};
    const auto slope = [](float half_angle) { return std::tan(std::min(double(half_angle), widest_half_angle)); };
    const double slope_u = slope(light.outer_angle);
    return {slope_u, facts_of(light.type).cone == LightCone::square ? slope(light.inner_angle) : slope_u};
}

std::vector<LightPyramid> light_pyramids(const View& view, const Light& light) {
    if (is_spot(light.type)) return {spot_pyramid(view, light)};
    std::vector<LightPyramid> faces;
    for (int face = 0; face < 6; ++face) faces.push_back(face_pyramid(view, light, face));
    return faces;
}

ParallelAxes parallel_axes(const glm::dvec3& direction) {
    const glm::dvec3 along = glm::normalize(direction);
    const glm::dvec3 helper = std::abs(along.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, along));
    return {along, u, glm::cross(along, u)};
}

}  // namespace strata
