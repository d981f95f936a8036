// The panel of the pinned pixel says what the session says.
#include <algorithm>
#include <cstring>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/transparency/sample_blend.h"
#include "replay/session/drawn_by.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/pixel/pixel_history.h"
#include "ui/pixel/pixel_inside.h"
#include "ui/pixel/probe_series.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// The desk's frames for asking what the panel ought to say.
Session& other_session() {
    static const auto session = must(Session::open(small_scenarios(), {.validation = true}));
    return *session;
}

/// The desk at a frame of its own, with a pixel pinned and a part of the panel in front.
Desk& pinned(std::string_view scenario, glm::ivec2 pixel, std::string_view part) {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of(scenario));
    desk.model().pin = pixel;
    must(desk.player->wait());
    must(desk.player->click("tabs/Pixel"));
    must(desk.player->click(fmt::format("Pixel/parts/{}", part)));
    must(desk.player->wait());
    return desk;
}

HostImage one_texel(float value) {
    HostImage image{Shape{.extent = {1, 1}, .format = Format::r32f}, std::vector<std::byte>(sizeof value)};
    std::memcpy(image.texels.data(), &value, sizeof value);
    return image;
}

/// Of a value in the part of the steps.
std::string path_of(const PixelStep& step, const PixelValue& value) {
    return fmt::format("Pixel/steps/{} {}/{}", step.step, step.name.substr(step.name.rfind('/') + 1), value.image);
}

TEST(PixelHistory, SaysWhatIsNewWhatChangedAndWhatDidNot) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<StepImages> steps = {{0, {}, "a/one", {{"light", one_texel(1)}, {"depth_layers", one_texel(nan)}}},
                                           {3, {}, "a/two", {{"light", one_texel(1)}}},
                                           {4, {}, "b/one", {{"light", one_texel(2)}, {"depth_layers", one_texel(nan)}}}};
    const auto history = history_of(steps);
    ASSERT_EQ(history.size(), 3u);
    EXPECT_EQ(history[0].values[0].change, Change::first);
    EXPECT_EQ(history[1].values[0].change, Change::same);
    EXPECT_EQ(history[2].values[0].image, "depth_layers");
    EXPECT_EQ(history[2].values[0].change, Change::same) << "NaN is as it was";
    EXPECT_EQ(history[2].values[1].change, Change::changed);
    EXPECT_EQ(history[2].step, 4u);
}

TEST(PixelHistory, DepthIsSaidInMetersToo) {
    const PixelValue value{.image = "depth_layers", .format = Format::r32f, .value = {.025, 0, 0, 1}};
    EXPECT_EQ(text_of(value, .1), "0.025  (4 m)");
    EXPECT_EQ(text_of({.image = "light", .format = Format::rg16f, .value = {1, .5, 0, 1}}, .1), "1  0.5");
}

TEST(Tiles, AreCountedRowByRow) {
    EXPECT_EQ(tile_at({0, 0}, 96, 16), 0u);
    EXPECT_EQ(tile_at({95, 15}, 96, 16), 5u);
    EXPECT_EQ(tile_at({16, 16}, 97, 16), 8u) << "a tile that is cut off counts";
}

TEST(PixelPanel, SaysHowToPinAPixelWhereNoneIs) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Pixel"));
    EXPECT_THAT(desk.said("Pixel/state"), HasSubstr("pins a pixel"));
}

TEST(PixelPanel, EndsItsStepsWithWhatThePictureShows) {
    Desk& desk = pinned("three_panes", {40, 20}, "Steps");
    const auto steps = must(other_session().pixel_steps(desk.replay()->request, {40, 20}));
    std::size_t values = 0;
    for (const PixelStep& step : history_of(steps))
        for (const PixelValue& value : step.values) {
            if (value.layers > 1) continue;
            const double near{desk.replay()->frame.bare.view.near};
            EXPECT_EQ(desk.said(path_of(step, value)), text_of(value, near));
            ++values;
        }
    EXPECT_GT(values, 4u);
    desk.expect_no_conflicts();
}

