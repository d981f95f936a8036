// What the device is given and what references start from, derived twice from the same frame, agree: for every scenario, and for
// the cases by hand that no scenario has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "captures/scenarios.h"
#include "passes/reference/bounds.h"
#include "passes/reference/fragments.h"
#include "passes/reference/light_sets.h"
#include "passes/reference/ordering.h"
#include "passes/reference/triangles.h"
#include "passes/scene/object_order.h"
#include "passes/scene/scene_facts.h"
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
    const auto* rows = &facts.row_bounds({16, 16, 1});
    facts.row_bounds({8, 8, 1});
    EXPECT_EQ(&facts.row_bounds({16, 16, 1}), rows);
    EXPECT_EQ(facts.derived(), 6u) << "bounds of rows, once per extent";
}

}  // namespace
}  // namespace strata
