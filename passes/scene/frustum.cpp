#include "passes/scene/frustum.h"

#include <algorithm>
#include <cstddef>

#include "capture_format/view.h"
#include "passes/scene/view_space.h"

namespace strata {
namespace {

constexpr double single_precision_margin = 1e-4;  // of a place's distance and size: what the device tests is rounded to floats

}  // namespace

Frustum::Frustum(const View& view) : near_(view.near) {
    const double w = view.width, h = view.height;
    const std::array corners = {ray_through(view, 0, 0), ray_through(view, w, 0), ray_through(view, w, h),
                                ray_through(view, 0, h)};
    const glm::dvec3 middle = ray_through(view, w / 2, h / 2);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 normal = glm::normalize(glm::cross(corners[i], corners[(i + 1) % corners.size()]));
        inward_[i] = glm::dot(normal, middle) < 0 ? -normal : normal;
    }
}

Frustum::Frustum(glm::dvec2 slopes, double near)
    : near_(near),
      inward_{glm::normalize(glm::dvec3(1, 0, slopes.x)), glm::normalize(glm::dvec3(-1, 0, slopes.x)),
              glm::normalize(glm::dvec3(0, 1, slopes.y)), glm::normalize(glm::dvec3(0, -1, slopes.y))} {}

bool Frustum::meets(const BoundingSphere& sphere) const {
    const double reach = sphere.radius + single_precision_margin * (sphere.radius + glm::length(sphere.center));
    if (sphere.center.z + reach < near_) return false;
    if (sphere.center.z - reach <= 0) return true;
    return std::ranges::none_of(inward_, [&](const glm::dvec3& normal) { return glm::dot(normal, sphere.center) < -reach; });
}

bool Frustum::meets(std::span<const glm::dvec3> corners) const {
    const auto margin = [](const glm::dvec3& corner) { return single_precision_margin * glm::length(corner); };
    if (std::ranges::all_of(corners, [&](const glm::dvec3& corner) { return corner.z + margin(corner) < near_; })) return false;
    return std::ranges::none_of(inward_, [&](const glm::dvec3& normal) {
        return std::ranges::all_of(corners, [&](const glm::dvec3& corner) { return glm::dot(normal, corner) < -margin(corner); });
    });
}

bool Frustum::contains(const BoundingSphere& sphere) const {
    if (sphere.center.z - sphere.radius < near_) return false;
    return std::ranges::all_of(inward_,
                               [&](const glm::dvec3& normal) { return glm::dot(normal, sphere.center) >= sphere.radius; });
}

}  // namespace strata
