// Why the reference of light blockers and portals can be believed (docs/algorithms/lighting.md 2.10 and 7). The eye is at the
// origin and looks along +z, so that world and view are one.
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "captures/scenarios.h"
#include "passes/reference/blockers.h"
#include "passes/reference/fragments.h"
#include "passes/reference/shade.h"

namespace strata {
namespace {

Frame must_build(std::string_view name) {
    const Scenario& scenario = **find_scenario(name);
    return scenario.build(0, {.width = scenario.width, .height = scenario.height});
}

/// A blocker of half size 1 in the plane z = 0 that faces +z, and a light 1 m before it.
struct Wall {
    Frame frame;
    Light light;
    Wall() {
        frame.blockers.emplace_back();
        light.position = {0, 0, 1};
        light.blockers = {0};
        light.range = 100;
    }
    void cut(const Portal& portal) {
        light.portals.push_back(static_cast<std::uint32_t>(frame.portals.size()));
        frame.portals.push_back(portal);
    }
    LightBlockers blockers() const { return light_blockers(frame, light); }
    bool lit(const glm::dvec3& p) const { return lets_through(blockers(), light_point(frame, light), p); }
    /// Dark area of the plane z, by the middles of squares of 2 cm within 5 m.
    double dark_area(double z) const {
        const LightBlockers all = blockers();
        const glm::dvec4 from = light_point(frame, light);
        int dark = 0;
        for (int y = -250; y < 250; ++y)
            for (int x = -250; x < 250; ++x) dark += lets_through(all, from, {.02 * x + .01, .02 * y + .01, z}) ? 0 : 1;
        return dark * 4e-4;
    }
};

Portal window(float half) { return {.half_u = half, .half_v = half}; }

TEST(Blockers, AShadowGrowsWithTheDistanceBehindTheBlocker) {  // docs/algorithms/lighting.md T2.1
    const Wall wall;
    EXPECT_FALSE(wall.lit({1.9999, 1.9999, -1}));
    EXPECT_TRUE(wall.lit({2.0002, 0, -1}));
    EXPECT_TRUE(wall.lit({0, -2.0002, -1}));
    EXPECT_NEAR(wall.dark_area(-1), 16, 1e-9);
    EXPECT_NEAR(wall.dark_area(-3), 64, 1e-9);
}

TEST(Blockers, APortalIsAHoleInTheShadow) {  // docs/algorithms/lighting.md T2.1
    Wall wall;
    wall.cut(window(.25f));
    EXPECT_NEAR(wall.dark_area(-1), 15, 1e-9);
    EXPECT_TRUE(wall.lit({.4999, .4999, -1}));
    EXPECT_FALSE(wall.lit({.5001, 0, -1}));
}

TEST(Blockers, AShelfShadesTheGroundUnderAHighLight) {  // docs/algorithms/lighting.md T2.2
    Wall shelf;
    shelf.frame.blockers[0] = {.center = {0, 2, 10}, .u = {1, 0, 0}, .v = {0, 0, 1}};
    shelf.light.position = {0, 5, 10};
    const double edge = 5. / 3;
    for (const glm::dvec3 side : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1)}) {
        EXPECT_FALSE(shelf.lit(glm::dvec3(0, 0, 10) + side * (edge - 1e-4)));
        EXPECT_TRUE(shelf.lit(glm::dvec3(0, 0, 10) + side * (edge + 1e-4)));
    }
    shelf.cut({.center = {0, 2, 10}, .u = {1, 0, 0}, .v = {0, 0, 1}, .half_u = .5f, .half_v = .5f});
    EXPECT_TRUE(shelf.lit({.8333, 0, 10}));
    EXPECT_FALSE(shelf.lit({.8334, 0, 10}));
}

