// Lists of more fragments than a driver lets a loop iterate are right.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr double optical_depth = 1.4;
constexpr std::uint32_t width = 2, height = 2;

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

struct LongCase {
    std::string technique, set;
    double rmse = 0;  ///< beyond the technique's tolerance
};

void expect_right(std::size_t layers) {
    const LongCase cases[] = {{"transparency/sorted_lists", ""},
                              {"transparency/exact_function", "accumulation=single"},
                              // Among layers of equal area a last float bit decides which step is removed.
                              {"transparency/adaptive", "accumulation=single", .02},
                              {"transparency/multi_layer", ""},
                              {"transparency/multi_layer", "buckets=8"},
                              {"transparency/moments", "storage=normalized"}};
    const auto session = session_of({two_stacks(layers)});
    for (const LongCase& c : cases) {
        SCOPED_TRACE(fmt::format("{} {} at {} layers", c.technique, c.set, layers));
        const ChoiceChanges choices = c.set.empty() ? chosen({c.technique}) : chosen({c.technique}, {c.set});
        const Technique& technique = *must(find_technique(c.technique));
        const Accuracy accuracy = must(session->judge({.choices = choices}, technique.stage, Against::model));
        // 1 - alpha is rounded to float, in every layer alike.
        const double rounding = std::ldexp(double(layers), -24);
        EXPECT_LE(accuracy.model_rmse, technique.tolerance.rmse + rounding + c.rmse);
        EXPECT_LE(accuracy.model_worst, technique.tolerance.worst + rounding + c.rmse);
        EXPECT_EQ(accuracy.compared, width * height);
    }
}

TEST(LongLists, OfTwentyThousandFragmentsAreRight) { expect_right(20'000); }

TEST(ExhaustiveLongLists, OfAHundredThousandFragmentsAreRight) { expect_right(100'000); }

}  // namespace
}  // namespace strata
