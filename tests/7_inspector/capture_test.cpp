// What a frame is made of, and the outline of a draw.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/frame/capture_tables.h"
#include "ui/frame/counter_rows.h"
#include "ui/picture/outline.h"

namespace strata::ui {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAre;

TEST(Outline, RunsAlongTheEdgesOfThePixelsThatShowTheDraw) {
    constexpr Cover none = Cover::none, hidden = Cover::hidden, shown = Cover::shown;
    const Cover cover[] = {none, none,  none,    //
                           none, shown, hidden,  //
                           none, shown, none};
    const Outline outline = outline_of(cover, 3);
    EXPECT_EQ(outline.shown, 2u);
    EXPECT_EQ(outline.hidden, 1u);
    EXPECT_EQ(outline.from, glm::uvec2(1, 1));
    EXPECT_EQ(outline.to, glm::uvec2(3, 3));
    EXPECT_THAT(outline.around_shown, UnorderedElementsAre(OutlineLine{1, 1, 2, 1}, OutlineLine{1, 3, 2, 3},
                                                           OutlineLine{1, 1, 1, 3}, OutlineLine{2, 1, 2, 3}));
    EXPECT_THAT(outline.around_all,
                UnorderedElementsAre(OutlineLine{1, 1, 3, 1}, OutlineLine{2, 2, 3, 2}, OutlineLine{1, 3, 2, 3},
                                     OutlineLine{1, 1, 1, 3}, OutlineLine{2, 2, 2, 3}, OutlineLine{3, 1, 3, 2}));
}

TEST(CaptureTables, HaveARowPerThingOfTheFrame) {
    const Frame frame = scenario_frames("glass_and_smoke").front();
    const auto tables = capture_tables(frame);
    const auto rows_of = [&](std::string_view name) { return std::ranges::find(tables, name, &CaptureTable::name)->rows.size(); };
    EXPECT_EQ(rows_of("draws"), frame.draws.size());
    EXPECT_EQ(rows_of("emitters"), frame.emitters.size());
    EXPECT_EQ(rows_of("materials"), frame.materials.size());
    EXPECT_EQ(rows_of("textures"), frame.textures.size());
    EXPECT_EQ(rows_of("lights"), frame.lights.size());
    for (const CaptureTable& table : tables)
        for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.name;
}

TEST(CaptureTables, AreSortedByNumbersWhereThereAreNumbersAndFoundByText) {
    const CaptureTable table{.name = "things",
                             .columns = {{"thing", ""}, {"size", ""}},
                             .rows = {{{"0 Glass"}, {"10", 10}}, {{"1 smoke"}, {"9", 9}}, {{"2 glassy"}, {"100", 100}}}};
    std::vector<std::size_t> rows = rows_with(table, "");
    sort_rows(table, 1, SortDirection::up, rows);
    EXPECT_THAT(rows, ElementsAre(1, 0, 2));
    sort_rows(table, 1, SortDirection::down, rows);
    EXPECT_THAT(rows, ElementsAre(2, 0, 1));
    EXPECT_THAT(rows_with(table, "gLASS"), ElementsAre(0, 2));
    EXPECT_THAT(rows_with(table, "nothing"), ElementsAre());
}

TEST(CapturePanel, ASelectedDrawIsOutlinedWhereTheSessionSaysItShows) {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("glass_and_smoke"));
    must(desk.player->click("tabs/Capture"));
    must(desk.player->wait());
    const Frame frame = small_scenarios()[frame_of("glass_and_smoke")];
    must(desk.player->click(fmt::format("Capture/draws/0 {}", frame.draws.front().name)));
    must(desk.player->wait());
    ASSERT_EQ(desk.model().draw, 0u);
    ASSERT_NE(desk.model().outline, nullptr);

    using Covers = std::vector<Cover>;
    const auto job = desk.inspector->replayer().start<Covers>(
        [request = desk.replay()->request](Session& session, ui::Progress&) { return session.draw_cover(request, 0); });
    must(desk.player->wait());
    const Covers cover = must(*job->result());
    const auto shown = static_cast<std::size_t>(std::ranges::count(cover, Cover::shown));
    EXPECT_EQ(desk.model().outline->shown, shown);
    EXPECT_GT(shown, 0u);
    EXPECT_THAT(desk.said("Capture/cover"), testing::HasSubstr(fmt::format("shown in {} pixels", grouped(shown))));
    must(desk.player->click("Capture/go there"));
    EXPECT_GT(desk.model().view.zoom, 0);
    desk.expect_no_conflicts();
    must(desk.player->click("Capture/no outline"));
    must(desk.player->wait());
    EXPECT_EQ(desk.model().outline, nullptr);
}

TEST(CapturePanel, HasEveryTable) {
    Desk& desk = Desk::clean();
    must(desk.player->click("tabs/Capture"));
    must(desk.player->wait());
    for (const CaptureTable& table : capture_tables(small_scenarios().front())) {
        must(desk.player->choose("Capture/table", std::string(table.name)));
        must(desk.player->wait());
        EXPECT_EQ(desk.said("Capture/table"), table.name);
        desk.expect_no_conflicts();
    }
    must(desk.player->choose("Capture/table", "draws"));
}

}  // namespace
}  // namespace strata::ui
