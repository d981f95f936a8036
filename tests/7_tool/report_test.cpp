// A report's own arithmetic, and what it looks like.
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/view.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/reference/difference.h"
#include "passes/stage_input.h"
#include "passes/transparency/judge.h"
#include "replay/report/flicker.h"
#include "replay/report/hard_cases.h"
#include "replay/report/pooled.h"
#include "replay/tables/table.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

Measurement row(std::string name, double error, double ms, double bytes = 0) {
    Measurement measured{.technique = std::move(name)};
    measured.accuracy.technique_errors = {{"rmse", "", error}};
    measured.stage_ms.median = ms;
    measured.bytes_per_pixel = bytes;
    return measured;
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBothErrorAndTime) {
    std::vector<Measurement> rows = {row("exact", 0, 10), row("good", .01, 2), row("dominated", .02, 3), row("fast", .5, 1)};
    mark_fronts(rows);
    EXPECT_TRUE(rows[0].on_front);
    EXPECT_TRUE(rows[1].on_front);
    EXPECT_FALSE(rows[2].on_front);
    EXPECT_TRUE(rows[3].on_front);
}

TEST(ParetoFront, OfMemoryIsItsOwn) {
    std::vector<Measurement> rows = {row("small and slow", .1, 9, 8), row("large and fast", .1, 1, 64)};
    mark_fronts(rows);
    EXPECT_FALSE(rows[0].on_front);
    EXPECT_TRUE(rows[0].on_memory_front);
    EXPECT_TRUE(rows[1].on_front);
    EXPECT_FALSE(rows[1].on_memory_front);
}

TEST(ParetoFront, EqualRowsShareIt) {
    std::vector<Measurement> rows = {row("one", .1, 1), row("other", .1, 1)};
    mark_fronts(rows);
    EXPECT_TRUE(rows[0].on_front);
    EXPECT_TRUE(rows[1].on_front);
}

/// It answers another question, as occlusion within a shorter radius does: it neither is ranked nor pushes others off the front.
TEST(ParetoFront, WhatHasAnotherTruthIsNotRanked) {
    std::vector<Measurement> rows = {row("easier", .01, 1, 1), row("default", .1, 2, 2)};
    rows[0].has_other_truth = true;
    mark_fronts(rows);
    EXPECT_FALSE(rows[0].on_front);
    EXPECT_FALSE(rows[0].on_memory_front);
    EXPECT_TRUE(rows[1].on_front);
    EXPECT_TRUE(rows[1].on_memory_front);
    EXPECT_EQ(best_within(standings(rows), {&Standing::time, 4}), 1u);
    EXPECT_EQ(find_answer(standings(rows), {}, {.error = .2}).recommended, 1u);
}

TEST(ParetoFront, WhatIsNotSupportedIsNeverOnIt) {
    std::vector<Measurement> rows = {row("one", .1, 1), {.technique = "cannot"}};
    rows[1].accuracy.not_supported = "chromatic";
    mark_fronts(rows);
    EXPECT_FALSE(rows[1].on_front);
    EXPECT_FALSE(rows[1].on_memory_front);
}

TEST(ParetoFront, ATimeWithinTheSpreadIsNotFaster) {
    const std::vector<Standing> rows = {{.error = .01, .time = 1, .spread = .05}, {.error = .1, .time = .93, .spread = .03}};
    EXPECT_EQ(pareto_front(rows, &Standing::time), (std::vector<bool>{true, false}));
    const std::vector<Standing> apart = {{.error = .01, .time = 1, .spread = .05}, {.error = .1, .time = .9, .spread = .03}};
    EXPECT_EQ(pareto_front(apart, &Standing::time), (std::vector<bool>{true, true}));
}

TEST(Ties, AreRowsThatOnlyTheSpreadKeepsOffTheFront) {
    const std::vector<Standing> rows = {{.error = .01, .time = 1, .spread = .05},
                                        {.error = .1, .time = .93, .spread = .03},  // .07 apart, .08 of spread
                                        {.error = .2, .time = 1.1},
                                        {.error = .3, .time = .5}};
    EXPECT_EQ(ties_in_time(rows), (std::vector<bool>{false, true, false, false}));
    std::vector<Measurement> measured;
    for (const Standing& standing : rows) {
        measured.push_back(row("transparency/a", *standing.error, standing.time));
        measured.back().stage_ms.mad = standing.spread;
    }
    mark_fronts(measured);
    EXPECT_TRUE(measured[1].is_tied);
    EXPECT_THAT(as_text(Report{.rows = measured}), HasSubstr("\n=  a"));
}

TEST(Budgets, OfTimeAreKeptWithTheSpread) {
    const std::vector<Standing> rows = {{.error = .1, .time = .99, .spread = .05}, {.error = .2, .time = .9, .spread = .05}};
    EXPECT_EQ(best_within(rows, {&Standing::time, 1}), 1u);
}

const std::vector<Standing> four_techniques = {{.error = 0, .time = 1},
                                               {.error = .001, .time = 2.7, .spread = .1},
                                               {.error = .004, .time = 1.8, .spread = .1},
                                               {.error = .005, .time = 1.9, .spread = .1},
                                               {.error = .02, .time = 1.1, .spread = .02},
                                               {.time = 0}};  // not supported

std::string answer_text(std::span<const Standing> rows, std::optional<std::size_t> baseline, const Question& asked,
                        const AnswerNames& names) {
    return as_text(answer_lines(rows, baseline, asked, names));
}

TEST(Answers, AreTheFastestRowThatKeepsAllLimits) {
    const Answer answer = find_answer(four_techniques, {}, {.error = .01, .within = 2});
    EXPECT_EQ(answer.recommended, 0u);
    EXPECT_EQ(answer.most_accurate, 0u);
    EXPECT_EQ(answer.cheaper, std::nullopt);
    EXPECT_EQ(answer.nearest, std::nullopt);
    const std::vector<Standing> inexact(four_techniques.begin() + 1, four_techniques.end());
    EXPECT_EQ(find_answer(inexact, {}, {.error = .01, .within = 3}).recommended, 1u);
    EXPECT_EQ(find_answer(inexact, {}, {.error = .01, .within = 3}).most_accurate, 0u);
    EXPECT_EQ(find_answer(inexact, {}, {.error = .01, .within = 3}).as_cheap, std::vector<std::size_t>{2});
    EXPECT_EQ(find_answer(inexact, {}, {.error = .01, .within = 3}).cheaper, 3u);
    EXPECT_EQ(find_answer(inexact, {}, {.within = 2}).recommended, 1u) << "the most accurate where no error is asked";
}

