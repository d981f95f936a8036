#include "passes/transparency/voxel/slices/depth_warp_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/ordering.h"
#include "passes/reference/shade.h"
#include "passes/reference/triangles.h"
#include "passes/transparency/voxel/thick_fragments/segment_model.h"

namespace strata::transparency {
namespace {

RayRectangle whole_image(const Frame& frame) {
    const glm::dvec2 a(pixel_ray(frame, 0, 0)), b(pixel_ray(frame, frame.view.width, frame.view.height));
    return {glm::min(a, b), glm::max(a, b)};
}

/// What dot(plane, ray) reaches over the rectangle, ray.z = 1.
std::array<double, 2> reached(const RayRectangle& rays, glm::dvec3 plane) {
    const glm::dvec2 a = glm::dvec2(plane) * rays.low, b = glm::dvec2(plane) * rays.high;
    const glm::dvec2 least = glm::min(a, b), most = glm::max(a, b);
    return {plane.z + least.x + least.y, plane.z + most.x + most.y};
}

}  // namespace

std::optional<Depths> depths_within(const Corners& corners, const RayRectangle& rays, double near) {
    Depths depths{std::min({corners[0].z, corners[1].z, corners[2].z}), std::max({corners[0].z, corners[1].z, corners[2].z})};
    if (depths.farthest <= near) return {};
    depths.nearest = std::max(depths.nearest, near) * (1 - double(depth_slack));
    depths.farthest *= 1 + double(depth_slack);
    const TriangleRays plane(corners);
    const double facing = glm::length(plane.area) * glm::length(corners[0]), volume = plane.volume;
    if (std::abs(volume) * double(steepest) < facing) return depths;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 edge = glm::cross(corners[i], corners[(i + 1) % 3] - corners[i]);
        if (reached(rays, volume < 0 ? edge : -edge)[1] < -double(ray_slack) * glm::length(edge)) return {};
    }
    const auto [least, most] = reached(rays, plane.area / volume);
    const double slack = double(depth_slack) * facing / std::abs(volume);
    if (most <= 0) return {};
    depths.nearest = std::max(depths.nearest, (1 - slack) / most);
    if (least > 0) depths.farthest = std::min(depths.farthest, (1 + slack) / least);
    return depths;
}

void Coverage::take(double from, double to) {
    const auto last = static_cast<double>(halves_.size() - 1);
    const auto half = [&](double s) { return static_cast<std::size_t>(std::clamp(std::floor(2 * s), 0., last)); };
    for (std::size_t i = half(from); i <= half(to); ++i) halves_[i] = true;
}

Coverage Coverage::coarser() const {
    Coverage result(slices() / 2);
    for (std::size_t i = 0; i < result.halves_.size(); ++i) result.halves_[i] = halves_[2 * i] || halves_[2 * i + 1];
    return result;
}

std::vector<bool> Coverage::used(std::uint32_t splatting) const {
    std::vector<bool> used(slices());
    const auto half = [&](std::size_t i) { return i < halves_.size() && halves_[i]; };  // before the first: no std::size_t
    for (std::size_t v = 0; v < used.size(); ++v) {
        used[v] = half(2 * v) || half(2 * v + 1);
        if (splatting == splatting_linear) used[v] = used[v] || half(2 * v - 1) || half(2 * v + 2);
    }
    return used;
}

std::uint32_t DepthWarp::count_up_to(int slice) const {
    return slice < 0 ? 0 : counts[std::min(static_cast<std::size_t>(slice), counts.size() - 1)];
}

double DepthWarp::packed(double t) const {
    const double k = std::floor(t), q = physical(static_cast<int>(k));
    return q + (t - k) * (physical(static_cast<int>(k) + 1) - q);
}

DepthWarp depth_warp(Coverage coverage, std::uint32_t physical, std::uint32_t splatting) {
    DepthWarp warp;
    std::vector<bool> used = coverage.used(splatting);
    for (; std::ranges::count(used, true) > physical; ++warp.halvings) {
        coverage = coverage.coarser();
        used = coverage.used(splatting);
    }
    std::uint32_t count = 0;
    for (const bool is_used : used) warp.counts.push_back(count += is_used ? 1 : 0);
    return warp;
}

DepthWarp unwarped(std::uint32_t slices) {
    DepthWarp warp;
    for (std::uint32_t v = 0; v < slices; ++v) warp.counts.push_back(v + 1);
    return warp;
}

Coverage transparent_coverage(const VoxelParams& params, const Frame& frame, const DepthCurve& curve) {
    Coverage coverage(static_cast<std::uint32_t>(curve.slices));
    const RayRectangle image = whole_image(frame);
    for (const std::uint32_t draw : transparent_draws(frame)) {
        if (layer_of(frame, draw) > 0) continue;
        const DrawSpace space = draw_space(frame, draw);
        const double half_deep = thickness_of(params, frame, draw) / 2;
        for (std::uint32_t triangle = 0; triangle < triangle_count(frame, draw); ++triangle) {
            const auto depths = depths_within(view_corners(frame, space, draw, triangle), image, double(frame.view.near));
            if (!depths) continue;
            const double offset = attributes_at(frame, draw, triangle, glm::dvec3(1, 0, 0)).depth_offset;
            const auto slice = [&](double z) { return curve.slice_of(std::max(z - offset, curve.nearest)); };
            coverage.take(slice(depths->nearest - half_deep), slice(depths->farthest + half_deep));
        }
    }
    return coverage;
}

DepthWarp depth_warp(const VoxelParams& params, const Frame& frame, const DepthCurve& curve) {
    if (params.volume == volume_dense) return unwarped(params.slices);
    return depth_warp(transparent_coverage(params, frame, curve), params.slices, params.splatting);
}

}  // namespace strata::transparency
