// Where shadow maps look from.
#include "passes/scene/shadow_views.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/scene/light_pyramids.h"
#include "passes/scene/map_places.h"
#include "passes/scene/scene_facts.h"
#include "passes/scene/view_space.h"

namespace strata {

namespace {

// A kernel of 8 texels reaches 4 from its center; half a texel of rounding and 2 of snapping come on top.
constexpr double margin_texels = 8;
// Origins move in steps of 4 texels, so that grids of 4 x 4 blocks over the map are stable too (docs/algorithms/deferred.md 5.8).
constexpr double snap_texels = 4;

double margin(std::uint32_t size) { return std::min(margin_texels, size / 8.0); }

// A matrix from its rows, each (x, y, z, 1) dotted.
glm::dmat4 from_rows(const glm::dvec4& u, const glm::dvec4& v, const glm::dvec4& depth, const glm::dvec4& w) {
    return glm::transpose(glm::dmat4(u, v, depth, w));
}

// The sphere around the part of the view's pyramid between two depths, on the view axis: touching all 8 corners, or centered
// on the far end where the pyramid is so wide that this is smaller. Depends on no position: its size never changes.
BoundingSphere slice_sphere(const View& view, double begin, double end) {
    // One pixel more than the view: jitter moves the picture by up to half of one.
    const double x = (1 + 2.0 / view.width + std::abs(double(view.projection[2][0]))) / std::abs(double(view.projection[0][0]));
    const double y = (1 + 2.0 / view.height + std::abs(double(view.projection[2][1]))) / std::abs(double(view.projection[1][1]));
    const double k = x * x + y * y;
    const double center = std::min(end, 0.5 * (begin + end) * (1 + k));
    const auto corner = [&](double z) { return std::sqrt(k * z * z + (z - center) * (z - center)); };
    return {{0, 0, center}, std::max(corner(begin), corner(end))};
}

ShadowView sun_view(const Frame& frame, const BoundingSphere& slice, std::span<const BoundingSphere> casters) {
    const std::uint32_t size = std::max(frame.sun.shadow.map_size, 1u);
    const double texel = 2 * slice.radius / (size - 2 * margin(size));
    const ParallelAxes axes = parallel_axes(glm::dvec3(frame.sun.direction));
    // Map coordinate along an axis: (world . axis - corner) / (size * texel), the corner on a grid fixed in the world.
    const auto row = [&](const glm::dvec3& axis) {
        const glm::dvec3 in_view = frame.view.to_view * axis;
        const double grid = snap_texels * texel;
        const double origin = glm::dot(frame.view.origin, axis);
        const double center = std::round((glm::dot(slice.center, in_view) + origin) / grid) * grid;
        const double corner = center - 0.5 * size * texel;
        return glm::dvec4(in_view, origin - corner) / (size * texel);
    };
    const glm::dvec3 along = frame.view.to_view * axes.along;
    const double last = glm::dot(slice.center, along) + slice.radius;
    double first = last - 2 * slice.radius;
    for (const BoundingSphere& caster : casters) first = std::min(first, glm::dot(caster.center, along) - caster.radius);
    first -= 1e-3 * (last - first);  // so that no caster is clipped for a rounded depth above 1
    ShadowView view;
    view.view_to_map = from_rows(row(axes.u), row(axes.v), glm::dvec4(-along, last) / (last - first), {0, 0, 0, 1});
    view.size = size;
    view.bias = double(frame.sun.shadow.bias);
    view.texel = texel;
    view.source_width = 2 * std::tan(std::min(double(frame.sun.angular_radius), widest_half_angle));
    view.soft = frame.sun.shadow.soft;
    return view;
}

void add_cascades(const Frame& frame, std::span<const BoundingSphere> casters, std::vector<ShadowView>& views) {
    const double near = double(frame.view.near);
    const double far = std::max(double(frame.sun.shadow_distance), 2 * near);
    const std::vector<double> ends = cascade_ends(near, far, std::max(frame.sun.cascades, 1u), cascade_share);
    double begin = near, blended_from = near;
    for (const double end : ends) {
        ShadowView view = sun_view(frame, slice_sphere(frame.view, blended_from, end), casters);
        view.range_begin = begin;
        view.read_from = blended_from;
        view.range_end = end;
        views.push_back(view);
        blended_from = end - cascade_blend * (end - begin);
        begin = end;
    }
}

// Meters from a local light at which its maps begin; what is nearer is its housing. A range says how far a light shines, not how
// near its casters are, and depth is a float, near / distance: as fine for any near.
constexpr double housing = 0.05;

// Wider than the pyramid by the margin, so that kernels at its rim find their texels.
ShadowView local_view(const Frame& frame, const Light& light, const LightPyramid& pyramid, std::uint32_t size) {
    const glm::dvec2 slopes = pyramid.slopes * (size / (size - 2 * margin(size)));
    const glm::dvec3 position = in_view_space(frame.view, light.position);
    const auto row = [&](const glm::dvec3& axis) { return glm::dvec4(axis, -glm::dot(axis, position)); };
    const glm::dvec4 w = row(pyramid.along);
    ShadowView view;
    view.view_to_map =
        from_rows(0.5 * (w + row(pyramid.u) / slopes.x), 0.5 * (w + row(pyramid.v()) / slopes.y), {0, 0, 0, housing}, w);
    view.size = size;
    view.bias = double(light.shadow.bias);
    view.range_end = double(std::numeric_limits<float>::max());
    view.texel = 2 * std::max(slopes.x, slopes.y) / size;
    view.source_width = 2 * double(light.source_radius);
    view.soft = light.shadow.soft;
    return view;
}

bool has_map(const Light& light) {
    const bool can = facts_of(light.type).maps != LightMaps::none;
    return can && light.shadow.casts && light.range > 0 && light.intensity != glm::vec3(0);
}

void add_local(const Frame& frame, const Light& light, Allocation allocation, std::vector<ShadowView>& views) {
    const std::uint32_t own = std::max(light.shadow.map_size, 1u);
    const std::uint32_t size = allocation == Allocation::need ? needed_size(frame, light) : own;
    for (const LightPyramid& pyramid : light_pyramids(frame.view, light))
        views.push_back(local_view(frame, light, pyramid, size));
}

}  // namespace

std::vector<double> cascade_ends(double near, double far, std::uint32_t count, double share) {
    std::vector<double> ends;
    for (std::uint32_t i = 1; i <= count; ++i) {
        const double t = double(i) / count;
        ends.push_back(i == count ? far : share * near * std::pow(far / near, t) + (1 - share) * (near + (far - near) * t));
    }
    return ends;
}

bool has_faces(const Light& light) { return facts_of(light.type).maps == LightMaps::six; }

std::uint32_t cube_face(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return static_cast<std::uint32_t>(2 * axis + (direction[axis] < 0 ? 1 : 0));
}

std::vector<ShadowView> shadow_views(const Frame& frame, Allocation allocation) {
    return SceneFacts(frame).shadow_views(allocation);
}

std::vector<ShadowView> shadow_views(const Frame& frame, const LitCasters& scene, Allocation allocation) {
    std::vector<ShadowView> views;
    if (shines(frame.sun) && frame.sun.shadow.casts) add_cascades(frame, scene.casters, views);
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        if (!has_map(scene.lights[i])) continue;
        const std::size_t first = views.size();
        add_local(frame, scene.lights[i], allocation, views);
        for (std::size_t view = first; view < views.size(); ++view) views[view].light = i;
    }
    place_maps(views, allocation);
    return views;
}

std::vector<std::uint32_t> shadowed_lights(std::span<const ShadowView> views) {
    std::vector<std::uint32_t> lights;
    for (const ShadowView& view : views) {
        if (lights.empty() || lights.back() != view.light) lights.push_back(view.light);
    }
    return lights;
}

}  // namespace strata
