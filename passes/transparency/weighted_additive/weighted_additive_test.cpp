// Facts about weighted blending with additiveness (docs/algorithms/transparency.md 3.2: the depth term, the table of oracles, how
// it fails).
#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "passes/transparency/truth.h"
#include "passes/transparency/weighted_additive/model.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

constexpr WeightedAdditiveParams published{.far = 300, .feather_start = .3333f};
constexpr WeightedAdditiveParams corrected{.far = 300, .feather_start = .3333f, .normalization = normalization_corrected};

Fragment glow(double depth, double light) { return {.depth = depth, .emission = glm::dvec3(light)}; }

double blend(const WeightedAdditiveParams& params, std::span<const Fragment> fragments, double behind = .1) {
    return composite(summed(fragments, params, 1), glm::dvec3(behind), params).x;
}

TEST(WeightedAdditive, WeighsByDepthFromTwentyToFive) {
    EXPECT_EQ(additive_depth_weight(published, .5), 20);
    EXPECT_EQ(additive_depth_weight(published, 4.3122), 20);
    EXPECT_LT(additive_depth_weight(published, 4.3125), 20);
    EXPECT_NEAR(additive_depth_weight(published, 5), 14.556, 1e-3);
    EXPECT_NEAR(additive_depth_weight(published, 10), 6.1348, 1e-4);
    EXPECT_NEAR(additive_depth_weight(published, 50), 5.0058, 1e-4);
    EXPECT_EQ(additive_depth_weight(published, 300), 5);
    EXPECT_EQ(additive_depth_weight(published, 1e6), 5);
}

TEST(WeightedAdditive, WeighsByOpacityAndByExposedEmission) {
    const double depth_term = additive_depth_weight(published, 10);
    EXPECT_EQ(additive_weight(published, 1, layer(10, 0, 0)), 0) << "invisible texels contribute nothing";
    EXPECT_NEAR(additive_weight(published, 1, layer(10, .1, 0)), depth_term * .027, 1e-9);
    EXPECT_NEAR(additive_weight(published, 1, layer(10, 1. / 3, 0)), depth_term, 1e-12);
    EXPECT_NEAR(additive_weight(published, 1, glow(10, .16665)), depth_term / 8, 1e-4);
    EXPECT_NEAR(additive_weight(published, .5, glow(10, .3333)), depth_term / 8, 1e-4) << "as the exposed picture shows it";
}

// The table of docs/algorithms/transparency.md 3.2 was measured with half-float sums: .20007 for .2.
TEST(WeightedAdditive, CountsAdditiveLayersAndMultipliesTheirMean) {
    EXPECT_NEAR(blend(published, std::array{glow(10, .2)}), .300858, 1e-4);
    EXPECT_NEAR(blend(published, std::vector<Fragment>(3, glow(10, .2))), .702427, 1e-4);
    EXPECT_DOUBLE_EQ(blend(published, std::array{glow(10, .2)}), .1 + .2 * 8 * 32 / 255) << "an eighth is 32/255 in a byte";
}

TEST(WeightedAdditive, CountsNoMoreThanEightAdditiveLayersInBytes) {
    const std::vector<Fragment> ten(10, glow(10, .2));
    EXPECT_NEAR(blend(published, ten), 1.70165, 2e-3) << "2.1 were right";
    WeightedAdditiveParams halves = published;
    halves.reveal = reveal_r16f;
    EXPECT_NEAR(blend(halves, ten), 2.1, 1e-12);
}

TEST(WeightedAdditive, IsWithinHalfAPercentForUpToEightAdditiveLayers) {
    for (std::size_t n = 1; n <= 8; ++n)
        EXPECT_NEAR(blend(published, std::vector<Fragment>(n, glow(10, .2))) - .1, .2 * double(n), .005 * .2 * double(n)) << n;
}

TEST(WeightedAdditive, BlendsOneCoveringLayer) { EXPECT_NEAR(blend(published, std::array{layer(10, .5, 1)}), .550196, 1e-6); }