/// The order of times within their spreads changes from run to run.
TEST(Answers, AreTheMostAccurateOfWhatIsAsFast) {
    std::vector<Standing> rows = {{.error = .006, .time = 2.3, .spread = .1}, {.error = .001, .time = 2.4, .spread = .05}};
    EXPECT_EQ(find_answer(rows, {}, {.error = .01}).recommended, 1u);
    EXPECT_EQ(find_answer(rows, {}, {.error = .01}).as_cheap, std::vector<std::size_t>{0});
    EXPECT_EQ(find_answer(rows, {}, {.error = .01, .within = 2.42}).recommended, 0u) << "2.4 +- .05 is not within 2.42";
    rows[1].spread = 1;
    EXPECT_EQ(find_answer(rows, {}, {.error = .01}).recommended, 0u) << "unsteady";
    rows[0].spread = 1;
    EXPECT_EQ(find_answer(rows, {}, {.error = .01}).recommended, 0u) << "both are, and the first is faster";
    rows[0].spread = .01, rows[1].spread = .01;
    EXPECT_EQ(find_answer(rows, {}, {.error = .01}).recommended, 0u) << "told apart";
}

TEST(Answers, AreTheBaselineWhereItKeepsTheError) {
    EXPECT_EQ(find_answer(four_techniques, 4, {.error = .03, .within = 2}).recommended, 4u);
    EXPECT_EQ(find_answer(four_techniques, 1, {.error = .002}).recommended, 1u) << "also where another is faster";
    EXPECT_EQ(find_answer(four_techniques, 4, {.error = .01}).recommended, 0u);
    EXPECT_EQ(find_answer(four_techniques, 4, {.within = 2}).recommended, 0u) << "it always keeps a time in units of its own";
}

/// Lists of a glass in smoke: all three are exact but for rounding, and the first is 2.7 times as slow as the second.
TEST(Answers, OfExactRowsAreTheFastest) {
    std::vector<Measurement> rows = {row("lists", 5.1e-8, 27), row("blend", 5.2e-8, 10, 8), row("function", 9e-5, 40, 4),
                                     row("adaptive", .002, 9)};
    for (Measurement& each : rows)
        each.accuracy.technique_errors.front() = {std::string(display_rmse), "of white",
                                                  each.accuracy.technique_errors.front().value};
    const Answer answer = find_answer(standings(rows), {}, {});
    EXPECT_EQ(answer.recommended, 1u);
    EXPECT_EQ(most_accurate_text(answer, "blend", rows.size(), "", true),
              "blend is the fastest of the 3 most accurate of 4 rows");
    EXPECT_EQ(find_answer(standings(rows), {}, {.within_ms = 9.5}).most_accurate, 3u);
    EXPECT_EQ(find_answer(standings(rows), {}, {.cost = &Standing::bytes_per_pixel}).recommended, 0u) << "the smallest";
    EXPECT_EQ(best_within(standings(rows), {&Standing::time, 100}), 1u);
    mark_fronts(rows);
    EXPECT_THAT(rows, ElementsAre(Field(&Measurement::on_front, false), Field(&Measurement::on_front, true),
                                  Field(&Measurement::on_front, false), Field(&Measurement::on_front, true)));
    for (Measurement& each : rows) each.accuracy.technique_errors.front().unit = "";
    EXPECT_EQ(find_answer(standings(rows), {}, {}).recommended, 0u) << "one draw of many millions is one";
    EXPECT_EQ(most_accurate_text(find_answer(standings(rows), {}, {}), "lists", 4, " over 2 captures", true),
              "lists is the most accurate of 4 rows over 2 captures");
}

TEST(Answers, OfNoRowThatKeepsAllNameTheNearest) {
    const std::vector<Standing> rows = {{.error = .2, .time = 1}, {.error = .011, .time = 2.5}, {.error = .001, .time = 9}};
    const Answer answer = find_answer(rows, 0, {.error = .01, .within = 2});
    EXPECT_EQ(answer.recommended, std::nullopt);
    EXPECT_EQ(answer.nearest, 1u) << "1.25 times the time; the others 20 times the error and 4.5 times the time";
    EXPECT_THAT(
        answer_text(rows, 0, {.error = .01, .within = 2}, {{"alpha", "b", "c"}, {"rmse"}, "alpha"}),
        AllOf(HasSubstr("no technique keeps both; the nearest, b (rmse 0.011, 2.50x, 0 bytes per pixel), misses both limits\n"),
              HasSubstr("the baseline alpha (rmse 0.2, 1.00x, 0 bytes per pixel) misses the limit of error\n")));
    EXPECT_EQ(find_answer(std::vector<Standing>{{.time = 1}}, {}, {.error = 1}).nearest, std::nullopt) << "not supported";
}

