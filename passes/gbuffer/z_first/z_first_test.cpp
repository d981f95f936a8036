// Facts of the z-first packing: the example and the errors of docs/algorithms/deferred.md 2.5.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "passes/gbuffer/z_first/model.h"

namespace strata::gbuffer {
namespace {

double degrees_off(const glm::dvec3& n) {
    const glm::dvec3 stored = z_first_normal(z_first_halves(n));
    return std::atan2(glm::length(glm::cross(n, stored)), glm::dot(n, stored)) * 180 / std::numbers::pi;
}

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

TEST(ZFirstGBuffer, LevelWallsAreTheWorst) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> around(0, std::numbers::pi);
    double worst = 0, sum = 0;
    constexpr int count = 200000;
    for (int i = 0; i < count; ++i) {
        const double a = around(random), error = degrees_off({std::cos(a), 0, -std::sin(a)});
        worst = std::max(worst, error);
        sum += error;
    }
    EXPECT_NEAR(worst, 1.886, .05 * 1.886);
    EXPECT_NEAR(sum / count, .808, .05 * .808);
}

}  // namespace
}  // namespace strata::gbuffer
