// Median-split hierarchy, Moeller and Trumbore 1997 against its triangles.
#include "passes/reference/rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/surfaces.h"
#include "passes/reference/triangles.h"

namespace strata {
namespace {

constexpr std::uint32_t leaf_triangles = 4;
// Barycentrics may be this much outside, so that no ray slips between two triangles that share a side.
constexpr double side_slack = 1e-12;
// Median splits halve: 64 levels hold any scene.
constexpr std::size_t deepest_stack = 64;

}  // namespace

struct RayScene::Span {
    glm::dvec3 origin, direction, inverse;
    double begin, end;

    // Slab test. A ray inside a slab's face gives 0 * inf = NaN, which these comparisons count as inside.
    bool touches(const Node& node) const {
        double enter = begin, leave = end;
        for (glm::length_t i = 0; i < 3; ++i) {
            const double a = (node.low[i] - origin[i]) * inverse[i], b = (node.high[i] - origin[i]) * inverse[i];
            if (!(a == a) || !(b == b)) continue;
            enter = std::max(enter, std::min(a, b));
            leave = std::min(leave, std::max(a, b));
        }
        // Boxes are exact, the slab distances are rounded.
        return enter <= leave + 1e-12 * std::abs(leave);
    }
};

RayScene::RayScene(const Frame& frame, RayMask mask) : frame_(&frame) {
    for (const std::uint32_t draw : opaque_draws(frame)) {
        if (mask == RayMask::shadow_casters && !frame.draws[draw].casts_shadow) continue;
        const DrawSpace space = draw_space(frame, draw);
        for (std::uint32_t i = 0; i < triangle_count(frame, draw); ++i) {
            const Corners c = view_corners(frame, space, draw, i);
            triangles_.push_back({c[0], c[1], c[2], draw, i, space.handedness});
        }
    }
    if (triangles_.empty()) return;
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

void RayScene::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
    const auto begin = triangles_.begin() + first, end = begin + count;
    glm::dvec3 low = begin->a, high = begin->a, middle_low = begin->a + begin->b + begin->c, middle_high = middle_low;
    for (auto t = begin; t != end; ++t) {
        low = glm::min(low, glm::min(t->a, glm::min(t->b, t->c)));
        high = glm::max(high, glm::max(t->a, glm::max(t->b, t->c)));
        middle_low = glm::min(middle_low, t->a + t->b + t->c);
        middle_high = glm::max(middle_high, t->a + t->b + t->c);
    }
    nodes_[node] = {.low = low, .high = high, .first = first, .count = count};
    if (count <= leaf_triangles) return;
    const glm::dvec3 spread = middle_high - middle_low;
    const glm::length_t axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [axis](const Triangle& p, const Triangle& q) {
        const double a = p.a[axis] + p.b[axis] + p.c[axis], b = q.a[axis] + q.b[axis] + q.c[axis];
        return std::tie(a, p.draw, p.triangle) < std::tie(b, q.draw, q.triangle);
    });
    const std::uint32_t children = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = children;
    nodes_[node].count = 0;
    nodes_.resize(nodes_.size() + 2);
    build(children, first, half);
    build(children + 1, first + half, count - half);
}

bool RayScene::solid(const Triangle& triangle, const glm::dvec3& barycentric) const {
    const Material& material = *material_of(*frame_, triangle.draw);
    if (material.alpha_mode != AlphaMode::mask) return true;
    return reaches_cutoff(alpha_at(*frame_, triangle.draw, triangle.triangle, barycentric), material);
}

std::optional<Hit> RayScene::intersect(const Triangle& triangle, const Span& ray) const {
    const glm::dvec3 e1 = triangle.b - triangle.a, e2 = triangle.c - triangle.a, to_origin = ray.origin - triangle.a;
    const glm::dvec3 p = glm::cross(ray.direction, e2), q = glm::cross(to_origin, e1);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) return std::nullopt;
    const double b1 = glm::dot(to_origin, p) / determinant, b2 = glm::dot(ray.direction, q) / determinant;
    if (!(b1 >= -side_slack && b2 >= -side_slack && b1 + b2 <= 1 + side_slack)) return std::nullopt;
    const double distance = glm::dot(e2, q) / determinant;
    if (!(distance > ray.begin && distance <= ray.end)) return std::nullopt;
    Hit hit{.distance = distance, .draw = triangle.draw, .triangle = triangle.triangle, .barycentric = {1 - b1 - b2, b1, b2}};
    hit.across = glm::cross(e1, e2);
    hit.front_facing = determinant * triangle.handedness > 0;
    if (!solid(triangle, hit.barycentric)) return std::nullopt;
    return hit;
}

template <typename Accept>
void RayScene::traverse(Span& ray, const Accept& accept) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, deepest_stack> stack;
    std::size_t waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
        const Node& node = nodes_[stack[--waiting]];
        if (!ray.touches(node)) continue;
        if (node.count == 0) {
            stack[waiting++] = node.first + 1;
            stack[waiting++] = node.first;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const std::optional<Hit> hit = intersect(triangles_[i], ray);
            if (hit && !accept(*hit)) return;
        }
    }
}

std::optional<Hit> RayScene::closest(glm::dvec3 origin, glm::dvec3 direction, double begin, double end) const {
    Span ray{.origin = origin, .direction = direction, .inverse = 1.0 / direction, .begin = begin, .end = end};
    std::optional<Hit> nearest;
    traverse(ray, [&](const Hit& hit) {
        if (hit.distance >= end) return true;
        if (!nearest ||
            std::tie(hit.distance, hit.draw, hit.triangle) < std::tie(nearest->distance, nearest->draw, nearest->triangle)) {
            nearest = hit;
            ray.end = hit.distance;
        }
        return true;
    });
    return nearest;
}

bool RayScene::clear(glm::dvec3 origin, glm::dvec3 direction, double begin, double end) const {
    Span ray{.origin = origin, .direction = direction, .inverse = 1.0 / direction, .begin = begin, .end = end};
    bool blocked = false;
    traverse(ray, [&](const Hit& hit) {
        blocked = hit.distance < end;
        return !blocked;
    });
    return !blocked;
}

namespace {

/// Error of the coarsest G-buffer's depth, relative: halves round by 2^-11.
constexpr double depth_error = 5e-4;
/// Height, relative to depth, below which surfaces coincide: rounding of doubles decides which is in front.
constexpr double coincident = 1e-9;

}  // namespace

std::optional<Hit> Departure::closest(const RayScene& scene, const glm::dvec3& direction, double end) const {
    const double per_height = glm::length(position) / glm::dot(direction, normal);
    for (double begin = coincident * per_height;;) {
        const std::optional<Hit> hit = scene.closest(position, direction, begin, end);
        if (!hit || hit->draw != draw || hit->distance >= depth_error * per_height) return hit;
        if (std::abs(glm::dot(hit->across, normal)) < .5 * glm::length(hit->across)) return hit;
        begin = hit->distance;
    }
}

Departure seen_surface(const RayScene& scene, const glm::dvec3& position, const glm::dvec3& normal) {
    if (const auto seen = scene.closest(glm::dvec3(0), position, 1 - depth_error, 1 + depth_error))
        return {seen->distance * position, normal, seen->draw};
    return {off_surface_of_depth(position, normal), normal, std::nullopt};
}

glm::dvec3 off_surface_of_depth(const glm::dvec3& position, const glm::dvec3& normal) {
    return position + depth_error * glm::length(position) * normal;
}

}  // namespace strata
