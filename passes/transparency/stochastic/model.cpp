#include "passes/transparency/stochastic/model.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "capture_format/frame/frame.h"
#include "passes/reference/shade.h"
#include "passes/reference/triangles.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"
#include "passes/transparency/rounding.h"
#include "passes/transparency/sample_blend.h"
#include "passes/transparency/stochastic/subset.shared.h"

namespace strata::transparency {
namespace {

// How far a float alpha may be from ours: textures are filtered and particles faded in float.
constexpr double alpha_rounding = 4e-6;
// And a threshold: its octave comes from a float logarithm.
constexpr double threshold_rounding = 1e-4;
// And a point, relative to its distance and that of its object: some roundings to float.
constexpr double place_rounding = 0x1p-21;

/// What a fragment draws lots with.
double lot_coverage(const Fragment& f) {
    const double mean = coverage(f);
    return mean < double(least_coverage) ? 0 : std::min(mean, 1.);
}

std::uint32_t subsample_count(const StochasticParams& params) { return params.mode == mode_hashed ? 1 : 4u << params.samples; }

double cell_number(const glm::ivec3& cell, std::uint32_t seed) {
    return ((hashed(hashed(seed), glm::uvec3(cell)) >> 8) + .5) * 0x1p-24;
}

/// Of all cells of the lattice that a cube around the point touches.
ThresholdRange lattice_numbers(const glm::dvec3& position, double reach, double scale, std::uint32_t seed) {
    const auto cell_of = [&](double aside) { return glm::ivec3(glm::floor((position + aside) * scale + .5)); };
    const glm::ivec3 low = cell_of(-reach), high = cell_of(reach);
    if (glm::any(glm::greaterThan(high - low, glm::ivec3(1)))) return {0, 1};  // so far away that any cell may be meant
    ThresholdRange range{1, 0};
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) {
                const double number = cell_number({x, y, z}, seed);
                range = {std::min(range.least, number), std::max(range.most, number)};
            }
    return range;
}

struct CoveredSubset {
    std::uint64_t bits = 0;
    bool undecided = false;
};

CoveredSubset covered_by(const SeededFragment& fragment, const StochasticParams& params) {
    const double alpha = lot_coverage(fragment.fragment);
    if (alpha == 0) return {};
    if (params.mode == mode_hashed)
        return {alpha >= fragment.threshold.most,
                alpha > fragment.threshold.least - threshold_rounding && alpha < fragment.threshold.most + threshold_rounding};
    const auto subset = [&](double a) { return covered_subset(a, fragment.key, subsample_count(params), params.subset); };
    return {subset(alpha), subset(alpha - alpha_rounding) != subset(alpha + alpha_rounding)};
}

}  // namespace

std::uint32_t subset_key(std::uint32_t seed, glm::uvec3 at, std::uint32_t draw, std::uint32_t triangle) {
    return fragment_key(seed, at, draw, triangle);
}

std::uint64_t covered_subset(double alpha, std::uint32_t key, std::uint32_t subsamples, std::uint32_t subset) {
    const auto fixed_alpha = static_cast<std::uint32_t>(std::clamp(alpha, 0., 1.) * 0x1p24);
    std::uint32_t wanted = subset_size(key, fixed_alpha, subsamples);
    std::uint64_t covered = 0;
    for (std::uint32_t s = 0; s < subsamples; ++s) {
        const bool is_in =
            subset == subset_bernoulli ? random_24_bits(key, s) < fixed_alpha : is_selected(key, s, wanted, subsamples - s);
        if (!is_in) continue;
        covered |= std::uint64_t{1} << s;
        --wanted;
    }
    return covered;
}

double mixed_uniformly(double u1, double u2, double l) {
    const double m = std::lerp(u1, u2, l), a = std::min(l, 1 - l);
    if (a == 0) return m;
    if (m < a) return m * m / (2 * a * (1 - a));
    if (m < 1 - a) return (m - a / 2) / (1 - a);
    return 1 - (1 - m) * (1 - m) / (2 * a * (1 - a));
}

ThresholdRange hashed_thresholds(const glm::dvec3& position, double reach, double octave, std::uint32_t seed) {
    const double coarse = std::floor(octave);
    const ThresholdRange u1 = lattice_numbers(position, reach, std::exp2(coarse), seed);
    const ThresholdRange u2 = lattice_numbers(position, reach, std::exp2(coarse + 1), seed);
    const auto mixed = [&](double a, double b) { return std::clamp(mixed_uniformly(a, b, octave - coarse), 1e-6, 1.); };
    return {mixed(u1.least, u2.least), mixed(u1.most, u2.most)};
}

double hashed_threshold(const glm::dvec3& position, double octave, std::uint32_t seed) {
    return hashed_thresholds(position, 0, octave, seed).least;
}

