// Color where T(z) has one channel, on the device.
#include <array>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const std::string voxel = "transparency/voxel";

Run run_of(Session& session, Request request, std::vector<std::string> sets) {
    request.choices = chosen({voxel}, std::move(sets));
    request.outputs = {"color"};
    session.forget_memo();
    return must(session.run(request));
}

/// A green glass over the whole image that reflects .1, in front of nothing or of white.
Frame green_glass(float behind) {
    Frame frame = frame_of_cards(std::array{Card{.center = {0, 0, 2}, .color = {.1f, .1f, .1f, 1}}}, 16);
    frame.materials[0].transmission = {.2f, .8f, .2f};
    frame.background = glm::vec3(behind);
    return frame;
}

glm::dvec3 seen(Session& session, std::size_t frame, const std::string& tint) {
    const auto run = run_of(session, {.variant = {.frame = frame}}, {"channels=mono", "accumulation=single", tint});
    return glm::dvec3(in_double(run.images.at("color")).at(7, 7));
}

void expect_near(glm::dvec3 got, glm::dvec3 wanted, double slack) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[c], wanted[c], slack) << "channel " << c;
}

TEST(TintOnTheDevice, IsTheChaptersOfASingleGlassOverAnExactBackground) {
    const auto session = session_of({green_glass(0), green_glass(1)});
    expect_near(seen(*session, 0, "tint=skew"), {.0318, .1272, .0318}, 5e-5);
    expect_near(seen(*session, 0, "tint=corrected"), glm::dvec3(.1), 1e-6);
    for (const char* tint : {"tint=total", "tint=skew", "tint=corrected"})
        expect_near(seen(*session, 1, tint) - seen(*session, 0, tint), {.2, .8, .2}, 1e-6);
}

TEST(ExhaustiveTintOnTheDevice, IsWhatTheModelSays) {
    const Technique& technique = *must(find_technique(voxel));
    const std::vector<std::string> settings[] = {
        {"tint=skew"},
        {"tint=corrected"},
        {"tint=corrected", "accumulation=packed", "bits=16"},
        {"tint=corrected", "accumulation=single", "resolution=quarter"},
    };
    for (const char* scenario : {"glass_and_smoke", "three_panes"})
        for (std::vector<std::string> sets : settings) {
            sets.emplace_back("channels=mono");
            Request request = on_scenario(scenario, sets.size() == 2 ? 4 : 1);
            request.choices = chosen({voxel}, sets);
            const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
            expect_within_tolerance(accuracy, technique, request, scenario);
        }
}

TEST(TintOnTheDevice, ChangesNoBitWhereItSaysNothing) {
    struct Case {
        const char *scenario, *channels;
    };
    // Three channels know colors; where nothing has one, one channel does.
    for (const Case c : {Case{"glass_and_smoke", "channels=rgb"}, Case{"three_panes", "channels=mono"}}) {
        const Request request = on_scenario(c.scenario);
        const auto total = run_of(session_of_scenarios(), request, {c.channels, "tint=total"});
        for (const char* tint : {"tint=skew", "tint=corrected"}) {
            const auto run = run_of(session_of_scenarios(), request, {c.channels, tint});
            EXPECT_EQ(run.images.at("color").texels, total.images.at("color").texels) << c.scenario << " " << tint;
            EXPECT_EQ(run.image_bytes, total.image_bytes);
        }
    }
}

/// What makes the skew lies where N was, in as many channels.
TEST(TintOnTheDevice, NeedsNoFurtherStepAndNoFurtherTarget) {
    const Request request = on_scenario("glass_and_smoke");
    const auto total = run_of(session_of_scenarios(), request, {"channels=mono", "tint=total"});
    for (const char* tint : {"tint=skew", "tint=corrected"}) {
        const auto run = run_of(session_of_scenarios(), request, {"channels=mono", tint});
        ASSERT_EQ(run.steps.size(), total.steps.size());
        for (std::size_t i = 0; i < run.steps.size(); ++i) EXPECT_EQ(run.steps[i].name, total.steps[i].name);
        EXPECT_EQ(run.image_bytes, total.image_bytes);
        EXPECT_NE(run.images.at("color").texels, total.images.at("color").texels);
    }
}

}  // namespace
}  // namespace strata