TEST(Blockers, ADirectionalLightsShadowIsAPrism) {  // docs/algorithms/lighting.md T2.3
    Wall roof;
    roof.light.type = LightType::directional;
    roof.light.direction = {0, 0, -1};
    EXPECT_NEAR(roof.dark_area(-1), 4, 1e-9);
    EXPECT_NEAR(roof.dark_area(-50), 4, 1e-9);
    roof.light.direction = glm::normalize(glm::vec3(1, 0, -1));
    EXPECT_NEAR(roof.dark_area(-2), 4, 1e-9);
    EXPECT_FALSE(roof.lit({2.99, 0, -2})) << "two meters down it has moved two meters aside";
    EXPECT_TRUE(roof.lit({.99, 0, -2}));
}

TEST(Blockers, LightAndPointMayChangePlaces) {  // docs/algorithms/lighting.md T2.4
    std::mt19937 random(24);
    std::uniform_real_distribution<double> within(-2, 2);
    Wall wall;
    wall.cut({.center = {.3, .1, 0}, .u = {.8f, .6f, 0}, .v = {-.6f, .8f, 0}, .half_u = .4f, .half_v = .2f});
    const LightBlockers all = all_blockers(wall.frame, wall.light);
    int dark = 0;
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 a(within(random), within(random), within(random)), b(within(random), within(random), within(random));
        if (std::abs(a.z) < .02 || std::abs(b.z) < .02) continue;
        ASSERT_EQ(clear_between(all, a, b), clear_between(all, b, a)) << "at " << i;
        dark += clear_between(all, a, b) ? 0 : 1;
    }
    EXPECT_GT(dark, 10000);
}

TEST(Blockers, APortalAsLargeAsItsBlockerOpensAllOfIt) {  // docs/algorithms/lighting.md T2.8
    Wall wall;
    wall.cut(window(1));
    EXPECT_EQ(wall.dark_area(-1), 0) << "but for the boundary, which no middle of a square is on";
    wall.frame.portals[0] = window(3);
    EXPECT_EQ(wall.dark_area(-1), 0);
    EXPECT_TRUE(wall.lit({2, 2, -1})) << "not even the boundary";
}

TEST(Blockers, APortalWithoutAreaOpensNothing) {  // docs/algorithms/lighting.md T2.8, N5
    Wall wall;
    wall.cut({.half_u = 1, .half_v = 0});
    EXPECT_NEAR(wall.dark_area(-1), 16, 1e-9);
    EXPECT_FALSE(wall.lit({0, 0, -1}));
    EXPECT_TRUE(wall.blockers().portals.empty());
}

TEST(Blockers, ABlockerWithoutAreaStopsNothing) {
    Wall wall;
    wall.frame.blockers[0].half_v = 0;
    EXPECT_TRUE(wall.lit({0, 0, -1}));
    EXPECT_TRUE(wall.blockers().blockers.empty());
}

TEST(Blockers, APortalOffThePlaneIsProjectedOntoItAndItsPartOutsideIgnored) {  // docs/algorithms/lighting.md N5
    Wall wall;
    wall.cut({.center = {.9, 0, .3}, .half_u = .5f, .half_v = .25f});
    EXPECT_TRUE(wall.lit({.81, 0, -1})) << "from .4 of the blocker on";
    EXPECT_FALSE(wall.lit({.79, 0, -1}));
    EXPECT_TRUE(wall.lit({1.99, 0, -1}));
    EXPECT_NEAR(wall.dark_area(-1), 16 - 1.2, 1e-9);
    wall.frame.portals[0].center.x = 1.6;
    EXPECT_TRUE(wall.blockers().portals.empty()) << "all of it is outside";
}

TEST(Blockers, ATurnedPortalIsTurnedInItsBlocker) {
    Wall wall;
    const float s = std::numbers::sqrt2_v<float> / 2;
    wall.cut({.u = {s, s, 0}, .v = {-s, s, 0}, .half_u = .5f, .half_v = .25f});
    EXPECT_TRUE(wall.lit({.68, .68, -1})) << "its u ends at .5 of the blocker, which is .707 on each axis a meter on";
    EXPECT_FALSE(wall.lit({.72, .72, -1}));
    EXPECT_TRUE(wall.lit({-.34, .34, -1}));
    EXPECT_FALSE(wall.lit({-.37, .37, -1}));
}

