// Facts about weighted blending (docs/algorithms/transparency.md 3.1: the table of weights, oracles (a) to (e), section 11).
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "passes/transparency/truth.h"
#include "passes/transparency/weighted/model.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

constexpr double near_plane = .1;
constexpr std::array all_weights{weight_w7,   weight_w8,   weight_w9,         weight_w10,
                                 weight_blog, weight_2015, weight_2015_plain, weight_constant};

double blend(std::uint32_t weight, std::span<const Fragment> fragments, double behind) {
    return weighted_blend(fragments, glm::dvec3(behind), {.weight = weight, .scale = 1}, near_plane).x;
}

double share_of_alpha(std::uint32_t weight, double depth) {
    return weight_in_double({.weight = weight, .scale = 1}, near_plane, layer(depth, .5, 0)) / .5;
}

TEST(WeightedBlending, HasTheWeightsOfThePaper) {
    struct Row {
        double depth, w7, w8, w9;
    };
    const Row rows[] = {
        {.1, 3000, 3000, 3000}, {1, 249.938, 3000, 2999.81}, {5, 9.9999, 79.9936, 2887.22}, {10, 2.49999, 9.9999, 1846.15},
        {50, .1, .08, 7.66039}, {100, .025, .01, .479923},   {200, .01, .01, .03}};
    for (const Row& row : rows) {
        EXPECT_NEAR(share_of_alpha(weight_w7, row.depth), row.w7, row.w7 * 1e-4) << row.depth;
        EXPECT_NEAR(share_of_alpha(weight_w8, row.depth), row.w8, row.w8 * 1e-4) << row.depth;
        EXPECT_NEAR(share_of_alpha(weight_w9, row.depth), row.w9, row.w9 * 1e-4) << row.depth;
    }
}

TEST(WeightedBlending, WeighsByTheCubeOfReversedDepthInEquationTen) {
    EXPECT_DOUBLE_EQ(share_of_alpha(weight_w10, near_plane), 3000);
    EXPECT_NEAR(share_of_alpha(weight_w10, 2 * near_plane), 3000. / 8, 1e-9);
    EXPECT_DOUBLE_EQ(share_of_alpha(weight_w10, 100), .01);
}

TEST(WeightedBlending, WeighsByTheBrightestColorOrAlphaInTheFormOfTheBlog) {
    // McGuire's blog, 2014 (docs/algorithms/transparency.md 3.1): max(min(1, max(r, g, b) alpha), alpha) times
    // clamp(.03 / (1e-5 + (z / 200)^4), 1e-2, 3e3). At 50 m the latter is .03 / (1e-5 + 1 / 256) = 7.660389, at 10 m
    // .03 / (1e-5 + 1 / 160000) = 1846.154, at 300 m .01.
    const auto weight = [](double depth, double alpha, glm::dvec3 unpremultiplied) {
        const Fragment f{
            .depth = depth, .color = alpha * unpremultiplied, .transmittance = glm::dvec3(1 - alpha), .alpha = alpha};
        return weight_in_double({.weight = weight_blog, .scale = 1}, near_plane, f);
    };
    EXPECT_NEAR(weight(50, .5, {.2, .9, .1}), .5 * 7.660389, 4e-6) << "alpha";
    EXPECT_NEAR(weight(50, .5, {.2, 1.2, .1}), .6 * 7.660389, 5e-6) << "green";
    EXPECT_NEAR(weight(50, .5, {.2, .3, 1.6}), .8 * 7.660389, 6e-6) << "blue";
    EXPECT_NEAR(weight(50, .5, {1000, .3, .1}), 7.660389, 8e-6) << "no more than 1";
    EXPECT_NEAR(weight(10, .25, glm::dvec3(0)), .25 * 1846.154, 2e-3);
    EXPECT_NEAR(weight(300, .25, glm::dvec3(0)), .0025, 1e-12);
    EXPECT_NEAR(weight(.1, .25, glm::dvec3(0)), 750, 1e-5);
}

TEST(WeightedBlending, IsNotAnAverageInDisguise) {
    // The form of 2015 is one without its depth range, and so was a public port.
    for (const std::uint32_t weight : all_weights) {
        const double ratio = share_of_alpha(weight, 1) / share_of_alpha(weight, 100);
        if (weight == weight_constant || weight == weight_2015_plain) {
            EXPECT_EQ(ratio, 1);
        } else {
            EXPECT_GT(ratio, 100) << weight;
        }
    }
}

TEST(WeightedBlending, IsExactForOneColorWhateverTheWeights) {
    for (const std::uint32_t weight : all_weights) {
        const std::array fragments{layer(1, .3, .7), layer(7, .5, .7), layer(20, .2, .7)};
        EXPECT_NEAR(blend(weight, fragments, 2), exact_blend(fragments, glm::dvec3(2)).x, 1e-12) << weight;
    }
}

TEST(WeightedBlending, IsExactForASingleLayer) {
    for (const std::uint32_t weight : all_weights)
        for (const double depth : {.2, 3., 40.})
            EXPECT_NEAR(blend(weight, std::array{layer(depth, .4, 1)}, .5), .4 + .6 * .5, 1e-12);
}

TEST(WeightedBlending, AveragesTwoLayersAtOneDepth) {
    for (const std::uint32_t weight : {weight_w7, weight_w8, weight_w9, weight_w10, weight_constant})
        EXPECT_NEAR(blend(weight, std::array{layer(1, .5, 1), layer(1, .5, 0)}, 0), .375, 1e-12) << weight;
}