TEST(Answers, KeepLimitsInMillisecondsAndInBytes) {
    const std::vector<Standing> rows = {
        {.error = .001, .time = 1, .bytes_per_pixel = 0, .ms = 4, .ms_spread = .1, .bytes = 0},
        {.error = .002, .time = .5, .bytes_per_pixel = 600, .ms = 2, .ms_spread = .2, .bytes = 6e6},
        {.error = .003, .time = .4, .bytes_per_pixel = 64, .ms = 1.6, .ms_spread = .1, .bytes = 3 * 0x1p20},
        {.error = .5, .time = .1, .bytes_per_pixel = 8, .ms = .4, .ms_spread = 0, .bytes = 8e4}};
    EXPECT_EQ(find_answer(rows, 0, {.within_ms = 2.1}).recommended, 2u) << "2 +- .2 is not within 2.1";
    EXPECT_EQ(find_answer(rows, 0, {.within_ms = 2.2}).recommended, 1u) << "the most accurate";
    EXPECT_EQ(find_answer(rows, 0, {.within_ms = 2.2, .memory = 4e6}).recommended, 2u);
    EXPECT_EQ(find_answer(rows, {}, {.error = .01}).recommended, 2u) << "the fastest";
    EXPECT_EQ(find_answer(rows, {}, {.error = .01, .cost = &Standing::bytes_per_pixel}).recommended, 0u) << "the smallest";
    const Answer smaller = find_answer(rows, 2, {.error = .01, .within_ms = 2.2, .cost = &Standing::bytes_per_pixel});
    EXPECT_EQ(smaller.recommended, 2u);
    EXPECT_EQ(smaller.cheaper, 0u) << "misses the limit of time, and is smaller";
    const AnswerNames names{{"a", "b", "c", "d"}, {"rmse"}, "a"};
    EXPECT_EQ(answer_text(rows, 0, {.error = .01, .within = 2, .within_ms = 2, .memory = 3 * 0x1p20}, names),
              "answer for rmse up to 0.01 within 2x of a within 2 ms in 3 MiB: use c (rmse 0.003, 0.40x, 1.6 ms, 3 MiB)\n"
              "cheaper: d (rmse 0.5, 0.10x, 0.4 ms, 78.1 KiB) misses the limit of error\n"
              "the baseline a (rmse 0.001, 1.00x, 4 ms, 0 bytes) misses the limit of time\n");
    EXPECT_THAT(
        answer_text(rows, 0, {.error = 1e-4, .within_ms = .1, .memory = 10}, names),
        HasSubstr("no technique keeps all; the nearest, a (rmse 0.001, 1.00x, 4 ms, 0 bytes), misses the limits of error and "
                  "time\n"));
    EXPECT_THAT(answer_text(std::span(rows).subspan(1, 1), {}, {.error = 1e-4, .within_ms = .1, .memory = 10}, names),
                HasSubstr("misses all three limits"));
}

/// Times of a machine that has another GPU say nothing of one that is asked for.
TEST(Answers, RestOnTheModeledTimesOfTheGpuThatTheyAreFor) {
    Report report{.time_unit = "transparency/alpha_blend", .question = {.error = .1, .within = .5, .gpu = "ps4"}};
    const std::pair<const char*, std::optional<double>> modeled[] = {
        {"alpha_blend", .8}, {"moments", .32}, {"weighted", {}}, {"wavelet", .1}};
    double error = .01, ms = 4;
    for (const auto& [technique, cost] : modeled) {
        report.rows.push_back(row(fmt::format("transparency/{}", technique), error *= 2, ms /= 2));
        report.rows.back().modeled = ModeledCost{.kilocycles = cost, .ms = cost, .missing = cost ? "" : "nothing counts it"};
    }
    report.rows.back().accuracy.technique_errors.clear();
    EXPECT_EQ(answer_of(report).recommended, 1u) << ".32 / .8; without a modeled time there is no answer";
    EXPECT_THAT(as_text(answer_lines(report)),
                AllOf(testing::StartsWith("times are modeled for ps4: instructions alone, no memory, no blending\n"),
                      HasSubstr("\nwithout a modeled time: weighted, which therefore take no part (nothing counts it)\n"),
                      HasSubstr("use moments (rmse 0.04, 0.40x modeled, ")));
    report.question.gpu.clear();
    EXPECT_EQ(answer_of(report).recommended, 2u) << "measured ones: .5 ms";
    report.device = {.name = "A GPU"};
    EXPECT_THAT(as_text(answer_lines(report)), testing::StartsWith("times are of A GPU\n"));
    report.device.software = true;
    EXPECT_THAT(as_text(answer_lines(report)), testing::StartsWith("times are of "));
    EXPECT_THAT(as_text(answer_lines(report)), HasSubstr(", a CPU, and no GPU's: --cost cycles:GPU models one\n"));
    report.question = {.error = .1, .cost = &Standing::bytes_per_pixel};
    EXPECT_THAT(as_text(answer_lines(report)), testing::StartsWith("answer for ")) << "no time takes part";
}

TEST(Answers, SayWhereASpreadIsTooLargeToTellRowsApart) {
    const std::vector<Standing> rows = {{.error = .01, .time = 1.02, .spread = .02},
                                        {.error = .01, .time = 1.1, .spread = .1},
                                        {.error = .01, .time = 2.4, .spread = 1.4}};
    const Answer answer = find_answer(rows, {}, {.error = .02});
    EXPECT_EQ(answer.as_cheap, std::vector<std::size_t>{1});
    EXPECT_EQ(answer.unsteady, std::vector<std::size_t>{2});
    EXPECT_THAT(
        answer_text(rows, {}, {.error = .02}, {{"a", "b", "c"}, {"rmse"}, "a"}),
        HasSubstr("as fast within the spread: b (rmse 0.01, 1.10x, 0 bytes per pixel)\n1 more may be as fast: the spread of "
                  "their times is above 25 %\n"));
}

