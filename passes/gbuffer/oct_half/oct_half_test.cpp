// Facts of octahedral coordinates in half floats: the errors of docs/algorithms/deferred.md 2.5.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "passes/gbuffer/layout_model.h"
#include "passes/gbuffer/oct_half/model.h"

namespace strata::gbuffer {
namespace {

double degrees_off(const glm::dvec3& n) {
    const glm::dvec3 stored = from_octahedron(oct_half_coordinates(n));
    return std::atan2(glm::length(glm::cross(n, stored)), glm::dot(n, stored)) * 180 / std::numbers::pi;
}

TEST(OctHalfGBuffer, NormalsOfAnyDirectionAreOffByTheMeanOfTheTable) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> gauss;
    double sum = 0;
    constexpr int count = 500000;
    for (int i = 0; i < count; ++i) {
        const double x = gauss(random), y = gauss(random), z = gauss(random);
        sum += degrees_off(glm::normalize(glm::dvec3(x, y, z)));
    }
    EXPECT_NEAR(sum / count, .0150, .05 * .0150);
}

/// Where x, y and z are alike the octahedron's face is farthest from the sphere, so a step of a coordinate turns a normal most.
TEST(OctHalfGBuffer, NormalsNearTheMiddlesOfFacesAreTheWorst) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> near_one(.7, 1.3);
    double worst = 0;
    for (int i = 0; i < 500000; ++i) {
        const double x = near_one(random), y = near_one(random), z = near_one(random);
        worst = std::max(worst, degrees_off(glm::normalize(glm::dvec3(x, y, -z))));
    }
    EXPECT_NEAR(worst, .0587, .05 * .0587);
}

TEST(OctHalfGBuffer, AxesAreExact) {
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        for (const double sign : {1.0, -1.0}) EXPECT_EQ(from_octahedron(oct_half_coordinates(axis * sign)), axis * sign);
}

}  // namespace
}  // namespace strata::gbuffer
