// Accuracy and cost: what of a report becomes points and rows, and that the panel says what the session measures.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/srgb.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/report/variants.h"
#include "replay/session/choice_text.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"
#include "ui/report/report_columns.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Measurement row(std::string technique, double error, double ms, double bias = 0) {
    Measurement made{.technique = std::move(technique)};
    made.accuracy.technique_errors = {{"rmse", "radiance", error}, {"bias", "radiance", bias}};
    made.stage_ms = made.frame_ms = {.median = ms, .mad = ms / 10};
    made.tolerance = 1;
    return made;
}

/// Four techniques, of which one cannot do the frame.
Report report() {
    Report made{.repeats = 3};
    made.rows = {row("transparency/sorted_lists", 0, 8),
                 row("transparency/moments", .01, 2, -.3),
                 row("transparency/weighted", .1, 4, .1),
                 row("transparency/alpha_blend", .2, 1, .2),
                 {.technique = "transparency/voxel"}};
    made.rows[2].settings = "falloff=30";
    made.rows[4].accuracy.not_supported = "glass is colored";
    return made;
}

const ReportColumn& column(const std::vector<ReportColumn>& columns, std::string_view head) {
    return *std::ranges::find(columns, head, &ReportColumn::head);
}

double linear(float channel) { return decode_srgb(double{channel}); }

/// In Oklab (Ottosson 2020), where a distance of .02 is just seen.
glm::dvec3 perceived(const ImVec4& color) {
    const glm::dvec3 rgb(linear(color.x), linear(color.y), linear(color.z));
    const glm::dvec3 cones = glm::pow(glm::dvec3(.4122214708 * rgb.x + .5363325363 * rgb.y + .0514459929 * rgb.z,
                                                 .2119034982 * rgb.x + .6806995451 * rgb.y + .1073969566 * rgb.z,
                                                 .0883024619 * rgb.x + .2817188376 * rgb.y + .6299787005 * rgb.z),
                                      glm::dvec3(1 / 3.));
    return {.2104542553 * cones.x + .7936177850 * cones.y - .0040720468 * cones.z,
            1.9779984951 * cones.x - 2.4285922050 * cones.y + .4505937099 * cones.z,
            .0259040371 * cones.x + .7827717662 * cones.y - .8086757660 * cones.z};
}

/// Of the fourteen techniques of transparency six had almost the color of another: points and names were mistaken.
TEST(ReportColumns, TellFourteenTechniquesApartByColor) {
    for (std::size_t i = 0; i < 14; ++i)
        for (std::size_t j = i + 1; j < 14; ++j)
            EXPECT_GT(glm::distance(perceived(color_of_stage(i)), perceived(color_of_stage(j))), .07) << i << " " << j;
}

TEST(ReportColumns, AreTheErrorsThenTheCostsThatWereMeasured) {
    std::vector<std::string> labels;
    for (const ReportColumn& each : columns_of(report())) labels.push_back(each.label);
    EXPECT_THAT(labels,
                ElementsAre("rmse (radiance)", "bias (radiance)", "ms of the stage", "ms of the frame", "bytes per pixel"));
    EXPECT_EQ(cell_text(column(columns_of(report()), "ms"), 1), "2 \xc2\xb1 0.2");
    EXPECT_EQ(cell_text(column(columns_of(report()), "rmse"), 4), "\xe2\x80\x93");
}

/// The error that ranks rows is the axis that a plot begins with.
TEST(ReportColumns, BeginWithWhatRanksRows) {
    Report made = report();
    for (Measurement& row : made.rows) {
        if (!row.is_measured()) continue;
        row.accuracy.technique_errors.push_back({"display rmse", "of white", .01, true});
        row.accuracy.touched = {{"rmse", "radiance", .1}, {"display rmse", "of white", .02}};
        row.accuracy.touched_share = .5;
    }
    const auto columns = columns_of(made);
    EXPECT_EQ(columns.front().head, "display rmse touched, % of white");
    EXPECT_EQ(*columns.front().values[1], .02);
    EXPECT_EQ(&column_of(columns, ReportColumn::Kind::error, "nothing"), &columns.front());
}

