// Every verb: its help, a success, a failure with its sentence and its exit code.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/frame.h"
#include "capture_format/reader.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/file_verbs.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

void record_panes(const std::string& options = "") { ASSERT_EQ(strata("record three_panes -o panes.strata " + options).code, 0); }

TEST(Tool, EveryVerbHasHelpInBothForms) {
    for (const char* verb : verb_names()) {
        const Finished help = strata(std::string("help ") + verb), flag = strata(std::string(verb) + " --help");
        EXPECT_EQ(help.code, 0) << verb;
        EXPECT_EQ(help.out, flag.out) << verb;
        EXPECT_THAT(help.out, AllOf(HasSubstr("--help"), HasSubstr("-v,--verbose"))) << verb;
    }
}

/// Those that print a table: TableOutput.AsCommaSeparatedValuesAndAsJsonIsOfEveryVerbThatPrintsATable.
TEST(Tool, EveryVerbThatPrintsResultsButNoTablePrintsThemAsJsonToo) {
    write_file(folder() / "sound.strata", sound_capture());
    for (const char* command : {"list", "list --scenarios", "--list-gpus", "info sound.strata", "validate sound.strata",
                                "accept sound.strata --dry-run", "graph sound.strata", "spectra sound.strata --modes 3",
                                "replay sound.strata", "diff sound.strata sound.strata"}) {
        const Finished printed = strata(fmt::format("{} --json", command));
        ASSERT_EQ(printed.code, 0) << command << printed.err;
        const json made = json::parse(printed.out);
        EXPECT_THAT(made["schema"].get<std::string>(), HasSubstr("strata.")) << command;
        EXPECT_TRUE(made.contains("schema_version")) << command;
    }
}

TEST(Tool, GpusAreListedAsTextAndAsJson) {
    const std::string text = strata("--list-gpus").out;
    const json listed = json::parse(strata("--list-gpus --json").out);
    EXPECT_EQ(static_cast<std::ptrdiff_t>(listed["gpus"].size()), std::ranges::count(text, '\n'));
    for (const json& gpu : listed["gpus"]) {
        EXPECT_THAT(text, HasSubstr(fmt::format("{}  {}  (", gpu["index"].get<int>(), gpu["name"].get<std::string>())));
        EXPECT_EQ(gpu["can_replay"].get<bool>(), gpu["lacks"].is_null());
    }
    EXPECT_THAT(strata("-v --json"), Refuses(2, "options.needs", "option=--json other=--list-gpus"));
}

TEST(Tool, WithoutAVerbItListsThem) {
    const Finished bare = strata("");
    EXPECT_EQ(bare.code, 0);
    for (const char* verb : verb_names()) EXPECT_THAT(bare.out, HasSubstr(verb));
}

TEST(Tool, AnUnknownVerbOrOptionIsAUsageErrorThatNamesTheNearestAndNothingElse) {
    const Refusal wrongs[] = {
        {"reply", 2, "options.unknown_verb", "verb=reply suggestion=\"; did you mean replay?\""},
        {"help reply", 2, "options.unknown_verb", "verb=reply suggestion=\"; did you mean replay?\""},
        {"help nosuch", 2, "options.unknown_verb", "verb=nosuch suggestion=\"\""},
        {"--list-gpu", 2, "options.unknown", "verb=strata option=--list-gpu suggestion=\"; did you mean --list-gpus?\""},
    };
    expect_refusals("", wrongs);
    for (const std::string verb : verb_names()) {
        const Finished refused = strata(verb + " -v --halp");
        EXPECT_THAT(refused,
                    Refuses(2, "options.unknown",
                            fmt::format("verb=\"strata {}\" option=--halp suggestion=\"; did you mean --help?\"", verb)));
        EXPECT_EQ(std::ranges::count(refused.err, '\n'), 2) << "the sentence and its id: " << refused.err;
        EXPECT_EQ(std::ranges::count(strata(verb + " --halp").err, '\n'), 1) << verb;
    }
}

