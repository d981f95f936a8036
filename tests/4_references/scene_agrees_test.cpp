// What the device is given and what references start from, derived twice from the same frame, agree: for every scenario, and for
// the cases by hand that no scenario has.
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "captures/scenarios.h"
#include "passes/reference/blockers.h"
#include "passes/reference/bounds.h"
#include "passes/reference/fragments.h"
#include "passes/reference/light_sets.h"
#include "passes/reference/ordering.h"
#include "passes/reference/triangles.h"
#include "passes/scene/light_records.h"
#include "passes/scene/object_order.h"
#include "passes/scene/scene_facts.h"
#include "tests/4_references/random_blockers.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

std::vector<std::pair<std::string_view, Frame>> frames_of_scenarios() {
    std::vector<std::pair<std::string_view, Frame>> frames;
    for (const Scenario& scenario : scenarios()) frames.emplace_back(scenario.name, scenario.build(0, {}));
    return frames;
}

/// An opaque quad, one that casts no shadow, a masked and a blended one, and two emitters.
Frame every_kind() {
    Frame frame = tiny::frame(16, 16);
    for (int i = 0; i < 4; ++i) tiny::add_quad(frame, {2, 2, 8, 8}, 2 + i);
    frame.materials = {Material{}, Material{}, Material{}};
    frame.materials[1].alpha_mode = AlphaMode::mask;
    frame.materials[2].alpha_mode = AlphaMode::blend;
    frame.draws[0].material = frame.draws[1].material = 0;
    frame.draws[2].material = 2;
    frame.draws[3].material = 1;
    frame.draws[1].casts_shadow = false;
    frame.emitters.resize(2);
    return frame;
}

TEST(Scene, ListsDrawsInTheOrderOfSubmission) {
    const Frame frame = every_kind();
    const DrawLists lists = draw_lists(frame);
    EXPECT_THAT(lists.opaque, testing::ElementsAre(0, 1, 3));
    EXPECT_THAT(lists.casters, testing::ElementsAre(0, 3));
    EXPECT_THAT(lists.transparent, testing::ElementsAre(2, 4, 5));
    EXPECT_EQ(opaque_draws(frame), lists.opaque);
    EXPECT_EQ(transparent_draws(frame), lists.transparent);
}

/// Pipelines leave backs out only where every draw does: two-sided materials and particles show all of their triangles.
TEST(Scene, ShowsNoBacksWhereEveryMaterialIsOneSided) {
    Frame frame = every_kind();
    EXPECT_TRUE(shows_no_backs(frame, draw_lists(frame).opaque));
    EXPECT_FALSE(shows_no_backs(frame, draw_lists(frame).transparent)) << "particles";
    frame.emitters.clear();
    EXPECT_TRUE(shows_no_backs(frame, draw_lists(frame).transparent));
    frame.materials[2].double_sided = true;
    EXPECT_FALSE(shows_no_backs(frame, draw_lists(frame).transparent));
    EXPECT_TRUE(shows_no_backs(frame, draw_lists(frame).opaque)) << "no draw of it uses that material";
}

TEST(Scene, ListsTheSunFirstAndNoLightThatIsDark) {
    Frame frame = tiny::frame(4, 4);
    frame.sun.irradiance = {1, 1, 1};
    frame.lights = {{.name = "black", .intensity = {0, 0, 0}, .range = 1},
                    {.name = "short", .intensity = {1, 1, 1}, .range = 0},
                    {.name = "dark", .intensity = {-1, 0, 0}, .range = 1}};
    for (const auto& lights : {light_list(frame), shining_lights(frame)}) {
        ASSERT_EQ(lights.size(), 2u);
        EXPECT_EQ(lights[0].name, "sun");
        EXPECT_EQ(lights[1].name, "dark");
    }
}

TEST(Scene, AgreesWithReferencesOnDraws) {
    for (const auto& [name, frame] : frames_of_scenarios()) {
        const SceneFacts facts(frame);
        EXPECT_EQ(facts.lists().opaque, opaque_draws(frame)) << name;
        EXPECT_EQ(facts.lists().transparent, transparent_draws(frame)) << name;
        EXPECT_EQ(back_to_front_draws(frame), painters_order(frame)) << name;
        for (const Emitter& emitter : frame.emitters)
            EXPECT_EQ(back_to_front_particles(frame, emitter), painters_order(frame, emitter)) << name;
        for (const std::uint32_t index : facts.lists().transparent)
            EXPECT_EQ(triangles_drawn(frame, index), triangle_count(frame, index)) << name;
    }
}