TEST(Blockers, PortalsThatAbutLeaveNoLineBetweenThem) {
    Wall wall;
    wall.cut({.center = {-.25, 0, 0}, .half_u = .25f, .half_v = .25f});
    wall.cut({.center = {.25, 0, 0}, .half_u = .25f, .half_v = .25f});
    EXPECT_TRUE(wall.lit({0, 0, -1})) << "each is open, and the line between them belonged to neither";
    wall.frame.portals[1].center.x = .2502;
    EXPECT_FALSE(wall.lit({.0002, 0, -1})) << "a tenth of a millimeter is not a gap, two are";
}

TEST(Blockers, APortalOpensNoBlockerButItsOwn) {  // docs/algorithms/lighting.md N16
    Wall wall;
    wall.frame.blockers.push_back(wall.frame.blockers[0]);
    wall.frame.blockers[1].center.z = -.001;
    wall.light.blockers = {0, 1};
    wall.cut(window(.5f));
    EXPECT_FALSE(wall.lit({0, 0, -1}));
    wall.cut({.center = {0, 0, -.001}, .half_u = .5f, .half_v = .5f, .blocker = 1});
    EXPECT_TRUE(wall.lit({0, 0, -1}));
    EXPECT_FALSE(wall.lit({1.1, 0, -1}));
}

TEST(Blockers, ALightInThePlaneIsNotStopped) {  // docs/algorithms/lighting.md N2, 2.6
    Wall wall;
    for (const double side : {1., -1.}) {
        wall.light.position = {0, 0, .0199 * side};
        EXPECT_TRUE(wall.lit({.1, 0, -side}));
        wall.light.position = {0, 0, .0201 * side};
        EXPECT_FALSE(wall.lit({.1, 0, -side}));
    }
    wall.light.type = LightType::directional;
    wall.light.direction = glm::vec3(std::sqrt(1 - 9e-4f * 9e-4f), 0, -9e-4f);
    EXPECT_TRUE(wall.lit({100, 0, -.1}));
    wall.light.direction = glm::vec3(std::sqrt(1 - 1.1e-3f * 1.1e-3f), 0, -1.1e-3f);
    EXPECT_FALSE(wall.lit({.1 / 1.1e-3, 0, -.1}));
}

TEST(Blockers, APointOnTheLightsSideIsLit) {  // docs/algorithms/lighting.md N3
    const Wall wall;
    EXPECT_TRUE(wall.lit({0, 0, 3})) << "the light is between it and the blocker";
    EXPECT_TRUE(wall.lit({0, 0, .5}));
    EXPECT_TRUE(wall.lit({0, 0, 0}));
}

TEST(Blockers, FacesOnABlockersPlaneAreLitFromTheirOwnSide) {  // docs/algorithms/lighting.md N6
    Wall wall;
    for (const double side : {1., -1.}) {
        wall.light.position = {0, 0, side};
        for (const double noise : {0., 1e-4, -1e-4}) {
            const glm::dvec3 on_plane(.2, .1, noise);
            EXPECT_TRUE(wall.lit(off_surface(on_plane, {0, 0, side}))) << noise;
            EXPECT_FALSE(wall.lit(off_surface(on_plane, {0, 0, -side}))) << noise;
        }
    }
    EXPECT_NEAR(off_surface({0, 0, 100}, {0, 0, -1}).z, 100 - .05, 1e-12) << "5e-4 of the depth from 20 m on";
}

