// What passes and steps gave, brought back: in the order of the frame, and the same bits a run gives.
#include <algorithm>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/stages.h"
#include "replay/images/image_io.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const PassImages& pass_named(const std::vector<PassImages>& passes, std::string_view label) {
    const auto found = std::ranges::find(passes, label, &PassImages::label);
    if (found == passes.end()) throw std::runtime_error(fmt::format("no pass is called {}", label));
    return *found;
}

TEST(PassImages, ComeInTheOrderOfTheFrameWithTheStagesOutputs) {
    const auto session = scenario_session("glass_and_smoke");
    const auto passes = must(session->pass_images({}));
    ASSERT_GE(passes.size(), 5u);
    EXPECT_TRUE(std::ranges::is_sorted(passes, {}, &PassImages::at));
    for (const PassImages& pass : passes)
        for (const auto& [name, image] : pass.images) {
            EXPECT_EQ(std::ranges::count(info(pass.stage).outputs, name), 1) << pass.label << " " << name;
            EXPECT_EQ(image.texels.size(), bytes(image.shape)) << pass.label << " " << name;
        }
    EXPECT_TRUE(pass_named(passes, "transparency").images.contains("color"));
    EXPECT_TRUE(pass_named(passes, "combine at film").images.contains("display"));
}

TEST(PassImages, AreWhatTheStageLeftAndNotWhatLaterStagesMadeOfIt) {
    const auto session = scenario_session("three_panes");
    const auto passes = must(session->pass_images({}));
    const HostImage &combined = pass_named(passes, "combine").images.at("color"),
                    &composited = pass_named(passes, "transparency").images.at("color");
    EXPECT_NE(hash_of(combined), hash_of(composited));
    const auto run = must(session->run({.outputs = {"color", "display"}}));
    EXPECT_EQ(hash_of(composited), hash_of(run.images.at("color")));
    EXPECT_EQ(hash_of(pass_named(passes, "combine at film").images.at("display")), hash_of(run.images.at("display")));
}

TEST(PassImages, ComeWithARunsOutputsWhenAskedFor) {
    const auto session = scenario_session("three_panes", 4);
    const Request plain{.outputs = {"color", "depth_layers", "display"}};
    Request with_passes = plain;
    with_passes.passes = Passes::read_back;
    const auto run = must(session->run(plain)), more = must(session->run(with_passes));
    EXPECT_TRUE(run.passes.empty());
    EXPECT_FALSE(more.passes.empty());
    ASSERT_EQ(run.images.size(), more.images.size());
    for (const auto& [name, image] : run.images) EXPECT_EQ(hash_of(image), hash_of(more.images.at(name))) << name;
}

TEST(StepImages, ComeStepByStepAndEndWithWhatThePassLeft) {
    const auto session = scenario_session("three_panes");
    const auto steps = must(session->step_images({}, Stage::transparency));
    ASSERT_FALSE(steps.empty());
    EXPECT_TRUE(std::ranges::is_sorted(steps, {}, &StepImages::step));
    std::map<std::string, std::string> last;
    for (const StepImages& step : steps)
        for (const auto& [name, image] : step.images) last[name] = hash_of(image);
    const auto passes = must(session->pass_images({}));
    EXPECT_EQ(last.at("color"), hash_of(pass_named(passes, "transparency").images.at("color")));
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
    EXPECT_THAT(session->pixel_steps({}, {64, 0}),
                FailsWith("frame.no_pixel", Field("width", 64), Field("height", 36), Field("x", 64), Field("y", 0)));
}

TEST(StepImages, OfAStageTheFrameDoesNotNeedAreNone) {
    const auto session = scenario_session("opaque_only");
    EXPECT_TRUE(must(session->step_images({}, Stage::transparency)).empty());
}

}  // namespace
}  // namespace strata
