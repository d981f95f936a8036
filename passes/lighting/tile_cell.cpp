#include "passes/lighting/tile_cell.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/shaders/scene/view.shared.h"

namespace strata::lighting {
namespace {

constexpr float farthest_cell = 1e18f;
constexpr float relative_slack = 4e-6f;
constexpr float cosine_slack = 1e-6f;
constexpr float axis_slack = 1.01f;

float dot(const glm::vec3& a, const glm::vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float length(const glm::vec3& a) { return std::sqrt(dot(a, a)); }

/// Least and largest dot(plane.xyz, p) + plane.w of the cell.
glm::vec2 reach_along(const glm::vec3& normal, float w, const Cell<float>& cell) {
    glm::vec2 reach(HUGE_VALF, -HUGE_VALF);
    for (const glm::vec3& corner : cell.corners) {
        const float along = dot(normal, corner) + w;
        reach = {std::min(reach.x, along), std::max(reach.y, along)};
    }
    return reach;
}

glm::vec2 reach_from(const glm::vec3& normal, const glm::vec3& point, const Cell<float>& cell) {
    return reach_along(normal, -dot(normal, point), cell);
}

/// How far ahead of the apex its center is, and its radius.
glm::vec2 sphere_around_cone(float cosine, float range) {
    const float sine = std::sqrt(std::max(0.f, 1 - cosine * cosine));
    return cosine >= sine ? glm::vec2(range * (.5f / cosine)) : range * glm::vec2(cosine, sine);
}

bool round_spot_touches(const LightRecord& light, const Cell<float>& cell, float slack) {
    const float scale = 1 / std::sqrt(dot(light.direction, light.direction));
    const float cosine = light.cos_outer * scale - cosine_slack;
    if (cosine <= 0) return true;
    const glm::vec3 axis = light.direction * scale;
    const glm::vec2 around = sphere_around_cone(cosine, light.range);
    if (!sphere_touches(light.position + axis * around.x, around.y + slack, cell)) return false;
    const glm::vec3 center = .5f * (.5f * (cell.corners[0] + cell.corners[3]) + .5f * (cell.corners[4] + cell.corners[7]));
    float farthest = 0;
    for (const glm::vec3& corner : cell.corners) farthest = std::max(farthest, length(center - corner));
    return cone_touches({axis, cosine, light.range}, center - light.position, farthest + slack);
}

bool square_spot_touches(const LightRecord& light, const Cell<float>& cell, float slack) {
    const glm::vec3 axis_v = glm::cross(light.direction, light.axis_u);
    for (const float side : {-1.f, 1.f}) {
        const glm::vec3 u = light.direction * light.tan_half.x + side * light.axis_u;
        const glm::vec3 v = light.direction * light.tan_half.y + side * axis_v;
        if (reach_from(u / length(u), light.position, cell).y < -slack) return false;
        if (reach_from(v / length(v), light.position, cell).y < -slack) return false;
    }
    if (reach_from(light.direction, light.position, cell).y < -slack) return false;
    const glm::vec3 wide = light.tan_half.x * light.axis_u, high = light.tan_half.y * axis_v;
    return std::ranges::none_of(cell.planes, [&](const glm::vec4& plane) {
        const glm::vec3 normal(plane);
        const float apex = dot(normal, light.position) + plane.w;
        const float base = dot(normal, light.direction) + std::abs(dot(normal, wide)) + std::abs(dot(normal, high));
        return std::max(apex, apex + axis_slack * light.range * base) < -slack;
    });
}

bool half_box_touches(const LightRecord& light, const Cell<float>& cell, float slack) {
    const glm::vec3 axis_v = glm::cross(light.direction, light.axis_u);
    const glm::vec2 along_u = reach_from(light.axis_u, light.position, cell), along_v = reach_from(axis_v, light.position, cell),
                    ahead = reach_from(light.direction, light.position, cell);
    const float least = std::max({along_u.x, along_v.x, ahead.x}), most = std::min(along_u.y, along_v.y);
    const float range = axis_slack * light.range;
    if (least > range + slack || most < -range - slack || ahead.y < -slack) return false;
    return std::ranges::none_of(cell.planes, [&](const glm::vec4& plane) {
        const glm::vec3 normal(plane);
        const float aside =
            std::abs(dot(normal, light.axis_u)) + std::abs(dot(normal, axis_v)) + std::max(0.f, dot(normal, light.direction));
        return dot(normal, light.position) + plane.w + range * aside < -slack;
    });
}

std::span<const ClipPlaneRecord> planes_of(const TouchedBy& by) {
    return by.clip_planes.subspan(by.light.clips > 0 ? by.light.first_clip : 0, by.light.clips);
}

bool is_clipped(const TouchedBy& by, const Cell<float>& cell) {
    return std::ranges::any_of(planes_of(by), [&](const ClipPlaneRecord& plane) {
        return reach_along(plane.normal, plane.distance, cell).y < -by.slack - relative_slack * std::abs(plane.distance);
    });
}

}  // namespace

glm::vec3 view_ray(const ViewRecord& view, glm::vec2 pixel) {
    const glm::vec2 ndc = glm::vec2(2, -2) * pixel / glm::vec2(view.extent) + glm::vec2(-1, 1);
    return {(ndc - view.ndc_offset) / view.ndc_scale, 1};
}

Cell<float> tile_cell(const ViewRecord& view, glm::uvec2 tile, std::uint32_t tile_size, glm::vec2 z_near_far) {
    const glm::uvec2 first = tile * tile_size, last = glm::min(first + tile_size, view.extent);
    const glm::vec3 upper_left = view_ray(view, glm::vec2(first)), lower_right = view_ray(view, glm::vec2(last));
    const TileRays<float> rays{.left = upper_left.x, .right = lower_right.x, .bottom = lower_right.y, .top = upper_left.y};
    return cell_between(rays, std::min(z_near_far.x, farthest_cell), std::min(z_near_far.y, farthest_cell));
}

float cell_slack(const LightRecord& light, const Cell<float>& cell) {
    const glm::vec3 corner = glm::max(glm::abs(cell.corners[4]), glm::abs(cell.corners[7]));
    const float reach = light.range * (1 + light.tan_half.x + light.tan_half.y);
    return relative_slack * (length(light.position) + corner.x + corner.y + corner.z + reach);
}

bool sphere_touches(const glm::vec3& center, float radius, const Cell<float>& cell) {
    for (const glm::vec4& plane : cell.planes)
        if (dot(glm::vec3(plane), center) + plane.w < -radius) return false;
    glm::vec3 low = cell.corners[0], high = cell.corners[0];
    for (const glm::vec3& corner : cell.corners) low = glm::min(low, corner), high = glm::max(high, corner);
    const glm::vec3 off = center - glm::clamp(center, low, high);
    return dot(off, off) <= radius * radius;
}

bool cone_touches(const Cone& cone, const glm::vec3& from_apex, float radius) {
    const float along = dot(from_apex, cone.axis);
    const float aside = std::sqrt(std::max(0.f, dot(from_apex, from_apex) - along * along));
    const float from_side = cone.cosine * aside - std::sqrt(std::max(0.f, 1 - cone.cosine * cone.cosine)) * along;
    return from_side <= radius && along <= cone.range + radius && along >= -radius;
}

bool light_touches(const TouchedBy& by, const Cell<float>& cell) {
    const LightRecord& light = by.light;
    const LightBounds bounds = facts_of(static_cast<LightType>(light.type)).bounds;
    if (bounds == LightBounds::everywhere) return !is_clipped(by, cell);
    if (!sphere_touches(light.position, light.range + by.slack, cell)) return false;
    if (bounds == LightBounds::round_cone && !round_spot_touches(light, cell, by.slack)) return false;
    if (bounds == LightBounds::pyramid && !square_spot_touches(light, cell, by.slack)) return false;
    if (bounds == LightBounds::half_box && !half_box_touches(light, cell, by.slack)) return false;
    const bool is_half = bounds == LightBounds::half_sphere;
    if (is_half && reach_from(light.direction, light.position, cell).y < -by.slack) return false;
    return !is_clipped(by, cell);
}

bool is_straddled(const TouchedBy& by, const Cell<float>& cell) {
    return std::ranges::any_of(planes_of(by), [&](const ClipPlaneRecord& plane) {
        return reach_along(plane.normal, plane.distance, cell).x < by.slack + relative_slack * std::abs(plane.distance);
    });
}

}  // namespace strata::lighting
