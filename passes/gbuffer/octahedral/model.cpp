// Layout D of docs/algorithms/deferred.md 2.1 in double: attributes of the pixel's center through codes and back.
#include "passes/gbuffer/octahedral/model.h"

#include <algorithm>
#include <cmath>

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/fill.shared.h"
#include "passes/gbuffer/nearest.h"
#include "passes/gbuffer/octahedral/octahedral.shared.h"
#include "passes/technique.h"

namespace strata::gbuffer {
namespace {

const double center = octahedral_center, depth_steps = octahedral_depth_steps;

double sign_without_zero(double x) { return x >= 0 ? 1 : -1; }

std::uint32_t code(double p) { return static_cast<std::uint32_t>(std::floor(std::clamp(p, -1.0, 1.0) * center + 0.5) + center); }

}  // namespace

glm::uvec2 octahedral_codes(const glm::dvec3& n) {
    glm::dvec2 p = glm::dvec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (n.z < 0) p = {(1 - std::abs(p.y)) * sign_without_zero(p.x), (1 - std::abs(p.x)) * sign_without_zero(p.y)};
    return {code(p.x), code(p.y)};
}

glm::dvec3 octahedral_normal(const glm::uvec2& codes) {
    glm::dvec2 p = (glm::dvec2(codes) - center) / center;
    const double z = 1 - std::abs(p.x) - std::abs(p.y), fold = std::max(-z, 0.0);
    p -= glm::dvec2(sign_without_zero(p.x), sign_without_zero(p.y)) * fold;
    return glm::normalize(glm::dvec3(p, z));
}

std::uint32_t octahedral_depth_code(double z, double near) {
    const double share = std::log(std::max(z / near, 1.0)) / std::log(double(octahedral_far_over_near));
    return static_cast<std::uint32_t>(std::floor(std::min(share, 1.0) * depth_steps + 0.5));
}

double octahedral_depth(std::uint32_t depth_code, double near) {
    return near * std::pow(double(octahedral_far_over_near), depth_code / depth_steps);
}

ImageSet octahedral_model(const StageInput& input, const Settings& settings) {
    const double near = input.frame.view.near;
    std::vector<NearestSurface> surfaces = nearest_surfaces(input.frame, ShadeAt::pixel_center, settings.as<FillParams>().masked);
    for (NearestSurface& s : surfaces) {
        if (!s.exists) continue;
        s.point = stored_material(s.point);
        s.point.normal = octahedral_normal(octahedral_codes(s.point.normal));
        s.point.position.z = octahedral_depth(octahedral_depth_code(s.point.position.z, near), near);
    }
    return surface_images(input.frame, surfaces);
}

}  // namespace strata::gbuffer
