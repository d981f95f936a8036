// Facts about the K-buffer (docs/algorithms/transparency.md 2.2): its key, its three tails, what it keeps and what it loses.
#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "passes/transparency/k_buffer/model.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

constexpr std::array all_tails{tail_drop, tail_blend, tail_hybrid};

Fragment spark(double depth, double light) { return {.depth = depth, .emission = glm::dvec3(light)}; }

double blend(std::span<const Fragment> fragments, double behind, std::uint32_t layers, std::uint32_t tail) {
    return k_buffer_blend(fragments, glm::dvec3(behind), {.layers = layers, .tail = tail}).x;
}

// The oracle of docs/algorithms/transparency.md 2.2: of four equal layers front to back, two are kept.
const std::array four{layer(.1, .5, 1), layer(.2, .5, 1), layer(.3, .5, 1), layer(.4, .5, 1)};

TEST(KBuffer, LosesTheTailItDrops) {
    EXPECT_DOUBLE_EQ(blend(four, 0, 2, tail_drop), .75);
    // T_K of the background shows instead of T_K times what the tail leaves of it.
    EXPECT_DOUBLE_EQ(blend(four, 1, 2, tail_drop), .75 + .25);
}

TEST(KBuffer, IsExactForATailOfOneColor) {
    EXPECT_DOUBLE_EQ(blend(four, 0, 2, tail_blend), .9375);
    EXPECT_DOUBLE_EQ(blend(four, 0, 2, tail_hybrid), .9375);
}

TEST(KBuffer, IsExactInAnyOrderAsLongAsThereIsRoom) {
    std::vector<Fragment> fragments{layer(1, .25, 1), layer(2, .5, 0), layer(3, .75, 1), layer(4, .5, .5)};
    const double wanted = exact_blend(fragments, glm::dvec3(.125)).x;
    do {
        for (const std::uint32_t tail : all_tails) EXPECT_DOUBLE_EQ(blend(fragments, .125, 4, tail), wanted);
    } while (std::ranges::next_permutation(fragments, {}, &Fragment::depth).found);
}

TEST(KBuffer, BlendsTheTailInTheOrderItFallsOut) {
    const Fragment near = layer(1, .5, 0), white = layer(2, .5, 1), black = layer(3, .5, 0);
    EXPECT_DOUBLE_EQ(blend(std::array{near, black, white}, 0, 1, tail_blend), .5 * .5);
    EXPECT_DOUBLE_EQ(blend(std::array{near, white, black}, 0, 1, tail_blend), .5 * .25);
    // What is displaced falls out later than what never had a place.
    EXPECT_DOUBLE_EQ(blend(std::array{white, black, near}, 0, 1, tail_blend), .5 * .5);
    for (const auto& order : {std::array{near, black, white}, std::array{near, white, black}})
        EXPECT_DOUBLE_EQ(blend(order, 0, 1, tail_hybrid), .5 * .375) << "the average of both orders, in either";
}

TEST(KBuffer, GivesTheTailTheMeanCoverageOfItsLayers) {
    // .25 and .75 let .1875 through; twice their mean lets .25.
    const std::array fragments{layer(1, .5, 0), layer(2, .25, 0), layer(3, .75, 0)};
    EXPECT_DOUBLE_EQ(blend(fragments, 1, 1, tail_hybrid), .5 * .25);
    EXPECT_DOUBLE_EQ(blend(fragments, 1, 1, tail_blend), .5 * .1875);
}

TEST(KBuffer, AddsLightThatHasNoCoverageWhereverItEndsUp) {
    const std::array lit{layer(1, .5, 0), spark(2, .25), spark(3, .5), spark(4, 1)};
    for (const std::uint32_t layers : {1u, 2u, 3u, 4u})
        for (const std::uint32_t tail : {tail_blend, tail_hybrid})
            EXPECT_DOUBLE_EQ(blend(lit, .5, layers, tail), .5 * (1.75 + .5)) << layers;
    EXPECT_DOUBLE_EQ(blend(lit, .5, 2, tail_drop), .5 * (.25 + .5)) << "a spark takes a slot";
}

