// Facts about stochastic transparency and hashed alpha (docs/algorithms/transparency.md 2.6): expectation, variance,
// repeatability.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "passes/transparency/stochastic/model.h"
#include "passes/transparency/stochastic/subset.shared.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

constexpr std::uint32_t many = 200000;

struct Spread {
    double mean = 0, deviation = 0;
};

template <typename Value>
Spread over_pixels(Value value, std::uint32_t pixels = many) {
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < pixels; ++i) {
        const double v = value(glm::uvec3(i % 1024, i / 1024, 0));
        sum += v, squares += v * v;
    }
    const double mean = sum / pixels;
    return {mean, std::sqrt(std::max(0., squares / pixels - mean * mean))};
}

double blend(std::span<const Fragment> fragments, double behind, const StochasticParams& params, glm::uvec3 at) {
    std::vector<SeededFragment> seeded;
    for (std::uint32_t i = 0; i < fragments.size(); ++i) seeded.push_back({fragments[i], fragment_key(params.seed, at, i, 0)});
    return stochastic_blend(seeded, glm::dvec3(behind), params).radiance.x;
}

Spread blends(std::span<const Fragment> fragments, double behind, const StochasticParams& params) {
    return over_pixels([&](glm::uvec3 at) { return blend(fragments, behind, params, at); });
}

StochasticParams uncorrected(std::uint32_t subset, std::uint32_t mode = mode_layered) {
    return {.samples = 1, .subset = subset, .correction = correction_none, .mode = mode};
}

TEST(StochasticSubset, CoversItsAlphaOnAverage) {
    for (const std::uint32_t subset : {subset_bernoulli, subset_stratified})
        for (const double alpha : {.01, .3, .5, .97}) {
            const Spread share = over_pixels(
                [&](glm::uvec3 at) { return std::popcount(covered_subset(alpha, fragment_key(0, at, 0, 0), 8, subset)) / 8.; });
            EXPECT_NEAR(share.mean, alpha, 2e-3) << subset;
            EXPECT_LE(share.deviation, std::sqrt(alpha * (1 - alpha) / 8) * 1.01) << subset;
        }
}

TEST(StochasticSubset, OfOnePercentCoversOneOfEightSubsamplesWithProbabilityEightPercent) {
    const Spread covers = over_pixels([](glm::uvec3 at) {
        return double(std::popcount(covered_subset(.01, fragment_key(0, at, 0, 0), 8, subset_stratified)));
    });
    EXPECT_NEAR(covers.mean, .08, 2e-3);
    EXPECT_NEAR(covers.deviation, std::sqrt(.08 * .92), 2e-3) << "one or none";
}

TEST(StochasticSubset, HasNoVarianceWhereAlphaIsAWholeNumberOfSubsamples) {
    for (std::uint32_t n = 0; n <= 64; ++n)
        for (std::uint32_t x = 0; x < 200; ++x) {
            const std::uint64_t subset = covered_subset(n / 64., fragment_key(3, {x, 0, 0}, 0, 0), 64, subset_stratified);
            EXPECT_EQ(std::popcount(subset), int(n));
        }
}

TEST(StochasticSubset, CoversAllOrNothingAtTheEndsOfAlpha) {
    for (const std::uint32_t subset : {subset_bernoulli, subset_stratified})
        for (std::uint32_t x = 0; x < 1000; ++x) {
            EXPECT_EQ(covered_subset(1, fragment_key(0, {x, 0, 0}, 0, 0), 8, subset), 255u);
            EXPECT_EQ(covered_subset(0, fragment_key(0, {x, 0, 0}, 0, 0), 8, subset), 0u);
        }
}

TEST(StochasticSubset, PrefersNoSubsample) {
    for (const std::uint32_t subset : {subset_bernoulli, subset_stratified})
        for (int s = 0; s < 8; ++s) {
            const Spread covers = over_pixels(
                [&](glm::uvec3 at) { return double(covered_subset(.4, fragment_key(0, at, 0, 0), 8, subset) >> s & 1); });
            EXPECT_NEAR(covers.mean, .4, 4e-3) << s;
        }
}

