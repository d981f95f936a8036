// How much of a cell's face a portal opens that may fit between the ways through it (docs/algorithms/lighting.md 5.6).
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/light.h"
#include "passes/indirect/lpv/occlusion/small_portals.h"

namespace strata::indirect {
namespace {

const LightGrid grid{.origin = {-2, -2, -2}, .cell = .5, .cells = glm::uvec3(8)};
const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

TEST(SmallPortals, OpenTheirAreaOfACellsFace) {
    const Portal hole{.center = {0, .25, .25}, .u = y, .v = z, .half_u = .02f, .half_v = .03f};
    EXPECT_NEAR(opened_share(grid, hole), .04 * .06 / .25, 1e-7);
    Portal oblique = hole;
    oblique.u = glm::normalize(x + 2.f * y);
    EXPECT_NEAR(opened_share(grid, oblique), .04 * .06 / .25 * 2 / std::sqrt(5.), 1e-7) << "seen along x";
    Portal turned = hole;
    turned.u = glm::normalize(y + z), turned.v = glm::normalize(y - z);
    EXPECT_NEAR(opened_share(grid, turned), .04 * .06 / .25, 1e-7);
}

TEST(SmallPortals, OpenNoMoreThanTheFaceHolds) {
    const Portal slit{.center = {0, .25, .25}, .u = y, .v = z, .half_u = 9, .half_v = .02f};
    EXPECT_NEAR(opened_share(grid, slit), .04 / .5, 1e-7) << "across all of it";
    const Portal at_a_corner{.center = {0, 0, 0}, .u = y, .v = z, .half_u = .02f, .half_v = .02f};
    EXPECT_NEAR(opened_share(grid, at_a_corner), .04 * .04 / .25 / 4, 1e-7) << "of four faces";
    const Portal at_the_border{.center = {0, -2, .25}, .u = y, .v = z, .half_u = .02f, .half_v = .02f};
    EXPECT_NEAR(opened_share(grid, at_the_border), .04 * .04 / .25 / 2, 1e-7) << "half of it is outside of the grid";
    const Portal large{.center = {0, 0, 0}, .u = y, .v = z, .half_u = 1, .half_v = 1};
    EXPECT_NEAR(opened_share(grid, large), 1, 1e-12);
}

TEST(SmallPortals, OpenNothingWithoutArea) {
    EXPECT_EQ(opened_share(grid, {.center = {0, .25, .25}, .u = y, .v = z, .half_u = 0, .half_v = 1}), 0);
}

}  // namespace
}  // namespace strata::indirect