TEST(WeightedAdditive, DarkensStacksOfCoveringLayersUnlessCorrected) {
    const std::array two{layer(10, .5, 1), layer(10, .5, 1)};
    EXPECT_NEAR(blend(published, two), .525098, 1e-6);
    EXPECT_NEAR(blend(corrected, two), .775, 1e-3);
    EXPECT_NEAR(exact_blend(two, glm::dvec3(.1)).x, .775, 1e-12);
}

TEST(WeightedAdditive, DampsLightBehindCoverage) {
    const std::array both{layer(10, .5, 1), glow(12, .2)};
    EXPECT_NEAR(blend(published, both), .782010, 2e-4);
    EXPECT_NEAR(blend(corrected, both), .674, 1e-3) << "exact is .65";
}

TEST(WeightedAdditive, ShowsWhiteOfAHundredWhereHalvesOverflow) {
    for (const auto& params : {published, corrected}) {
        EXPECT_EQ(blend(params, std::vector<Fragment>(4, layer(1, 1, 1000))), 100);
        EXPECT_NEAR(blend(params, std::vector<Fragment>(3, layer(1, 1, 1000))), 1000, 1e-9) << "60000 is finite";
        EXPECT_EQ(blend(params, std::vector<Fragment>(4, layer(1, 1, 1e9))), 100)
            << "colors end at 1000 before they are weighted";
    }
}

TEST(WeightedAdditive, StallsWhereABytesProductCannotFallFurther) {
    const std::vector<Fragment> thin(200, layer(10, .01, 0));
    EXPECT_NEAR(summed(thin, published, 1).reveal.x, 50. / 255, 1e-12);
    WeightedAdditiveParams halves = published;
    halves.reveal = reveal_r16f;
    EXPECT_NEAR(summed(thin, halves, 1).reveal.x, .1339796749, 1e-9);
}

TEST(WeightedAdditive, LeavesThePixelAloneWithoutCoverageOrLight) {
    for (const auto& params : {published, corrected}) {
        EXPECT_EQ(blend(params, {}, .123), .123);
        EXPECT_EQ(blend(params, std::array{layer(10, 0, 1)}, .123), .123);
    }
}

TEST(WeightedAdditive, HidesTheBackgroundBehindAnOpaqueLayer) {
    for (const auto& params : {published, corrected}) EXPECT_EQ(blend(params, std::array{layer(10, 1, .25)}, 1e6), .25);
}

TEST(WeightedAdditive, PunchesThroughWithALargeFeatherStartAndHalosWithASmallOne) {
    // A dim edge of light over a bright one farther away: how much of the far one's weight the near edge has.
    const auto share = [](float feather_start) {
        const WeightedAdditiveParams params{.far = 300, .feather_start = feather_start};
        return additive_weight(params, 1, glow(3, .02)) / additive_weight(params, 1, glow(10, 2));
    };
    EXPECT_GT(share(.01f), 3) << "dims the bright one: a dark halo";
    EXPECT_LT(share(1), 1e-4) << "as if the edge were not there";
}

TEST(WeightedAdditive, MergesResolutionsInAnyOrder) {
    const AdditiveSums a = summed(std::array{layer(3, .5, 1), glow(5, .2)}, published, 1),
                       b = summed(std::array{layer(9, .25, 0)}, published, 1);
    EXPECT_EQ(composite(merged(a, b), glm::dvec3(.1), published), composite(merged(b, a), glm::dvec3(.1), published));
    EXPECT_EQ(composite(merged(a, {}), glm::dvec3(.1), published), composite(a, glm::dvec3(.1), published));
}

TEST(WeightedAdditive, TintsTheBackgroundPerChannel) {
    const Fragment red{.depth = 1, .transmittance = {1, .2, .2}, .alpha = 1};
    const glm::dvec3 seen = composite(summed(std::array{red}, published, 1), glm::dvec3(1), published);
    EXPECT_EQ(seen, glm::dvec3(1, .2, .2));
}

}  // namespace
}  // namespace strata::transparency