TEST(ReportColumns, ABiasRanksByItsSizeAndIsShownWithItsSign) {
    const auto columns = columns_of(report());
    const ReportColumn& bias = column(columns, "bias");
    EXPECT_EQ(cell_text(bias, 1), "-0.3");
    EXPECT_EQ(bias.axis_label(), "|bias| (radiance)");
    EXPECT_THAT(sorted_rows(bias, SortOrder::ascending), ElementsAre(0, 2, 3, 1, 4));
    EXPECT_THAT(sorted_rows(bias, SortOrder::descending), ElementsAre(1, 3, 2, 0, 4));
    EXPECT_THAT(front_of(report(), bias, column(columns, "ms")), ElementsAre(true, false, true, true, false));
    Report other = report();
    other.rows[3].has_other_truth = true;
    EXPECT_THAT(front_of(other, bias, column(columns, "ms")), ElementsAre(true, true, true, false, false))
        << "a row with another truth neither is on the front nor pushes others off it";
}

TEST(ReportColumns, AnAxisIsLogarithmicWhereThatIsWorthIt) {
    const auto columns = columns_of(report());
    EXPECT_EQ(natural_scale(column(columns, "rmse")), AxisScale::linear) << "an exact technique has the error 0";
    EXPECT_EQ(natural_scale(column(columns, "ms")), AxisScale::linear) << "8 is less than ten times 1";
    Report wide = report();
    wide.rows[0].stage_ms.median = 10;
    EXPECT_EQ(natural_scale(column(columns_of(wide), "ms")), AxisScale::logarithmic);
}

TEST(ReportPlot, HasATechniquePerSeriesWithItsSpreadThenTheFrontThenWhatIsShown) {
    const Report made = report();
    const auto columns = columns_of(made);
    const ReportAxes axes{column(columns, "rmse"), column(columns, "ms"), AxisScale::logarithmic, AxisScale::linear};
    const ReportPlot plot = plot_of(made, axes, 3);
    std::vector<std::string> labels;
    for (const PlotSeries& series : plot.series) labels.push_back(series.label);
    ASSERT_THAT(labels, testing::UnorderedElementsAre("moments", "weighted", "alpha_blend", "Pareto front", "shown now"));
    EXPECT_EQ(plot.without_place, 1u) << "an error of 0 on a logarithmic axis";
    EXPECT_THAT(plot.rows[3], ElementsAre(3, 1)) << "from the cheapest on; the exact technique has no place";
    EXPECT_THAT(plot.rows[4], ElementsAre(3));
    const PlotPoint moments = *plot.point_of(1);
    EXPECT_EQ(plot.series[moments.series].points[moments.point], glm::dvec2(2, .01));
    EXPECT_THAT(plot.series[moments.series].spreads, ElementsAre(.2));
    EXPECT_THAT(plot.series[moments.series].notes[0], HasSubstr("nothing is both more accurate and cheaper"));
    EXPECT_EQ(plot.point_of(0), std::nullopt);
}

TEST(ReportRemarks, SayWhatIsNotSupportedAndWhatMayBeABug) {
    Report made = report();
    made.rows[1].accuracy.model_rmse = 2;
    const auto remarks = remarks_of(made);
    ASSERT_EQ(remarks.size(), 2u);
    EXPECT_TRUE(remarks[0].is_doubt);
    EXPECT_EQ(remarks[0].what, "moments");
    EXPECT_EQ(remarks[1].what, "voxel");
    EXPECT_EQ(remarks[1].why, "cannot do this frame: glass is colored");
}

TEST(ReportBase, KeepsTheOtherStagesChoicesAlone) {
    const Request base = report_base(
        {.choices = chosen({"transparency/weighted", "shadows/pcf"}, {"transparency/weighted:falloff=3", "shadows/pcf:radius=2"}),
         .outputs = {"transparency/weighted:weight", "color"}},
        Stage::transparency);
    EXPECT_THAT(use_texts(base.choices), ElementsAre("shadows/pcf"));
    EXPECT_THAT(set_texts(base.choices), ElementsAre("shadows/pcf:radius=2"));
    EXPECT_THAT(base.outputs, ElementsAre("display"));
    const Request row_of_it = request_of(report().rows[2], base);
    EXPECT_THAT(use_texts(row_of_it.choices), ElementsAre("shadows/pcf", "transparency/weighted"));
    EXPECT_THAT(set_texts(row_of_it.choices), ElementsAre("shadows/pcf:radius=2", "transparency/weighted:falloff=30"));
}

constexpr const char* panel = "Accuracy and cost";
constexpr strata::Stage measured_stage = strata::Stage::gbuffer;

