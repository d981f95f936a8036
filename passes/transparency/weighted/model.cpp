#include "passes/transparency/weighted/model.h"

#include <algorithm>
#include <cmath>

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

glm::dvec3 weighted_blend(std::span<const Fragment> fragments, glm::dvec3 behind, const WeightedParams& params, double near,
                          SumsIn format) {
    const auto kept = [&](double sum) { return format == SumsIn::halves ? rounded(sum, half_float) : sum; };
    glm::dvec3 colors(0), through(1);
    double coverages = 0;
    for (const Fragment& fragment : fragments) {
        const double weight = params.form == form_normalized ? weight_in_double(params, near, fragment) : 1;
        const glm::dvec3 added = (fragment.color + fragment.emission) * weight;
        for (int c = 0; c < 3; ++c) {
            colors[c] = kept(colors[c] + added[c]);
            through[c] = kept(through[c] * fragment.transmittance[c]);
        }
        coverages = kept(coverages + coverage(fragment) * weight);
    }
    if (params.form == form_sum) return colors + behind * (1 - coverages);
    const auto layers = double(fragments.size());
    if (params.form == form_average) through = glm::dvec3(fragments.empty() ? 1 : std::pow(1 - coverages / layers, layers));
    colors = glm::clamp(colors, -half_float.largest, half_float.largest);
    return colors / std::max(std::min(coverages, half_float.largest), 1e-5) * (glm::dvec3(1) - through) + through * behind;
}

ImageSet weighted_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<WeightedParams>();
    const double near = double(input.frame.view.near);
    const SampleBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind) {
        return weighted_blend(fragments, behind, params, near, SumsIn::halves);
    };
    return {{"color", blended(input.before.at("color"), input.frame, input.before, blend)}};
}

}  // namespace strata::transparency