TEST(Answers, AreSentences) {
    AnswerNames names{{"b", "c", "d", "alpha", "f"}, {"display rmse", true}, "alpha"};
    names.commands = {"replay b", "replay c", "replay d", "replay alpha", "replay f"};
    names.baseline_note = "its time contains 2 ms";
    std::vector<Standing> rows(four_techniques.begin() + 1, four_techniques.end());
    EXPECT_EQ(
        answer_text(rows, 3, {.error = .01, .within = 3}, names),
        "answer for display rmse up to 1 % within 3x of alpha: use c (display rmse 0.4 %, 1.80x, 0 bytes per pixel)\n"
        "as fast within the spread: d (display rmse 0.5 %, 1.90x, 0 bytes per pixel)\n"
        "most accurate: b (display rmse 0.1 %, 2.70x, 0 bytes per pixel)\n"
        "cheaper: alpha (display rmse 2 %, 1.10x, 0 bytes per pixel) misses the limit of error\n"
        "the baseline alpha (display rmse 2 %, 1.10x, 0 bytes per pixel) misses the limit of error; its time contains 2 ms\n"
        "to replay it: replay c\n");
    EXPECT_THAT(answer_text(rows, 3, {.within = 2}, names),
                AllOf(HasSubstr("within 2x of alpha: use c ("), HasSubstr("2 %, 1.10x, 0 bytes per pixel) keeps it, too;")));
    rows[3].error = 1e-6;
    EXPECT_EQ(
        answer_text(rows, 3, {.error = .01}, names),
        "answer for display rmse up to 1 %: keep the baseline alpha (display rmse 1.0e-04 %, 1.10x, 0 bytes per pixel): exact, "
        "nothing that shows is out of order; its time contains 2 ms\nto replay it: replay alpha\n");
}

/// Zeros would be times.
TEST(StoppedReport, SaysNothingOfTimesThatWereNotMeasured) {
    Report report{.capture_name = "a.strata", .rows = {row("exact", 0, 0), row("good", .01, 0)}};
    report.stopped = "stopped after the errors of 2 of 9 rows; no time was measured";
    report.is_timed = false;
    const std::string text = as_text(report);
    EXPECT_THAT(text, HasSubstr("good"));
    EXPECT_THAT(text, HasSubstr("\n" + report.stopped + "\n"));
    EXPECT_THAT(text, Not(HasSubstr("bytes")));
    EXPECT_THAT(text, Not(HasSubstr("timed run")));
    const auto json = nlohmann::json::parse(as_json(report));
    EXPECT_EQ(json["stopped"], report.stopped);
    EXPECT_FALSE(json.contains("best_within"));
    EXPECT_EQ(json["rows"].size(), 2u);
    EXPECT_FALSE(json["rows"][0].contains("stage_ms"));
    std::istringstream csv(as_csv(report));
    std::string head, line;
    std::getline(csv, head);
    while (std::getline(csv, line)) {
        EXPECT_EQ(std::ranges::count(line, ','), std::ranges::count(head, ',')) << line;
        EXPECT_THAT(line, testing::EndsWith(",,,,"));
    }
    EXPECT_EQ(pooled(std::array{report}).captures, 0u);
}

TEST(Report, SaysHowFarATruthMadeOfRandomDirectionsIsExpectedToBeOff) {
    const auto session = scenario_session("cornell_box");
    const ReportRequest wanted{
        .base = {.variant = {.extent_divisor = 4}}, .stage = Stage::indirect, .techniques = {"ambient"}, .repeats = 1};
    const Report report = must(make_report(*session, wanted));
    ASSERT_EQ(report.truths.size(), 1u);
    const StandardError own = report.truths.front().own_error.value();
    const auto json = nlohmann::json::parse(as_json(report));
    EXPECT_EQ(json["truths"][0]["standard_error"]["rmse"], own.rmse);
    EXPECT_EQ(json["truths"][0]["standard_error"]["relative_rmse"], own.relative);
    EXPECT_THAT(as_text(report), HasSubstr(fmt::format("; its own standard error: rmse {}, relative rmse {}\n",
                                                       short_number(own.rmse), short_number(own.relative))));
    // Below a tenth of what the technique errs, or errors would not be the technique's.
    EXPECT_LT(own.relative, .03);
    EXPECT_LT(10 * own.rmse, report.rows.front().accuracy.technique_errors.front().value);
}

TEST(Report, MeasuresSettingsAgainstTheTruthThatTheyApproximate) {
    const auto session = scenario_session("cornell_box");
    const ReportRequest wanted{.base = {.variant = {.extent_divisor = 8}},
                               .stage = Stage::indirect,
                               .techniques = {"ambient", "lpv map_size=16 bounces=2"},
                               .repeats = 1};
    const Report report = must(make_report(*session, wanted));
    ASSERT_EQ(report.truths.size(), 2u);
    for (const Measurement& row : report.rows) EXPECT_EQ(row.truth, row.settings.empty() ? "" : "two bounces");
    EXPECT_THAT(as_text(report), HasSubstr("\ntruth: one bounce gathered"));
    EXPECT_THAT(as_text(report), HasSubstr("\ntruth of lpv map_size=16 bounces=2: one and two bounces gathered"));
    const auto json = nlohmann::json::parse(as_json(report));
    EXPECT_EQ(json["truths"][1]["name"], "two bounces");
    for (const auto& row : json["rows"]) {
        EXPECT_EQ(row.contains("truth"), row["technique"] == "indirect/lpv");
        EXPECT_EQ(row.contains("has_other_truth"), row["technique"] == "indirect/lpv");
    }
    for (const auto& best : json["best_within"]) EXPECT_NE(best["technique"], "indirect/lpv");
    EXPECT_EQ(report.rows.back().technique, "indirect/lpv") << "what is not ranked comes after what is";
    EXPECT_THAT(as_text(report), AllOf(HasSubstr("\nt  lpv map_size=16"), HasSubstr("\nt measured against another truth")));
    EXPECT_THAT(as_csv(report), HasSubstr(",,\"two bounces\"\n"));
}

/// Exposure chooses the unit that light is stored in. A report keeps a truth in the frame's unit and scales it back for every
/// row.
TEST(Report, CountsWhatAStageTouchesInAnyUnitOfLight) {
    std::vector<double> shares;
    for (const float exposure : {1.f, .37f, 1.7e-6f}) {
        std::vector<Frame> frames = scenario_frames("glass_and_smoke");
        frames[0].view.width = 64, frames[0].view.height = 36;
        frames[0].view.exposure *= exposure;
        const auto session = session_of(std::move(frames));
        shares.push_back(
            must(make_report(*session, {.techniques = {"alpha_blend"}, .repeats = 1})).rows.at(0).accuracy.touched_share);
    }
    EXPECT_LT(shares[0], 1);
    EXPECT_THAT(shares, testing::Each(shares[0]));
}