BlendedSample stochastic_blend(std::span<const SeededFragment> fragments, glm::dvec3 behind, const StochasticParams& params,
                               std::optional<Rounding> half) {
    const auto add = [&](glm::dvec3& sum, glm::dvec3 term) {
        for (int c = 0; c < 3; ++c) sum[c] = in_half(sum[c] + term[c], half);
    };
    const std::uint32_t subsamples = subsample_count(params);
    constexpr double uncovered = std::numeric_limits<double>::infinity();
    std::array<double, 64> nearest;
    nearest.fill(uncovered);
    std::vector<CoveredSubset> covered;
    BlendedSample result;
    glm::dvec3 reveal(1);
    for (const SeededFragment& fragment : fragments) {
        covered.push_back(covered_by(fragment, params));
        result.undecided |= covered.back().undecided;
        if (lot_coverage(fragment.fragment) > 0)
            for (int c = 0; c < 3; ++c) reveal[c] = in_half(reveal[c] * fragment.fragment.transmittance[c], half);
        for (std::uint32_t s = 0; s < subsamples; ++s)
            if (covered.back().bits >> s & 1) nearest[s] = std::min(nearest[s], std::max(fragment.fragment.depth, 0.));
    }

    glm::dvec3 colors(0);
    double weights = 0;
    for (std::size_t i = 0; i < fragments.size(); ++i) {
        const Fragment& fragment = fragments[i].fragment;
        std::uint64_t shown = 0;
        for (std::uint32_t s = 0; s < subsamples; ++s)
            if (std::max(fragment.depth, 0.) <= nearest[s]) shown |= std::uint64_t{1} << s;
        const double share = std::popcount(shown) / double(subsamples), alpha = lot_coverage(fragment);
        const double weight =
            params.mode == mode_depth_based ? alpha * share : std::popcount(shown & covered[i].bits) / double(subsamples);
        if (alpha > 0) add(colors, glm::min(fragment.color / alpha, glm::dvec3(half_float.largest)) * weight);
        weights = in_half(weights + weight, half);
        add(result.radiance, (fragment.emission + (alpha > 0 ? glm::dvec3(0) : fragment.color)) * share);
    }
    const auto seen = std::count(nearest.begin(), nearest.begin() + subsamples, uncovered);
    // Without a covered subsample there is no color to correct; hashed alpha is meant to be all or nothing.
    const bool corrects = params.correction == correction_alpha && params.mode != mode_hashed && weights > 0;
    const glm::dvec3 through = corrects ? reveal : glm::dvec3(double(seen) / subsamples);
    const bool normalizes = corrects || params.mode != mode_depth_based;
    result.radiance += colors * (normalizes ? (1.0 - through) / std::max(weights, 1e-7) : glm::dvec3(1)) + behind * through;
    return result;
}

namespace {

/// What a fragment is a fragment of, from its place among all triangles of the transparent draws.
class Origins {
public:
    explicit Origins(const Frame& frame) : frame_(frame) {
        std::uint32_t first = 0;
        for (const std::uint32_t draw : transparent_draws(frame)) {
            origins_.push_back({draw, first, draw_space(frame, draw)});
            first += triangle_count(frame, draw);
        }
    }

    SeededFragment seeded(const Fragment& fragment, glm::uvec3 at, const StochasticParams& params) const {
        const Origin& origin = *--std::ranges::upper_bound(origins_, fragment.submission, {}, &Origin::first_ordinal);
        const std::uint32_t triangle = fragment.submission - origin.first_ordinal;
        SeededFragment result{fragment, subset_key(params.seed, at, origin.draw, triangle)};
        if (params.mode == mode_hashed) result.threshold = thresholds(origin, triangle, at, params);
        return result;
    }

private:
    struct Origin {
        std::uint32_t draw = 0, first_ordinal = 0;
        DrawSpace space;
    };

    /// Cells are as large as a pixel on a surface that faces the eye there.
    ThresholdRange thresholds(const Origin& origin, std::uint32_t triangle, glm::uvec3 at, const StochasticParams& params) const {
        const View& view = frame_.view;
        const glm::dvec2 pixel = glm::dvec2(at) + sample_position(view.samples, at.z);
        const glm::dvec3 ray = pixel_ray(frame_, pixel.x, pixel.y);
        const double z = 1 / TriangleRays(view_corners(frame_, origin.space, origin.draw, triangle)).inverse_z(ray);
        const glm::dvec3 position = ray * z;
        const bool flat = std::abs(glm::determinant(origin.space.linear)) < 1e-30;
        const glm::dmat3 to_object = flat ? glm::transpose(origin.space.linear) : glm::inverse(origin.space.linear);
        const glm::dvec2 size(2 * z / (double(view.projection[0][0]) * view.width),
                              2 * z / (std::abs(double(view.projection[1][1])) * view.height));
        const double footprint = std::max(glm::length(to_object[0]) * size.x, glm::length(to_object[1]) * size.y);
        const double stretch = std::max({glm::length(to_object[0]), glm::length(to_object[1]), glm::length(to_object[2])});
        const double reach = place_rounding * stretch * (glm::length(position) + glm::length(origin.space.offset));
        return hashed_thresholds(to_object * (position - origin.space.offset), reach, -std::log2(footprint), params.seed);
    }

    const Frame& frame_;
    std::vector<Origin> origins_;
};

}  // namespace

ImageSet stochastic_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<StochasticParams>();
    const Origins origins(input.frame);
    const auto blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3 at) {
        std::vector<SeededFragment> seeded;
        seeded.reserve(fragments.size());
        for (const Fragment& fragment : fragments) seeded.push_back(origins.seeded(fragment, at, params));
        return stochastic_blend(seeded, behind, params, input.rounding.half);
    };
    return {{"color", blended(background(input), input, blend)}};
}

}  // namespace strata::transparency
