// Facts about depth peeling (docs/algorithms/transparency.md 2.3): exact layers from the front, and what it loses.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "passes/transparency/depth_peeling/model.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

constexpr double near_plane = .1;

double blend(std::span<const Fragment> fragments, double behind, std::uint32_t passes) {
    return peeled_blend(fragments, glm::dvec3(behind), passes, near_plane).x;
}

TEST(DepthPeeling, IsExactInAnyOrderWithAPassPerLayer) {
    std::vector<Fragment> fragments{layer(1, .3, 1), layer(2, .5, .2), layer(3, .7, .9), layer(4, .1, 5)};
    const double wanted = exact_blend(fragments, glm::dvec3(.4)).x;
    do {
        EXPECT_DOUBLE_EQ(blend(fragments, .4, 4), wanted);
        EXPECT_DOUBLE_EQ(blend(fragments, .4, 64), wanted);
    } while (std::ranges::next_permutation(fragments, {}, &Fragment::depth).found);
}

TEST(DepthPeeling, LeavesOutWhatIsBehindItsLastLayer) {
    // The four layers of .5 of docs/algorithms/transparency.md 2.2: two passes see .75 of .9375, and the background through them
    // as if nothing were there.
    const std::array four{layer(.1, .5, 1), layer(.2, .5, 1), layer(.3, .5, 1), layer(.4, .5, 1)};
    EXPECT_DOUBLE_EQ(blend(four, 0, 2), .75);
    EXPECT_DOUBLE_EQ(blend(four, 8, 2), .75 + .25 * 8);
    EXPECT_DOUBLE_EQ(blend(four, 0, 4), .9375);
}

TEST(DepthPeeling, LosesAllButTheLastOfCoincidentLayers) {
    const Fragment white = layer(1, .5, 1), black = layer(1, .5, 0);
    EXPECT_DOUBLE_EQ(blend(std::array{black, black}, 1, 8), .5) << "the truth is .25";
    EXPECT_DOUBLE_EQ(blend(std::array{black, white}, 0, 8), .5) << "the later submission is nearer, and there is no other";
    EXPECT_DOUBLE_EQ(blend(std::array{white, black}, 0, 8), 0);
    for (const std::size_t n : {2u, 3u, 8u})
        EXPECT_DOUBLE_EQ(blend(std::vector<Fragment>(n, layer(3, .5, 1)), 0, 8), .5) << n << " are one";
    EXPECT_DOUBLE_EQ(blend(std::array{black, layer(std::nextafter(1., 2.), .5, 0)}, 1, 8), .25) << "the least gap is enough";
}

TEST(DepthPeeling, LosesWhatIsBroughtBeforeTheNearPlane) {
    const std::array offset{layer(.05, .5, 0), layer(-4, .5, 0), layer(.09, .5, 0)};
    EXPECT_DOUBLE_EQ(blend(offset, 1, 8), .5);
}

TEST(DepthPeeling, MultipliesTheColorsOfGlass) {
    const Fragment red{.depth = 1, .transmittance = {1, .2, .2}, .alpha = 1},
        green{.depth = 2, .transmittance = {.2, 1, .2}, .alpha = 1};
    const glm::dvec3 seen = peeled_blend(std::array{green, red}, glm::dvec3(1), 2, near_plane);
    EXPECT_NEAR(seen.x, .2, 1e-15);
    EXPECT_NEAR(seen.z, .04, 1e-15);
}

TEST(DepthPeeling, TakesAPassForALightThatCoversNothing) {
    const Fragment spark{.depth = 1, .emission = glm::dvec3(3)};
    EXPECT_DOUBLE_EQ(blend(std::array{spark, layer(2, .5, 1)}, 0, 1), 3);
    EXPECT_DOUBLE_EQ(blend(std::array{spark, layer(2, .5, 1)}, 0, 2), 3.5);
}

TEST(DepthPeeling, NeedsTwoHundredPassesForTwoHundredLayers) {
    std::vector<Fragment> layers;
    for (int i = 0; i < 200; ++i) layers.push_back(layer(1 + i, .01, 0));
    EXPECT_NEAR(blend(layers, 1, 8), std::pow(.99, 8), 1e-12) << "the truth is .134";
    EXPECT_NEAR(blend(layers, 1, 64), std::pow(.99, 64), 1e-12);
}

TEST(DepthPeeling, LeavesThePixelAloneWithoutFragments) { EXPECT_EQ(blend({}, .123, 8), .123); }

}  // namespace
}  // namespace strata::transparency
