// Facts of the z-first packing: the example and the errors of docs/algorithms/deferred.md 2.5.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "passes/gbuffer/z_first/model.h"
#include "tests/support/normal_errors.h"

namespace strata::gbuffer {
namespace {

double degrees_off(const glm::dvec3& n) { return degrees_between(z_first_normal(z_first_halves(n)), n); }

TEST(ZFirstGBuffer, DecodesTheExampleOfTheChapter) {
    const glm::dvec3 n(.6, 0, -.8), stored = z_first_normal(z_first_halves(n));
    EXPECT_NEAR(stored.x, .5996, 5e-5);
    EXPECT_NEAR(std::abs(stored.y), .0279, 5e-5);
    EXPECT_NEAR(stored.z, -.7998, 1e-4);
    EXPECT_NEAR(degrees_off(n), 1.60, .005);
}

TEST(ZFirstGBuffer, TheSignBitTellsUpFromDownAndAMinusZeroCounts) {
    EXPECT_GT(z_first_normal(z_first_halves({0, 1, 0})).y, .999);
    EXPECT_LT(z_first_normal(z_first_halves({0, -1, 0})).y, -.999);
    EXPECT_LE(z_first_normal({0.5, -0.0}).y, 0);
    EXPECT_EQ(z_first_normal(z_first_halves({-1, 0, 0})), glm::dvec3(-1, 0, 0));
}

/// Every other one is exact: what is under the root is below 0 there, and max(0, .) makes it 0. The |.| of the talk would leave
/// an error there, too: .808 degrees in the mean, the chapter's number.
TEST(ZFirstGBuffer, LevelWallsAreTheWorst) {
    double worst = 0, sum = 0;
    constexpr int count = 200000;
    for (int i = 0; i < count; ++i) {
        const double a = std::numbers::pi * (i + .5) / count, error = degrees_off({std::cos(a), 0, -std::sin(a)});
        worst = std::max(worst, error);
        sum += error;
    }
    EXPECT_NEAR(worst, 1.886, .05 * 1.886);
    EXPECT_NEAR(sum / count, .808 / 2, .05 * .808 / 2);
}

}  // namespace
}  // namespace strata::gbuffer
