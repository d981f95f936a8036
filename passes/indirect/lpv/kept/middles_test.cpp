// Where the eye's place decides on which side of a blocker a cell's middle is.
#include <gtest/gtest.h>

#include "passes/indirect/lpv/kept/middles.h"

namespace strata::indirect {
namespace {

/// Middles at multiples of half a metre from (-2, -2, -2) to (1.5, 1.5, 1.5).
const LightGrid grid{.origin = glm::dvec3(-2.25), .cell = .5, .cells = glm::uvec3(8)};

bool meets(const Blocker& blocker) {
    Frame frame;
    frame.blockers = {blocker};
    return has_middle_on_a_plane(frame, grid);
}

/// A square of two metres.
Blocker square(glm::dvec3 center, glm::vec3 u, glm::vec3 v) { return {.center = center, .u = u, .v = v}; }

TEST(MiddlesOnPlanes, AreFoundOfUprightAndObliqueWalls) {
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    EXPECT_TRUE(meets(square({.5, 0, 0}, y, z)));
    EXPECT_TRUE(meets(square({0, -1, .1}, z, x)));
    EXPECT_FALSE(meets(square({.25, 0, 0}, y, z))) << "at the border of cells";
    EXPECT_FALSE(meets(square({.501, 0, 0}, y, z)));
    EXPECT_TRUE(meets(square({.5 + 1e-6, 0, 0}, y, z)));
    const glm::vec3 slope = glm::normalize(glm::vec3(1, 0, 1));
    EXPECT_TRUE(meets(square({.5, 0, .5}, slope, y)));
    EXPECT_FALSE(meets(square({.6, 0, .5}, slope, y)));
    EXPECT_FALSE(meets(square({0, 0, .25}, x, y)));
    EXPECT_FALSE(meets(square({0, 0, 5}, x, y))) << "outside of the grid";
    EXPECT_FALSE(meets(square({9, 0, 0}, x, y))) << "too far beside the grid";
}

TEST(MiddlesOnPlanes, AreNoneOfABlockerWithoutArea) {
    EXPECT_FALSE(meets({.center = {.5, 0, 0}, .u = {0, 1, 0}, .v = {0, 0, 1}, .half_u = 0, .half_v = 1}));
}

}  // namespace
}  // namespace strata::indirect