/// A stage with few techniques, measured once in the panel.
Desk& measured_desk() {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("one_sphere"));
    must(desk.player->wait());
    must(desk.player->click(fmt::format("tabs/{}", panel)));
    must(desk.player->choose(fmt::format("{}/stage", panel), std::string(name(measured_stage))));
    must(desk.player->choose(fmt::format("{}/repeats", panel), "3 repeats"));
    must(desk.player->choose(fmt::format("{}/repeats", panel), "1 repeat"));
    must(desk.player->click(fmt::format("{}/measure", panel)));
    must(desk.player->wait());
    return desk;
}

/// The same by a session of its own.
const Report& measured_alone() {
    static const Report made = [] {
        const auto session = must(Session::open(small_scenarios(), {.validation = true}));
        return must(make_report(*session,
                                {.base = {.variant = {.frame = frame_of("one_sphere")}}, .stage = measured_stage, .repeats = 1}));
    }();
    return made;
}

TEST(CostPanel, SaysOfEverySettingWhatTheSessionMeasures) {
    Desk& desk = measured_desk();
    const Report& alone = measured_alone();
    ASSERT_GE(alone.rows.size(), 2u);
    const auto columns = columns_of(alone);
    for (std::size_t i = 0; i < alone.rows.size(); ++i) {
        if (!alone.rows[i].accuracy.not_supported.empty()) continue;
        const std::string path = fmt::format("{}/table/{}/", panel, short_label(alone.rows[i]));
        for (const ReportColumn& each : columns)
            if (each.spreads.empty() && !each.is_detail) {
                EXPECT_EQ(desk.said(path + each.head), cell_text(each, i)) << path << each.head;
            }
        EXPECT_THAT(desk.said(path + "ms"), HasSubstr("\xc2\xb1"));
    }
    desk.expect_no_conflicts();
}

TEST(CostPanel, AClickOnARowAppliesItInOneStepOfUndo) {
    Desk& desk = measured_desk();
    const Technique* before = desk.model().choices().at(measured_stage).technique;
    const auto other = std::ranges::find_if(measured_alone().rows, [&](const Measurement& each) {
        return each.technique != before->name && each.accuracy.not_supported.empty();
    });
    ASSERT_NE(other, measured_alone().rows.end());
    must(desk.player->click(fmt::format("{}/table/{}/apply", panel, short_label(*other))));
    must(desk.player->wait());
    EXPECT_EQ(desk.model().choices().at(measured_stage).technique->name, other->technique);
    EXPECT_EQ(row_of(measured_alone(), desk.model().choices().at(measured_stage)), other - measured_alone().rows.begin());
    must(desk.player->key("ctrl+z"));
    must(desk.player->wait());
    EXPECT_EQ(desk.model().choices().at(measured_stage).technique, before);
}

TEST(CostPanel, AReportThatIsCancelledLeavesNothing) {
    Desk& desk = Desk::clean();
    must(desk.player->click(fmt::format("tabs/{}", panel)));
    must(desk.player->choose(fmt::format("{}/stage", panel), "transparency"));
    desk.model().select_frame(frame_of("smoke_grenade"));
    must(desk.player->wait());
    must(desk.player->click(fmt::format("{}/measure", panel)));
    EXPECT_FALSE(desk.inspector->is_settled());
    must(desk.player->click(fmt::format("{}/cancel", panel)));
    must(desk.player->wait());
    EXPECT_THAT(desk.said(fmt::format("{}/state", panel)), HasSubstr("nothing is measured yet"));
    EXPECT_EQ(desk.inspector->replayer().error("A"), nullptr);
    EXPECT_TRUE(desk.inspector->replayer().is_current("A"));
}

TEST(CostPanel, AStageThatTheFrameDoesNotNeedSaysWhy) {
    Desk& desk = Desk::clean();
    must(desk.player->click(fmt::format("tabs/{}", panel)));
    must(desk.player->choose(fmt::format("{}/stage", panel), "transparency"));
    desk.model().select_frame(frame_of("opaque_only"));
    must(desk.player->wait());
    const auto skipped = std::ranges::find(desk.replay()->skipped, strata::Stage::transparency, &SkippedStage::stage);
    ASSERT_NE(skipped, desk.replay()->skipped.end());
    EXPECT_THAT(desk.said(fmt::format("{}/left out", panel)), HasSubstr(skipped->reason));
    EXPECT_THAT(desk.player->click(fmt::format("{}/measure", panel)), FailsWith("script.disabled"));
}

}  // namespace
}  // namespace strata::ui
