#include "passes/transparency/weighted/model.h"

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

double bounded(double weight) { return std::max(1e-2, std::min(3e3, weight)); }

}  // namespace

double weight_in_double(const WeightedParams& params, double near, const Fragment& f) {
    const double z = f.depth * double(params.scale), from_200 = std::pow(z / 200, 6);
    const double ninth = bounded(.03 / (1e-5 + std::pow(z / 200, 4)));
    const glm::dvec3 p = f.color + f.emission;
    switch (params.weight) {
        case weight_w7:
            return coverage(f) * bounded(10 / (1e-5 + std::pow(z / 5, 2) + from_200));
        case weight_w8:
            return coverage(f) * bounded(10 / (1e-5 + std::pow(z / 10, 3) + from_200));
        case weight_w9:
            return coverage(f) * ninth;
        // D = (zn zf / z - zf) / (zn - zf) with the far plane at infinity: 1 - D = zn / z.
        case weight_w10:
            return coverage(f) * bounded(3e3 * std::pow(near / f.depth, 3));
        case weight_blog:
            return std::max(std::min(1., std::max({p.x, p.y, p.z})), coverage(f)) * ninth;
        case weight_2015:
        case weight_2015_plain: {
            const double a = 8 * std::min(1., coverage(f)) + .01, b = .05 + .95 * near / f.depth;
            const double range = params.weight == weight_2015 ? std::sqrt(1e4 * z) : 1;
            return std::clamp(1e8 * std::pow(a * b / range, 3), 1e-2, 3e2);
        }
        default:
            return 1;
    }
}

namespace {

struct Sums {
    glm::dvec3 colors{0}, through{1};
    double coverages = 0, layers = 0;

    Sums& operator+=(const Sums& other) {
        colors += other.colors;
        through += other.through;
        coverages += other.coverages;
        layers += other.layers;
        return *this;
    }
    friend Sums operator*(const Sums& s, double share) {
        return {s.colors * share, s.through * share, s.coverages * share, s.layers * share};
    }
};

/// In half floats the sums are rounded at every blend, which is how the targets keep them.
Sums summed(std::span<const Fragment> fragments, const WeightedParams& params, double near, std::optional<Rounding> half) {
    const auto kept = [&](double sum) { return in_half(sum, half); };
    Sums sums;
    for (const Fragment& fragment : fragments) {
        const double weight = params.form == form_normalized ? weight_in_double(params, near, fragment) : 1;
        const glm::dvec3 added = (fragment.color + fragment.emission) * weight;
        for (int c = 0; c < 3; ++c) {
            sums.colors[c] = kept(sums.colors[c] + added[c]);
            sums.through[c] = kept(sums.through[c] * fragment.transmittance[c]);
        }
        sums.coverages = kept(sums.coverages + coverage(fragment) * weight);
        sums.layers += 1;
    }
    return sums;
}

/// Two resolutions of the same place.
Sums merged(const Sums& a, const Sums& b) {
    return {a.colors + b.colors, a.through * b.through, a.coverages + b.coverages, a.layers + b.layers};
}

glm::dvec3 resolved(const Sums& sums, glm::dvec3 behind, const WeightedParams& params) {
    if (params.form == form_sum) return sums.colors + behind * (1 - sums.coverages);
    glm::dvec3 through = sums.through;
    if (params.form == form_average)
        through = glm::dvec3(sums.layers > 0 ? std::pow(1 - sums.coverages / sums.layers, sums.layers) : 1);
    const glm::dvec3 colors = glm::clamp(sums.colors, -half_float.largest, half_float.largest);
    return colors / std::max(std::min(sums.coverages, half_float.largest), 1e-5) * (1.0 - through) + through * behind;
}

}  // namespace

glm::dvec3 weighted_blend(std::span<const Fragment> fragments, glm::dvec3 behind, const WeightedParams& params, double near) {
    return resolved(summed(fragments, params, near, std::nullopt), behind, params);
}

ImageSet weighted_model(const StageInput& input, const Settings& settings) {
    using Low = LowSums<Sums>;
    const auto params = settings.as<WeightedParams>();
    const View& view = input.frame.view;
    const auto sum = [&](std::span<const Fragment> fragments) {
        return summed(fragments, params, double(view.near), input.rounding.half);
    };
    const Low low(input, [&](std::span<const Fragment> fragments, glm::uvec2) -> Low::Texel { return {sum(fragments)}; });
    const auto blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3 at) -> BlendedSample {
        const Low::Texel read = low.at(place_of(glm::uvec2(at), {view.width, view.height}));
        return {resolved(merged(sum(fragments), read.sums), behind, params), read.undecided};
    };
    return {{"color", blended_at_full_resolution(background(input), input, blend)}};
}

}  // namespace strata::transparency