TEST(StochasticSubset, IsTheSameForTheHalvesOfAQuadAndAnotherForAnotherQuad) {
    const glm::uvec3 at{7, 9, 1};
    EXPECT_EQ(fragment_key(0, at, 2, 6), fragment_key(0, at, 2, 7));
    EXPECT_NE(fragment_key(0, at, 2, 6), fragment_key(0, at, 2, 8));
    EXPECT_NE(fragment_key(0, at, 2, 6), fragment_key(0, at, 3, 6));
    EXPECT_NE(fragment_key(0, at, 2, 6), fragment_key(1, at, 2, 6));
    EXPECT_NE(fragment_key(0, at, 2, 6), fragment_key(0, {9, 7, 1}, 2, 6));
}

TEST(StochasticLayers, ShowAQuarterOfTheSecondOfTwoHalves) {
    // White behind black: what is seen is how much of the second shows. Deviations: .4330 / sqrt(8), and hypergeometric.
    const std::array two{layer(1, .5, 0), layer(2, .5, 1)};
    const Spread bernoulli = blends(two, 0, uncorrected(subset_bernoulli)),
                 stratified = blends(two, 0, uncorrected(subset_stratified));
    EXPECT_NEAR(bernoulli.mean, .25, 1e-3);
    EXPECT_NEAR(bernoulli.deviation, .1531, 1e-3);
    EXPECT_NEAR(stratified.mean, .25, 1e-3);
    EXPECT_NEAR(stratified.deviation, .0945, 1e-3);
}

TEST(StochasticLayers, AreRightOnAverageWithoutCorrection) {
    const std::array fragments{layer(3, .3, .2), layer(1, .6, .9), layer(2, .15, .5)};
    const double exact = exact_blend(fragments, glm::dvec3(1)).x;
    for (const std::uint32_t subset : {subset_bernoulli, subset_stratified})
        for (const std::uint32_t mode : {mode_layered, mode_depth_based})
            EXPECT_NEAR(blends(fragments, 1, uncorrected(subset, mode)).mean, exact, 2e-3) << subset << mode;
}

TEST(StochasticLayers, HaveTheVarianceOfASingleLayerThatEachSubsetHas) {
    const std::array one{layer(1, .3, 1)};
    EXPECT_NEAR(blends(one, 0, uncorrected(subset_bernoulli)).deviation, std::sqrt(.3 * .7 / 8), 1e-3);
    EXPECT_NEAR(blends(one, 0, uncorrected(subset_stratified)).deviation, std::sqrt(.4 * .6) / 8, 1e-3) << "2 or 3 of 8";
    EXPECT_EQ(blends(std::array{layer(1, .25, 1)}, 0, uncorrected(subset_stratified)).deviation, 0);
}

TEST(AlphaCorrection, MakesOneLayerExactAndTheBackgroundOfManyWithoutNoise) {
    const StochasticParams params{.samples = 1, .subset = subset_stratified, .correction = correction_alpha};
    const Spread one = blends(std::array{layer(1, .3, .7)}, .5, params);
    EXPECT_NEAR(one.mean, .3 * .7 + .7 * .5, 1e-9);
    EXPECT_LT(one.deviation, 1e-5);
    const Spread black = blends(std::array{layer(1, .3, 0), layer(2, .6, 0)}, 1, params);
    EXPECT_NEAR(black.mean, .7 * .4, 1e-9);
    EXPECT_LT(black.deviation, 1e-5);
}

TEST(AlphaCorrection, LosesThinLayersThatNoSubsampleCovers) {
    // Where one does the pixel is exact; elsewhere, in 92 % of the pixels, the layer is not there at all.
    const StochasticParams params{.samples = 1, .subset = subset_stratified, .correction = correction_alpha};
    EXPECT_NEAR(blends(std::array{layer(1, .01, 1)}, 0, params).mean, .01 * .08, 5e-5);
    EXPECT_NEAR(blends(std::array{layer(1, .01, 0)}, 1, params).mean, 1 - .01 * .08, 5e-5);
    StochasticParams by_depth = params;
    by_depth.mode = mode_depth_based;
    EXPECT_NEAR(blends(std::array{layer(1, .01, 1)}, 0, by_depth).mean, .01, 1e-9);
}

