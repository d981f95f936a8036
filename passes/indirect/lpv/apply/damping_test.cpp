// Facts about damping, on the model: light that comes through the back of a surface is dimmed (docs/algorithms/lighting.md 5.8).
#include <cmath>

#include <gtest/gtest.h>

#include "passes/indirect/lpv/propagation/propagation_model.h"
#include "passes/indirect/reading_model.h"

namespace strata::indirect::in_double {
namespace {

using glm::dvec3, glm::dvec4, glm::uvec3;

/// After 16 steps from a lobe towards +z in the middle of 33 cells a side.
struct LoneLobe {
    LitGrid lit{.grid = {.cells = uvec3(33)}, .light = {}};

    LoneLobe() {
        Channel light(cell_count(lit.grid));
        light[cell_index(lit.grid.cells, uvec3(16))] = cosine_lobe({0, 0, 1});
        light = propagated({lit.grid.cells}, light, {propagation_clamped, faces_centre}, 16);
        lit.light.fill(light);
        lit.irradiance = irradiance_cell;
    }
    /// Half a cell before a surface so many cells from the lobe along z.
    double at(double cells, const dvec3& normal, double damping) {
        lit.damping = damping;
        return irradiance(lit, {.position = dvec3(16.5, 16.5, 16.5 + cells) - 0.5 * normal, .normal = normal}).x;
    }
};

TEST(Damping, KeepsLightByTheAngleBetweenItAndItsChange) {
    const dvec4 light(1, 0, 0, 0), across(0, 1, 0, 0);
    EXPECT_EQ(kept_share(light, 0.5 * light, 2), 1) << "grows towards the outside";
    EXPECT_EQ(kept_share(light, 2.0 * light, 2), 0) << "grows towards the inside";
    EXPECT_EQ(kept_share(light, light + across, 2), 0.25) << "across: half, squared";
    EXPECT_EQ(kept_share(light, light + across, 0.5), std::sqrt(0.5));
    EXPECT_EQ(kept_share(light, light, 2), 1) << "does not change";
    EXPECT_EQ(kept_share(dvec4(0), light, 2), 1) << "there is none";
}

TEST(Damping, TakesAwayWhatComesThroughTheBackOfASurfaceAndLeavesTheRest) {
    LoneLobe lobe;
    for (const double cells : {2, 3, 4}) {
        const dvec3 forwards(0, 0, 1), backwards(0, 0, -1);
        for (const double damping : {1, 2, 4}) {
            // Surfaces that look away from the lobe should receive nothing.
            EXPECT_LT(lobe.at(cells, forwards, damping), 1e-3 * lobe.at(cells, forwards, 0)) << "before the lobe";
            EXPECT_LT(lobe.at(-cells, backwards, damping), 1e-3 * lobe.at(-cells, backwards, 0)) << "behind the lobe";
            EXPECT_NEAR(lobe.at(cells, backwards, damping) / lobe.at(cells, backwards, 0), 1, 1e-4) << "before, lit by it";
            // The truth is 0 here, too, but light grows towards the lobe: damping does not find out.
            EXPECT_NEAR(lobe.at(-cells, forwards, damping) / lobe.at(-cells, forwards, 0), 1, 1e-4) << "behind, facing it";
        }
    }
}

}  // namespace
}  // namespace strata::indirect::in_double