TEST(PixelPanel, AClickOnAStepSelectsIt) {
    Desk& desk = pinned("three_panes", {40, 20}, "Steps");
    const auto step = must(other_session().pixel_steps(desk.replay()->request, {40, 20})).front();
    must(desk.player->click(fmt::format("Pixel/steps/{} {}", step.step, step.name.substr(step.name.rfind('/') + 1))));
    must(desk.player->wait());
    EXPECT_EQ(desk.model().step, step.step);
    EXPECT_EQ(desk.model().image.step, step.step);
}

TEST(PixelPanel, AsksAgainOnlyForAnotherPixel) {
    Desk& desk = pinned("three_panes", {40, 20}, "Steps");
    must(desk.player->frames(3));
    EXPECT_TRUE(desk.inspector->replayer().is_idle());
    desk.model().pin = glm::ivec2(41, 20);
    must(desk.player->wait());
    EXPECT_THAT(desk.said("Pixel/pixel"), HasSubstr("41 20"));
    const PixelStep last = history_of(must(other_session().pixel_steps(desk.replay()->request, {41, 20}))).back();
    EXPECT_EQ(desk.said(path_of(last, last.values.front())), text_of(last.values.front(), 1));
}

TEST(PixelPanel, APixelOutsideOfTheFrameIsASentence) {
    Desk& desk = pinned("three_panes", {4000, 20}, "Steps");
    EXPECT_THAT(desk.said("Pixel/steps/error"), testing::AllOf(HasSubstr("96 x 54"), HasSubstr("4000, 20")));
}

TEST(PixelPanel, ListsTheFragmentsInTheOrderOfDepth) {
    Desk& desk = pinned("three_panes", {48, 27}, "Fragments");
    Request request = desk.replay()->request;
    const auto lists = must(other_session().transparent_fragments(request));
    const auto fragments = transparency::nearest_first(lists->at(48, 27));
    ASSERT_FALSE(fragments.empty());
    const Frame frame = must(other_session().frame(request.variant.frame));
    for (std::size_t i = 0; i < fragments.size(); ++i) {
        const std::string row = fmt::format("Pixel/fragments/{}", i + 1);
        EXPECT_EQ(desk.said(row + "/depth"), fmt::format("{:.5g}", fragments[i].depth));
        EXPECT_EQ(desk.said(row + "/alpha"), fmt::format("{:.4f}", fragments[i].alpha));
        EXPECT_EQ(desk.said(row + "/drawn by"), drawn_by(frame, fragments[i].submission));
    }
    EXPECT_EQ(desk.said("Pixel/fragments/1/before"), "1.0000");
    EXPECT_THAT(desk.said("Pixel/fragments/count"), StartsWith(fmt::format("{} fragment", fragments.size())));
    desk.expect_no_conflicts();
}

TEST(PixelPanel, ProbesTheChosenVariantAndOneMoreOverTheSameSteps) {
    Desk& desk = pinned("three_panes", {48, 27}, "Probe");
    const std::string chosen = variant_of(desk.model().choices().at(Stage::transparency));
    std::vector<std::string> variants = {chosen};
    for (const Technique* technique : techniques_of(Stage::transparency))
        if (variants.size() < 2 && technique->name != chosen) variants.emplace_back(technique->name);
    // An arrow opens a row.
    const WidgetRecord tree = desk.widget("Pixel/probe/techniques");
    ImGui::GetIO().MousePos = {tree.from.x + 8, (tree.from.y + tree.to.y) / 2};
    must(desk.player->frames(2));
    ImGui::GetIO().MouseDown[0] = true;
    must(desk.player->frames(1));
    ImGui::GetIO().MouseDown[0] = false;
    must(desk.player->frames(2));
    must(desk.player->click(fmt::format("Pixel/probe/techniques/{}", short_variant(variants[1]))));
    must(desk.player->wait());
    const Probe wanted = must(probe(other_session(), desk.replay()->request, {48, 27, 0}, {.variants = variants}));
    for (const ProbeCurve& curve : wanted.curves) {
        ASSERT_EQ(curve.not_supported, "");
        const std::string row = fmt::format("Pixel/probe/metrics/{}", short_variant(curve.variant));
        EXPECT_EQ(desk.said(row + "/L1 ln z"), fmt::format("{:.5f}", curve.metrics.l1_logarithmic));
        EXPECT_EQ(desk.said(row + "/behind"), fmt::format("{:+.5f}", curve.metrics.total));
    }
    desk.expect_no_conflicts();
}

