// Facts about the draw and the resolve that all function techniques share (docs/algorithms/transparency.md 7, oracles F1 to F6).
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "passes/transparency/functions/model.h"
#include "passes/transparency/rounding.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

Transmittance exact(std::span<const Fragment> fragments) {
    return [fragments](const Fragment& at) {
        glm::dvec3 through(1);
        for (const Fragment& f : fragments)
            if (f.depth < at.depth) through *= f.transmittance;
        return through;
    };
}

const Transmittance nothing_hides = [](const Fragment&) { return glm::dvec3(1); };

std::vector<Fragment> ramp() {
    std::vector<Fragment> fragments;
    for (int i = 0; i < 200; ++i) fragments.push_back(layer(1 + i, .01, i / 199.));
    return fragments;
}

TEST(FunctionResolve, IsTheSortedBlendForTheExactFunction) {
    const std::array fragments{layer(3, .5, 1), layer(1, .25, .5), layer(2, .75, .2)};
    EXPECT_NEAR(function_blend(fragments, glm::dvec3(.7), exact(fragments)).x, exact_blend(fragments, glm::dvec3(.7)).x, 1e-12);
}

TEST(FunctionResolve, IsTheWeightedAverageForNoFunctionAtAll) {
    EXPECT_NEAR(function_blend(ramp(), glm::dvec3(0), nothing_hides).x, .43301, 1e-5);
    EXPECT_NEAR(function_blend(std::array{layer(1, .5, 1), layer(2, .5, 0)}, glm::dvec3(0), nothing_hides).x, .375, 1e-12);
}

TEST(FunctionResolve, IsExactForOneColorWhateverTheFunction) {
    const std::array fragments{layer(1, .3, .7), layer(7, .5, .7), layer(20, .2, .7)};
    const double wanted = exact_blend(fragments, glm::dvec3(2)).x;
    int call = 0;
    const Transmittance arbitrary = [&](const Fragment&) { return glm::dvec3(.1 + .3 * (call++ % 3)); };
    EXPECT_NEAR(function_blend(fragments, glm::dvec3(2), arbitrary).x, wanted, 1e-12);
}

TEST(FunctionResolve, DoesNotCareHowTheFunctionIsScaled) {
    const std::array fragments{layer(1, .3, .9), layer(7, .5, .1), layer(20, .2, .4)};
    const Transmittance whole = exact(fragments), part = [&](const Fragment&f) { return .3 * exact(fragments)(f); };
    EXPECT_NEAR(function_blend(fragments, glm::dvec3(1), whole).x, function_blend(fragments, glm::dvec3(1), part).x, 1e-12);
}

TEST(FunctionResolve, AddsEmissionWithoutCoverage) {
    const std::array sparks{Fragment{.depth = 1, .emission = glm::dvec3(.3)}, Fragment{.depth = 2, .emission = glm::dvec3(.4)}};
    EXPECT_NEAR(function_blend(sparks, glm::dvec3(.1), exact(sparks)).x, .8, 1e-12);
    const std::array dimmed{layer(1, .5, 0), Fragment{.depth = 2, .emission = glm::dvec3(.3)}};
    EXPECT_NEAR(function_blend(dimmed, glm::dvec3(0), exact(dimmed)).x, .15, 1e-12);
}

TEST(FunctionResolve, IsExactForASingleFragment) {
    for (const double alpha : {1e-4, .01, .5, .999})
        EXPECT_NEAR(function_blend(std::array{layer(1, alpha, 1)}, glm::dvec3(2), nothing_hides).x, alpha + (1 - alpha) * 2,
                    1e-12);
    // A wall of alpha 1 lets exp(-32) through.
    EXPECT_NEAR(function_blend(std::array{layer(1, 1, 0)}, glm::dvec3(1), nothing_hides).x, std::exp(-32.), 1e-15);
}

TEST(FunctionResolve, TintsGlassPerChannel) {
    const std::array glass{Fragment{.depth = 1, .transmittance = {1, .2, .2}, .alpha = 1},
                           Fragment{.depth = 2, .transmittance = {.2, 1, .2}, .alpha = 1}};
    const glm::dvec3 seen = function_blend(glass, glm::dvec3(1), exact(glass));
    EXPECT_NEAR(seen.x, .2, 1e-12);
    EXPECT_NEAR(seen.y, .2, 1e-12);
    EXPECT_NEAR(seen.z, .04, 1e-12);
}

TEST(FunctionResolve, StallsInPackedFloatsAsTheChapterMeasured) {
    // 200 layers of tau .01005: eleven bits stop at 2, ten at 1, sixteen at 1.990.
    const auto sum_of = [](SmallFloat format) {
        double sum = 0;
        for (int i = 0; i < 200; ++i) sum = rounded(sum - std::log(.99), format, Rounding::to_nearest);
        return sum;
    };
    EXPECT_DOUBLE_EQ(sum_of(float11), 2);
    EXPECT_DOUBLE_EQ(sum_of(float10), 1);
    EXPECT_NEAR(std::exp(-sum_of(half_float)), .1367, 1e-4);
}

TEST(SmallFloats, RoundAndSaturate) {
    EXPECT_EQ(rounded(1 + 1. / 4096, half_float, Rounding::to_nearest), 1);
    EXPECT_EQ(rounded(1 + 3. / 4096, half_float, Rounding::to_nearest), 1 + 1. / 1024);
    EXPECT_EQ(rounded(1 + 3. / 4096, half_float, Rounding::towards_zero), 1);
    EXPECT_EQ(rounded(-1 - 3. / 4096, half_float, Rounding::towards_zero), -1);
    EXPECT_EQ(rounded(7e4, half_float, Rounding::to_nearest), 65504);
    EXPECT_EQ(rounded(7e4, float10, Rounding::to_nearest), 64512);
    EXPECT_EQ(rounded(1e-9, half_float, Rounding::to_nearest), 0);
    EXPECT_EQ(rounded(6e-8, half_float, Rounding::to_nearest), std::ldexp(1., -24)) << "the smallest denormal";
}

}  // namespace
}  // namespace strata::transparency
