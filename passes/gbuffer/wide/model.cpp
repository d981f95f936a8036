// Layout A of docs/algorithms/deferred.md 2.1 in double, half floats exact: position and normal component by component.
#include "passes/gbuffer/wide/model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/gbuffer/wide/wide.shared.h"
#include "passes/reference/place_code.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {
namespace {

constexpr double last_step = wide_metallic_steps - 1;

/// How many pixels a position lies beside the ray of a pixel's center.
glm::dvec2 pixels_aside(const Frame& frame, const glm::dvec2& center, const glm::dvec3& position) {
    const glm::dvec3 ray = pixel_ray(frame, center.x, center.y);
    const glm::dvec3 next = pixel_ray(frame, center.x + 1, center.y + 1);
    return (glm::dvec2(position) / position.z - glm::dvec2(ray)) / (glm::dvec2(next) - glm::dvec2(ray));
}

// What interpolation in floats may be off by, of a position's length. With it no decided place of city_of_boxes, far_wall and
// fence_and_foliage at 640 x 360 is over 0.003 pixel off.
constexpr double position_rounding = 1e-6;
// Change of a place's code, in pixels, from which on a texel is not compared. The code is dominated by y.
constexpr double compared_change = 0.004;

}  // namespace

bool place_hangs_on_rounding(const Frame& frame, const glm::dvec2& center, const glm::dvec3& exact) {
    const auto stored_place = [&](const glm::dvec3& position) {
        return place_code(pixels_aside(frame, center, wide_position(position, frame.view.near)));
    };
    const double place = stored_place(exact), slack = position_rounding * glm::length(exact);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const double aside : {-slack, slack}) {
            glm::dvec3 moved = exact;
            moved[axis] += aside;
            if (std::abs(stored_place(moved) - place) > compared_change) return true;
        }
    return false;
}

glm::dvec3 wide_normal(const glm::dvec3& n) {
    return glm::normalize(glm::dvec3(nearest_half(n.x), nearest_half(n.y), nearest_half(n.z)));
}

glm::dvec3 wide_position(const glm::dvec3& p, double near) {
    return {nearest_half(p.x), nearest_half(p.y), half_depth(p.z, near)};
}

std::uint32_t wide_material_code(const SurfacePoint& p) {
    const auto step = static_cast<std::uint32_t>(std::floor(std::clamp(p.metallic, 0.0, 1.0) * last_step + 0.5));
    return static_cast<std::uint32_t>(p.model) * wide_metallic_steps + step;
}

ImageSet wide_model(const StageInput& input, const Settings& settings) {
    const double near = input.frame.view.near;
    return stored_images(input, settings, [near](NearestSurface& s, const SampleAt& at) {
        const std::uint32_t code = code_of_half(half_of_code(wide_material_code(s.point)));
        s.point = stored_color(s.point);
        s.point.model = static_cast<LightingModel>(code / wide_metallic_steps);
        s.point.metallic = code % wide_metallic_steps / last_step;
        s.point.occlusion = nearest_half(std::clamp(s.point.occlusion, 0.0, 1.0));
        s.point.normal = wide_normal(s.point.normal);
        s.undecided |= place_hangs_on_rounding(at.frame, at.center, s.point.position);
        s.point.position = wide_position(s.point.position, near);
        s.offset = pixels_aside(at.frame, at.center, s.point.position);
    });
}

}  // namespace strata::gbuffer
