#include "passes/indirect/lpv/injection/emission_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/light_types.h"
#include "passes/reference/lights.h"

namespace strata::indirect::in_double {
namespace {

using std::numbers::pi;
// A recorded axis with less than this across the direction is none; a direction with more than this along y is upright.
constexpr double shortest_axis = 1e-3, upright = 0.99;

double square_spot(const Light& light, const glm::dvec3& direction) {
    const LightAxes axes = light_axes(light);
    const glm::dvec3 away(glm::dot(direction, axes.u), glm::dot(direction, axes.v), glm::dot(direction, axes.along));
    return away.z > 0 ? square_spot_share(place_in_spot(light, away)) : 0;
}

/// The area that a tube of radius R shows: a rectangle of 2 R by 2 h sin(angle) and a circle.
double tube_area(const Light& light, const glm::dvec3& direction) {
    const double radius = light.source_radius;
    const double sine = glm::length(glm::cross(direction, glm::normalize(glm::dvec3(light.axis_u))));
    return 2 * radius * 2 * double(light.half_extent.x) * sine + pi * radius * radius;
}

}  // namespace

LightAxes light_axes(const Light& light) {
    const glm::dvec3 along = glm::normalize(glm::dvec3(light.direction)), recorded(light.axis_u);
    const glm::dvec3 across = recorded - along * glm::dot(along, recorded);
    if (glm::length(across) < shortest_axis) return axes_around(light.direction);
    const glm::dvec3 u = glm::normalize(across);
    return {along, u, glm::cross(along, u)};
}

LightAxes axes_around(const glm::vec3& direction) {
    const glm::dvec3 along = glm::normalize(glm::dvec3(direction));
    const glm::dvec3 helper = std::abs(along.y) < upright ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, along));
    return {along, u, glm::cross(along, u)};
}

glm::dvec3 radiant_intensity(const Light& light, const glm::dvec3& direction) {
    const glm::dvec3 shines = glm::max(glm::dvec3(light.intensity), 0.0);
    const double cosine = glm::dot(direction, glm::dvec3(light.direction)), radius = light.source_radius;
    const LightTypeFacts& facts = facts_of(light.type);
    if (facts.cone == LightCone::round) return shines * round_spot_share(light, cosine);
    if (facts.cone == LightCone::square) return shines * square_spot(light, direction);
    switch (facts.shape) {
        case LightShape::sphere:
            return shines * (pi * radius * radius);
        case LightShape::disc:
            return shines * (pi * radius * radius * std::max(0.0, cosine));
        case LightShape::rectangle:
            return shines * (4 * double(light.half_extent.x) * double(light.half_extent.y) * std::max(0.0, cosine));
        case LightShape::tube:
            return shines * tube_area(light, direction);
        default:
            return shines;
    }
}

}  // namespace strata::indirect::in_double