TEST(Report, HasNoImplementationErrorWhereItsModelDecidesNothing) {
    Report report{.rows = {row("edges/one", 0, 1)}};
    report.rows[0].accuracy.undecided = 9;
    EXPECT_THAT(as_text(report), HasSubstr("not every model could be compared; rounding decides every texel"));
    EXPECT_TRUE(nlohmann::json::parse(as_json(report))["rows"][0]["implementation_error"]["rmse"].is_null());
    report.rows[0].accuracy.compared = 1;
    EXPECT_EQ(nlohmann::json::parse(as_json(report))["rows"][0]["implementation_error"]["rmse"], 0);
}

/// Above 640 x 360 samples models are compared at a smaller extent.
TEST(Report, OfALargeFrameSaysHowManyTexelsWereComparedWithTheModel) {
    const Scenario* scenario = must(find_scenario("crossing_planes"));
    const auto session = session_of({scenario->build(0, {.width = 345, .height = 171, .samples = 4})});
    const Report report = must(make_report(*session, {.stage = Stage::edges, .techniques = {"bitwise"}, .repeats = 1}));
    const Accuracy& accuracy = report.rows.front().accuracy;
    EXPECT_EQ(accuracy.compared + accuracy.undecided, std::size_t{345 / 2} * (171 / 2));
    EXPECT_GT(accuracy.compared, 0u);
    EXPECT_EQ(accuracy.worst.image, "edges");
}

TEST(HardCaseReport, HasTheCasesThatWereCompleteWhenItWasStopped) {
    const std::vector<Variant> rows = must(variants({.techniques = {"alpha_blend"}}));
    std::stop_source source;
    std::size_t cases = 0;
    const auto stop_in_the_third = [&](std::string_view, double) {
        if (++cases == 3) source.request_stop();
    };
    const HardCaseReport report = must(measure_hard_cases({}, rows, stop_in_the_third, source.get_token()));
    EXPECT_EQ(report.rows.front().outcomes.size(), 2u);
    EXPECT_EQ(report.stopped, fmt::format("stopped after 2 of {} cases", hard_cases().size()));
    EXPECT_THAT(as_text(report), testing::AllOf(HasSubstr("\nstopped after 2 of"), Not(HasSubstr(hard_cases()[2].name))));
    EXPECT_EQ(nlohmann::json::parse(as_json(report))["stopped"], report.stopped);
    EXPECT_EQ(measure_hard_cases({}, rows, {}, source.get_token()).error().fault, Fault::stopped);
}

TEST(Budgets, AreOfWholeBytes) {
    const std::vector<Measurement> rows = {row("with a counter", .1, 1, 16.0007)};
    EXPECT_EQ(best_within(standings(rows), {&Standing::bytes_per_pixel, 16}), 0u);
}

TEST(Budgets, AreKeptByTheMostAccurateRowWithinThem) {
    const std::vector<Standing> rows = {{.error = 0, .time = 9, .bytes_per_pixel = 400},
                                        {.error = .01, .time = 2, .bytes_per_pixel = 32},
                                        {.error = .2, .time = 1, .bytes_per_pixel = 10},
                                        {.time = 0}};  // not supported
    EXPECT_EQ(best_within(rows, {&Standing::time, 2}), 1u);
    EXPECT_EQ(best_within(rows, {&Standing::time, 1.9}), 2u);
    EXPECT_EQ(best_within(rows, {&Standing::time, .5}), std::nullopt);
    EXPECT_EQ(best_within(rows, {&Standing::bytes_per_pixel, 16}), 2u);
    std::vector<std::string> names;
    for (const Budget& budget : budgets()) names.push_back(name(budget));
    EXPECT_THAT(names, ElementsAre("time <= 1", "time <= 2", "time <= 4", "bytes per pixel <= 16", "bytes per pixel <= 32",
                                   "bytes per pixel <= 64"));
}

TEST(Spread, IsTheMedianAndItsDeviation) {
    const double values[] = {5, 1, 2, 3, 4};
    const Spread spread = spread_of(values);
    EXPECT_EQ(spread.median, 3);
    EXPECT_EQ(spread.mad, 1);
    EXPECT_EQ(spread.low, 1);
    EXPECT_EQ(spread.high, 5);
    EXPECT_EQ(spread.repeats, 5u);
}

TEST(Spread, OfARatioIsThatOfTheTurnsSoABusyMachineCancels) {
    const double unit[] = {1, 10, 2}, twice[] = {2, 20, 4};
    const Spread ratio = ratio_of(twice, unit);
    EXPECT_EQ(ratio.median, 2);
    EXPECT_EQ(ratio.mad, 0);
    EXPECT_EQ(ratio.repeats, 3u);
}

TEST(Implementations, AreDoubtedByTheirErrorByTheirWorstTexelAndWhereNothingCouldBeCompared) {
    Measurement measured = row("transparency/one", .1, 1);
    measured.tolerance = 1e-2;
    measured.tolerated_worst = .1;
    measured.accuracy.model_rmse = 1e-2;
    measured.accuracy.model_worst = .1;
    EXPECT_EQ(implementation_doubt(measured), "");
    measured.accuracy.model_worst = .2;
    EXPECT_THAT(implementation_doubt(measured), HasSubstr("is 2.0e-01 from its own model in one texel, 1.0e-01 is tolerated"));
    measured.accuracy.model_rmse = 2e-2;
    EXPECT_THAT(implementation_doubt(measured), HasSubstr("is 2.0e-02 from its own model, 1.0e-02 is tolerated"));
    measured.accuracy.incomparable = "the result lacks color";
    EXPECT_EQ(implementation_doubt(measured), "cannot be compared: the result lacks color");
    EXPECT_THAT(as_text(Report{.rows = {measured}}), HasSubstr("! one cannot be compared: the result lacks color"));
}

TEST(Percentile, IsTheNearestRank) {
    std::vector<double> values;
    for (int i = 1; i <= 100; ++i) values.push_back(i);
    EXPECT_EQ(percentile(values, 99), 99);
    EXPECT_EQ(percentile(values, 95), 95);
    EXPECT_EQ(percentile(values, 0), 1);
    EXPECT_EQ(percentile({}, 99), 0);
}