// The device is the last thing that a reader of a verb's help looks for.
TEST(Tool, TheOptionsOfADeviceStandBehindThoseOfTheVerb) {
    for (const std::string verb : verb_names()) {
        const std::string help = strata("help " + verb).out;
        const std::size_t device = help.find("Device:"), gpu = help.find("--without");
        EXPECT_EQ(device == help.npos, gpu == help.npos) << verb;
        EXPECT_TRUE(device == help.npos || (help.find("Options:") < device && device < gpu)) << help;
    }
}

TEST(List, ShowsEveryTechniqueAndItsParameters) {
    const Finished listed = strata("list --json");
    ASSERT_EQ(listed.code, 0);
    EXPECT_EQ(json::parse(listed.out)["techniques"].size(), techniques().size());
    for (const Technique& technique : techniques()) {
        const Finished one = strata("list " + std::string(technique.name));
        for (const Param& param : technique.params) EXPECT_THAT(one.out, HasSubstr(std::string(param.name)));
    }
    for (const StageInfo& stage : stages())
        EXPECT_THAT(strata("list " + std::string(stage.name)).out,
                    AllOf(StartsWith(stage.name), ContainsRegex("\n  [a-z_]+/[a-z_]+ ")))
            << "every stage is done by some technique";
    EXPECT_EQ(strata("list --stage transparency").out, strata("list transparency").out);
}

/// By name, by technique with its number, and as JSON.
TEST(List, ShowsWhatAScenariosFrameMustContain) {
    EXPECT_THAT(strata("list --scenarios").out,
                AllOf(HasSubstr("witness lighting: tiles over lights > 0\n"), HasSubstr("witness feature fog\n"),
                      HasSubstr("witness edges: edge_samples > 400 at 4 samples\n"),
                      HasSubstr("witness transparency packing=rgb10: overflowed > 10\n")));
    EXPECT_EQ(strata("list --scenarios --names").out.find("witness"), std::string::npos);
    const json listed = json::parse(strata("list --scenarios --json").out);
    for (const json& scenario : listed["scenarios"])
        EXPECT_EQ(scenario["witnesses"].size(), (*find_scenario(scenario["name"].get<std::string>()))->witnesses.size())
            << scenario["name"];
}

/// What --outputs refuses as unknown is not on the lists, and what is on them it takes.
TEST(List, ShowsTheImagesAndViewsThatOutputsTakes) {
    const Finished images = strata("list --images --names"), views = strata("list --views --names");
    EXPECT_EQ(std::size_t(std::ranges::count(images.out, '\n')), frame_images().size());
    EXPECT_THAT(views.out, HasSubstr("\ntransparency/voxel:"));
    const json listed = json::parse(strata("list --views --json").out);
    std::size_t known = 0;
    for (const Technique& technique : techniques()) known += technique.views.size() + technique.tables.size();
    EXPECT_EQ(listed["views"].size(), known);
    for (const json& view : listed["views"]) EXPECT_NE(view["help"], "") << view["name"];
    record_panes();
    std::string all;
    std::istringstream lines(images.out);
    for (std::string line; std::getline(lines, line);)
        if (line != "depth") all += (all.empty() ? "" : ",") + line;  // at 4 samples its layers are asked for
    // Not every image comes into being in this frame, which is exit 2, but each is known.
    EXPECT_THAT(strata("-v replay panes.strata --outputs " + all), Refuses(2, "frame.no_output", "is left out"));
    EXPECT_THAT(strata("-v replay panes.strata --outputs colr"), Refuses(2, "frame.unknown_image", "image=colr"));
    EXPECT_EQ(strata("list --views --images").code, 2);
}

