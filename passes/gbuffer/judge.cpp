#include "passes/gbuffer/judge.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "passes/gbuffer/coverage/judge.h"
#include "passes/reference/shade.h"

namespace strata {
namespace {

struct Sums {
    double angle = 0, worst_angle = 0, position = 0, color = 0, roughness = 0, metallic = 0, occlusion = 0;
    double surfaces = 0, disagreeing = 0;
};

// What is not a number is as wrong as can be; std::max and a comparison would pass over it.
double infinite_if_nan(double error) { return std::isnan(error) ? HUGE_VAL : error; }

// atan2 and not acos: acos loses every angle below 1e-8 in a double, and 0.03 degrees in a float.
double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return infinite_if_nan(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi);
}

double square(double x) { return x * x; }

/// A texel of surface_normal, surface_color and surface_material.
struct Texel {
    glm::dvec4 normal, color, material;
};

Texel texel(const ImageSet& images, std::size_t i) {
    return {images.at("surface_normal").texels[i], images.at("surface_color").texels[i], images.at("surface_material").texels[i]};
}

/// Readers reconstruct positions at the pixel's center; the truth lies under the sample.
double position_error(const Frame& frame, std::size_t i, double z, double true_z) {
    const View& view = frame.view;
    const std::size_t pixels = std::size_t(view.width) * view.height;
    const glm::dvec2 corner(double(i % pixels % view.width), double(i % pixels / view.width));
    const glm::dvec2 at = corner + sample_position(view.samples, static_cast<std::uint32_t>(i / pixels));
    const glm::dvec3 wanted = pixel_ray(frame, at.x, at.y) * true_z;
    const glm::dvec3 got = pixel_ray(frame, corner.x + 0.5, corner.y + 0.5) * z;
    return glm::length(got - wanted) / glm::length(wanted);
}

void add(Sums& sums, const Texel& got, const Texel& wanted) {
    const double angle = degrees_between(got.normal, wanted.normal);
    sums.angle += square(angle);
    sums.worst_angle = std::max(sums.worst_angle, angle);
    const glm::dvec3 color = glm::dvec3(got.color) - glm::dvec3(wanted.color);
    sums.color += glm::dot(color, color) / 3;
    sums.roughness += square(got.color.w - wanted.color.w);
    sums.metallic += square(got.material.y - wanted.material.y);
    sums.occlusion += square(got.material.z - wanted.material.z);
}

}  // namespace

std::vector<Figure> gbuffer_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage& normals = truth.at("surface_normal");
    Sums sums;
    for (std::size_t i = 0; i < normals.texels.size(); ++i) {
        if (!normals.undecided.empty() && normals.undecided[i]) continue;
        const Texel got = texel(result, i), wanted = texel(truth, i);
        if ((got.normal.w > 0) != (wanted.normal.w > 0)) ++sums.disagreeing;
        if (got.normal.w <= 0 || wanted.normal.w <= 0) continue;
        ++sums.surfaces;
        add(sums, got, wanted);
        sums.position += square(position_error(input.frame, i, got.normal.w, wanted.normal.w));
    }
    const auto rms = [&](double sum) { return infinite_if_nan(std::sqrt(sum / std::max(1.0, sums.surfaces))); };
    std::vector<Figure> figures = {
        {"normal angle rms", "degrees", rms(sums.angle)},    {"normal angle worst", "degrees", sums.worst_angle},
        {"position rms", "of distance", rms(sums.position)}, {"base color rmse", "", rms(sums.color)},
        {"roughness rmse", "", rms(sums.roughness)},         {"metallic rmse", "", rms(sums.metallic)},
        {"occlusion rmse", "", rms(sums.occlusion)},         {"coverage differs", "samples", sums.disagreeing}};
    std::ranges::copy(gbuffer::coverage_figures(result, truth, input.frame), std::back_inserter(figures));
    return figures;
}

}  // namespace strata