TEST(TransparencyJudge, CountsRelativeErrorsOfTheWorstChannel) {
    ReferenceImage truth(100, 1, 1, {.99, .99, .99, 1}), got = truth;
    got.at(0, 0).x += .5;   // relative to .99 + .01
    got.at(1, 0).y -= .05;  // over 2 %, not over 10 %
    const Frame frame;
    std::map<std::string, double> metrics;
    for (const Metric& metric : transparency_judge({{"color", got}}, {{"color", truth}}, {frame, {}}))
        metrics[metric.name] = metric.value;
    EXPECT_DOUBLE_EQ(metrics["over 2 %"], 2);
    EXPECT_DOUBLE_EQ(metrics["over 10 %"], 1);
    EXPECT_NEAR(metrics["P99"], .05, 1e-12);
    EXPECT_EQ(metrics["P95"], 0);
    EXPECT_NEAR(metrics["worst"], .5, 1e-12);
}

TEST(Flicker, IsHowMuchAnErrorChangesNotHowLargeItIs) {
    const ReferenceImage truth(2, 1, 1, glm::dvec4(1)), off(2, 1, 1, glm::dvec4(3));
    Flicker steady, popping;
    for (int i = 0; i < 3; ++i) steady.add_frame(off, truth);
    EXPECT_EQ(steady.mean(), 0);
    popping.add_frame(truth, truth);
    EXPECT_EQ(popping.mean(), 0);
    popping.add_frame(off, truth);  // by 2, then not at all
    popping.add_frame(off, truth);
    EXPECT_DOUBLE_EQ(popping.mean(), 1);
}

TEST(Flicker, WalksATwentiethOfTheWayToWhatIsTransparent) {
    const Frame panes = scenario_frames("three_panes").front();  // at 3, 3.5 and 4 m
    EXPECT_NEAR(*default_dolly(panes), .05 * 3.5, 1e-6);
    EXPECT_FALSE(default_dolly(scenario_frames("empty").front()));
}

/// Three cards of alpha .99 a centimeter apart: turned to one side, another of them is drawn last.
TEST(Flicker, ShowsThatObjectOrderPopsAndIsNothingForWhatIsExact) {
    const auto session = scenario_session("three_cards");
    const ReportRequest wanted{.flicker = Walk{.frames = 7, .dolly = 0, .pan = 9}};
    std::vector<Request> rows(3);
    rows[0].choices = chosen({"transparency/sorted_lists"});
    rows[1].choices = chosen({"transparency/alpha_blend"});
    rows[2].choices = chosen({"transparency/weighted"});
    const std::vector<MeasuredFlicker> flicker = must(measure_flicker(*session, wanted, rows, {}));
    EXPECT_EQ(flicker[0].error, 0);
    EXPECT_GT(flicker[1].error, 1e-3);
    EXPECT_GT(flicker[2].error, 0);
    EXPECT_FALSE(flicker[0].coverage);
}

/// Walked ahead and turned is recorded from there, bit for bit.
TEST(Eye, MovedIsTheSameAsAFrameRecordedFromThere) {
    std::vector<Frame> frames = scenario_frames("smoke_grenade");
    frames.push_back(frames.front());
    View& view = frames.back().view;
    const double turned = .1;
    const glm::dvec3 ahead = glm::transpose(view.to_view) * glm::dvec3(0, 0, 1);
    view.origin += .5 * ahead;
    const glm::dvec3 to_the_right = glm::transpose(view.to_view) * glm::dvec3(std::sin(turned), 0, std::cos(turned));
    const glm::dvec3 up = glm::transpose(view.to_view) * glm::dvec3(0, 1, 0);
    view.to_view = glm::transpose(glm::dmat3(glm::cross(to_the_right, up), up, to_the_right));
    const auto session = must(Session::open(frames, {.validation = true}));
    const Request small{.variant = {.extent_divisor = 4}};
    Request moved = small, recorded = small;
    moved.variant.eye = {.dolly = .5, .pan = turned};
    recorded.variant.frame = 1;
    const HostImage still = must(session->run(small)).images.at("display");
    const HostImage there = must(session->run(moved)).images.at("display");
    EXPECT_EQ(there.texels, must(session->run(recorded)).images.at("display").texels);
    EXPECT_NE(there.texels, still.texels);
    EXPECT_EQ(still.texels, must(session->run(small)).images.at("display").texels) << "the memo must tell the eyes apart";
}

Report report_on(std::string capture, std::vector<Measurement> rows) {
    for (Measurement& row : rows) row.time = Spread{.median = row.stage_ms.median};
    return {.capture_name = std::move(capture), .time_unit = "transparency/one", .rows = std::move(rows)};
}

TEST(Pool, TakesGeometricMeansOfEqualRows) {
    const double halves_and_twice[] = {.5, 2}, with_zero[] = {0, 1e-3};
    EXPECT_DOUBLE_EQ(geometric_mean(halves_and_twice), 1);
    EXPECT_NEAR(geometric_mean(with_zero), 1e-4, 1e-15);  // 0 counts as 1e-5
    Measurement tuned = row("transparency/one", .5, 4);
    tuned.settings = "k=2";
    const Pool pool = pooled(std::vector{report_on("a", {row("transparency/one", .1, 1), tuned}),
                                         report_on("b", {row("transparency/one", .4, 4), tuned})});
    ASSERT_EQ(pool.rows.size(), 2u);
    EXPECT_EQ(pool.captures, 2u);
    EXPECT_EQ(pool.error.name, "rmse");
    EXPECT_NEAR(pool.rows[0].error, .2, 1e-12);
    EXPECT_NEAR(*pool.rows[0].time, 2, 1e-12);
    EXPECT_TRUE(pool.rows[0].on_front);
    EXPECT_EQ(pool.rows[1].settings, "k=2");
    EXPECT_FALSE(pool.rows[1].on_front);
}

