#include "passes/transparency/moments/model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame_features.h"
#include "passes/reference/ordering.h"
#include "passes/stage_input.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/moments/canonical.h"
#include "passes/transparency/moments/moments.shared.h"
#include "passes/transparency/rounding.h"

namespace strata::transparency {
namespace {

constexpr double pi = 3.14159265358979323846, wrapping_zone = .1 * pi;

bool is_trigonometric(std::uint32_t kind) { return kind >= moments_trig2; }
std::size_t root_count(std::uint32_t kind) { return 2 + kind % 3; }
double phase(double w) { return (w + 1) * (pi - wrapping_zone / 2); }

/// b1, b2, ... of one fragment of optical depth 1.
std::vector<double> moments_of(std::uint32_t kind, double w) {
    std::vector<double> moments;
    for (std::size_t i = 1; i <= 2 * root_count(kind); ++i) {
        if (!is_trigonometric(kind)) {
            moments.push_back(std::pow(w, double(i)));
            continue;
        }
        const double angle = double((i + 1) / 2) * phase(w);
        moments.push_back(i % 2 ? std::cos(angle) : std::sin(angle));
    }
    return moments;
}

/// Even power moments of the distribution that a degenerate one is mixed with; trigonometric ones are 0.
std::vector<double> bias_moments(const MomentsParams& params) {
    static constexpr double fine[3][4] = {{.375, .375}, {.48, .451, .45}, {.75, .67666667, .63, .6003030303}};
    static constexpr double coarse[3][4] = {
        {.628, .628}, {.5566, .489, .47869382}, {.4247491639, .2240780268, .1536923077, .1290044053}};
    std::vector<double> moments(2 * root_count(params.kind), 0.);
    if (is_trigonometric(params.kind)) return moments;
    const auto& even = (params.storage == storage_normalized ? coarse : fine)[params.kind % 3];
    for (std::size_t i = 0; i < root_count(params.kind); ++i) moments[2 * i + 1] = even[i];
    return moments;
}

/// b0 and the others as the storage keeps them, fragment by fragment in submission order. FP32 is part of it: the bias of 5e-7 is
/// only a few of its steps.
std::vector<double> stored(const MomentsParams& params, std::span<const WarpedFragment> projected, Rounding half) {
    std::vector<double> kept(1 + 2 * root_count(params.kind), 0.);
    for (const WarpedFragment& fragment : projected) {
        const std::vector<double> moments = moments_of(params.kind, fragment.w);
        const double tau = std::min(fragment.optical_depth, double(largest_moment_depth)), before = kept[0];
        if (tau <= 0) continue;
        if (params.storage == storage_normalized) {
            std::vector<double> mixed = moments;
            if (before > 0) {
                mixed = dequantized(params.kind, std::span(kept).subspan(1));
                for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i] += (moments[i] - mixed[i]) * tau / (before + tau);
            }
            kept[0] = before + tau;
            std::ranges::copy(quantized(params.kind, mixed), kept.begin() + 1);
            continue;
        }
        const auto added = [&](double sum, double term) {
            return params.storage == storage_half ? rounded(sum + term, half_float, half)
                                                  : double(static_cast<float>(sum + term));
        };
        kept[0] = added(before, tau);
        for (std::size_t i = 0; i < moments.size(); ++i) kept[i + 1] = added(kept[i + 1], tau * moments[i]);
    }
    return kept;
}

/// Muenstermann et al. 2018, section 5.2 and table 1: by kind, for sums in FP32 and for 16 bits. FP16 sums are not in the paper.
double bias_of(const MomentsParams& params) {
    struct Row {
        double sums_32, normalized_16;
    };
    static constexpr Row rows[] = {{5e-7, 6e-5}, {5e-6, 6e-4}, {5e-5, 2.5e-3}, {4e-7, 4e-4}, {8e-7, 6.5e-4}, {1.5e-6, 8.5e-4}};
    if (params.storage == storage_half) return 5e-3;
    const Row& row = rows[params.kind];
    return params.storage == storage_single ? row.sums_32 : row.normalized_16;
}

double transmittance_of(const MomentsParams& params, std::span<const double> kept, double w, double own_optical_depth) {
    const double total = kept[0];
    if (total < double(least_moment_depth)) return 1;
    std::vector<double> moments(kept.begin() + 1, kept.end());
    if (params.storage == storage_normalized) {
        moments = dequantized(params.kind, moments);
    } else {
        for (double& moment : moments) moment /= total;
    }
    const std::vector<double> mixed_in = bias_moments(params);
    const double bias = double(params.bias) * bias_of(params);
    for (std::size_t i = 0; i < moments.size(); ++i) moments[i] += (mixed_in[i] - moments[i]) * bias;
    const double share = absorbance_share(params.kind, moments, w, double(params.overestimation));
    const double own = params.compensation == compensation_own ? double(params.overestimation) * own_optical_depth : 0;
    return std::exp(std::min(own - total * share, 0.));
}

double moment_depth(const Fragment& f, std::size_t channel, std::size_t channels) {
    return std::min(channel_depth(f, channel, channels), double(largest_moment_depth));
}

}  // namespace

double absorbance_share(std::uint32_t kind, std::span<const double> moments, double w, double overestimation) {
    if (!is_trigonometric(kind)) return power_share(moments, w, overestimation);
    return circle_share(moments, phase(w), 2 * pi - wrapping_zone, overestimation);
}

double transmittance_in_double(const MomentsParams& params, std::span<const WarpedFragment> projected, double w,
                               double own_optical_depth) {
    return transmittance_of(params, stored(params, projected, Rounding::to_nearest), w, own_optical_depth);
}

ImageSet moments_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<MomentsParams>();
    const std::size_t channels = channel_count(params.channels, frame_features(input.frame));
    const std::size_t numbers = 1 + 2 * root_count(params.kind);
    const DepthRange range = transparent_depth_range(input.frame);
    const double log_nearest = std::log(double(range.nearest)), log_range = std::log(double(range.farthest)) - log_nearest;
    const auto warped = [=](double z) { return std::clamp(2 * (std::log(z) - log_nearest) / log_range - 1, -1., 1.); };

    const Rounding half = input.rounding.half;

    PrepassModel prepass{.divisor = divisor_of(params.resolution)};
    prepass.project = [=](std::span<const Fragment> fragments, glm::uvec2) {
        std::vector<double> all;
        for (std::size_t channel = 0; channel < channels; ++channel) {
            std::vector<WarpedFragment> projected;
            for (const Fragment& f : fragments) projected.push_back({warped(f.depth), moment_depth(f, channel, channels)});
            const std::vector<double> kept = stored(params, projected, half);
            all.insert(all.end(), kept.begin(), kept.end());
        }
        return all;
    };
    prepass.function = [=](std::span<const double> kept, glm::uvec2) -> Transmittance {
        return [=](const Fragment& f) {
            glm::dvec3 through(0);
            for (std::size_t channel = 0; channel < channels; ++channel)
                through[static_cast<int>(channel)] = transmittance_of(params, kept.subspan(channel * numbers, numbers),
                                                                      warped(f.depth), moment_depth(f, channel, channels));
            return channels == 1 ? glm::dvec3(through.x) : through;
        };
    };
    return function_model(input, params.accumulation, prepass);
}

}  // namespace strata::transparency
