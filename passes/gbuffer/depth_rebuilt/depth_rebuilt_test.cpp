// Facts of the layout with rebuilt depth: the errors of normals of docs/algorithms/deferred.md 2.5, and depth at the sample.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "passes/gbuffer/depth_rebuilt/model.h"
#include "passes/gbuffer/layout_model.h"

namespace strata::gbuffer {
namespace {

TEST(DepthRebuiltGBuffer, AMillionNormalsAreOffAsTheTableSays) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> gauss;
    double worst = 0, sum = 0;
    constexpr int count = 1000000;
    for (int i = 0; i < count; ++i) {
        const double x = gauss(random), y = gauss(random), z = gauss(random);
        const glm::dvec3 n = glm::normalize(glm::dvec3(x, y, z)), stored = depth_rebuilt_normal(n);
        const double error = std::atan2(glm::length(glm::cross(n, stored)), glm::dot(n, stored)) * 180 / std::numbers::pi;
        worst = std::max(worst, error);
        sum += error;
    }
    EXPECT_NEAR(worst, .0037, .05 * .0037);
    EXPECT_NEAR(sum / count, .0013, .05 * .0013);
}

/// Reversed depth is near / z in a float: a step is 2^-24 to 2^-23 of it at every distance.
TEST(DepthRebuiltGBuffer, DepthIsExactToHalfAStepOfAFloatAndLiesAtTheSample) {
    Frame frame;
    frame.view.near = .1f;
    for (double z = .2; z < 5000; z *= 1.7) {
        NearestSurface s;
        s.depth = double(frame.view.near) / z;
        rebuild_from_depth(s, {frame, {.5, .5}, {.125, .375}});
        EXPECT_NEAR(s.point.position.z / z, 1, 0x1p-24);
        EXPECT_EQ(s.offset, glm::dvec2(.125, .375));
    }
}

}  // namespace
}  // namespace strata::gbuffer
