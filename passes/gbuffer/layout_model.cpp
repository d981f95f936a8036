#include "passes/gbuffer/layout_model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/fill_params.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {
namespace {

double sign_without_zero(double x) { return x >= 0 ? 1 : -1; }

}  // namespace

ImageSet stored_images(const StageInput& input, const Settings& settings, const Store& store) {
    const auto params = settings.as<FillParams>();
    const ShadeAt shade_at = params.attributes == attributes_at_sample ? ShadeAt::sample : ShadeAt::pixel_center;
    const View& view = input.frame.view;
    SurfacesOfSamples surfaces = nearest_surfaces(input.frame, shade_at, params.masked);
    surfaces.rivals.clear();  // a model leaves out what is undecided
    const std::size_t pixels = std::size_t(view.width) * view.height;
    for (std::size_t i = 0; i < surfaces.nearest.size(); ++i) {
        if (!surfaces.nearest[i].exists) continue;
        const std::size_t pixel = i % pixels;
        const glm::dvec2 center(double(pixel % view.width) + 0.5, double(pixel / view.width) + 0.5);
        const glm::dvec2 offset = sample_position(view.samples, static_cast<std::uint32_t>(i / pixels)) - 0.5;
        store(surfaces.nearest[i], {input.frame, center, offset});
    }
    return surface_images(input.frame, surfaces);
}

glm::dvec2 to_octahedron(const glm::dvec3& n) {
    const glm::dvec2 p = glm::dvec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    if (n.z >= 0) return p;
    return {(1 - std::abs(p.y)) * sign_without_zero(p.x), (1 - std::abs(p.x)) * sign_without_zero(p.y)};
}

glm::dvec3 from_octahedron(const glm::dvec2& p) {
    const double z = 1 - std::abs(p.x) - std::abs(p.y), fold = std::max(-z, 0.0);
    return glm::normalize(glm::dvec3(p - glm::dvec2(sign_without_zero(p.x), sign_without_zero(p.y)) * fold, z));
}

std::uint32_t octahedral_code(double coordinate, double steps_to_one) {
    return static_cast<std::uint32_t>(std::floor(std::clamp(coordinate, -1.0, 1.0) * steps_to_one + 0.5) + steps_to_one);
}

double octahedral_coordinate(std::uint32_t code, double steps_to_one) { return (code - steps_to_one) / steps_to_one; }

double half_depth(double z, double near) { return nearest_half(std::max(z, near)); }

ImageSet half_depth_images(const StageInput& input, const Settings& settings, glm::dvec3 (*stored)(const glm::dvec3& normal)) {
    const double near = input.frame.view.near;
    return stored_images(input, settings, [near, stored](NearestSurface& s, const SampleAt&) {
        s.point = stored_material(s.point);
        s.point.normal = stored(s.point.normal);
        s.point.position.z = half_depth(s.point.position.z, near);
    });
}

glm::dvec3 octahedral_rounded(const glm::dvec3& normal, double steps_to_one) {
    const auto rounded = [&](double p) { return octahedral_coordinate(octahedral_code(p, steps_to_one), steps_to_one); };
    const glm::dvec2 p = to_octahedron(normal);
    return from_octahedron({rounded(p.x), rounded(p.y)});
}

void rebuild_from_depth(NearestSurface& s, const SampleAt& at) {
    s.point.position.z = double(at.frame.view.near) / double(static_cast<float>(s.depth));
    s.offset = at.offset;
}

}  // namespace strata::gbuffer