TEST(Pool, DoesNotRankWhatHasAnotherTruth) {
    Measurement easier = row("transparency/easier", .01, 1);
    easier.has_other_truth = true;
    const std::vector<Measurement> rows = {easier, row("transparency/one", .4, 4)};
    const Pool pool = pooled(std::vector{report_on("a", rows), report_on("b", rows)});
    EXPECT_EQ(pool.rows[0].technique, "transparency/one");
    EXPECT_TRUE(pool.rows[0].on_front);
    EXPECT_FALSE(pool.rows[1].on_front);
    EXPECT_EQ(best_within(standings(pool), {&Standing::time, 4}), 0u);
}

TEST(Pool, PrefersTheRelativeErrorBecauseFramesDifferInBrightness) {
    Measurement both = row("transparency/one", 3, 1);
    both.accuracy.technique_errors.push_back({"relative rmse", "", .25});
    const Pool pool = pooled(std::vector{report_on("a", {both}), report_on("b", {both})});
    EXPECT_EQ(pool.error.name, "relative rmse");
    EXPECT_DOUBLE_EQ(pool.rows[0].error, .25);
}

/// Off by 1 % of white on one frame and by 17 % on another: neither mean hides the second.
TEST(Pool, TakesTheMeanOfSharesOfWhiteAndNamesTheWorst) {
    const auto off_by = [](double share) {
        Measurement measured = row("transparency/one", 3, 1);
        measured.accuracy.technique_errors.push_back({"relative rmse", "", .5});
        measured.accuracy.technique_errors.push_back({"display rmse", "of white", share, true});
        return measured;
    };
    const Pool pool = pooled(std::vector{report_on("a", {off_by(.01)}), report_on("b", {off_by(.17)})});
    EXPECT_DOUBLE_EQ(pool.rows[0].error, .09);
    EXPECT_DOUBLE_EQ(pool.rows[0].worst_error, .17);
    EXPECT_EQ(pool.rows[0].worst_frame, "b");
    Measurement relative = off_by(.17);
    relative.ranked_by = RankedBy::relative_rmse;
    EXPECT_EQ(ranking_error(relative).name, "relative rmse");
    EXPECT_EQ(ranking_metric(relative).value, .5);
    EXPECT_THAT(as_text(pool), AllOf(HasSubstr("2 captures: mean of errors, geometric mean of times\n"), HasSubstr(" 17   b ")));
}

/// A row off by a share of white over so many pixels.
Measurement off_by_over(std::string technique, double error, double ms, std::size_t pixels) {
    Measurement made = row(std::move(technique), error, ms);
    made.accuracy.technique_errors = made.accuracy.touched = {{"display rmse", "of white", error}};
    made.accuracy.touched_share = .5;
    made.accuracy.footing = Footing{.pixels = pixels};
    return made;
}

Report frame_of(const char* capture, std::size_t frame, std::vector<Measurement> rows) {
    Report report = report_on(capture, std::move(rows));
    report.frame = frame, report.base.variant.frame = frame;
    report.time_unit = "transparency/alpha_blend";
    return report;
}

/// A technique that is good in most frames of a walk and wrong in one is wrong.
TEST(Pool, TakesTheWorstFrameOfACaptureAndTheMeanOverCaptures) {
    const auto rows = [](double alpha, double weighted, std::size_t pixels) {
        return std::vector{off_by_over("transparency/alpha_blend", alpha, 1, pixels),
                           off_by_over("transparency/weighted", weighted, .5, pixels)};
    };
    std::vector<Report> reports = {frame_of("a", 0, rows(.03, .001, 3000)), frame_of("a", 1, rows(.02, .17, 1000)),
                                   frame_of("a", 4, rows(.02, .001, 99))};
    for (Report& report : reports) report.question = {.error = .04, .within = 1};
    const Pool walk = pooled(reports);
    EXPECT_EQ(walk.captures, 1u);
    EXPECT_EQ(walk.frames, 2u);
    EXPECT_EQ(walk.left_out, std::vector<std::string>{"a frame 4"}) << "under 100 pixels";
    EXPECT_EQ(walk.rows[0].technique, "transparency/alpha_blend");
    EXPECT_DOUBLE_EQ(walk.rows[0].error, .03);
    EXPECT_DOUBLE_EQ(walk.rows[1].error, .17);
    EXPECT_EQ(walk.rows[1].worst_frame, "a frame 1");
    EXPECT_DOUBLE_EQ(*walk.rows[1].rms_error, std::sqrt((3000 * .001 * .001 + 1000 * .17 * .17) / 4000));
    EXPECT_EQ(answer_of(walk).recommended, 0u);
    EXPECT_THAT(as_text(walk),
                AllOf(HasSubstr("transparency of 2 frames: the error of the worst frame, geometric mean of times\n"),
                      HasSubstr("fewer than 100 pixels: a frame 4\n"),
                      HasSubstr("answer over 2 frames for display rmse up to 4 % within 1x of alpha_blend: keep "
                                "the baseline alpha_blend (display rmse 3 % on a frame 0, 1.00x, ")));
    reports.push_back(frame_of("b", 0, rows(.01, .01, 1000)));
    reports.back().question = reports.front().question;
    const Pool both = pooled(reports);
    EXPECT_EQ(both.captures, 2u);
    EXPECT_DOUBLE_EQ(both.rows[0].error, (.03 + .01) / 2);
    EXPECT_DOUBLE_EQ(both.rows[1].error, (.17 + .01) / 2);
    EXPECT_THAT(as_text(both), HasSubstr("alpha_blend (display rmse 2 % in the mean, 3 % on a frame 0, 1.00x, "));
    EXPECT_FALSE(is_unanswered(both));
    for (Report& report : reports) report.question = {.error = .001};
    EXPECT_TRUE(is_unanswered(pooled(reports)));
}

