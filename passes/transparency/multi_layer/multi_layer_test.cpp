// Facts about multi-layer alpha blending (docs/algorithms/transparency.md 2.5 and hard case H5).
#include "passes/transparency/multi_layer/model.h"

#include <algorithm>
#include <array>
#include <random>

#include <gtest/gtest.h>

#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

double blend(std::span<const Fragment> fragments, std::uint32_t layers, double behind = 0) {
    return multi_layer_blend(fragments, glm::dvec3(behind), layers).x;
}

std::vector<Fragment> ramp() {
    std::vector<Fragment> fragments;
    for (int i = 0; i < 200; ++i) fragments.push_back(layer(1 + i, .01, i / 199.));
    return fragments;
}

TEST(MultiLayer, IsExactForSortedFragmentsInEitherDirection) {
    std::vector<Fragment> sorted = ramp();
    const double exact = exact_blend(sorted, glm::dvec3(.3)).x;
    EXPECT_NEAR(blend(sorted, 2, .3), exact, 1e-12);
    std::ranges::reverse(sorted);
    EXPECT_NEAR(blend(sorted, 2, .3), exact, 1e-12);
}

TEST(MultiLayer, CannotPutAFragmentBetweenMergedLayers) {
    const std::array fragments{layer(.2, .5, 0), layer(.8, .5, 1), layer(.9, .5, 0), layer(.85, .5, 1)};
    EXPECT_DOUBLE_EQ(blend(fragments, 2), .3125);
    EXPECT_DOUBLE_EQ(exact_blend(fragments, glm::dvec3(0)).x, .375);
    EXPECT_NEAR(blend(fragments, 2, 1) - blend(fragments, 2), .0625, 1e-12);  // what shows through is exact
}

TEST(MultiLayer, PutsTheLaterOfTwoCoincidentFragmentsInFront) {
    EXPECT_DOUBLE_EQ(blend(std::array{layer(1, .5, 0), layer(1, .5, 1)}, 4), .5);
    EXPECT_DOUBLE_EQ(blend(std::array{layer(1, .5, 1), layer(1, .5, 0)}, 4), .25);
}

TEST(MultiLayer, LosesTheOrderOfThinLayersThatComeInNone) {
    std::vector<Fragment> shuffled = ramp();
    std::ranges::shuffle(shuffled, std::mt19937(1));
    for (const std::uint32_t layers : {4u, 8u}) {
        EXPECT_GT(blend(shuffled, layers), .30) << layers;
        EXPECT_LT(blend(shuffled, layers), .45) << layers;
    }
    EXPECT_LT(blend(shuffled, 16), blend(shuffled, 4));
}

}  // namespace
}  // namespace strata::transparency
