// transparency/weighted_additive on a device: the table of layers of docs/algorithms/transparency.md 3.2, and the mask of tiles.
#include <array>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view additive = "transparency/weighted_additive";

/// A particle that fills the image.
Particle sheet(double depth, glm::vec3 color, float alpha) {
    return {.center = {0, 0, depth}, .size = float(2 * depth), .color = color, .alpha = alpha};
}

Frame frame_of_sheets(std::span<const Particle> covering, std::span<const Particle> glowing) {
    Frame frame = frame_of_cards({}, 8);
    frame.background = glm::vec3(.1f);
    frame.emitters.push_back({.name = "smoke", .particles = {covering.begin(), covering.end()}});
    frame.emitters.push_back({.name = "fire", .alpha_mode = AlphaMode::additive, .particles = {glowing.begin(), glowing.end()}});
    return frame;
}

struct Row {
    std::string_view name;
    std::vector<Particle> covering, glowing;
    double seen, tolerance;
};

// Half floats are good to 5e-4 of a sum; a step of the byte R is .1 / 255 of the background, one of A 8 / 255 of what is added.
const std::vector<Row>& rows() {
    static const Particle white = sheet(10, glm::vec3(1), .5f), spark = sheet(10, glm::vec3(.2f), 1);
    static const std::vector<Row> table = {
        {"one additive layer", {}, {spark}, .300858, 5e-4},
        {"three additive layers", {}, std::vector(3, spark), .702427, 5e-4},
        {"ten additive layers", {}, std::vector(10, spark), 1.70165, 5e-3},
        {"a covering layer", {white}, {}, .550196, 5e-4},
        {"two covering layers", {white, white}, {}, .525098, 5e-4},
        {"light behind coverage", {white}, {sheet(12, glm::vec3(.2f), 1)}, .782010, 1e-3},
        {"overflow", std::vector(4, sheet(1, glm::vec3(1000), 1)), {}, 100, 1e-3},
    };
    return table;
}

HostImage color_of(Session& session, std::size_t frame, const std::vector<std::string>& sets = {}) {
    return must(
               session.run({.variant = {.frame = frame}, .choices = chosen({std::string(additive)}, sets), .outputs = {"color"}}))
        .images.at("color");
}

TEST(AdditiveLayers, LookAsInTheChaptersTable) {
    std::vector<Frame> frames;
    for (const Row& row : rows()) frames.push_back(frame_of_sheets(row.covering, row.glowing));
    const auto session = session_of(std::move(frames));
    for (std::size_t i = 0; i < rows().size(); ++i)
        EXPECT_NEAR(in_double(color_of(*session, i)).at(3, 3).x, rows()[i].seen, rows()[i].tolerance) << rows()[i].name;
}

/// Exact is .1340. A byte stops at 50/255, and at 42/255 where a driver rounds what it multiplies with to a byte as well; half
/// floats come to .1406 rounded to nearest and to .1252 cut off (llvmpipe).
TEST(AdditiveLayers, LetThroughOfTwoHundredThinOnesWhatTheirStorageCan) {
    Frame frame = frame_of_sheets(std::vector(200, sheet(10, glm::vec3(0), .01f)), {});
    frame.background = glm::vec3(1);
    const auto session = session_of({frame});
    const auto through = [&](std::string set) { return in_double(color_of(*session, 0, {std::move(set)})).at(3, 3).x; };
    EXPECT_GT(through("reveal=r8"), 41.9 / 255);
    EXPECT_LT(through("reveal=r8"), 50.1 / 255);
    EXPECT_NEAR(through("reveal=r16f"), .1340, .009);
}

/// Half floats differ from the model by rounding alone; bytes have a tolerance that would hide a small mistake.
TEST(AdditiveLayers, InHalfFloatsAreCloseToTheModel) {
    for (const char* scenario : {"two_hundred_layers", "smoke_grenade", "additive_sparks"})
        for (const char* normalization : {"normalization=published", "normalization=corrected"}) {
            Request request = on_scenario(scenario);
            request.choices = chosen({std::string(additive)}, {"reveal=r16f", normalization});
            const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::transparency, Against::model));
            EXPECT_LE(accuracy.model_rmse, 8e-3) << scenario << " " << normalization;
        }
}

TEST(TilesWithoutFragments, AreSkippedAndNoPixelKnowsIt) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Request request = on_scenario("one_pane", samples);
        request.choices = chosen({std::string(additive)});
        request.outputs = {"color"};
        const auto some = must(session_of_scenarios().run(request));
        set(request, "tiles=all");
        const auto all = must(session_of_scenarios().run(request));
        const std::uint64_t tiles = std::uint64_t{(some.width + 7) / 8} * ((some.height + 7) / 8);
        EXPECT_GT(counted(some, "tiles skipped"), tiles / 3);
        EXPECT_LT(counted(some, "tiles skipped"), tiles);
        EXPECT_EQ(counted(all, "tiles skipped"), 0u);
        EXPECT_EQ(some.images.at("color").texels, all.images.at("color").texels);
    }
}

}  // namespace
}  // namespace strata