TEST(DepthBased, IsLessNoisyThanTheNearestLayers) {
    std::vector<Fragment> fragments;
    for (int i = 0; i < 12; ++i) fragments.push_back(layer(1 + i, .2, i % 2));
    const double layered = blends(fragments, 0, uncorrected(subset_stratified)).deviation;
    EXPECT_LT(blends(fragments, 0, uncorrected(subset_stratified, mode_depth_based)).deviation, .7 * layered);
}

TEST(DepthBased, EstimatesTransmittanceInStepsOfASubsample) {
    // Nothing but the second layer's share of 8 subsamples: alpha T with T = n / 8.
    const std::array two{layer(1, .5, 0), layer(2, .5, 1)};
    const auto steps = [&](glm::uvec3 at) { return 16 * blend(two, 0, uncorrected(subset_bernoulli, mode_depth_based), at); };
    for (std::uint32_t x = 0; x < 1000; ++x) EXPECT_NEAR(steps({x, 0, 0}), std::round(steps({x, 0, 0})), 1e-12);
}

TEST(StochasticLayers, DimEmissionByWhatStandsInFrontAndCountItOnce) {
    for (const std::uint32_t correction : {correction_none, correction_alpha}) {
        const StochasticParams params{.samples = 1, .subset = subset_stratified, .correction = correction};
        const std::array fragments{layer(1, .5, 0), Fragment{.depth = 2, .emission = glm::dvec3(.3)}};
        EXPECT_NEAR(blends(fragments, 0, params).mean, .15, 1e-9);
        EXPECT_EQ(blend(std::array{Fragment{.depth = 2, .emission = glm::dvec3(.3)}}, .25, params, {}), .55);
    }
}

TEST(StochasticLayers, HideEverythingBehindAnOpaqueLayer) {
    for (const std::uint32_t mode : {mode_layered, mode_depth_based}) {
        const std::array fragments{layer(1, 1, .25), layer(2, .5, 1000), Fragment{.depth = 3, .emission = glm::dvec3(1e6)}};
        EXPECT_EQ(blend(fragments, 1e9, {.samples = 1, .correction = correction_alpha, .mode = mode}, {}), .25);
        EXPECT_EQ(blend({}, .123, {.samples = 1, .correction = correction_alpha, .mode = mode}, {}), .123);
    }
}

TEST(StochasticLayers, AtOneDepthShareWhatTheyCover) {
    const std::array two{layer(1, .5, 1), layer(1, .5, 0)};
    for (const std::uint32_t correction : {correction_none, correction_alpha})
        EXPECT_NEAR(blends(two, 0, {.samples = 1, .subset = subset_stratified, .correction = correction}).mean, .375, 2e-3);
}

TEST(HashedAlpha, IsUniformWhateverTheMixtureOfItsLattices) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-500, 500);
    for (const double l : {0., .1, .5, .9}) {
        std::vector<double> thresholds(1000000);
        double sum = 0;
        for (double& threshold : thresholds) {
            threshold = hashed_threshold({anywhere(random), anywhere(random), anywhere(random)}, 3 + l, 0);
            sum += threshold;
        }
        std::ranges::sort(thresholds);
        double distance = 0;  // Kolmogorov and Smirnov's
        for (std::size_t i = 0; i < thresholds.size(); ++i)
            distance = std::max(distance, std::abs(thresholds[i] - (double(i) + .5) / double(thresholds.size())));
        EXPECT_NEAR(sum / double(thresholds.size()), .5, .002) << l;
        EXPECT_LT(distance, .004) << l;
        for (const double alpha : {.1, .5, .9}) {
            const auto passing = std::ranges::upper_bound(thresholds, alpha) - thresholds.begin();
            EXPECT_NEAR(double(passing) / double(thresholds.size()), alpha, .004) << l;
        }
    }
}

