#include "passes/rain/judge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "passes/rain/formulas.h"
#include "passes/reference/decoded.h"
#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

double infinite_if_nan(double error) { return std::isnan(error) ? HUGE_VAL : error; }

// atan2 and not acos, which loses small angles.
double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return infinite_if_nan(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi);
}

/// Base color and roughness: what water changes whichever way the surface looks.
double distance(const glm::dvec4& a, const glm::dvec4& b) { return glm::length(a - b); }

struct Texel {
    glm::dvec4 dry, got, wanted;  ///< of surface_color
};

/// Wet where dry is true, or the other way: nearer to the wrong one of what the sample is with and without rain. Nothing where
/// rain makes no difference.
enum class Verdict { right, wrong, no_difference };
Verdict verdict(const Texel& t, const glm::dvec4& fully_wet) {
    constexpr double visible = 0.02;  // twice what 8 bits per channel lose
    const bool is_wet = distance(t.wanted, t.dry) > 0;
    const glm::dvec4 other = is_wet ? t.dry : fully_wet;
    if (distance(t.wanted, other) < visible) return Verdict::no_difference;
    return distance(t.got, other) < distance(t.got, t.wanted) ? Verdict::wrong : Verdict::right;
}

struct Sums {
    double color = 0, roughness = 0, angle = 0, worst_angle = 0, surfaces = 0, wrong = 0, told_apart = 0;

    void add(const Texel& t, double degrees, Verdict wetness) {
        const glm::dvec3 off(t.got - t.wanted);
        color += glm::dot(off, off) / 3;
        roughness += std::pow(t.got.w - t.wanted.w, 2);
        angle += degrees * degrees;
        worst_angle = std::max(worst_angle, degrees);
        wrong += wetness == Verdict::wrong;
        told_apart += wetness != Verdict::no_difference;
        ++surfaces;
    }
};

glm::dvec4 fully_wet_color(const StageInput& input, const DecodedTexels& texels, std::uint32_t x, std::uint32_t y) {
    const SurfacePoint wet = rain::wet_surface(input.frame, decoded_surface(input.frame, texels, x, y), {}, 1);
    return glm::dvec4(wet.base_color, wet.roughness);
}

}  // namespace

std::vector<Metric> rain_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage &wanted = truth.at("surface_color"), &wanted_normal = truth.at("surface_normal");
    const ReferenceImage &got = result.at("surface_color"), &got_normal = result.at("surface_normal");
    Sums sums;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (wanted_normal.texels[i].w <= 0 || !decided(got, wanted, i)) continue;
        const DecodedTexels dry{input.before.at("surface_normal").texels[i], input.before.at("surface_color").texels[i],
                                input.before.at("surface_material").texels[i]};
        const auto x = static_cast<std::uint32_t>(i % wanted.width);
        const auto y = static_cast<std::uint32_t>(i / wanted.width % wanted.height);
        const Texel texel{dry.color, got.texels[i], wanted.texels[i]};
        const double angle = degrees_between(glm::dvec3(got_normal.texels[i]), glm::dvec3(wanted_normal.texels[i]));
        sums.add(texel, angle, verdict(texel, fully_wet_color(input, dry, x, y)));
    }
    const auto rms = [&](double sum) { return infinite_if_nan(std::sqrt(sum / std::max(1.0, sums.surfaces))); };
    return {{"base color rmse", "", rms(sums.color)},
            {"roughness rmse", "", rms(sums.roughness)},
            {"normal angle rms", "degrees", rms(sums.angle)},
            {"normal angle worst", "degrees", sums.worst_angle, true},
            {"wrongly wet or dry", "% of samples", 100 * sums.wrong / std::max(1.0, sums.told_apart)}};
}

}  // namespace strata
