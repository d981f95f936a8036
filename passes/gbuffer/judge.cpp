#include "passes/gbuffer/judge.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>

#include "capture_format/frame/frame.h"
#include "passes/gbuffer/coverage/judge.h"
#include "passes/reference/place_code.h"
#include "passes/reference/shade.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

struct Sums {
    double angle = 0, angles = 0, worst_angle = 0, along = 0, across = 0, color = 0, roughness = 0, metallic = 0, occlusion = 0;
    double surfaces = 0, other_models = 0, disagreeing = 0;
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

/// Where a reader of the texel under a sample finds its surface.
glm::dvec3 read_position(const Frame& frame, std::size_t i, const Texel& t) {
    const View& view = frame.view;
    const std::size_t pixel = i % (std::size_t(view.width) * view.height);
    const std::size_t column = pixel % view.width, row = pixel / view.width;
    const glm::dvec2 at = glm::dvec2(column, row) + 0.5 + offset_of_place_code(t.material.w);
    return pixel_ray(frame, at.x, at.y) * t.normal.w;
}

/// Along the eye's ray to the true place and across it, relative to the distance.
void add_position(Sums& sums, const glm::dvec3& got, const glm::dvec3& wanted) {
    const double distance = glm::length(wanted), along = glm::dot(got - wanted, wanted) / distance;
    sums.along += square(along / distance);
    const glm::dvec3 aside = got - wanted - wanted * (along / distance);
    sums.across += glm::dot(aside, aside) / square(distance);
}

void add(Sums& sums, const Texel& got, const Texel& wanted) {
    const double angle = degrees_between(got.normal, wanted.normal);
    sums.angle += square(angle);
    sums.angles += angle;
    sums.worst_angle = std::max(sums.worst_angle, angle);
    const glm::dvec3 color = glm::dvec3(got.color) - glm::dvec3(wanted.color);
    sums.color += glm::dot(color, color) / 3;
    sums.roughness += square(got.color.w - wanted.color.w);
    sums.metallic += square(got.material.y - wanted.material.y);
    sums.occlusion += square(got.material.z - wanted.material.z);
    sums.other_models += got.material.x != wanted.material.x;
}

bool exists(const Texel& t) { return t.normal.w > 0; }

/// How unlike two surfaces are: squares of the angle in radians, of the relative distance in depth and of what is stored from 0
/// to 1.
double unlikeness(const Texel& a, const Texel& b) {
    if (exists(a) != exists(b)) return HUGE_VAL;
    if (!exists(a)) return 0;
    const double angle = glm::radians(degrees_between(a.normal, b.normal));
    const glm::dvec4 color = a.color - b.color;
    const glm::dvec2 material(a.material.y - b.material.y, a.material.z - b.material.z);
    return square(angle) + square((a.normal.w - b.normal.w) / b.normal.w) + glm::dot(color, color) +
           glm::dot(material, material) + (a.material.x != b.material.x);
}

/// Alternatives of one texel: places in the lists of all images, which run side by side.
struct Rivals {
    std::size_t begin = 0, end = 0;
};

Texel alternative(const ImageSet& images, std::size_t k) {
    const auto value = [&](std::string_view name) { return images.find(name)->second.alternatives[k].value; };
    return {value("surface_normal"), value("surface_color"), value("surface_material")};
}

/// In degrees; 0 where at most one of the surfaces exists.
double largest_angle(const ImageSet& truth, std::size_t texel_index, const Rivals& rivals) {
    std::vector<glm::dvec3> normals;
    const auto add = [&](const Texel& t) {
        if (exists(t)) normals.emplace_back(t.normal);
    };
    add(texel(truth, texel_index));
    for (std::size_t k = rivals.begin; k < rivals.end; ++k) add(alternative(truth, k));
    double largest = 0;
    for (const glm::dvec3& a : normals)
        for (const glm::dvec3& b : normals) largest = std::max(largest, degrees_between(a, b));
    return largest;
}

}  // namespace

Metric settle_gbuffer(const ImageSet& result, ImageSet& truth) {
    const ReferenceImage& normals = truth.at("surface_normal");
    double squared_angles = 0, surfaces = 0;
    for (const glm::dvec4& normal : normals.texels) surfaces += normal.w > 0;
    const std::size_t count = normals.alternatives.size();
    for (Rivals rivals{}; rivals.begin < count; rivals.begin = rivals.end) {
        const std::size_t i = normals.alternatives[rivals.begin].texel;
        while (rivals.end < count && normals.alternatives[rivals.end].texel == i) ++rivals.end;
        if (!normals.undecided[i]) continue;
        squared_angles += square(largest_angle(truth, i, rivals));
        const Texel got = texel(result, i);
        double least = unlikeness(got, texel(truth, i));
        std::optional<std::size_t> nearest;
        for (std::size_t k = rivals.begin; k < rivals.end; ++k) {
            const double unlike = unlikeness(got, alternative(truth, k));
            if (unlike >= least) continue;
            least = unlike;
            nearest = k;
        }
        for (auto& [name, image] : truth) {
            if (image.alternatives.empty()) continue;
            if (nearest && name == "depth_layers")
                image.texels[i].x = image.alternatives[*nearest].value.x;  // the rest is of the pixel
            if (nearest && name != "depth_layers") image.texels[i] = image.alternatives[*nearest].value;
            image.undecided[i] = false;
        }
    }
    for (auto& [name, image] : truth) image.alternatives.clear();
    return {"normal angle rms", "degrees", std::sqrt(squared_angles / std::max(1.0, surfaces))};
}

std::vector<Metric> gbuffer_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage& normals = truth.at("surface_normal");
    Sums sums;
    for (std::size_t i = 0; i < normals.texels.size(); ++i) {
        if (!normals.undecided.empty() && normals.undecided[i]) continue;
        const Texel got = texel(result, i), wanted = texel(truth, i);
        if ((got.normal.w > 0) != (wanted.normal.w > 0)) ++sums.disagreeing;
        if (got.normal.w <= 0 || wanted.normal.w <= 0) continue;
        ++sums.surfaces;
        add(sums, got, wanted);
        add_position(sums, read_position(input.frame, i, got), read_position(input.frame, i, wanted));
    }
    const double surfaces = std::max(1.0, sums.surfaces);
    const auto mean = [&](double sum) { return infinite_if_nan(sum / surfaces); };
    const auto rms = [&](double sum) { return infinite_if_nan(std::sqrt(sum / surfaces)); };
    std::vector<Metric> metrics = {{"normal angle rms", "degrees", rms(sums.angle)},
                                   {"normal angle worst", "degrees", sums.worst_angle},
                                   {"normal angle mean", "degrees", mean(sums.angles)},
                                   {"position along", "of distance", rms(sums.along)},
                                   {"position across", "of distance", rms(sums.across)},
                                   {"base color rmse", "", rms(sums.color), true},
                                   {"roughness rmse", "", rms(sums.roughness), true},
                                   {"metallic rmse", "", rms(sums.metallic), true},
                                   {"occlusion rmse", "", rms(sums.occlusion)},
                                   {"other lighting model", "%", 100 * mean(sums.other_models)},
                                   {"coverage differs", "samples", sums.disagreeing, true}};
    std::ranges::copy(gbuffer::coverage_metrics(result, truth, input.frame), std::back_inserter(metrics));
    return metrics;
}

}  // namespace strata
