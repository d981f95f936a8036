// Facts of octahedral coordinates in half floats: the errors of docs/algorithms/deferred.md 2.5.
#include <gtest/gtest.h>

#include <random>

#include "passes/gbuffer/layout_model.h"
#include "passes/gbuffer/oct_half/model.h"
#include "tests/support/normal_errors.h"

namespace strata::gbuffer {
namespace {

glm::dvec3 oct_half_stored(const glm::dvec3& n) { return from_octahedron(oct_half_coordinates(n)); }

TEST(OctHalfGBuffer, NormalsOfAnyDirectionAreOffByTheMeanOfTheTable) {
    EXPECT_NEAR(errors_of_a_million_normals(oct_half_stored).mean, .0150, .05 * .0150);
}

/// Where x, y and z are alike the octahedron's face is farthest from the sphere, so a step of a coordinate turns a normal most.
TEST(OctHalfGBuffer, NormalsNearTheMiddlesOfFacesAreTheWorst) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> near_one(.7, 1.3);
    const auto near_a_middle = [&] {
        const double x = near_one(random), y = near_one(random), z = near_one(random);
        return glm::normalize(glm::dvec3(x, y, -z));
    };
    EXPECT_NEAR(normal_errors(500000, near_a_middle, oct_half_stored).worst, .0587, .05 * .0587);
}

TEST(OctHalfGBuffer, AxesAreExact) {
    for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        for (const double sign : {1.0, -1.0}) EXPECT_EQ(oct_half_stored(axis * sign), axis * sign);
}

}  // namespace
}  // namespace strata::gbuffer
