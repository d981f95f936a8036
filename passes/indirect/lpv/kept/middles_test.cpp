// Where rounding decides on which side of a blocker a cell's middle is.
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/indirect/lpv/kept/middles.h"

namespace strata::indirect {
namespace {

/// Middles at multiples of half a meter from (-2, -2, -2) to (1.5, 1.5, 1.5).
const LightGrid half_meters{.origin = glm::dvec3(-2.25), .cell = .5, .cells = glm::uvec3(8)};

bool meets(const Blocker& blocker) {
    Frame frame;
    frame.blockers = {blocker};
    return has_middle_of_either_side(frame, frame.view.origin, half_meters);
}

/// A square of two meters.
Blocker square(glm::dvec3 center, glm::vec3 u, glm::vec3 v) { return {.center = center, .u = u, .v = v}; }

const glm::vec3 right(1, 0, 0), up(0, 1, 0), ahead(0, 0, 1);
constexpr double mm = 1e-3;

// A side begins a millimeter before the plane, seen along (1, .37, .14), whichever way the blocker faces.
TEST(MiddlesOfEitherSide, LieAMillimeterBeforeUprightAndObliqueWalls) {
    for (const bool turned : {false, true}) {
        const auto wall = [&](glm::dvec3 center, glm::vec3 u, glm::vec3 v) {
            return turned ? square(center, v, u) : square(center, u, v);
        };
        EXPECT_TRUE(meets(wall({.5 + mm, 0, 0}, up, ahead)));
        EXPECT_TRUE(meets(wall({.5 + mm + 1e-6, 0, 0}, up, ahead)));
        EXPECT_TRUE(meets(wall({0, -1 + mm, .1}, ahead, right)));
        EXPECT_FALSE(meets(wall({.5 - mm, 0, 0}, up, ahead))) << "behind it";
        EXPECT_FALSE(meets(wall({.25 + mm, 0, 0}, up, ahead))) << "at the border of cells";
        const glm::vec3 slope = glm::normalize(glm::vec3(-1, 0, 1));
        const glm::dvec3 across = mm * glm::normalize(glm::dvec3(1, 0, 1));
        EXPECT_TRUE(meets(wall(glm::dvec3(.5, 0, .5) + across, slope, up)));
        EXPECT_FALSE(meets(wall(glm::dvec3(.6, 0, .5) + across, slope, up)));
        EXPECT_FALSE(meets(wall({0, 0, .25 + mm}, right, up)));
        EXPECT_FALSE(meets(wall({0, 0, 5 + mm}, right, up))) << "outside of the grid";
        EXPECT_FALSE(meets(wall({9, 0, mm}, right, up))) << "too far beside the grid";
    }
}

TEST(MiddlesOfEitherSide, AreNotThoseOnThePlaneWhichBelongToOne) {
    EXPECT_FALSE(meets(square({.5, 0, 0}, up, ahead)));
    EXPECT_FALSE(meets(square({0, -1, .1}, ahead, right)));
    EXPECT_FALSE(meets(square({.5, 0, .5}, glm::normalize(glm::vec3(1, 0, 1)), up)));
}

/// Along the plane runs the direction that decides.
TEST(MiddlesOfEitherSide, AreThoseOnAPlaneThatNoDirectionDecidesAbout) {
    const glm::vec3 along = glm::normalize(glm::vec3(1, .37f, .14f)), across = glm::normalize(glm::cross(along, up));
    EXPECT_TRUE(meets(square({.5, 0, 0}, along, glm::cross(along, across))));
    EXPECT_FALSE(meets(square(glm::dvec3(.5, 0, 0) + 3 * mm * glm::dvec3(across), along, glm::cross(along, across))));
}

TEST(MiddlesOfEitherSide, AreNoneOfABlockerWithoutArea) {
    EXPECT_FALSE(meets({.center = {.5 + mm, 0, 0}, .u = up, .v = ahead, .half_u = 0, .half_v = 1}));
}

}  // namespace
}  // namespace strata::indirect
