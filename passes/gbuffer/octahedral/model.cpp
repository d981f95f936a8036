// Layout D of docs/algorithms/deferred.md 2.1 in double: attributes through codes and back.
#include "passes/gbuffer/octahedral/model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/gbuffer/octahedral/octahedral.shared.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {
namespace {

const double center = octahedral_center, depth_steps = octahedral_depth_steps;

}  // namespace

glm::uvec2 octahedral_codes(const glm::dvec3& n) {
    const glm::dvec2 p = to_octahedron(n);
    return {octahedral_code(p.x, center), octahedral_code(p.y, center)};
}

glm::dvec3 octahedral_normal(const glm::uvec2& codes) {
    return from_octahedron({octahedral_coordinate(codes.x, center), octahedral_coordinate(codes.y, center)});
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
    return stored_images(input, settings, [near](NearestSurface& s, const SampleAt&) {
        s.point = stored_material(s.point);
        s.point.normal = octahedral_normal(octahedral_codes(s.point.normal));
        s.point.position.z = octahedral_depth(octahedral_depth_code(s.point.position.z, near), near);
    });
}

}  // namespace strata::gbuffer
