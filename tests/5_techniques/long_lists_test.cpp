// Lists of more fragments than a driver lets a loop turn are right or refused: never wrong in silence.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"
#include "passes/registry.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::HasSubstr;

constexpr double optical_depth = 1.4;
constexpr std::uint32_t width = 4, height = 4;

/// Layers before a white wall, red behind and green in front: so many in the left half of the picture, 100 in the right one, of
/// equal optical depth.
Frame two_stacks(std::size_t left) {
    scenario::FrameBuilder builder(0, {.width = width, .height = height, .samples = 1, .frames = 1});
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -1}, .swing = 0});
    builder.draw(builder.add(scenario::sphere(50, 16)), builder.add(scenario::unlit("wall", glm::vec4(1))),
                 {.position = {0, 0, -100}});
    const auto add = [&](std::size_t layers, double side) {
        Emitter emitter{.name = "stack"};
        for (std::size_t i = 0; i < layers; ++i)
            emitter.particles.push_back({.center = {side * 40, 0, -20 + 10. * double(i) / double(layers)},
                                         .size = 40,
                                         .color = {1 - float(i) / float(layers), float(i) / float(layers), 0},
                                         .alpha = float(-std::expm1(-optical_depth / double(layers)))});
        builder.frame.emitters.push_back(std::move(emitter));
    };
    add(left, -1);
    add(100, 1);
    return std::move(builder.frame);
}

/// Whether the method draws the stacks, which are its model's then; or it says that it cannot.
bool draws(Session& session, const Technique& technique) {
    const auto accuracy = session.judge({.choices = chosen({std::string(technique.name)})}, technique.stage, Against::model);
    if (!accuracy) {
        EXPECT_EQ(accuracy.error().fault, Fault::device_lacks) << accuracy.error().sentence;
        EXPECT_THAT(accuracy.error().sentence, HasSubstr("unfinished"));
        return false;
    }
    EXPECT_LE(accuracy->model_rmse, technique.tolerance.rmse) << technique.name;
    EXPECT_EQ(accuracy->compared, width * height) << technique.name;
    return true;
}

TEST(LongLists, AreRightOrRefused) {
    const auto short_enough = must(Session::open({two_stacks(1000)}, {.validation = true}));
    const auto long_ones = must(Session::open({two_stacks(6000)}, {.validation = true}));
    for (const std::string name : {"sorted_lists", "exact_function", "adaptive", "multi_layer"}) {
        const Technique& technique = *must(find_technique("transparency/" + name));
        EXPECT_TRUE(draws(*short_enough, technique)) << name;
        EXPECT_FALSE(draws(*long_ones, technique)) << name;
    }
}

}  // namespace
}  // namespace strata