TEST(WeightedBlending, DoesNotDependOnTheOrderOfDrawing) {
    std::vector<Fragment> fragments{layer(1, .2, 1), layer(2, .9, .5), layer(9, .4, 0)};
    const double expected = blend(weight_w7, fragments, 1);
    std::ranges::reverse(fragments);
    EXPECT_NEAR(blend(weight_w7, fragments, 1), expected, 1e-12);
}

TEST(WeightedBlending, LosesTheOrderOfTwoHundredThinLayersWithoutWeights) {
    std::vector<Fragment> ramp;
    for (int i = 0; i < 200; ++i) ramp.push_back(layer(1 + i, .01, i / 199.));
    EXPECT_NEAR(blend(weight_constant, ramp, 0), .4330, 1e-4);
    EXPECT_NEAR(exact_blend(ramp, glm::dvec3(0)).x, .2962, 1e-4);
}

TEST(WeightedBlending, BlendsTheMicroExampleOfTheChapter) {
    const std::array fragments{layer(1, .5, 1), layer(2, .5, 0), layer(4, .5, 1)};
    EXPECT_NEAR(blend(weight_w9, fragments, 0), .581983, 1e-6);
}

TEST(WeightedBlending, ShowsWhatIsBehindANearlyOpaqueLayer) {
    // The front card covers everything, and a fifth of what is seen is still the card behind it.
    const std::array fragments{layer(5, 1, 0), layer(10, 1, 1)};
    EXPECT_EQ(exact_blend(fragments, glm::dvec3(0)).x, 0);
    EXPECT_NEAR(blend(weight_w7, fragments, 0), 2.49999 / (9.9999 + 2.49999), 1e-4);
}

TEST(WeightedBlending, LosesEmissionWithoutCoverage) {
    const Fragment spark{.depth = 2, .emission = glm::dvec3(5)};
    EXPECT_EQ(blend(weight_w7, std::array{spark}, .25), .25);
}

TEST(WeightedBlending, LetsColoredGlassTintTheBackgroundExactly) {
    const Fragment red{.depth = 1, .transmittance = {1, .2, .2}, .alpha = 1},
        green{.depth = 2, .transmittance = {.2, 1, .2}, .alpha = 1};
    const glm::dvec3 seen = weighted_blend(std::array{red, green}, glm::dvec3(1), {.weight = weight_w7, .scale = 1}, near_plane);
    EXPECT_NEAR(seen.x, .2, 1e-12);
    EXPECT_NEAR(seen.z, .04, 1e-12);
}

TEST(WeightedBlending, SaturatesItsSumsWhereHalfFloatsEnd) {
    // 21 layers of weight 3000 fit. Of 100 layers with radiance 2 both sums end at 65504, and their ratio is 1 instead of 2.
    const std::vector<Fragment> wall(100, layer(.05, 1, 2));
    EXPECT_DOUBLE_EQ(blend(weight_w7, wall, 0), 1);
    EXPECT_DOUBLE_EQ(blend(weight_w7, std::vector<Fragment>(10, layer(.05, 1, 2)), 0), 2);
}

TEST(WeightedBlending, WeighsByTheFormOf2015) {
    // 100 a^3 b^3 z^-1.5 with a = 8 alpha + .01 and b = .05 + .95 near / z.
    EXPECT_NEAR(.5 * share_of_alpha(weight_2015, 1), 100 * std::pow(4.01 * .145, 3), 1e-9);
    EXPECT_NEAR(.5 * share_of_alpha(weight_2015, 4), 100 * std::pow(4.01 * .07375, 3) / 8, 1e-9);
    const auto plain = [](double alpha, double depth) {
        return weight_in_double({.weight = weight_2015_plain, .scale = 1}, near_plane, layer(depth, alpha, 0));
    };
    EXPECT_EQ(plain(.036, 500), 300);  // saturated however far
    EXPECT_LT(plain(.034, 500), 300);
}

double blend_as(std::uint32_t form, std::span<const Fragment> fragments, double behind) {
    return weighted_blend(fragments, glm::dvec3(behind), {.weight = weight_w7, .scale = 1, .form = form}, near_plane).x;
}

TEST(WeightedAverage, IsExactForEqualLayersAndForgetsUnequalAlphas) {
    const std::array equal{layer(1, .5, .7), layer(9, .5, .7), layer(20, .5, .7)};
    EXPECT_NEAR(blend_as(form_average, equal, 2), exact_blend(equal, glm::dvec3(2)).x, 1e-12);
    EXPECT_NEAR(blend_as(form_average, std::array{layer(1, .5, 1), layer(5, .5, 0)}, 0), .375, 1e-12);
    // .9 and .1 let .09 through; twice their mean lets .25.
    EXPECT_NEAR(blend_as(form_average, std::array{layer(1, .9, 0), layer(2, .1, 0)}, 1), .25, 1e-12);
    EXPECT_EQ(blend_as(form_average, {}, .123), .123);
}

TEST(WeightedSum, IsExactForOneLayerAndSubtractsTheBackgroundFromThree) {
    EXPECT_NEAR(blend_as(form_sum, std::array{layer(1, .4, 1)}, .5), .4 + .6 * .5, 1e-12);
    EXPECT_NEAR(blend_as(form_sum, std::vector<Fragment>(3, layer(1, .5, 0)), 1), -.5, 1e-12);
    EXPECT_EQ(blend_as(form_sum, {}, .123), .123);
}

TEST(WeightedBlending, LeavesThePixelAloneWithoutFragments) { EXPECT_EQ(blend(weight_w7, {}, .123), .123); }

}  // namespace
}  // namespace strata::transparency