TEST(Pool, LimitsInMillisecondsAndBytesAreOfItsWorstFrame) {
    std::vector<Report> reports;
    for (const double ms : {1., 4.}) {
        reports.push_back(frame_of(ms < 2 ? "a" : "b", 0, {off_by_over("transparency/alpha_blend", .01, ms, 1000)}));
        reports.back().rows[0].stage_bytes = std::uint64_t(1000 * ms);
        reports.back().question = {.within_ms = 3.9};
    }
    EXPECT_TRUE(is_unanswered(pooled(reports)));
    for (Report& report : reports) report.question = {.within_ms = 4, .memory = 4000};
    EXPECT_FALSE(is_unanswered(pooled(reports)));
    for (Report& report : reports) report.question = {.memory = 3999};
    EXPECT_TRUE(is_unanswered(pooled(reports)));
    for (Report& report : reports) report.rows[0].accuracy.footing->pixels = 7;
    EXPECT_TRUE(is_unanswered(pooled(reports)));
    EXPECT_THAT(as_text(pooled(reports)), HasSubstr("answer: none; the stage changes fewer than 100 pixels of each frame\n"));
    for (Report& report : reports) report.skipped = "nothing is transparent";
    EXPECT_FALSE(is_unanswered(pooled(reports))) << "no frame needs the stage";
}

TEST(Pool, RanksOnlyWhatCanDoAllCapturesThatNeedTheStage) {
    Measurement cannot{.technique = "transparency/half"};
    cannot.accuracy.not_supported = "chromatic";
    Report skipped = report_on("c", {});
    skipped.skipped = "nothing is transparent";
    const Pool pool = pooled(std::vector{report_on("a", {row("transparency/half", 0, 1), row("transparency/one", .4, 1)}),
                                         report_on("b", {cannot, row("transparency/one", .4, 1)}), skipped});
    EXPECT_EQ(pool.captures, 2u);
    ASSERT_EQ(pool.rows.size(), 2u);
    EXPECT_EQ(pool.rows[0].technique, "transparency/one");
    EXPECT_TRUE(pool.rows[0].on_front);
    EXPECT_EQ(pool.rows[1].frames, 1u);
    EXPECT_FALSE(pool.rows[1].on_front);
    EXPECT_THAT(as_text(pool), HasSubstr("1 of 2"));
}

TEST(Table, FitsATerminalOf120ColumnsHoweverLongTheSettings) {
    Report report = report_on("a", {});
    for (int i = 0; i < 45; ++i) {
        Measurement measured = row("transparency/some_technique", -1.234567e-5 * i, 1234.5, 123456);
        measured.settings = i % 2 == 0 ? "" : "a_long_key=with_its_value another=choice and=more and_more=0.0001";
        for (const char* name : {"bias", "P99", "over 10 %", "more"})
            measured.accuracy.technique_errors.push_back({name, "radiance", -1e-9});
        measured.accuracy.technique_errors.push_back({"a detail", "", 1, true});
        measured.accuracy.flip = .123456;
        measured.flicker = measured.coverage_flicker = 1e-9;
        measured.time = Spread{.median = 123.456, .mad = 10};
        report.rows.push_back(measured);
    }
    report.rows.back().accuracy.not_supported = std::string(300, 'x');
    report.flicker = Walk{.dolly = .2};
    const std::string text = as_text(report);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
    EXPECT_THAT(text, Not(HasSubstr("detail")));
}

/// Every case with the verdict, at the defaults of a technique and at a point.
HardCaseReport hard_cases_of(HardOutcome outcome) {
    HardCaseReport report{.device = {.name = "a device", .driver = "its driver"}};
    for (const char* settings : {"", "one_key=with_its_value another=choice and=more"})
        report.rows.push_back({"transparency/some_technique", settings, std::vector(hard_cases().size(), outcome)});
    return report;
}

TEST(Table, CutsNoNumberHoweverManyColumns) {
    Table table{.heads = std::vector<std::string>(20, "column"),
                .rows = {{.label = "row", .cells = std::vector<std::string>(20, "1.234e-05")}}};
    const std::string text = as_text(table);
    EXPECT_THAT(text, HasSubstr("1.234e-05\n"));
    EXPECT_THAT(text, Not(HasSubstr("...")));
}

TEST(HardCaseTable, FitsATerminalOf120ColumnsAndSaysWhatEachVerdictIs) {
    using Verdict = HardOutcome::Verdict;
    const std::pair<Verdict, const char*> cells[] = {
        {Verdict::holds, " ok "},          {Verdict::not_applicable, " - "},       {Verdict::fails, " -1.2e-05 "},
        {Verdict::documented, "-1.2e-05"}, {Verdict::undocumented, " -1.2e-05! "}, {Verdict::undeserved, " ok? "}};
    for (const auto& [verdict, cell] : cells) {
        const std::string text = as_text(hard_cases_of({.verdict = verdict, .error = -1.234567e-5}));
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
        EXPECT_THAT(text, HasSubstr(cell));
        EXPECT_THAT(text, HasSubstr("some_technique one_key=with_its_value another=choice and=more"));
        for (const HardCase& hard_case : hard_cases()) EXPECT_THAT(text, HasSubstr(std::string(hard_case.name)));
    }
}

TEST(HardCaseJson, HasARowForEachOfTheSettings) {
    const auto json = nlohmann::json::parse(as_json(hard_cases_of({.verdict = HardOutcome::Verdict::fails, .error = .5})));
    ASSERT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["rows"][0]["settings"], "");
    EXPECT_EQ(json["rows"][1]["settings"], "one_key=with_its_value another=choice and=more");
    EXPECT_EQ(json["rows"][1]["cases"].size(), hard_cases().size());
    EXPECT_EQ(json["rows"][1]["cases"][0]["verdict"], "fails");
    EXPECT_EQ(json["rows"][1]["cases"][0]["error"], .5);
}

TEST(Table, NumbersAreShort) {
    EXPECT_EQ(short_number(0), "0");
    EXPECT_EQ(short_number(.0123456), "0.0123");
    EXPECT_EQ(short_number(-1.2345e-5), "-1.2e-05");
    EXPECT_EQ(short_number(1234.5), "1234");
}

}  // namespace
}  // namespace strata
