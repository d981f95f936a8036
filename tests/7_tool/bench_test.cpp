// strata bench: what it measures, what it says of it, and what it refuses.
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "captures/scenarios.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/bench/bench.h"
#include "replay/bench/device_bench.h"
#include "replay/report/variants.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string short_name(const Technique& technique) { return below_stage(technique.name); }

/// A ratio of a technique that states some, to type: `bench NAME --only 'NAME OF RATIO'`.
std::string command_of_one() {
    for (const Technique& technique : techniques())
        if (!technique.claims.ratios.empty())
            return fmt::format("bench {} --only '{}' --repeats 2", short_name(technique), technique.claims.ratios.front().name);
    return "";
}

void expect_every_ratio_measured(const Technique& technique) {
    const Finished made = strata(fmt::format("bench {} --size 48x27 --repeats 2 --json --validation", technique.name));
    ASSERT_EQ(made.code, 0) << made.err;
    const json bench = json::parse(made.out);
    EXPECT_EQ(bench["schema"], "strata.bench");
    EXPECT_EQ(bench["schema_version"], 1);
    EXPECT_EQ(bench["repeats"], 2);
    EXPECT_FALSE(bench["device"]["name"].get<std::string>().empty());
    ASSERT_EQ(bench["rows"].size(), technique.claims.ratios.size());
    for (std::size_t i = 0; i < technique.claims.ratios.size(); ++i) {
        const json& row = bench["rows"][i];
        const TimeRatio& stated = technique.claims.ratios[i];
        if (row.contains("not_measured")) {  // in so small a frame nothing that is to be compared may happen
            ASSERT_FALSE(stated.witness.counter.empty()) << row;
            EXPECT_THAT(row["not_measured"].get<std::string>(), testing::StartsWith(std::string(stated.witness.otherwise)));
            continue;
        }
        EXPECT_EQ(row["technique"], technique.name);
        EXPECT_EQ(row["name"], stated.name);
        EXPECT_EQ(row["scene"], stated.scenario);
        EXPECT_EQ(row["extent"], json({48, 27}));
        EXPECT_EQ(row["ratio"]["repeats"], 2);
        EXPECT_GT(row["ratio"]["low"], 0);
        for (const char* variant : {"of", "against"}) EXPECT_GT(row[variant]["ms"]["median"], 0) << row;
        EXPECT_NE(row["of"], row["against"]);
        EXPECT_EQ(row.contains("published"), stated.published.has_value());
    }
}

TEST(BenchVerb, MeasuresEveryRatioOfTheTechniqueThatStatesTheFewest) {
    const Technique* fewest = nullptr;
    for (const Technique& technique : techniques())
        if (!technique.claims.ratios.empty() && (!fewest || technique.claims.ratios.size() < fewest->claims.ratios.size()))
            fewest = &technique;
    ASSERT_TRUE(fewest);
    expect_every_ratio_measured(*fewest);
}

TEST(ExhaustiveBenchVerb, MeasuresEveryRatioThatATechniqueStates) {
    for (const Technique& technique : techniques())
        if (!technique.claims.ratios.empty()) expect_every_ratio_measured(technique);
}

TEST(BenchVerb, EveryPublishedRatioHasASourceAndEveryCounterIsOneOfEitherWays) {
    for (const Technique& technique : techniques())
        for (const TimeRatio& ratio : technique.claims.ratios) {
            EXPECT_TRUE(!ratio.published || !ratio.source.empty()) << ratio.name;
            EXPECT_TRUE(find_scenario(ratio.scenario)) << ratio.name;
            const auto of = variant_of(technique, ratio.of, {}), against = variant_of(technique, ratio.against, {});
            ASSERT_TRUE(of && against) << ratio.name;
            EXPECT_EQ(ratio.witness.counter.empty(), ratio.witness.otherwise.empty()) << ratio.name;
            EXPECT_TRUE(ratio.witness.counter.empty() || std::ranges::count(ratio.counters, ratio.witness.counter)) << ratio.name;
            for (const std::string_view counter : ratio.counters) {
                const auto has = [&](const Variant& variant) {
                    return std::ranges::count(variant.technique->counters, counter, &Counter::name) > 0;
                };
                EXPECT_TRUE(has(*of) || has(*against)) << ratio.name << " has no counter " << counter;
            }
        }
}