TEST(ProbeSeries, HasTheDepthsThatTheCommandLineTakes) {
    Desk& desk = pinned("three_panes", {48, 27}, "Probe");
    const ProbeQuestion question{desk.replay()->request, {48, 27}, 0, {}, {"transparency/sorted_lists"}};
    const auto job = desk.inspector->replayer().start<Probe>(
        [question](Session& session, ui::Progress& progress) { return probe_each(session, progress, question, {}); });
    must(desk.player->wait());
    EXPECT_EQ(must(*job->result()).depths.size(), ProbeOptions().samples);
}

TEST(ProbeSeries, TheExactStepsEndWithWhatIsLetThrough) {
    Probe probe{.from = 1, .to = 10, .depths = {1, 5, 9}, .exact = {glm::dvec3(1), glm::dvec3(.5), glm::dvec3(.1)}};
    probe.fragments = {{.depth = 2, .transmittance = glm::dvec3(.5), .alpha = .5},
                       {.depth = 6, .transmittance = glm::dvec3(.25), .alpha = .75}};
    probe.curves = {{.variant = "stage/a x=1", .through = {glm::dvec3(1), glm::dvec3(.6), glm::dvec3(.1)}},
                    {.variant = "stage/b", .not_supported = "it cannot"}};
    const auto shown = series_of(probe, ProbeQuantity::transmittance, ProbeChannel::mean);
    ASSERT_EQ(shown.size(), 2u);
    EXPECT_EQ(shown[0].points, (std::vector<glm::dvec2>{{1, 1}, {2, .5}, {6, .125}}));
    EXPECT_EQ(shown[1].label, "a x=1");
    const auto errors = series_of(probe, ProbeQuantity::error, ProbeChannel::green);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NEAR(errors[0].points[1].y, .1, 1e-12);
    EXPECT_EQ(errors[0].notes.size(), errors[0].points.size());
}

TEST(PixelPanel, ListsTheRowsOfThePixelsTile) {
    const glm::uvec2 pixel(48, 40);
    Desk& desk = pinned("lights_room", pixel, "Tile");
    std::size_t techniques = 0;
    for (const Technique* technique : techniques_of(Stage::lighting)) {
        const auto table = std::ranges::find_if(technique->tables, [](const DebugTable& t) { return t.tile > 0; });
        if (table == technique->tables.end()) continue;
        desk.model().use(*technique);
        must(desk.player->wait());
        ++techniques;
        EXPECT_EQ(desk.said("Pixel/inside/technique"), technique->name);
        Request request = desk.replay()->request;
        const std::string output = fmt::format("{}:{}", technique->name, table->name);
        request.outputs = {output};
        const NumberTable numbers = must(other_session().run(request)).tables.at(output);
        std::size_t row = 0;
        for (const std::vector<double>& wanted : numbers.rows) {
            if (wanted[0] != tile_at(pixel, 96, table->tile)) continue;
            const std::string path = fmt::format("Pixel/inside/{}/{}/{}", table->name, row++, table->columns[1].name);
            EXPECT_THAT(desk.said(path), StartsWith(fmt::format("{:.0f}", wanted[1])));
        }
        EXPECT_GT(row, 0u) << "the pixel's tile has lights";
        for (const DebugView& view : technique->views) EXPECT_NE(desk.said(fmt::format("Pixel/inside/views/{}", view.name)), "");
        desk.expect_no_conflicts();
    }
    EXPECT_GT(techniques, 0u);
}

}  // namespace
}  // namespace strata::ui