TEST(HashedAlpha, MixesByTheThreeCasesOfItsDistribution) {
    EXPECT_EQ(mixed_uniformly(.3, .9, 0), .3);
    EXPECT_EQ(mixed_uniformly(.3, .9, 1), .9);
    EXPECT_DOUBLE_EQ(mixed_uniformly(.5, .5, .3), .5) << "symmetric";
    EXPECT_DOUBLE_EQ(mixed_uniformly(.2, .2, .4), .2 * .2 / (2 * .4 * .6));
    EXPECT_DOUBLE_EQ(mixed_uniformly(.4, .4, .1), (.4 - .05) / .9);
    EXPECT_DOUBLE_EQ(mixed_uniformly(.8, .8, .4), 1 - .2 * .2 / (2 * .4 * .6));
}

TEST(HashedAlpha, StaysWithTheSurface) {
    const glm::dvec3 point{.3, .7, -1.1};
    EXPECT_EQ(hashed_threshold(point, 3.5, 0), hashed_threshold(point + 1e-4, 3.5, 0));
    EXPECT_NE(hashed_threshold(point, 3.5, 0), hashed_threshold(point, 3.5, 1));
    EXPECT_NEAR(hashed_threshold(point, 4 - 1e-9, 0), hashed_threshold(point, 4 + 1e-9, 0), 1e-6)
        << "octaves meet without a jump";
}

TEST(HashedAlpha, KnowsEveryThresholdThatRoundingOfThePointMayMean) {
    // At octave 3 and 4 cells end at odd multiples of 1/16 and 1/32: x is at an end of the first, y and z are within both.
    const glm::dvec3 border{5. / 16, .01, .01}, aside{1e-6, 0, 0};
    const ThresholdRange range = hashed_thresholds(border, 1e-5, 3, 0);
    const double below = hashed_threshold(border - aside, 3, 0), above = hashed_threshold(border + aside, 3, 0);
    EXPECT_NE(below, above);
    EXPECT_EQ(range.least, std::min(below, above));
    EXPECT_EQ(range.most, std::max(below, above));
    const ThresholdRange inside = hashed_thresholds({.3, .01, .01}, 1e-5, 3, 0);
    EXPECT_EQ(inside.least, inside.most);
    const ThresholdRange anywhere = hashed_thresholds(border, 1, 3, 0);
    EXPECT_LT(anywhere.least, 1e-5);
    EXPECT_GT(anywhere.most, 1 - 1e-5);
}

TEST(HashedAlpha, IsUndecidedWhereRoundingMayCoverOrNot) {
    const StochasticParams params{.correction = correction_none, .mode = mode_hashed};
    const auto undecided = [&](ThresholdRange range) {
        const std::array one{SeededFragment{layer(1, .5, 1), 0, range}};
        return stochastic_blend(one, glm::dvec3(7), params).undecided;
    };
    EXPECT_TRUE(undecided({.3, .7}));
    EXPECT_FALSE(undecided({.3, .4}));
    EXPECT_FALSE(undecided({.6, .7}));
    EXPECT_TRUE(undecided({.49999, .49999}));
}

TEST(HashedAlpha, ShowsTheNearestFragmentAboveItsThreshold) {
    const StochasticParams params{.correction = correction_none, .mode = mode_hashed};
    const auto seen = [&](double first, double second) {
        const std::array two{SeededFragment{layer(1, .5, 1), 0, {first, first}},
                             SeededFragment{layer(2, .5, .25), 0, {second, second}}};
        return stochastic_blend(two, glm::dvec3(7), params).radiance.x;
    };
    EXPECT_EQ(seen(.4, .4), 1);
    EXPECT_EQ(seen(.6, .4), .25);
    EXPECT_EQ(seen(.6, .6), 7);
}

}  // namespace
}  // namespace strata::transparency