TEST(List, FindsAndShowsWhatTheFieldCallsThem) {
    EXPECT_EQ(strata("list oit").out, strata("list transparency").out);
    EXPECT_EQ(strata("list wboit").out, strata("list transparency/weighted").out);
    EXPECT_THAT(strata("list").out, AllOf(HasSubstr("transparency (oit): "), HasSubstr(" (wboit). ")));
    EXPECT_EQ(json::parse(strata("list wboit --json").out)["techniques"][0]["aliases"], json({"wboit"}));
    record_panes();
    const Finished report = strata("report panes.strata --stage oit --techniques 'wboit weight=w9' --use ao/none --repeats 1");
    EXPECT_EQ(report.code, 0) << report.err;
    EXPECT_THAT(report.out, HasSubstr("weighted weight=w9"));
    EXPECT_EQ(strata("replay panes.strata --use wboit --set avboit:slices=64").code, 2) << "one technique of a stage";
}

TEST(List, AMisspelledTechniqueGetsASuggestion) {
    std::string typed(techniques_of(Stage::transparency).back()->name);
    std::swap(typed[typed.size() - 2], typed[typed.size() - 3]);
    EXPECT_THAT(strata("-v list " + typed),
                Refuses(2, "list.unknown", "did you mean " + std::string(techniques_of(Stage::transparency).back()->name)));
}

TEST(Record, AnUnknownScenarioIsAUsageError) {
    EXPECT_THAT(strata("-v record three_pains -o x.strata"), Refuses(2, "scenario.unknown", "did you mean three_panes"));
    EXPECT_FALSE(std::filesystem::exists(folder() / "x.strata"));
}

TEST(Record, ABudgetThatIsTooSmallIsAUsageErrorThatNamesTheSmallestThatIsEnough) {
    // At 160 x 90 the thumbnail of one pane is larger than its frame. No scenario has a frame larger than its first.
    for (const std::string scenario : {"smoke_grenade --size 16x9 --frames 3", "one_pane --size 160x90"}) {
        const Finished refused = strata(fmt::format("-v record {} -o x.strata --budget 1KiB", scenario));
        EXPECT_THAT(refused, Refuses(2, "record.budget_too_small", "budget=1024 part=")) << scenario;
        EXPECT_THAT(refused.err, testing::ContainsRegex(" part=\"(frame [0-2]|the thumbnail)\" bytes=[0-9]+\n"));
        EXPECT_FALSE(std::filesystem::exists(folder() / "x.strata"));
        const std::uint64_t enough = std::strtoull(refused.err.c_str() + refused.err.find(" bytes=") + 7, nullptr, 10);
        EXPECT_EQ(strata(fmt::format("record {} -o x.strata --budget {}", scenario, enough - 1)).code, 2) << scenario;
        const Finished recorded = strata(fmt::format("record {} -o x.strata --budget {}", scenario, enough));
        EXPECT_EQ(recorded.code, 0) << recorded.err;
        std::filesystem::remove(folder() / "x.strata");
    }
}

TEST(Record, FramesOfAnyShapeHaveASmallThumbnail) {
    for (const char* size : {"4x2000", "2000x4", "320x180"}) {
        const Finished recorded = strata(std::string("record three_panes -o thin.strata --size ") + size);
        ASSERT_EQ(recorded.code, 0) << size << ": " << recorded.err;
        const auto capture = Capture::open(folder() / "thin.strata");
        ASSERT_TRUE(capture) << capture.error().sentence;
        EXPECT_GT(capture->thumbnail().width, 0u) << size << ": " << recorded.err;
        EXPECT_LE(capture->thumbnail().width, 160u) << size;
    }
}

TEST(Info, SaysWhatAFrameCallsForAndWhy) {
    record_panes();
    const json info = json::parse(strata("info panes.strata --json").out);
    EXPECT_EQ(info["schema"], "strata.info");
    EXPECT_TRUE(info["frame"]["features"].contains("transparent"));
    EXPECT_EQ(strata("info nowhere.strata").code, 3);
}

TEST(Replay, WritesExrPngAndJsonAndMakesTheFolder) {
    record_panes();
    const Finished replayed = strata("replay panes.strata -o deep/er --validation");
    ASSERT_EQ(replayed.code, 0) << replayed.err;
    for (const char* file : {"panes.f0000.exr", "panes.f0000.png", "panes.f0000.json"})
        EXPECT_TRUE(std::filesystem::exists(folder() / "deep/er" / file)) << file;
}