TEST(Scene, AgreesWithReferencesOnLights) {
    for (const auto& [name, frame] : frames_of_scenarios()) {
        const SceneFacts facts(frame);
        const std::vector<Light> shining = shining_lights(frame);
        ASSERT_EQ(facts.lights().size(), shining.size()) << name;
        for (std::size_t i = 0; i < shining.size(); ++i) {
            EXPECT_EQ(facts.lights()[i].name, shining[i].name) << name;
            EXPECT_EQ(facts.lights()[i].type, shining[i].type) << name;
            EXPECT_EQ(facts.lights()[i].intensity, shining[i].intensity) << name;
            EXPECT_EQ(facts.lights()[i].position, shining[i].position) << name;
        }
        for (const Allocation allocation : {Allocation::own, Allocation::need})
            EXPECT_EQ(shadowed_lights(facts.shadow_views(allocation)), mapped_lights(frame)) << name;
    }
}

/// The blockers and portals that the device is given of a light, in the reference's terms.
LightBlockers given_blockers(const LightRecords& given, const LightRecord& light) {
    LightBlockers result;
    for (std::uint32_t i = 0; i < light.blockers; ++i) {
        const auto& [blocker, portals] = given.light_blockers[light.first_blocker + i];
        const BlockerRecord& b = given.blockers[blocker];
        const glm::dvec3 normal(b.normal), u(b.u);
        result.blockers.push_back({.shape = {b.center, normal, u, glm::cross(normal, u), b.half_u, b.half_v, b.one_sided != 0},
                                   .blocker = blocker,
                                   .portals = portals});
    }
    for (std::uint32_t i = 0; i < light.portals; ++i) {
        const BlockerPortalRecord& p = given.blocker_portals[light.first_portal + i];
        result.portals.push_back({p.center, p.half_extent, p.turn, p.blocker});
    }
    return result;
}

/// Whether values agree to within 1e-6: more than the rounding of records, a tenth of what a blocker grows by.
bool is_near(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-6 * (1 + glm::length(b)); }
bool is_near(double a, double b) { return std::abs(a - b) < 1e-6 * (1 + std::abs(b)); }

bool is_same(const LightBlocker& a, const LightBlocker& b) {
    return a.blocker == b.blocker && a.portals == b.portals && a.shape.one_sided == b.shape.one_sided &&
           is_near(a.shape.center, b.shape.center) && is_near(a.shape.normal, b.shape.normal) && is_near(a.shape.u, b.shape.u) &&
           is_near(a.shape.half_u, b.shape.half_u) && is_near(a.shape.half_v, b.shape.half_v);
}

/// In view space: the two may differ in the v axis that they measure along.
bool is_same(const PlacedPortal& a, const PlacedBlocker& in_a, const PlacedPortal& b, const PlacedBlocker& in_b) {
    const auto in_view = [](const PlacedBlocker& in, const glm::dvec2& flat) { return in.u * flat.x + in.v * flat.y; };
    return a.blocker == b.blocker && is_near(in_view(in_a, a.center), in_view(in_b, b.center)) &&
           is_near(in_view(in_a, a.turn * a.half_extent.x), in_view(in_b, b.turn * b.half_extent.x)) &&
           is_near(a.half_extent.y, b.half_extent.y);
}

/// Whether both have the same blockers, portals and bits in the same order.
bool is_same(const LightBlockers& a, const LightBlockers& b) {
    if (a.blockers.size() != b.blockers.size() || a.portals.size() != b.portals.size()) return false;
    for (std::size_t i = 0; i < a.blockers.size(); ++i)
        if (!is_same(a.blockers[i], b.blockers[i])) return false;
    for (std::size_t k = 0; k < a.portals.size(); ++k)
        for (std::size_t i = 0; i < a.blockers.size(); ++i)
            if (a.blockers[i].blocker == a.portals[k].blocker &&
                !is_same(a.portals[k], a.blockers[i].shape, b.portals[k], b.blockers[i].shape))
                return false;
    return true;
}

/// Whether a change by less than a micrometer changes what the reference says: a number is on a threshold, where rounding
/// decides.
bool is_on_a_threshold(const Frame& frame, const Light& light) {
    const LightBlockers before = light_blockers(frame, light);
    for (const float nudge : {-3e-7f, 3e-7f}) {
        Frame larger = frame, leaning = frame;
        for (Blocker& blocker : larger.blockers) blocker.half_u *= 1 + nudge, blocker.half_v *= 1 + nudge;
        for (Portal& portal : larger.portals) portal.half_u *= 1 + nudge, portal.half_v *= 1 + nudge;
        for (Portal& portal : leaning.portals) portal.u += nudge * glm::cross(portal.u, portal.v);
        if (!is_same(light_blockers(larger, light), before) || !is_same(light_blockers(leaning, light), before)) return true;
        for (int axis = 0; axis < 3; ++axis) {
            Light moved = light;
            moved.position[axis] += double(nudge);
            moved.direction[axis] += nudge;
            if (!is_same(light_blockers(frame, moved), before)) return true;
        }
    }
    return false;
}