TEST(BenchVerb, RatiosOfFramesInWhichNothingOverflowsAreNoRatios) {
    const std::string command = "bench voxel --only 'noting overflows, against letting' --repeats 1 --json";
    const Finished made = strata(command + " --size 48x27");
    ASSERT_EQ(made.code, 0) << made.err;
    const json row = json::parse(made.out)["rows"][0];
    EXPECT_EQ(row["witness"], "overflowed > 0");
    EXPECT_GT(row["of"]["counters"]["overflowed"], 0);
    ASSERT_EQ(strata("record one_pane -o pane.strata").code, 0);
    EXPECT_THAT(strata("-v bench voxel pane.strata --only 'noting overflows, against letting' --repeats 1"),
                Refuses(2, "bench.same_work", "reason=\"nothing overflowed\""));
    const json rows = json::parse(strata("bench voxel pane.strata --only splat: --repeats 1 --json").out)["rows"];
    EXPECT_EQ(rows[1]["not_measured"], "nothing overflowed: both variants did the same work");
    EXPECT_FALSE(rows[1].contains("ratio"));
    EXPECT_TRUE(rows[3].contains("ratio")) << "into two slices, against one";
}

TEST(BenchVerb, MeasuresAWayInAChangedFrameOfTheScenario) {
    const Finished made = strata("bench lpv --only 'injection: 4 lights' --size 32x18 --repeats 1 --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json row = json::parse(made.out)["rows"][0];
    EXPECT_EQ(row["of"]["frame"], "4 lights");
    EXPECT_EQ(row["against"]["frame"], "1 light");
    EXPECT_GT(row["of"]["counters"]["injected"], row["against"]["counters"]["injected"]);
    EXPECT_GT(row["of"]["stage_bytes"], 0);
    ASSERT_EQ(strata("record two_rooms -o rooms.strata").code, 0);
    EXPECT_THAT(strata("-v bench lpv rooms.strata --only 'injection: 4 lights' --repeats 1"),
                Refuses(2, "bench.needs_scenario", "scenario=hall_of_lights_65"));
}

TEST(BenchVerb, CountsInTheLastRepeatWhichIsTimedAndNotInTheWarmUp) {
    const Finished made = strata("bench lpv --only 'volume kept' --size 32x18 --repeats 1 --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json row = json::parse(made.out)["rows"][0];
    EXPECT_EQ(row["of"]["counters"]["cells relit"], 0) << "light of the warm-up was kept";
    EXPECT_GT(row["against"]["counters"]["cells relit"], 1000);
}

TEST(BenchVerb, TakesACaptureAndWritesTheJsonBesideTheTable) {
    ASSERT_EQ(strata("record one_pane -o pane.strata").code, 0);
    const Finished made = strata(command_of_one() + " -o ratios.json" + " pane.strata");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.out, AllOf(HasSubstr("measured"), HasSubstr("published"), HasSubstr("of pane.strata, 64 x 36, 1 sample"),
                                HasSubstr("2 timed runs of each variant")));
    std::ifstream file(folder() / "ratios.json");
    const json bench = json::parse(file);
    ASSERT_EQ(bench["rows"].size(), 1u);
    EXPECT_EQ(bench["rows"][0]["scene"], "pane.strata");
    EXPECT_EQ(bench["rows"][0]["samples"], 1);
    EXPECT_EQ(json::parse(strata(command_of_one() + " pane.strata --samples 4 --json").out)["rows"][0]["samples"], 4);
}

TEST(BenchVerb, WrongRequestsEndWithASentence) {
    ASSERT_EQ(strata("record opaque_only -o opaque.strata").code, 0);
    std::string stating, silent;
    for (const Technique& technique : techniques())
        if (technique.claims.ratios.empty()) silent = short_name(technique);
        else if (technique.stage == Stage::transparency) stating = short_name(technique);
    const std::string misspelled = stating.substr(0, stating.size() - 1);
    const Refusal wrongs[] = {
        {misspelled, 2, "technique.unknown", "did you mean " + stating},
        {silent, 2, "bench.no_ratios", "technique=" + silent},
        {stating + " --only nothing_like_it", 2, "bench.unknown_ratio", "only=nothing_like_it"},
        {stating + " --size 48by27", 2, "options.malformed", "option=--size value=48by27"},
        {stating + " --repeats 0", 2, "options.out_of_range", "low=1 high=1000 value=0 option=--repeats"},
        {"device --only wrap", 2, "options.not_applicable", "option=--only"},
        {"devise", 2, "technique.unknown", "did you mean device"},
        {stating + " --frame 1", 2, "options.needs", "option=--frame other=capture"},
        {stating + " --size 48x27 --set colr=1", 2, "settings.unknown", "setting=colr"},
        {stating + " nowhere.strata", 3, "file.cannot_open", "file=nowhere.strata"},
        {stating + " opaque.strata --frame 1", 2, "capture.no_frame", "frame=1 frames=1"},
        {stating + " opaque.strata", 2, "stage.not_needed", "stage=transparency"},
    };
    expect_refusals("bench", wrongs);
}

TEST(BenchVerb, HoldsTheHottestStepsAgainstWhatTheDeviceCanDo) {
    ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0);
    const Finished made = strata("bench device panes.strata --repeats 2 --json --validation -o device.json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json bench = json::parse(made.out);
    EXPECT_EQ(bench["schema"], "strata.bench_device");
    EXPECT_EQ(bench["scene"], "panes.strata");
    EXPECT_EQ(bench["repeats"], 2);
    for (const char* limit : {"bytes_per_second", "operations_per_second"}) EXPECT_GT(bench["limits"][limit]["low"], 0) << limit;
    ASSERT_FALSE(bench["steps"].empty());
    EXPECT_LE(bench["steps"].size(), 10u);
    double last = std::numeric_limits<double>::infinity();
    for (const json& step : bench["steps"]) {
        const double ms = step["ms"]["median"].get<double>(), limit = bench["limits"]["bytes_per_second"]["median"].get<double>();
        EXPECT_LE(ms, last) << "the hottest first";
        last = ms;
        EXPECT_NEAR(step["share_of_bytes"].get<double>(), step["declared_bytes"].get<double>() / (ms * 1e-3) / limit, 1e-9)
            << step;
        EXPECT_EQ(step.contains("operations"), step["counted_by"] != "unknown") << step;
    }
    std::ifstream file(folder() / "device.json");
    EXPECT_EQ(json::parse(file)["schema"], "strata.bench_device");
}

TEST(BenchText, OfADeviceFitsATerminalAndSaysWhatIsCounted) {
    DeviceBench bench{.device = {.name = "a device", .driver = "its driver", .software = true},
                      .limits = {.bytes = {.median = 40e9}, .operations = {.median = 30e9}, .copied_bytes = 2000000},
                      .scene = "a capture.strata",
                      .repeats = 7,
                      .frame_ms = 300};
    const std::string name = "transparency/a_technique_of_a_long_name/and_its_step.comp";
    bench.steps.push_back({.name = name,
                           .ms = {.median = 100, .mad = 1},
                           .bytes = 1000000000,
                           .invocations = 1000000,
                           .counted_by = "dispatch",
                           .per_invocation = {.operations = 300, .loops = 2}});
    bench.steps.push_back({.name = name, .ms = {.median = 10}, .bytes = 1000, .counted_by = "unknown"});
    const std::string text = as_text(bench);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
    EXPECT_DOUBLE_EQ(bench.share_of_bytes(bench.steps[0]), .25) << "10 of 40 GB/s";
    EXPECT_DOUBLE_EQ(*bench.share_of_operations(bench.steps[0]), .1) << "3 of 30 billion";
    EXPECT_THAT(text, Not(HasSubstr("stopped")));
    bench.stopped = "stopped after 3 of 7 timed runs";
    EXPECT_THAT(as_text(bench), HasSubstr("\nstopped after 3 of 7 timed runs\n"));
    EXPECT_EQ(json::parse(as_json(bench))["stopped"], bench.stopped);
    EXPECT_THAT(text, AllOf(HasSubstr("a buffer of 1 MB"), HasSubstr("not counted"), HasSubstr("every loop iterated once"),
                            HasSubstr("whole and once")));
}

TEST(BenchText, FitsATerminalOf120ColumnsAndSaysWhatWasNotMeasured) {
    const std::string words =
        "one variant of many words against another of as many, which does not end before the line does, and on";
    const std::string source(300, 'x');
    const TimeRatio ratio{.name = words, .steps = {"a step"}, .published = 1.5, .source = source};
    const Technique technique{.stage = Stage::transparency, .name = "transparency/some_technique"};
    const Claim claim{.technique = &technique, .ratio = &ratio, .scene = words};
    TimedVariant variant{"transparency/some_technique", words, Spread{.median = 1.25, .mad = .25}, {}};
    for (int i = 0; i < 20; ++i) variant.counters.push_back({variant.technique, "some counter", 123456});
    Bench bench{.device = {.name = "a device", .driver = "its driver"}, .repeats = 7};
    bench.rows.push_back(
        {.claim = claim, .width = 320, .height = 180, .of = variant, .against = variant, .ratio = {.median = 2.5}});
    const TimeRatio of_stages{.name = words, .stages = {Stage::gbuffer, Stage::film}};
    bench.rows.push_back(
        {.claim = {.technique = &technique, .ratio = &of_stages, .scene = words}, .not_measured = "the frame does not need it"});
    const std::string text = as_text(bench);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
    EXPECT_THAT(text, AllOf(HasSubstr("2.50 +-0.00"), HasSubstr("1.50"), HasSubstr("some counter 123456"),
                            HasSubstr("not measured: the frame does not need it"), HasSubstr("a step of one variant")));
    const json made = json::parse(as_json(bench));
    EXPECT_EQ(made["rows"][0]["steps"], json({"a step"}));
    EXPECT_EQ(made["rows"][1]["steps"], json({"gbuffer:", "film:"}));
    EXPECT_EQ(made["rows"][0]["published"]["source"], source);
    EXPECT_EQ(made["rows"][1]["not_measured"], "the frame does not need it");
    EXPECT_FALSE(made["rows"][1].contains("ratio"));
}

}  // namespace
}  // namespace strata
