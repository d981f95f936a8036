#include "capture_format/import/gltf_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace strata::gltf {

namespace {

/// What an eye sees that looks along `forward`, without a projection.
View looking_along(glm::dvec3 eye, glm::dvec3 forward, glm::dvec3 up) {
    return {.origin = eye, .to_view = look_along(forward, up)};
}

/// A view that has been turned until what it sees lies in its middle, and what it then sees: x / z and y / z.
struct Aim {
    View view;
    glm::dvec2 low{0}, high{0};
    double nearest = 0;

    bool fits(double slope, double width_over_height) const {
        const glm::dvec2 widest = glm::max(-low, high);
        return nearest > 0 && widest.x <= slope * width_over_height && widest.y <= slope;
    }
};

Aim aimed_view(std::span<const glm::dvec3> points, glm::dvec3 eye, glm::dvec3 forward) {
    Aim aim;
    for (int turn = 0; turn < 4; ++turn) {  // the middle moves a little as the view turns; it has settled after two or three
        aim = {looking_along(eye, forward, {0, 1, 0}), glm::dvec2(1e300), glm::dvec2(-1e300), 1e300};
        for (const glm::dvec3& point : points) {
            const glm::dvec3 p = aim.view.to_view * (point - eye);
            aim.nearest = std::min(aim.nearest, p.z);
            aim.low = glm::min(aim.low, glm::dvec2(p) / p.z);
            aim.high = glm::max(aim.high, glm::dvec2(p) / p.z);
        }
        if (!(aim.nearest > 0)) return aim;
        const glm::dvec2 middle = (aim.low + aim.high) * 0.5;
        if (turn < 3) forward = glm::transpose(aim.view.to_view) * glm::normalize(glm::dvec3(middle, 1));
    }
    return aim;
}

}  // namespace

Result<View> camera_view(const CameraSource& camera, const glm::dmat4& to_world, double width_over_height) {
    if (camera.type != "perspective")
        return fail(Fault::bad_input, "import.gltf.orthographic", "orthographic cameras are not supported");
    const glm::dvec3 forward = -glm::dvec3(to_world[2]), up(to_world[1]);
    if (!(camera.yfov > 0 && camera.yfov < 3.1 && camera.znear > 0) || !(glm::length(glm::cross(forward, up)) > 0)) {
        return fail(Fault::bad_input, "import.gltf.camera", "camera '{camera:.60}' is degenerate", camera.name);
    }
    View view = looking_along(glm::dvec3(to_world[3]), forward, up);
    view.near = static_cast<float>(camera.znear);
    view.projection = perspective(camera.yfov, width_over_height, camera.znear);
    return view;
}

namespace {

double aspect_of(const GltfOptions& options) { return static_cast<double>(options.width) / options.height; }

/// Radians; `usual` where the options name none.
double fov_of(const GltfOptions& options, double usual) { return options.fov ? glm::radians(*options.fov) : usual; }

View looking(const glm::dvec3& eye, const glm::dvec3& target, double radius, const GltfOptions& options) {
    constexpr double usual_fov = 1.1;  // 63 degrees: a wide lens, as rooms are photographed with
    const auto near = static_cast<float>(std::clamp(radius * 1e-3, 1e-4, 0.1));
    return look_at({.eye = eye,
                    .target = target,
                    .vertical_fov = fov_of(options, usual_fov),
                    .near = double(near),
                    .width = options.width,
                    .height = options.height});
}

}  // namespace

View placed_view(const Bounds& bounds, const GltfOptions& options) {
    const glm::dvec3 eye = *options.eye;
    const glm::dvec3 middle = bounds.center() == eye ? eye - glm::dvec3(0, 0, 1) : bounds.center();
    return looking(eye, options.target.value_or(middle), bounds.radius(), options);
}

namespace {

double doubled_area(const WorldTriangle& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])); }

/// Walls hide more than what stands before them, and 200 views of every triangle of a room took 45 s.
void keep_largest(std::vector<WorldTriangle>& triangles) {
    constexpr std::size_t kept = 5000;
    if (triangles.size() <= kept) return;
    const auto end = triangles.begin() + static_cast<std::ptrdiff_t>(kept);
    std::nth_element(triangles.begin(), end, triangles.end(),
                     [](const auto& a, const auto& b) { return doubled_area(a) > doubled_area(b); });
    triangles.resize(kept);
}

}  // namespace

View inside_view(std::vector<WorldTriangle> triangles, const Bounds& bounds, const GltfOptions& options) {
    constexpr int places = 5, directions = 8;
    const Bounds box = bounds.empty() ? Bounds{glm::dvec3(-1), glm::dvec3(1)} : bounds;
    keep_largest(triangles);
    View best;
    double farthest = -1;
    for (int candidate = 0; candidate < places * places * directions; ++candidate) {
        const int x = candidate % places, z = candidate / places % places, direction = candidate / places / places;
        const glm::dvec3 share((x + 0.5) / places, 0.5, (z + 0.5) / places), eye = box.low + (box.high - box.low) * share;
        const double turn = 2 * std::numbers::pi * direction / directions;
        const View view = looking(eye, eye + glm::dvec3(std::sin(turn), 0, -std::cos(turn)), box.radius(), options);
        double sum = 0;  // of roots: a long corridor beside a wall before the eye counts less than a room; nothing counts 0
        for (const double depth : nearest_depths(triangles, view)) sum += std::sqrt(depth);
        if (sum <= farthest) continue;
        farthest = sum;
        best = view;
    }
    return best;
}

View framing_view(std::span<const glm::dvec3> points, const Bounds& bounds, const GltfOptions& options) {
    const double vertical_fov = fov_of(options, 0.7);  // near that of a 35 mm lens on 35 mm film
    constexpr double margin = 1.05;
    const double aspect = aspect_of(options);
    const double slope = std::tan(vertical_fov / 2) / margin;
    const double azimuth = glm::radians(options.azimuth.value_or(22)), elevation = glm::radians(options.elevation.value_or(16));
    const glm::dvec3 towards_eye(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                 std::cos(azimuth) * std::cos(elevation));
    // From the far distance every point is inside a sphere that fits; then as near as all points still fit.
    double near_end = 0, far_end = 1e-6 + bounds.radius() * (1 + 1 / std::min(slope, slope * aspect));
    for (int halving = 0; halving < 20; ++halving) {
        const double distance = (near_end + far_end) / 2;
        const bool fits = aimed_view(points, bounds.center() + towards_eye * distance, -towards_eye).fits(slope, aspect);
        (fits ? far_end : near_end) = distance;
    }
    const Aim aim = aimed_view(points, bounds.center() + towards_eye * far_end, -towards_eye);
    View view = aim.view;
    view.near = static_cast<float>(std::clamp(aim.nearest * 0.5, far_end * 1e-6, 0.1));
    view.projection = perspective(vertical_fov, aspect, static_cast<double>(view.near));
    return view;
}

}  // namespace strata::gltf