TEST(Blockers, AOneSidedBlockerStopsLightFromTheSideItsAxesFace) {
    Wall wall;
    wall.frame.blockers[0].one_sided = true;
    EXPECT_FALSE(wall.lit({0, 0, -1}));
    wall.light.position = {0, 0, -1};
    EXPECT_TRUE(wall.lit({0, 0, 1}));
    // A right-handed world is seen in left-handed view space: the side is the world's.
    wall.frame.view.to_view[0][0] = -1;
    EXPECT_TRUE(wall.lit({0, 0, 1}));
    wall.light.position = {0, 0, 1};
    EXPECT_FALSE(wall.lit({0, 0, -1}));
}

TEST(Blockers, PortalsLieRightInAMirroredView) {
    Wall wall;
    wall.cut({.center = {.5, .25, 0}, .u = {.6f, .8f, 0}, .v = {-.8f, .6f, 0}, .half_u = .3f, .half_v = .1f});
    Wall mirrored = wall;
    mirrored.frame.view.to_view[0][0] = -1;
    int open = 0;
    for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x) {
            const glm::dvec3 p(.1 * x + .013, .1 * y + .007, -1);
            ASSERT_EQ(mirrored.lit({-p.x, p.y, p.z}), wall.lit(p)) << x << " " << y;
            open += wall.lit(p) ? 1 : 0;
        }
    EXPECT_GT(open, 20);
}

TEST(Blockers, OutOfReachOnesAreLeftOut) {
    Wall wall;
    wall.light.range = .9f;
    EXPECT_TRUE(wall.blockers().blockers.empty());
    EXPECT_EQ(all_blockers(wall.frame, wall.light).blockers.size(), 1u);
    wall.light.type = LightType::sphere;
    wall.light.source_radius = .2f;
    EXPECT_EQ(wall.blockers().blockers.size(), 1u) << "the emitter comes nearer than its center";
}

TEST(Blockers, TheSmallestOf33IsDroppedAndCounted) {  // docs/algorithms/lighting.md N17
    Wall wall;
    wall.frame.blockers.clear();
    wall.light.blockers.clear();
    for (std::uint32_t i = 0; i < 33; ++i) {  // larger and farther away, so that it is the angle that decides
        const double away = 1 + i;
        wall.frame.blockers.push_back({.center = {0, 0, 1 - away}, .half_u = float(away), .half_v = 1});
        wall.light.blockers.push_back(32 - i);
    }
    const LightBlockers kept = wall.blockers();
    EXPECT_EQ(kept.dropped, 1u);
    ASSERT_EQ(kept.blockers.size(), 32u);
    for (std::uint32_t i = 0; i < 32; ++i) EXPECT_EQ(kept.blockers[i].blocker, 31 - i) << "in the light's order";
}

TEST(Blockers, AnEmittersPointsAreStoppedOneByOne) {
    Wall wall;
    wall.light.position = {0, 0, .01};  // in the plane: as a point it is not stopped at all
    const LightBlockers all = all_blockers(wall.frame, wall.light);
    EXPECT_TRUE(wall.lit({0, 0, -1}));
    EXPECT_FALSE(clear_between(all, {0, 0, -1}, {0, .1, .5}));
    EXPECT_TRUE(clear_between(all, {0, 0, -1}, {0, .1, -.5}));
    EXPECT_TRUE(clear_between(all, {0, 3, -1}, {0, 3, .5}));
}

TEST(Blockers, LetTheLightOfARoomLeaveItByTheDoorAlone) {
    const Frame frame = must_build("blocker_rooms");
    const Light& warm = frame.lights[0];
    const LightBlockers all = light_blockers(frame, warm);
    const glm::dvec4 from = light_point(frame, warm);
    int lit = 0, dark = 0;
    for (int x = 1; x < 40; ++x)
        for (int z = 1; z < 40; ++z) {  // the right room's floor, and where it sees the lamp through the wall at x = 0
            const glm::dvec3 p(.1 * x + .003, .01, -.1 * z - .003);
            const glm::dvec3 at = p + (warm.position - p) * (p.x / (p.x - warm.position.x));
            const bool through_door = std::abs(at.z + 2) < .4 && at.y < 2;
            ASSERT_EQ(lets_through(all, from, to_view(frame, p)), through_door) << p.x << " " << p.z;
            (through_door ? lit : dark)++;
        }
    EXPECT_GT(lit, 100);
    EXPECT_GT(dark, 800);
}