TEST(KBuffer, HidesEverythingBehindAnOpaqueLayer) {
    const std::array fragments{layer(2, .5, 1000), layer(1, 1, .25), spark(3, 60000), layer(4, .5, 1)};
    for (const std::uint32_t tail : all_tails) EXPECT_EQ(blend(fragments, 1e9, 2, tail), .25);
}

TEST(KBuffer, BreaksTiesByCoverageAndThenByColorWhateverTheOrder) {
    const Fragment black = layer(1, .5, 0), white = layer(1, .5, 1), thin = layer(1, .25, 1);
    EXPECT_DOUBLE_EQ(blend(std::array{black, white}, 0, 2, tail_drop), .25) << "the darker one is in front";
    EXPECT_DOUBLE_EQ(blend(std::array{white, black}, 0, 2, tail_drop), .25);
    EXPECT_DOUBLE_EQ(blend(std::array{black, thin}, 0, 2, tail_drop), .25) << "the thinner one is in front";
}

TEST(KBuffer, GivesTheSameBitsForCoincidentLayersInAnyOrder) {
    for (const std::size_t n : {2u, 3u, 6u}) {
        std::vector<Fragment> fragments;
        for (std::size_t i = 0; i < n; ++i) fragments.push_back(layer(3, .125 * double(1 + i), .5 * double(i)));
        const double kept = blend(fragments, 1, 8, tail_drop), averaged = blend(fragments, 1, 2, tail_hybrid);
        while (std::ranges::next_permutation(fragments, {}, &Fragment::alpha).found) {
            EXPECT_EQ(blend(fragments, 1, 8, tail_drop), kept) << n;
            EXPECT_NEAR(blend(fragments, 1, 2, tail_hybrid), averaged, 1e-15) << n;
        }
    }
}

TEST(KBuffer, TellsDepthsApartToSixteenBits) {
    EXPECT_LT(k_buffer_key(layer(1, .5, 1)), k_buffer_key(layer(1 + 0x1p-16, .5, 0)));
    const std::uint64_t here = k_buffer_key(layer(1, .5, 1)) >> 40, a_bit_on = k_buffer_key(layer(1 + 0x1p-18, .5, 1)) >> 40;
    EXPECT_EQ(here, a_bit_on);
    EXPECT_EQ(k_buffer_key(layer(-3, .5, 1)) >> 40, 0u) << "behind the eye is at it";
    EXPECT_LT(k_buffer_key(layer(1e38, 1, 65408)), ~std::uint64_t{0}) << "no fragment looks like an empty slot";
}

TEST(KBuffer, KeepsCoverageTo256thsAndColorToNineBits) {
    for (const double alpha : {0., .25, .5, .75, 1.})
        EXPECT_EQ(blend(std::array{layer(1, alpha, 0)}, 1, 1, tail_drop), 1 - alpha);
    EXPECT_NEAR(blend(std::array{layer(1, .01, 0)}, 1, 1, tail_drop), 1 - 3. / 256, 1e-12);
    for (const double light : {1e-3, .3, 7., 12345., 65408.})
        EXPECT_NEAR(blend(std::array{spark(1, light)}, 0, 1, tail_drop), light, light * 0x1p-9) << light;
    EXPECT_EQ(blend(std::array{spark(1, 1e9)}, 0, 1, tail_drop), 65408);
}

TEST(KBuffer, KeepsTwoHundredThinLayersInItsTail) {
    // T_total is .1340; coverages of 3/256 leave .0946 of it.
    const std::vector<Fragment> layers(200, layer(1, .01, 0));
    for (const std::uint32_t tail : {tail_blend, tail_hybrid}) EXPECT_NEAR(blend(layers, 1, 8, tail), .0946, 1e-4);
    EXPECT_NEAR(blend(layers, 1, 8, tail_drop), .9100, 1e-4);
}

TEST(KBuffer, LeavesThePixelAloneWithoutFragments) {
    for (const std::uint32_t tail : all_tails) EXPECT_EQ(blend({}, .123, 8, tail), .123);
}

}  // namespace
}  // namespace strata::transparency