struct Agreement {
    std::size_t lights = 0, blockers = 0, portals = 0, full = 0, undecided = 0;
};

/// Compares what a frame's lights are given with what the reference says of them; false where that differs.
bool agree_on_blockers(const Frame& frame, Agreement& found) {
    const LightRecords given = light_records(frame, light_list(frame));
    const std::vector<Light> shining = shining_lights(frame);
    if (given.lights.size() != shining.size() || given.blockers.size() != frame.blockers.size()) return false;
    for (std::size_t i = 0; i < shining.size(); ++i) {
        const LightBlockers expected = light_blockers(frame, shining[i]);
        if (!is_same(given_blockers(given, given.lights[i]), expected)) {
            if (!is_on_a_threshold(frame, shining[i])) return false;
            ++found.undecided;
        }
        ++found.lights;
        found.blockers += expected.blockers.size();
        found.portals += expected.portals.size();
        found.full += expected.dropped > 0 ? 1 : 0;
    }
    return true;
}

TEST(Scene, AgreesWithReferencesOnBlockersAndPortals) {
    Agreement found;
    for (const auto& [name, frame] : frames_of_scenarios()) EXPECT_TRUE(agree_on_blockers(frame, found)) << name;
    EXPECT_GT(found.blockers, 1000u);
    EXPECT_GT(found.portals, 700u);
    EXPECT_EQ(found.undecided, 0u);
}

TEST(Scene, AgreesWithReferencesOnRandomBlockersAndPortals) {
    tiny::Random random(32);
    Agreement found;
    for (int i = 0; i < 400; ++i) ASSERT_TRUE(agree_on_blockers(tiny::blockers_at_random(random), found)) << "frame " << i;
    EXPECT_EQ(found.lights, 1200u);
    EXPECT_GT(found.blockers, 10000u);
    EXPECT_GT(found.portals, 5000u);
    EXPECT_GT(found.full, 100u) << "no light had to choose 32 blockers";
    EXPECT_LE(found.undecided, 6u) << "lights with a number on a threshold";
}

TEST(Scene, AgreesWithReferencesOnBoundsAndDepthsButForRounding) {
    for (const auto& [name, frame] : frames_of_scenarios()) {
        const SceneFacts facts(frame);
        for (std::uint32_t draw = 0; draw < frame.draws.size(); ++draw) {
            const Sphere sphere = bounding_sphere(frame, draw);
            const BoundingSphere& given = facts.bounds().spheres[draw];
            const double rounding = 1e-9 * (1 + sphere.radius + glm::length(sphere.center));
            EXPECT_NEAR(glm::distance(given.center, sphere.center), 0, rounding) << name << " " << draw;
            EXPECT_NEAR(given.radius, sphere.radius, rounding) << name << " " << draw;
        }
        const DepthRange world = world_depth_range(frame), all = transparent_depth_range(frame);
        EXPECT_FLOAT_EQ(facts.world_depths().nearest, world.nearest) << name;
        EXPECT_FLOAT_EQ(facts.world_depths().farthest, world.farthest) << name;
        EXPECT_FLOAT_EQ(facts.transparent_depths().nearest, all.nearest) << name;
        EXPECT_FLOAT_EQ(facts.transparent_depths().farthest, all.farthest) << name;
    }
}

TEST(SceneFacts, DeriveNothingBeforeItIsAskedForAndNothingTwice) {
    const Frame frame = every_kind();
    const SceneFacts facts(frame);
    EXPECT_EQ(facts.derived(), 0u);
    const auto* views = &facts.shadow_views(Allocation::own);  // with the lists, lights and bounds they are made of
    EXPECT_EQ(facts.derived(), 4u);
    EXPECT_EQ(&facts.shadow_views(Allocation::own), views);
    EXPECT_EQ(facts.derived(), 4u);
    const auto* rows = &facts.fragment_bounds({16, 16, 1}, 1);
    facts.fragment_bounds({8, 8, 1}, 1);
    EXPECT_EQ(&facts.fragment_bounds({16, 16, 1}, 1), rows);
    EXPECT_EQ(facts.derived(), 6u) << "bounds, once per extent and samples";
}

}  // namespace
}  // namespace strata
