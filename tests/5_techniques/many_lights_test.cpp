// Lights of more turns than a driver lets the loops of an invocation take: right, or refused.
#include <gtest/gtest.h>

#include "passes/registry.h"
#include "replay/gpu/device.h"
#include "tests/5_techniques/light_scenes.h"

namespace strata {
namespace {

constexpr std::uint32_t most_blockers = 32;

/// Lights in a room, each with the same blockers, which stand behind the eye and stop nothing that is seen.
Frame blocked_lights(std::size_t lights, std::uint32_t blockers, std::string_view scenario = "lights_room") {
    Frame frame = dark_frame(scenario);
    frame.view.width = 16, frame.view.height = 9;
    for (Material& material : frame.materials) material.lighting_model = LightingModel::lambert;
    Light lamp;
    lamp.type = LightType::omni, lamp.range = 50, lamp.intensity = glm::vec3(4.f / float(lights));
    lamp.position = to_world(frame, {0, .5, 2});
    for (std::uint32_t i = 0; i < blockers; ++i) {
        Blocker wall;
        wall.center = to_world(frame, {0, 0, -20 - double(i)});
        wall.u = to_world(frame, {1, 0, 0}) - frame.view.origin, wall.v = to_world(frame, {0, 1, 0}) - frame.view.origin;
        wall.half_u = wall.half_v = 1;
        frame.blockers.push_back(wall);
        lamp.blockers.push_back(i);
    }
    frame.lights.assign(lights, lamp);
    return frame;
}

bool loops_are_short() { return !has(session_of_scenarios().device().capabilities, Capability::long_loops); }

Result<double> worst_error(const Frame& frame, const std::string& technique, std::vector<std::string> sets = {}) {
    auto session = Session::open({frame}, {});
    if (!session) return session.error();
    const Stage stage = must(find_technique(technique))->stage;
    auto accuracy = (*session)->judge({.choices = chosen({technique}, std::move(sets))}, stage, Against::model);
    if (!accuracy) return accuracy.error();
    return accuracy->model_worst;
}

/// Right where loops may turn as often as they like, refused elsewhere.
void expect_refused(const Frame& frame, const std::string& technique, const std::string& set = "") {
    SCOPED_TRACE(technique);
    const Result<double> error = worst_error(frame, technique, set.empty() ? std::vector<std::string>{} : std::vector{set});
    if (loops_are_short()) {
        ASSERT_FALSE(error) << *error;
        EXPECT_EQ(error.error().fault, Fault::device_lacks) << error.error().sentence;
    } else {
        ASSERT_TRUE(error) << error.error().sentence;
        EXPECT_LE(*error, must(find_technique(technique))->tolerance.worst);
    }
}

void expect_right(const Frame& frame, const std::string& technique) {
    SCOPED_TRACE(technique);
    EXPECT_LE(must(worst_error(frame, technique)), must(find_technique(technique))->tolerance.worst);
}

TEST(ManyLights, WithBlockersAreRightOrRefused) {
    const Frame frame = blocked_lights(10'000, 4);
    for (const char* technique : {"lighting/brute_force", "lighting/z_binned"}) expect_refused(frame, technique);
    expect_refused(frame, "lighting/tiled", "classify=off");
    expect_right(frame, "lighting/tiled");  // blockers that the tile has nothing of cost no turns
    for (const char* technique : {"lighting/brute_force", "lighting/z_binned", "lighting/tiled"})
        expect_right(blocked_lights(1'000, most_blockers), technique);
}

TEST(ManyLights, OnGlassAreRightOrRefused) {
    expect_refused(blocked_lights(1'020, most_blockers, "red_and_green_glass"), "transparency/sorted_lists");
    expect_right(blocked_lights(980, most_blockers, "red_and_green_glass"), "transparency/sorted_lists");
}

// Most of them outside of the picture: a tile has what few hundred it is reached by, and those beyond the 65,536 that records can
// name.
TEST(ManyLights, BeyondEveryListAreRightOrRefused) {
    Frame frame = dark_frame("lights_room");
    frame.view.width = 16, frame.view.height = 9;
    RandomLights random(7);
    random.add_lights(frame, 66'000, .05f);
    for (std::size_t i = 1'000; i < 65'800; ++i) frame.lights[i].position = to_world(frame, {0, 0, -100 - double(i)});
    expect_refused(frame, "lighting/brute_force");
    expect_right(frame, "lighting/tiled");
    expect_right(frame, "lighting/z_binned");
}

}  // namespace
}  // namespace strata