std::size_t files_in(const std::filesystem::path& in) {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(in), std::filesystem::directory_iterator()));
}

TEST(Replay, WritesNothingWithoutAFolder) {
    record_panes();
    ASSERT_EQ(strata("replay panes.strata").code, 0);
    EXPECT_EQ(files_in(folder()), 3u);  // the capture and what was printed
}

TEST(Replay, OfAnotherChoiceIntoTheSameFolderWritesOtherFiles) {
    record_panes();
    const char* choices[] = {"",
                             "--use weighted",
                             "--use weighted --set weight=w9",
                             "--set weight=w9 --use transparency/weighted",
                             "--samples 4",
                             "--force rain",
                             "--eye pan=0.1"};
    for (const char* choice : choices) ASSERT_EQ(strata(fmt::format("replay panes.strata -o out {}", choice)).code, 0) << choice;
    EXPECT_EQ(files_in(folder() / "out"), 3 * 6u);  // two of the choices are one
    EXPECT_TRUE(std::filesystem::exists(folder() / "out/panes.f0000.transparency-weighted,weight=w9.png"));
}

TEST(Replay, EqualRunsWriteEqualFiles) {
    record_panes();
    ASSERT_EQ(strata("replay panes.strata -o a").code, 0);
    ASSERT_EQ(strata("replay panes.strata -o b").code, 0);
    EXPECT_EQ(std::system(("cd " + folder().string() + " && cmp a/panes.f0000.exr b/panes.f0000.exr").c_str()), 0);
}

TEST(Replay, RepeatsAreBitIdentical) {
    record_panes();
    const Finished repeated = strata("replay panes.strata --repeats 3 -o out");
    EXPECT_EQ(repeated.code, 0);
    EXPECT_THAT(repeated.err, HasSubstr("bit for bit"));
}

TEST(Replay, SaysWhatViewsShowInNumbers) {
    record_panes();
    for (const Technique* technique : techniques_of(Stage::transparency)) {
        if (technique->tables.empty()) continue;
        std::string outputs;
        for (const DebugView& view : technique->views) outputs += fmt::format(",{}:{}", technique->name, view.name);
        for (const DebugTable& table : technique->tables) outputs += fmt::format(",{}:{}", technique->name, table.name);
        const Finished made =
            strata(fmt::format("replay panes.strata --use {} --outputs '{}' -o out --json", technique->name, outputs.substr(1)));
        ASSERT_EQ(made.code, 0) << made.err;
        const json frame = json::parse(made.out)["frames"][0];
        for (const DebugView& view : technique->views) {
            const json& shown = frame["views"][fmt::format("{}:{}", technique->name, view.name)];
            EXPECT_EQ(shown["unit"], std::string(view.unit)) << view.name;
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_LE(shown["least"][c], shown["mean"][c].get<double>() + 1e-9) << view.name;
                EXPECT_LE(shown["mean"][c], shown["most"][c].get<double>() + 1e-9) << view.name;
            }
        }
        EXPECT_EQ(frame["tables"].size(), technique->tables.size());
    }
}

/// Views of lists draw what they show themselves: the steps that count fragments are left out, and 0 would be a lie.
TEST(Replay, WhatWasLeftOutIsNotCountedInsteadOfZero) {
    record_panes();
    const std::string lists = "transparency/sorted_lists", use = "replay panes.strata --use " + lists;
    const auto frame_of = [](const Finished& replayed) { return json::parse(replayed.out)["frames"][0]; };
    const json whole = frame_of(strata(use + " --json"));
    EXPECT_GT(whole["counters"][lists]["fragments"], 0);
    EXPECT_FALSE(whole.contains("not_counted"));
    const std::string view = " --outputs " + lists + ":layers", until = " --until transparency/lists/count";
    for (const std::string& part : {view, until}) EXPECT_THAT(strata(use + part).out, HasSubstr("not counted: ")) << part;
    const json partly = frame_of(strata(use + until + " --json"));
    EXPECT_FALSE(partly["counters"].contains(lists));
    EXPECT_EQ(partly["not_counted"], json{lists});
    // With its passes a run has every image, so nothing is left out.
    EXPECT_EQ(frame_of(strata(use + view + " --json"))["counters"][lists], whole["counters"][lists]);
}

