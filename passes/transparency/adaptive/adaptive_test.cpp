// Facts about adaptive transparency (docs/algorithms/transparency.md 2.4 and hard case H5).
#include "passes/transparency/adaptive/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "passes/transparency/functions/model.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {
namespace {

double blend(std::span<const Fragment> fragments, std::uint32_t nodes) {
    const std::vector<CurveStep> curve = adaptive_curve(fragments, nodes);
    return function_blend(fragments, glm::dvec3(0), [&](const Fragment& f) { return transmittance_at(curve, f.depth); }).x;
}

TEST(AdaptiveCurve, RemovesTheLeastAreaTowardsTheEye) {
    const std::array fragments{layer(.2, .5, 0), layer(.6, .5, 0), layer(.4, .5, 0)};
    const std::vector<CurveStep> curve = adaptive_curve(fragments, 2);
    ASSERT_EQ(curve.size(), 2u);
    EXPECT_DOUBLE_EQ(curve[0].depth, .2);
    EXPECT_DOUBLE_EQ(curve[0].transmittance.x, .25);
    EXPECT_DOUBLE_EQ(curve[1].depth, .6);
    EXPECT_DOUBLE_EQ(curve[1].transmittance.x, .125);
    EXPECT_DOUBLE_EQ(transmittance_at(curve, .4).x, .25);  // exactly .5
}

TEST(AdaptiveCurve, IsExactWhileThereAreNodesForAll) {
    const std::array fragments{layer(3, .5, 1), layer(1, .25, .5), layer(2, .75, .2), layer(4, .9, .1)};
    EXPECT_NEAR(blend(fragments, 4), exact_blend(fragments, glm::dvec3(0)).x, 1e-12);
}

TEST(AdaptiveCurve, KeepsWhatShowsThroughEverythingExactly) {
    std::mt19937 random(5);
    std::vector<Fragment> fragments;
    double total = 1;
    for (int i = 0; i < 50; ++i) {
        fragments.push_back(layer(double(random() % 1000), .1, 0));
        total *= .9;
    }
    for (const std::uint32_t nodes : {4u, 8u, 16u})
        EXPECT_NEAR(adaptive_curve(fragments, nodes).back().transmittance.x, total, 1e-12);
}

TEST(AdaptiveCurve, LosesLittleOfTwoHundredThinLayersInWhateverOrderTheyCome) {
    std::vector<Fragment> ramp;
    for (int i = 0; i < 200; ++i) ramp.push_back(layer(1 + i, .01, i / 199.));
    std::ranges::shuffle(ramp, std::mt19937(1));
    // Over shuffles 4 nodes give .27 to .33; exact is .2962.
    EXPECT_NEAR(blend(ramp, 4), .30, .035);
    EXPECT_NEAR(blend(ramp, 8), .2962, 5e-3);
    EXPECT_NEAR(exact_blend(ramp, glm::dvec3(0)).x, .296181, 1e-6);
    std::ranges::sort(ramp, {}, &Fragment::depth);
    EXPECT_NEAR(blend(ramp, 8), .2749, 1e-4) << "near to far";
    std::ranges::reverse(ramp);
    EXPECT_NEAR(blend(ramp, 4), .3512, 1e-4) << "far to near";
}

TEST(AdaptiveCurve, DoesNotHideCoincidentFragmentsFromEachOther) {
    const std::array fragments{layer(1, .5, 0), layer(1, .5, 0)};
    const std::vector<CurveStep> curve = adaptive_curve(fragments, 4);
    EXPECT_EQ(transmittance_at(curve, 1).x, 1);
    EXPECT_DOUBLE_EQ(transmittance_at(curve, 1.001).x, .25);
}

}  // namespace
}  // namespace strata::transparency