TEST(Blockers, HoldLightOffTransparentSurfaces) {  // 2.8
    Frame frame = must_build("blocker_rooms");
    const ReferenceImage nothing_opaque(frame.view.width, frame.view.height);
    const FragmentLists held = transparent_fragments(frame, nothing_opaque);
    for (Light& light : frame.lights) light.blockers.clear();
    const FragmentLists free = transparent_fragments(frame, nothing_opaque);
    int same = 0, darker = 0;
    for (std::uint32_t y = 0; y < frame.view.height; ++y)
        for (std::uint32_t x = 0; x < frame.view.width; ++x) {
            if (held.at(x, y).empty()) continue;
            const double before = held.at(x, y)[0].color.x, after = free.at(x, y)[0].color.x;
            ASSERT_LE(before, after);
            (before < after ? darker : same)++;
        }
    EXPECT_GT(darker, 50) << "of the curtain, in the shadow of the wall";
    EXPECT_GT(same, 20) << "of the curtain, behind the door";
}

TEST(SoftBlockers, WithoutARadiusAreTheHardOnes) {  // 2.2
    Wall wall;
    wall.cut(window(.25f));
    const LightBlockers all = wall.blockers();
    const glm::dvec4 from = light_point(wall.frame, wall.light);
    for (int x = -30; x < 30; ++x) {
        const glm::dvec3 p(.1 * x + .05, .01, -1);
        EXPECT_EQ(soft_visibility(all, from, p, {}), lets_through(all, from, p) ? 1 : 0) << p.x;
        EXPECT_NEAR(soft_visibility(all, from, p, {.radius = 1e-6}), lets_through(all, from, p) ? 1 : 0, 1e-12) << p.x;
    }
}

TEST(SoftBlockers, BlurTheirEdgeOverThePenumbraOfTheSource) {
    const Wall wall;
    const LightBlockers all = wall.blockers();
    const glm::dvec4 from = light_point(wall.frame, wall.light);
    const auto visible = [&](double x) { return soft_visibility(all, from, {x, 0, -1}, {.radius = .2}); };
    // q = .2 * 1 / 2 on the blocker, twice that a meter behind it.
    EXPECT_NEAR(visible(2), .5, 1e-3);
    EXPECT_NEAR(visible(2.1), .84375, 1e-3) << "smoothstep at three quarters";
    EXPECT_EQ(visible(2.21), 1);
    EXPECT_EQ(visible(1.79), 0);
    for (double x = 1.8; x < 2.2; x += .01) EXPECT_LT(visible(x), visible(x + .01));
}

TEST(SoftBlockers, APortalGivesBackWhatItsBlockerTakes) {
    Wall wall;
    wall.cut(window(1));
    const LightBlockers all = wall.blockers();
    const glm::dvec4 from = light_point(wall.frame, wall.light);
    for (int x = 0; x < 60; ++x)
        EXPECT_NEAR(soft_visibility(all, from, {.05 * x, .3, -1}, {.radius = .2}), 1, 1e-3) << "a portal as large as it";
}

TEST(SoftBlockers, FadeInWhileTheLightLeavesTheirPlane) {  // 2.6
    Wall wall;
    const auto visible = [&](double height) {
        wall.light.position.z = height;
        return soft_visibility(all_blockers(wall.frame, wall.light), light_point(wall.frame, wall.light), {0, 0, -1},
                               {.fade = .02});
    };
    EXPECT_EQ(visible(.02), 1);
    EXPECT_NEAR(visible(.0201), 1, 1e-3) << "no jump where it begins";
    EXPECT_NEAR(visible(.03), .5, 1e-12);
    EXPECT_EQ(visible(.04), 0);
    EXPECT_EQ(visible(1), 0);
}

}  // namespace
}  // namespace strata