TEST(Replay, WarnsOfWhatATechniqueCannotDoAndFailsWhereItIsStrict) {
    ASSERT_EQ(strata("record additive_sparks -o sparks.strata --size 32x24").code, 0);
    const std::string weighted = "transparency/weighted", use = "replay sparks.strata --use " + weighted;
    const Finished warned = strata(use + " --json"), strict = strata(use + " --strict -v");
    EXPECT_EQ(warned.code, 0) << warned.err;
    EXPECT_THAT(warned.err, HasSubstr(weighted + " cannot do additive ("));
    EXPECT_THAT(std::string(json::parse(warned.out)["frames"][0]["not_supported"][weighted]), HasSubstr("additive ("));
    EXPECT_THAT(strict, Refuses(1, "replay.not_supported", "technique=" + weighted + " feature=\"additive ("));
    const Finished able = strata("replay sparks.strata --strict --json --use transparency/sorted_lists");
    EXPECT_EQ(able.code, 0) << able.err;
    EXPECT_FALSE(json::parse(able.out)["frames"][0].contains("not_supported"));
}

TEST(Replay, WrongRequestsAreUsageErrorsWithASentence) {
    record_panes();
    for (const char* wrong : {"--frames 9", "--frames a", "--use nothing/here", "--set colr=1", "--outputs pictures",
                              "--until nowhere", "--force rainbows", "--samples 3", "--gpu NoSuchDevice"}) {
        const Finished failed = strata(std::string("replay panes.strata ") + wrong);
        EXPECT_EQ(failed.code, 2) << wrong;
        EXPECT_FALSE(failed.err.empty()) << wrong;
    }
}

TEST(Graph, PrintsThePlanAndWhyStagesAreLeftOut) {
    record_panes();
    const Finished plan = strata("graph panes.strata");
    EXPECT_EQ(plan.code, 0);
    EXPECT_THAT(plan.out, HasSubstr("left out: rain: "));
    EXPECT_THAT(strata("graph panes.strata --dot").out, HasSubstr("digraph"));
}

