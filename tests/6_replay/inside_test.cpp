// What acts and steps gave, brought back: in the order of the frame, and the same bits a run gives.
#include <algorithm>

#include <gtest/gtest.h>

#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const ActImages& act_named(const std::vector<ActImages>& acts, std::string_view label) {
    const auto found = std::ranges::find(acts, label, &ActImages::label);
    if (found == acts.end()) throw std::runtime_error(fmt::format("no act is called {}", label));
    return *found;
}

TEST(ActImages, ComeInTheOrderOfTheFrameWithTheStagesOutputs) {
    const auto session = scenario_session("glass_and_smoke");
    const auto acts = must(session->act_images({}));
    ASSERT_GE(acts.size(), 5u);
    EXPECT_TRUE(std::ranges::is_sorted(acts, {}, &ActImages::at));
    for (const ActImages& act : acts)
        for (const auto& [name, image] : act.images) {
            EXPECT_EQ(std::ranges::count(info(act.stage).outputs, name), 1) << act.label << " " << name;
            EXPECT_EQ(image.texels.size(), bytes(image.shape)) << act.label << " " << name;
        }
    EXPECT_TRUE(act_named(acts, "transparency").images.contains("color"));
    EXPECT_TRUE(act_named(acts, "combine at film").images.contains("display"));
}

TEST(ActImages, AreWhatTheStageLeftAndNotWhatLaterStagesMadeOfIt) {
    const auto session = scenario_session("three_panes");
    const auto acts = must(session->act_images({}));
    const HostImage &combined = act_named(acts, "combine").images.at("color"),
                    &composited = act_named(acts, "transparency").images.at("color");
    EXPECT_NE(hash_of(combined), hash_of(composited));
    const auto run = must(session->run({.outputs = {"color", "display"}}));
    EXPECT_EQ(hash_of(composited), hash_of(run.images.at("color")));
    EXPECT_EQ(hash_of(act_named(acts, "combine at film").images.at("display")), hash_of(run.images.at("display")));
}

TEST(ActImages, ComeWithARunsOutputsWhenAskedFor) {
    const auto session = scenario_session("three_panes", 4);
    const Request plain{.outputs = {"color", "depth_layers", "display"}};
    Request with_acts = plain;
    with_acts.acts = Acts::brought_back;
    const auto run = must(session->run(plain)), more = must(session->run(with_acts));
    EXPECT_TRUE(run.acts.empty());
    EXPECT_FALSE(more.acts.empty());
    ASSERT_EQ(run.images.size(), more.images.size());
    for (const auto& [name, image] : run.images) EXPECT_EQ(hash_of(image), hash_of(more.images.at(name))) << name;
}

TEST(StepImages, ComeStepByStepAndEndWithWhatTheActLeft) {
    const auto session = scenario_session("three_panes");
    const auto steps = must(session->step_images({}, Stage::transparency));
    ASSERT_FALSE(steps.empty());
    EXPECT_TRUE(std::ranges::is_sorted(steps, {}, &StepImages::step));
    std::map<std::string, std::string> last;
    for (const StepImages& step : steps)
        for (const auto& [name, image] : step.images) last[name] = hash_of(image);
    const auto acts = must(session->act_images({}));
    EXPECT_EQ(last.at("color"), hash_of(act_named(acts, "transparency").images.at("color")));
}

/// The only step of that scope and name; null where there are several, which two plans may count differently.
const StepImages* only(const std::vector<StepImages>& steps, const StepImages& like) {
    const auto same = [&](const StepImages& step) { return step.scope == like.scope && step.name == like.name; };
    return std::ranges::count_if(steps, same) == 1 ? &*std::ranges::find_if(steps, same) : nullptr;
}

TEST(PixelSteps, AreTheTexelsOfWhatTheStepsWrote) {
    const auto session = scenario_session("glass_and_smoke");
    const glm::uvec2 pixel(83, 41);
    const auto pixels = must(session->pixel_steps({}, pixel));
    EXPECT_TRUE(std::ranges::is_sorted(pixels, {}, &StepImages::step));
    std::size_t compared = 0;
    for (const Stage stage : {Stage::gbuffer, Stage::lighting, Stage::combine, Stage::transparency}) {
        const auto whole = must(session->step_images({}, stage));
        for (const StepImages& step : whole) {
            const StepImages* found = only(pixels, step);
            if (!found || !only(whole, step)) continue;
            for (const auto& [name, image] : found->images) {
                const auto all = step.images.find(name);
                if (all == step.images.end() || all->second.shape.extent.width != 160) continue;
                EXPECT_EQ(image.shape.extent.width * image.shape.extent.height, 1u);
                for (std::uint32_t layer = 0; layer < image.shape.layers; ++layer)
                    EXPECT_EQ(texel(image, 0, 0, layer), texel(all->second, pixel.x, pixel.y, layer)) << step.name << " " << name;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 4u);
}

TEST(PixelSteps, EndWithThePictureOnEveryPixelAndTileOfIt) {
    const auto session = scenario_session("three_panes");
    const auto display = must(session->run({})).images.at("display");
    for (const glm::uvec2 pixel : {glm::uvec2(0), glm::uvec2(63, 35), glm::uvec2(30, 20)}) {
        const auto steps = must(session->pixel_steps({}, pixel));
        EXPECT_EQ(texel(steps.back().images.at("display"), 0, 0), texel(display, pixel.x, pixel.y));
    }
    const auto outside = session->pixel_steps({}, {64, 0});
    ASSERT_FALSE(outside);
    EXPECT_EQ(outside.error().sentence, "the frame is 64 x 36; there is no pixel 64, 0");
}

TEST(StepImages, OfAStageTheFrameDoesNotNeedAreNone) {
    const auto session = scenario_session("opaque_only");
    EXPECT_TRUE(must(session->step_images({}, Stage::transparency)).empty());
}

}  // namespace
}  // namespace strata
