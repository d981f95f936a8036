// The gallery of views says what the session says, and its pictures are made of the session's.
#include <cmath>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/view_params.h"
#include "tests/7_inspector/desk.h"
#include "tests/7_tool/process.h"
#include "tests/support/session.h"
#include "ui/picture/views.h"

namespace strata::ui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string tiled = "lighting/tiled";

/// The desk at a room of lights shaded in tiles, with the gallery in front.
Desk& gallery() {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("lights_room"));
    must(desk.player->wait());
    desk.model().use(*must(find_technique(tiled)));
    must(desk.player->click("tabs/Visualizers"));
    must(desk.player->wait());
    return desk;
}

/// The desk's frame with other outputs, by its own session.
strata::Run run_of(Desk& desk, std::vector<std::string> outputs) {
    Request request = desk.model().request();
    request.outputs = std::move(outputs);
    const auto job = desk.inspector->replayer().start<strata::Run>(
        [request](Session& session, ui::Progress&) { return session.run(request); });
    while (!job->result()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return must(*job->result());
}

HostImage picture_of(std::uint32_t width, const std::vector<float>& values) {
    HostImage image{{.extent = {width, static_cast<std::uint32_t>(values.size()) / width}, .format = Format::r32f}, {}};
    const auto bytes = std::as_bytes(std::span(values));
    image.texels.assign(bytes.begin(), bytes.end());
    return image;
}

TEST(Visualizers, HaveEveryViewOfEveryTechniqueThatRuns) {
    Desk& desk = gallery();
    std::size_t views = 0;
    for (const auto& [stage, choice] : desk.model().choices()) {
        const auto& skipped = desk.replay()->skipped;
        if (std::ranges::find(skipped, stage, &SkippedStage::stage) != skipped.end()) continue;
        for (const DebugView& view : choice.technique->views) {
            EXPECT_NO_THROW(desk.widget(fmt::format("Visualizers/{}/{}", choice.technique->name, view.name)));
            ++views;
        }
    }
    EXPECT_GE(views, 10u);
}

TEST(Visualizers, AClickShowsAViewWithItsHelpAndItsLegend) {
    Desk& desk = gallery();
    must(desk.player->click("Visualizers/lighting/tiled/LDS bytes"));
    must(desk.player->wait());
    EXPECT_EQ(desk.model().image.name, "lighting/tiled:LDS bytes");
    EXPECT_EQ(desk.said("Image/image"), "lighting/tiled:LDS bytes");
    EXPECT_THAT(desk.said("Visualizers/selected/help"), HasSubstr("of 2048"));
    EXPECT_EQ(desk.said("Visualizers/selected/white"), "2048 bytes");
    desk.expect_no_conflicts();
}

TEST(Visualizers, DigitsShowTheViewsOfOneTechniqueInTurn) {
    Desk& desk = gallery();
    const Technique& technique = *must(find_technique(tiled));
    must(desk.player->click("Visualizers/lighting/tiled/overflow"));
    for (const std::size_t number : {1u, 2u, 9u}) {
        must(desk.player->key(fmt::format("{}", number)));
        EXPECT_EQ(desk.model().image.name, output_name(technique, technique.views[number - 1].name));
    }
}

TEST(Visualizers, ThePinnedPixelHasTheSpectrumThatTheSessionCountsForItsTile) {
    Desk& desk = gallery();
    desk.model().pin = glm::ivec2(40, 30);
    must(desk.player->click("Visualizers/lighting/tiled/tile modes"));
    ImGui::GetIO().MousePos = {-1000, -1000};
    must(desk.player->wait());
    const strata::Run run = run_of(desk, {tiled + ":spectrum", tiled + ":spectra"});
    const double spectrum = texel(run.images.at(tiled + ":spectrum"), 40, 30).x;
    const auto& rows = run.tables.at(tiled + ":spectra").rows;
    const auto row = std::ranges::find_if(rows, [&](const auto& one) { return one[0] == spectrum; });
    ASSERT_NE(row, rows.end()) << "the view and the table are of one frame";
    EXPECT_THAT(desk.said(fmt::format("Visualizers/selected/pixel/spectra/{}", row - rows.begin())),
                HasSubstr(fmt::format("spectrum 0x{:x},  tiles {:.0f},", static_cast<std::uint32_t>(spectrum), (*row)[1])));
    EXPECT_THAT(desk.said("Visualizers/selected/tables/spectra/0"), HasSubstr(fmt::format("tiles {:.0f}", rows.front()[1])));
}

TEST(Visualizers, CurvesAreATablesColumnsOverItsFirst) {
    const NumberTable table{.columns = {{"step", ""}, {"held", "W"}, {"escaped", "W"}}, .rows = {{0, 5, 0}, {1, 3, 2}}};
    const std::vector<PlotSeries> curves = curves_of(table);
    ASSERT_EQ(curves.size(), 2u);
    EXPECT_EQ(curves[0].label, "held");
    EXPECT_THAT(curves[0].points, ElementsAre(glm::dvec2(0, 5), glm::dvec2(1, 3)));
    EXPECT_THAT(curves[1].points, ElementsAre(glm::dvec2(0, 0), glm::dvec2(1, 2)));
}

TEST(Visualizers, ATableOfCurvesIsPlotted) {
    Desk& desk = gallery();
    desk.model().select_frame(frame_of("two_rooms"));
    must(desk.player->wait());
    must(desk.player->click("Visualizers/indirect/lpv/visible taps"));
    must(desk.player->wait());
    EXPECT_NO_THROW(desk.widget("Visualizers/selected/tables/energy/curves/field"));
    EXPECT_THAT(desk.said("Visualizers/selected/tables/energy/0"), HasSubstr("held"));
}

TEST(Visualizers, CountersOfWhatHadNoRoomAreThoseOfTheRun) {
    Desk& desk = gallery();
    must(desk.player->click("Visualizers/lighting/tiled/overflow"));
    must(desk.player->wait());
    std::size_t found = 0;
    for (const CounterRecord& record : desk.replay()->run.counters) {
        if (record.technique != tiled || !record.name.starts_with("tiles over")) continue;
        EXPECT_EQ(desk.said(fmt::format("Visualizers/selected/overflow/{}", record.name)), fmt::format("{}", record.value));
        ++found;
    }
    EXPECT_EQ(found, 3u);
}

TEST(Visualizers, ASliceHasTheViewsValuesNearTheSliderAndNothingElse) {
    Desk& desk = gallery();
    must(desk.player->click("Visualizers/lighting/tiled/LDS bytes"));
    const strata::Run run = run_of(desk, {tiled + ":LDS bytes"});
    const HostImage& all = run.images.begin()->second;
    const double shown = texel(all, 40, 20).x;
    ASSERT_GT(shown, 0);
    must(desk.player->click("Visualizers/selected/slice"));
    must(desk.player->type("Visualizers/selected/slice at", fmt::format("{}", shown)));
    must(desk.player->wait());
    ASSERT_TRUE(desk.model().image.made);
    const HostImage& slice = *desk.model().image.made->image;
    EXPECT_EQ(texel(slice, 40, 20).x, shown);
    const double at = desk.widget("Visualizers/selected/slice at").number;
    const double half = desk.widget("Visualizers/selected/slice half").number;
    for (std::uint32_t x = 0; x < all.shape.extent.width; ++x) {
        const double value = texel(all, x, 20).x;
        EXPECT_EQ(texel(slice, x, 20).x, std::abs(value - at) <= half ? value : 0) << x;
    }
    must(desk.player->click("Visualizers/selected/slice"));
    EXPECT_FALSE(desk.model().image.made);
}

TEST(Visualizers, WavesOfTheModesAreThoseOfStrataIsa) {
    ASSERT_EQ(strata("record lights_room -o room.strata --size 80x48").code, 0);
    const Finished isa = strata("isa room.strata --use lighting/tiled --gpu-model bonaire --json --tiles tiles.exr");
    ASSERT_EQ(isa.code, 0) << isa.err;
    const double mean = nlohmann::json::parse(isa.out)["gpus"][0]["tiles"]["mean_waves_per_simd"];
    std::ofstream(folder() / "waves.txt") << "click tabs/Visualizers\nwait\nclick 'Visualizers/lighting/tiled/tile modes'\n"
                                             "wait\nchoose Visualizers/selected/waves/gpu bonaire\nwait\n"
                                             "expect Visualizers/selected/waves/mean '"
                                          << fmt::format("{:.2f} of", mean)
                                          << "'\nclick Visualizers/selected/waves/show\nwait\n"
                                             "expect Image/image 'made: waves per SIMD on bonaire'\n";
    const Finished played = strata("inspect room.strata --use lighting/tiled --script waves.txt");
    EXPECT_EQ(played.code, 0) << played.err;
}

TEST(Views, ThumbnailsAreMeansOfWhatIsANumber) {
    const HostImage image = picture_of(4, {1, 3, 5, NAN, 1, 3, 5, 7});
    const Texels small = thumbnail(image, 2);
    ASSERT_EQ(small.width, 2u);
    ASSERT_EQ(small.height, 1u);
    EXPECT_EQ(small.rgba[0], 2);
    EXPECT_FLOAT_EQ(small.rgba[4], 17.f / 3);
    EXPECT_EQ(thumbnail(image, 160).rgba[4], 3);
}

TEST(Views, ASliceKeepsTheTexelsOfItsValuesBitForBit) {
    const HostImage slice = slice_of(picture_of(3, {.1f, .2f, .30001f}), .2, .1);
    EXPECT_EQ(texel(slice, 0, 0).x, double{.1f});
    EXPECT_EQ(texel(slice, 1, 0).x, double{.2f});
    EXPECT_EQ(texel(slice, 2, 0).x, 0);
}

TEST(Views, HaveTheParametersThatTheirHelpNames) {
    const auto names_of = [](std::string_view technique, std::string_view view) {
        const Technique& of = *must(find_technique(technique));
        std::vector<std::string_view> names;
        for (const Param* param : params_of(of, *std::ranges::find(of.views, view, &DebugView::name)))
            names.push_back(param->name);
        return names;
    };
    EXPECT_THAT(names_of("transparency/voxel", "slice"), ElementsAre("shown_slice"));
    EXPECT_THAT(names_of("culling/hiz_two_phase", "pyramid"), ElementsAre("level"))
        << "of occluders, which is a parameter's name";
    EXPECT_THAT(names_of("lens/camera", "taps"), testing::IsEmpty()) << "before distortion, which is one, too";
}

TEST(Views, NameNothingButParametersInBackticks) {
    for (const Technique& technique : techniques())
        for (const DebugView& view : technique.views) {
            const auto marks = std::ranges::count(view.help, '`');
            EXPECT_EQ(static_cast<std::size_t>(marks), 2 * params_of(technique, view).size())
                << technique.name << ":" << view.name;
        }
}

}  // namespace
}  // namespace strata::ui