TEST(Report, AnExactTechniqueStandsInForTheTruthOfALargeFrame) {
    ASSERT_EQ(strata("record three_panes -o large.strata --size 641x360").code, 0);
    const Finished made = strata("report large.strata --repeats 1 --techniques alpha_blend,weighted,moments --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    EXPECT_THAT(report["truth"].get<std::string>(), HasSubstr("stands in"));
    EXPECT_THAT(report["truth"].get<std::string>(), HasSubstr("1/2 extent"));
    for (const json& row : report["rows"]) EXPECT_TRUE(row.contains("technique_error") || row.contains("not_supported")) << row;
}

TEST(ExhaustiveReport, JsonCsvAndTextNameEveryTechniqueOfTheStage) {
    record_panes("--size 48x27");
    const Finished made = strata("report panes.strata --repeats 1 --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    EXPECT_EQ(report["schema"], "strata.report");
    std::size_t rows = 0;
    for (const Technique* technique : techniques_of(Stage::transparency)) rows += 1 + technique->variants.size();
    EXPECT_EQ(report["rows"].size(), rows);
    for (const json& row : report["rows"]) EXPECT_EQ(row["technique_error"].back()["metric"], "FLIP") << row;
    const Finished text = strata("report panes.strata --repeats 1 --sweep pool=2"),
                   csv = strata("report panes.strata --repeats 1 --sweep pool=2 --csv");
    for (const Technique* technique : techniques_of(Stage::transparency)) {
        EXPECT_THAT(text.out, HasSubstr(std::string(technique->name.substr(technique->name.find('/') + 1))));
        EXPECT_THAT(csv.out, HasSubstr(std::string(technique->name)));
    }
    EXPECT_EQ(strata("report panes.strata --stage combine --error-at picture").code, 2);
    EXPECT_EQ(strata("report panes.strata --stage nothing").code, 2);
    EXPECT_EQ(strata("report panes.strata --sweep nothing=1,2").code, 2);
    EXPECT_EQ(strata("report panes.strata --dolly 1").code, 2);
}

TEST(Report, ASweepReplacesThePointsAndTimesAreMultiplesOfTheUnits) {
    record_panes();
    const Finished made = strata("report panes.strata --repeats 3 --sweep form=average,sum --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    std::size_t rows = 0;
    for (const Technique* technique : techniques_of(Stage::transparency))
        rows += std::ranges::count(technique->params, "form", &Param::name) > 0 ? 2 : 1;
    EXPECT_EQ(report["rows"].size(), rows);
    for (const json& row : report["rows"]) {
        EXPECT_EQ(row["time"]["repeats"], 3) << row;
        EXPECT_TRUE(row["technique"] != report["time_unit"] || row["time"]["median"] == 1) << row;
        EXPECT_EQ(row["bytes_per_pixel"], row["stage_bytes"].get<double>() / (64 * 36));
    }
    EXPECT_EQ(report["best_within"].size(), 6u);
}

TEST(Report, AnswersWhichTechniqueKeepsAnErrorAndATime) {
    record_panes();
    const std::string verb =
        "report panes.strata --repeats 3 --techniques 'sorted_lists,weighted weight=w9' --error 1% --within 1000x";
    const Finished made = strata(verb + " --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    EXPECT_EQ(report["rows"].size(), 3u) << "the time unit is measured, too";
    EXPECT_EQ(report["answer"]["error"], .01);
    EXPECT_EQ(report["answer"]["recommended"]["technique"], "transparency/alpha_blend") << "exact here";
    EXPECT_EQ(report["answer"]["nearest"], nullptr);
    for (const char* rows : {"as_cheap", "unsteady"}) EXPECT_TRUE(report["answer"][rows].is_array()) << rows;
    EXPECT_THAT(strata(verb).out, HasSubstr(" up to 1 % within 1000x of alpha_blend: keep the baseline alpha_blend"));
    const Finished defaults = strata("report panes.strata --repeats 1 --defaults --csv");
    EXPECT_EQ(std::size_t(std::ranges::count(defaults.out, '\n')), 1 + techniques_of(Stage::transparency).size());
    for (const char* wrong :
         {"--techniques nothing", "--techniques 'weighted weight=w0'", "--techniques lighting/tiled", "--error nan", "--error 0",
          "--error 2", "--error relative:", "--techniques 'weighted weight=w7 weight=w8'", "--within -2x", "--within 2y",
          "--within 2us", "--memory 0", "--cost cycles", "--cost cycles:nothing", "--cost cycles:h200", "--cost frames",
          "--cost memory", "--defaults --techniques weighted"})
        EXPECT_EQ(strata(std::string("report panes.strata ") + wrong).code, 2) << wrong;
    const Finished open = strata("-v report panes.strata --repeats 1 --techniques weighted --error 1e-9% --within 1000x");
    EXPECT_THAT(open, Refuses(1, "report.no_answer", "capture=panes.strata"));
    EXPECT_THAT(open.out, HasSubstr("no technique keeps both; the nearest, "));
    const json of_radiance =
        json::parse(strata("report panes.strata --repeats 1 --techniques weighted --error relative:90% --json").out);
    EXPECT_EQ(of_radiance["ranked_by"], "relative rmse touched");
    EXPECT_EQ(of_radiance["answer"]["error"], .9);
    const Finished modeled = strata(
        "-v report panes.strata --repeats 1 --techniques weighted --cost cycles:ps4 --within 1e-8ms --memory 64MiB --json");
    EXPECT_THAT(modeled, Refuses(1, "report.no_answer"));
    const json of_ps4 = json::parse(modeled.out);
    for (const json& row : of_ps4["rows"]) EXPECT_GT(row["modeled_kilocycles"], .01) << row;
    EXPECT_EQ(of_ps4["answer"]["cost"], "cycles:ps4");
    EXPECT_EQ(of_ps4["answer"]["within_ms"], 1e-8);
    EXPECT_EQ(of_ps4["answer"]["memory"], 64 * 0x1p20);
}

TEST(Report, OfAFolderIsThatOfItsCaptures) {
    std::filesystem::create_directories(folder() / "golden");
    EXPECT_THAT(strata("-v report golden"), Refuses(3, "report.no_capture_in_folder", "folder=golden"));
    for (const char* name : {"b", "a"})
        ASSERT_EQ(strata(fmt::format("record three_panes -o golden/{}.strata --size 16x9", name)).code, 0);
    std::ofstream(folder() / "golden/notes.txt") << "no capture";
    const json made = json::parse(strata("report golden --techniques weighted --repeats 1 --json").out);
    ASSERT_EQ(made["reports"].size(), 2u);
    EXPECT_EQ(made["reports"][0]["capture_name"], "a.strata");
    EXPECT_EQ(made["reports"][1]["capture_name"], "b.strata");
}

TEST(Report, OfSeveralFramesIsDecidedByTheWorst) {
    ASSERT_EQ(strata("record three_panes -o walk.strata --size 64x36 --frames 3").code, 0);
    const std::string verb = "report walk.strata --techniques weighted --repeats 1 --frames 0,2 --error ";
    const json made = json::parse(strata(verb + "90% --json").out);
    ASSERT_EQ(made["reports"].size(), 2u);
    EXPECT_EQ(made["reports"][1]["frame"], 2);
    EXPECT_EQ(made["pooled"]["captures"], 1);
    EXPECT_EQ(made["pooled"]["frames"], 2);
    EXPECT_EQ(made["pooled"]["answer"]["recommended"]["technique"], "transparency/alpha_blend");
    double worst = 0;
    for (const json& report : made["reports"])
        for (const json& metric : report["rows"][1]["touched_error"])
            if (metric["metric"] == "display rmse") worst = std::max(worst, metric["value"].get<double>());
    EXPECT_EQ(made["pooled"]["rows"][1]["error"], worst);
    EXPECT_THAT(strata("-v " + verb + "1e-9%"), Refuses(1, "report.no_pooled_answer", "frames=\"2 frames\""));
    EXPECT_THAT(strata("-v report walk.strata --frame 3"), Refuses(2, "capture.no_frame"));
}

TEST(Report, FlickerIsNothingForWhatIsExactWhereverTheEyeGoes) {
    record_panes();
    const Finished made = strata("report panes.strata --repeats 1 --sweep pool=2 --flicker 3 --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    EXPECT_EQ(report["flicker"]["frames"], 3);
    EXPECT_GT(report["flicker"]["dolly_meters"], .05);
    double least = 1, most = 0;
    for (const json& row : report["rows"]) {
        least = std::min(least, row["flicker"].get<double>());
        most = std::max(most, row["flicker"].get<double>());
    }
    EXPECT_EQ(least, 0);
    EXPECT_GT(most, 1e-4);
}

/// Of a line of comma-separated values; a quoted field may hold commas.
std::size_t fields(std::string_view line) {
    std::size_t count = 1;
    bool quoted = false;
    for (const char c : line) {
        quoted = quoted != (c == '"');
        count += c == ',' && !quoted;
    }
    return count;
}

TEST(Report, OfSeveralCapturesIsEachOnesAndAPooledOne) {
    record_panes("--size 48x27");
    ASSERT_EQ(strata("record red_and_green_glass -o glass.strata --size 48x27").code, 0);
    const std::string both = "report panes.strata glass.strata --repeats 1 --techniques alpha_blend,weighted,moments";
    const Finished made = strata(both + " --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json reports = json::parse(made.out);
    EXPECT_EQ(reports["schema"], "strata.reports");
    ASSERT_EQ(reports["reports"].size(), 2u);
    EXPECT_EQ(reports["reports"][1]["capture_name"], "glass.strata");
    EXPECT_EQ(reports["pooled"]["captures"], 2);
    EXPECT_EQ(reports["pooled"]["error"], "display rmse");
    EXPECT_EQ(reports["pooled"]["rows"].size(), reports["reports"][0]["rows"].size());
    EXPECT_THAT(strata(both).out, HasSubstr("of 2 captures"));
    std::istringstream csv(strata(both + " --csv").out);
    std::string head;
    std::getline(csv, head);
    std::size_t pooled = 0;
    for (std::string line; std::getline(csv, line);) {
        EXPECT_EQ(fields(line), fields(head)) << line;
        pooled += line.starts_with("\"pooled\",");
    }
    EXPECT_EQ(pooled, reports["pooled"]["rows"].size());
}

TEST(Probe, ListsThePixelsFragmentsAndWritesWhatEveryTechniqueLetsThrough) {
    record_panes();
    const Finished made = strata("probe panes.strata --at 32,18 --depths 64 -o deep/er --validation");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("pixel (32, 18), sample 0: 3 fragments"));
    std::ifstream file(folder() / "deep/er.json");
    const json probe = json::parse(file);
    EXPECT_EQ(probe["schema"], "strata.probe");
    EXPECT_EQ(probe["fragments"].size(), 3u);
    EXPECT_EQ(probe["depths"].size(), 64u);
    EXPECT_EQ(probe["curves"].size(), techniques_of(Stage::transparency).size());
    for (const char* written : {"deep/er.csv", "deep/er.svg"}) EXPECT_GT(std::filesystem::file_size(folder() / written), 1000u);
    for (const Technique* technique : techniques_of(Stage::transparency))
        EXPECT_THAT(made.out, HasSubstr(std::string(technique->name)));
}

TEST(Probe, WrongRequestsAreUsageErrorsWithASentence) {
    record_panes();
    const std::string technique(techniques_of(Stage::transparency).front()->name);
    const Refusal wrongs[] = {
        {"--at 64,0", 2, "frame.no_pixel", "x=64 y=0"},
        {"--at 0,0", 2, "probe.no_fragment", "x=0 y=0 nearest_x="},
        {"--at 32", 2, "options.malformed", "option=--at value=32"},
        {"--at 32,18 --sample 1", 2, "frame.no_sample", "sample=1 samples=1"},
        {"--at 32,18 --frame 1", 2, "capture.no_frame", "frame=1 frames=1"},
        {"--at 32,18 --techniques " + technique.substr(0, technique.size() - 1), 2, "technique.unknown", "did you mean"},
        {"--at 32,18 --techniques '" + technique + " nothing=1'", 2, "settings.unknown", "setting=nothing"},
        {"--at 32,18 --depths 1", 2, "options.out_of_range", "low=2 high=8192 value=1 option=--depths"},
        {"--at 32,18 --from 9", 2, "probe.empty_range", "from=9"},
        {"--at 32,18 --axis square", 2, "options.not_a_choice", "value=square"},
    };
    expect_refusals("probe panes.strata", wrongs);
}

TEST(Import, AnAnimationBecomesFrames) {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({0, 1}, "SCALAR", 1);
    gltf.floats({0, 0, 0, 1, 0, 0}, "VEC3", 3);
    std::ofstream(folder() / "moving.gltf") << gltf.text(showing(triangle, R"(,"animations":[{"name":"slide","samplers":[
        {"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])"));
    const Finished imported = strata("import moving.gltf --frames 3 --fps 4 --size 32x18");
    ASSERT_EQ(imported.code, 0) << imported.err;
    EXPECT_THAT(imported.err, HasSubstr("imported 3 frames, 1 draw"));
    EXPECT_EQ(json::parse(strata("info moving.strata --json").out)["frames"], 3);
    for (const char* wrong : {"--animation fly", "--fps 0", "--frames 0"}) {
        EXPECT_EQ(strata(std::string("import moving.gltf ") + wrong).code, 2) << wrong;
    }
}

}  // namespace
}  // namespace strata
