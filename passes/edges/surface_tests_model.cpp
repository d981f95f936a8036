#include "passes/edges/surface_tests_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "passes/edges/edges.shared.h"
#include "passes/stage_input.h"

namespace strata::edges {
namespace {

/// How far floats may be from the values here: decoded numbers are the device's own, so some roundings of 2^-24.
constexpr double rounding = 2e-6;

Verdict above(double value, double limit, double scale) {
    if (std::abs(value - limit) <= rounding * scale) return Verdict::undecided;
    return verdict_of(value > limit);
}

Verdict either(Verdict a, Verdict b) {
    if (a == Verdict::edge || b == Verdict::edge) return Verdict::edge;
    return a == Verdict::undecided ? a : b;
}

/// Sample i against sample 0.
struct Pair {
    const StageInput& input;
    std::uint32_t x, y, sample;

    glm::dvec4 of(std::string_view image, std::uint32_t which) const { return input.before.find(image)->second.at(x, y, which); }
    glm::dvec4 first(std::string_view image) const { return of(image, 0); }
    glm::dvec4 second(std::string_view image) const { return of(image, sample); }
    double color_difference(std::string_view image) const {
        const glm::dvec3 apart = glm::abs(glm::dvec3(first(image)) - glm::dvec3(second(image)));
        return apart.x + apart.y + apart.z;
    }
};

/// By the cosine, as the limit is given to shaders: an angle itself is ill conditioned near 0.
Verdict normals_differ(const Pair& pair, double degrees) {
    const double cosine = glm::dot(glm::dvec3(pair.first("surface_normal")), glm::dvec3(pair.second("surface_normal")));
    return above(-cosine, -std::cos(degrees * std::numbers::pi / 180), 1);
}

Verdict depths_differ(const Pair& pair, double step) {
    const double a = pair.first("surface_normal").w, b = pair.second("surface_normal").w;
    return above(std::abs(a - b), step * std::min(a, b), std::max(a, b));
}

Verdict materials_differ(const Pair& pair, double step) {
    const glm::dvec4 a = pair.first("surface_material"), b = pair.second("surface_material");
    if (a.x != b.x || a.y != b.y) return Verdict::edge;
    const double apart = pair.color_difference("surface_color") + pair.color_difference("emission");
    return above(apart, step, std::max(1.0, apart));
}

}  // namespace

std::uint32_t covered_samples(const StageInput& input, std::uint32_t x, std::uint32_t y) {
    const ReferenceImage& depth = input.before.at("depth_layers");
    std::uint32_t covered = 0;
    for (std::uint32_t sample = 0; sample < depth.layers; ++sample) covered += depth.at(x, y, sample).x > 0;
    return covered;
}

Verdict surface_verdict(const StageInput& input, std::uint32_t x, std::uint32_t y, const ModelLimits& limits) {
    const std::uint32_t covered = covered_samples(input, x, y), samples = input.before.at("depth_layers").layers;
    if (covered != samples) return verdict_of(covered != 0);
    Verdict verdict = Verdict::plain;
    for (std::uint32_t sample = 1; sample < samples; ++sample) {
        const Pair pair{input, x, y, sample};
        if ((limits.tests & test_normal) != 0) verdict = either(verdict, normals_differ(pair, limits.normal_angle));
        if ((limits.tests & test_depth) != 0) verdict = either(verdict, depths_differ(pair, limits.depth_step));
        if ((limits.tests & test_material) != 0) verdict = either(verdict, materials_differ(pair, limits.color_step));
    }
    return verdict;
}

ImageSet marked(const StageInput& input, const std::function<Verdict(std::uint32_t, std::uint32_t)>& verdict_at) {
    const auto depth = input.before.find("depth_layers");
    if (depth == input.before.end() || depth->second.layers < 2) return {};
    ReferenceImage edges(depth->second.width, depth->second.height, 1, glm::dvec4(0, 0, 0, 1));
    edges.channels = 1;
    edges.undecided.assign(edges.texels.size(), false);
    for (std::uint32_t y = 0; y < edges.height; ++y) {
        for (std::uint32_t x = 0; x < edges.width; ++x) {
            const Verdict verdict = verdict_at(x, y);
            edges.at(x, y).x = verdict == Verdict::edge ? 1 : 0;
            edges.undecided[edges.index(x, y)] = verdict == Verdict::undecided;
        }
    }
    return {{"edges", edges}};
}

}  // namespace strata::edges
