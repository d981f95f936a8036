#include "passes/transparency/weighted_additive/model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"
#include "passes/transparency/low_resolution/model.h"
#include "passes/transparency/rounding.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

constexpr double largest_half = half_float.largest;

double saturated(double value) { return std::clamp(value, 0., 1.); }
glm::dvec3 bounded(const glm::dvec3& v) { return glm::clamp(v, -largest_half, largest_half); }
double mean(const glm::dvec3& v) { return (v.x + v.y + v.z) / 3; }
double covered(const Fragment& f) { return saturated(coverage(f)); }
double relative_emission(const Fragment& f, double exposure) { return luminance(f.emission) * exposure; }

double stored(double value, const WeightedAdditiveParams& params, std::optional<Rounding> half) {
    return params.reveal == reveal_r8 ? std::round(saturated(value) * 255) / 255 : in_half(value, half);
}

}  // namespace

double additive_depth_weight(const WeightedAdditiveParams& params, double z) {
    const double near = .5, far = double(params.far);
    const double canonical = saturated(far / (far - near) - far * near / (z * (far - near)));
    return std::min(1e4 * std::pow(1 - canonical, 3) + 5, 20.);
}

double additive_weight(const WeightedAdditiveParams& params, double exposure, const Fragment& f) {
    const double emission = saturated(relative_emission(f, exposure)) / double(params.feather_start);
    return additive_depth_weight(params, f.depth) * std::pow(saturated(3 * covered(f) + emission), 3);
}

AdditiveSums summed(std::span<const Fragment> fragments, const WeightedAdditiveParams& params, double exposure,
                    std::optional<Rounding> half) {
    AdditiveSums sums;
    const auto add = [&](double& sum, double term) { sum = in_half(sum + term, half); };
    const auto add_color = [&](glm::dvec3& sum, glm::dvec3 term) {
        for (int c = 0; c < 3; ++c) add(sum[c], term[c]);
    };
    const glm::dvec3 brightest(1000);
    for (const Fragment& f : fragments) {
        const double weight = additive_weight(params, exposure, f);
        if (params.normalization == normalization_published) {
            add_color(sums.colors, glm::min(f.color + f.emission, brightest) * weight);
            add(sums.weights, weight);
        } else {
            add_color(sums.colors, glm::min(f.color, brightest) * weight);
            add(sums.weights, covered(f) * weight);
            add_color(sums.emissions, glm::min(f.emission, brightest) * weight);
            if (f.emission != glm::dvec3(0)) add(sums.emission_weights, weight);
        }
        for (int c = 0; c < 3; ++c) sums.reveal[c] = stored(sums.reveal[c] * f.transmittance[c], params, half);
        sums.additiveness = stored(sums.additiveness + saturated(10 * relative_emission(f, exposure)) / 8, params, half);
    }
    return merged(sums, {});
}

AdditiveSums merged(const AdditiveSums& a, const AdditiveSums& b) {
    return {.colors = bounded(a.colors + b.colors),
            .emissions = bounded(a.emissions + b.emissions),
            .weights = std::min(a.weights + b.weights, largest_half),
            .emission_weights = std::min(a.emission_weights + b.emission_weights, largest_half),
            .reveal = a.reveal * b.reveal,
            .additiveness = a.additiveness + b.additiveness};
}

glm::dvec3 composite(const AdditiveSums& sums, glm::dvec3 behind, const WeightedAdditiveParams& params) {
    const double reveal = mean(sums.reveal), layers = 8 * sums.additiveness;
    const glm::dvec3 average = sums.colors / std::max(sums.weights, 1e-5);
    const glm::dvec3 largest = glm::max(sums.colors, sums.emissions);
    glm::dvec3 light(100);
    if (std::max({largest.x, largest.y, largest.z}) < largest_half) {
        if (params.normalization == normalization_published) {
            light = average * std::max(layers / 4 * (1 - reveal) + layers * reveal + std::min(2 * (1 - reveal), 1.), 1.);
        } else {
            const glm::dvec3 emitted = sums.emissions / std::max(sums.emission_weights, 1e-5);
            light = average * (1.0 - sums.reveal) + emitted * std::max(layers, 1.) * (reveal + (1 - reveal) / 4);
        }
    }
    return light + behind * sums.reveal;
}

AdditiveSums& AdditiveSums::operator+=(const AdditiveSums& other) {
    colors += other.colors;
    emissions += other.emissions;
    weights += other.weights;
    emission_weights += other.emission_weights;
    reveal += other.reveal;
    additiveness += other.additiveness;
    return *this;
}

AdditiveSums operator*(const AdditiveSums& sums, double share) {
    return {.colors = sums.colors * share,
            .emissions = sums.emissions * share,
            .weights = sums.weights * share,
            .emission_weights = sums.emission_weights * share,
            .reveal = sums.reveal * share,
            .additiveness = sums.additiveness * share};
}

ImageSet weighted_additive_model(const StageInput& input, const Settings& settings) {
    using Low = LowSums<AdditiveSums>;
    const auto params = settings.as<WeightedAdditiveParams>();
    const View& view = input.frame.view;
    const Low low(input, [&](std::span<const Fragment> fragments, glm::uvec2) -> Low::Texel {
        return {summed(fragments, params, double(view.exposure), input.rounding.half)};
    });
    const auto blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3 at) -> BlendedSample {
        const Low::Texel read = low.at(place_of(glm::uvec2(at), {view.width, view.height}));
        const AdditiveSums all = merged(summed(fragments, params, double(view.exposure), input.rounding.half), read.sums);
        return {composite(all, behind, params), read.undecided};
    };
    return {{"color", blended_at_full_resolution(background(input), input, blend)}};
}

}  // namespace strata::transparency
