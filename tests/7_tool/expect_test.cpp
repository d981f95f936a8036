// Expectations through the tool: accepted once, met ever after, and every way not to meet them with its exit code.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/expectations/expectation_keys.h"
#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

void record_panes() { ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0); }

std::string bytes_of_panes() { return file_text(folder() / "panes.strata"); }

/// As if the capture had been accepted by a program that gave other bits for one image; `more` are further keys.
void expect_otherwise(const std::string& pass, const std::string& image, const json& more = json::object()) {
    const Capture capture = must(Capture::open(folder() / "panes.strata"));
    json expectation = json::parse(capture.expectations().back());
    for (json& of_pass : expectation[expectation_keys(expectation_version).passes])
        for (json& of_image : of_pass["images"])
            if (of_pass[expectation_keys(expectation_version).pass] == pass && of_image["name"] == image)
                of_image["hash"] = std::string(32, '0');
    expectation.update(more);
    must(append_expectation(folder() / "panes.strata", expectation.dump()));
}

json newest_expectation(const std::string& file) {
    return json::parse(must(Capture::open(folder() / file)).expectations().back());
}

/// panes.strata as golden.strata, and panes.strata recorded again.
void record_panes_again() {
    record_panes();
    std::filesystem::rename(folder() / "panes.strata", folder() / "golden.strata");
    record_panes();
}

std::string bytes_of_golden() { return file_text(folder() / "golden.strata"); }

TEST(Accept, ShowsWhatIsNewThenReplayMeetsIt) {
    record_panes();
    const Finished accepted = strata("accept panes.strata");
    ASSERT_EQ(accepted.code, 0) << accepted.err;
    EXPECT_THAT(accepted.out, HasSubstr("new      transparency"));
    EXPECT_THAT(accepted.out, HasSubstr("stored expected results of 1 frame in panes.strata"));
    const Finished replayed = strata("replay panes.strata --json");
    EXPECT_EQ(replayed.code, 0);
    EXPECT_THAT(replayed.err, HasSubstr("bit for bit as expected"));
    EXPECT_EQ(json::parse(replayed.out)["frames"][0]["expectation"]["agreement"], "exact");
}

TEST(Accept, ProcessesAtOnceOnOneCaptureLoseNothing) {
    record_panes();
    const auto all = techniques_of(Stage::transparency);
    std::vector<pid_t> running;
    for (std::size_t i = 0; i < 3; ++i)
        running.push_back(start(STRATA_BINARY_DIR "/strata", "accept panes.strata --use " + std::string(all[i]->name)));
    for (const pid_t process : running) EXPECT_EQ(code_of(process), 0);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(strata("replay panes.strata --expect --use " + std::string(all[i]->name)).code, 0) << all[i]->name;
}

TEST(Accept, OfImagesMakesSectionsThatTheToolKnowsItself) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata --with-images").code, 0);
    const Finished sound = strata("validate panes.strata");
    EXPECT_EQ(sound.code, 0);
    EXPECT_EQ(sound.err, "");
}

TEST(Validate, RefusesAnExpectationThatIsNoJson) {
    record_panes();
    must(append_expectation(folder() / "panes.strata", "display 1234"));
    EXPECT_THAT(strata("-v validate panes.strata"), Refuses(3, "expectation.cannot_read", "capture=panes.strata"));
}

TEST(Validate, RefusesAChangedHeaderOfASection) {
    record_panes();
    std::string bytes = bytes_of_panes();
    bytes[16 + 8] ^= 1;  // version of the first section, which the directory repeats
    std::ofstream(folder() / "panes.strata", std::ios::binary) << bytes;
    EXPECT_THAT(strata("-v validate panes.strata"), Refuses(3, "capture.section.header"));
}

TEST(Validate, SaysInJsonWhatIsWrong) {
    record_panes();
    const nlohmann::json sound = nlohmann::json::parse(strata("validate panes.strata --json").out);
    EXPECT_EQ(sound["is_sound"], true);
    EXPECT_FALSE(sound.contains("error"));
    std::string bytes = bytes_of_panes();
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(folder() / "panes.strata", std::ios::binary) << bytes;
    const Finished refused = strata("validate panes.strata --json");
    EXPECT_EQ(refused.code, 3);
    const nlohmann::json problem = nlohmann::json::parse(refused.out);
    EXPECT_EQ(problem["schema"], "strata.validate");
    EXPECT_EQ(problem["is_sound"], false);
    EXPECT_EQ("strata: " + problem["error"]["sentence"].get<std::string>() + "\n", refused.err);
}

TEST(Validate, SaysInJsonThatAFileCannotBeOpened) {
    for (const char* file : {"nowhere.strata", ".", "'two\nlines'"}) {
        const Finished refused = strata(fmt::format("validate {} --json", file));
        EXPECT_EQ(refused.code, 3) << file;
        const nlohmann::json problem = nlohmann::json::parse(refused.out);
        EXPECT_EQ(problem["is_sound"], false) << file;
        EXPECT_THAT(refused.err, testing::HasSubstr("strata: " + problem["error"]["sentence"].get<std::string>())) << file;
        EXPECT_EQ(strata(fmt::format("validate {}", file)).out, "") << file;
    }
}

TEST(Accept, WritesNothingWhenNothingChanged) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    const std::string before = bytes_of_panes();
    const Finished again = strata("accept panes.strata");
    EXPECT_EQ(again.code, 0);
    EXPECT_THAT(again.out, HasSubstr("nothing changed"));
    EXPECT_THAT(again.out, Not(HasSubstr("new ")));
    EXPECT_EQ(bytes_of_panes(), before);
}

TEST(Accept, ADryRunShowsAndWritesNothing) {
    record_panes();
    const std::string before = bytes_of_panes();
    const Finished shown = strata("accept panes.strata --dry-run");
    EXPECT_EQ(shown.code, 0);
    EXPECT_THAT(shown.out, HasSubstr("would be stored anew"));
    EXPECT_EQ(bytes_of_panes(), before);
}

TEST(Accept, ShowsTheFiguresOfWhatChanged) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata --with-images").code, 0);
    expect_otherwise("transparency", "color");
    const Finished accepted = strata("accept panes.strata");
    EXPECT_EQ(accepted.code, 0);
    EXPECT_THAT(accepted.out, HasSubstr("changed  transparency: 'color' differs in 0 of "));
    EXPECT_THAT(accepted.out, HasSubstr("same     gbuffer"));
    EXPECT_EQ(strata("replay panes.strata").code, 0);
}

TEST(Accept, AlsoKeepsTheResultsAcceptedBefore) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    expect_otherwise("transparency", "color");
    ASSERT_EQ(strata("replay panes.strata").code, 1);
    const Finished accepted = strata("accept panes.strata --also");
    EXPECT_THAT(accepted.out, HasSubstr("changed  transparency: 'color' has hash"));
    EXPECT_EQ(newest_expectation("panes.strata")["also"], true);
    EXPECT_EQ(strata("replay panes.strata").code, 0);
    EXPECT_THAT(strata("accept panes.strata --also").out, HasSubstr("nothing changed"));
}

TEST(Accept, ReplacesAllResultsAcceptedBefore) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    expect_otherwise("transparency", "color", {{"also", true}});
    const Finished accepted = strata("accept panes.strata");
    EXPECT_THAT(accepted.out, HasSubstr(", replaces 2 accepted results\n"));
    EXPECT_THAT(accepted.out, Not(HasSubstr("changed  ")));
    EXPECT_FALSE(newest_expectation("panes.strata").contains("also"));
    const Finished again = strata("accept panes.strata --json");
    EXPECT_EQ(json::parse(again.out)["frames"][0]["accepted_results"], 1);
    EXPECT_EQ(json::parse(again.out)["accepted_frames"], 0);
}

TEST(Accept, ToAnotherCaptureStoresWhatThisOneGives) {
    record_panes_again();
    const std::string before = bytes_of_golden(), panes = bytes_of_panes();
    EXPECT_THAT(strata("accept panes.strata --to golden.strata --dry-run").out, HasSubstr("golden.strata is not changed"));
    EXPECT_EQ(bytes_of_golden(), before);
    const Finished accepted = strata("accept panes.strata --to golden.strata --with-images");
    EXPECT_THAT(accepted.out, HasSubstr("new      transparency"));
    EXPECT_THAT(accepted.out, HasSubstr("stored expected results of 1 frame in golden.strata, images kept"));
    EXPECT_EQ(bytes_of_panes(), panes);
    EXPECT_EQ(strata("replay golden.strata --expect").code, 0);
    EXPECT_THAT(strata("accept panes.strata --to golden.strata").out, HasSubstr("nothing changed in golden.strata"));
}

TEST(Accept, ToAnotherCaptureShowsWhatDiffersFromItsResults) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    expect_otherwise("transparency", "color");
    std::filesystem::rename(folder() / "panes.strata", folder() / "golden.strata");
    record_panes();
    const Finished accepted = strata("accept panes.strata --to golden.strata --also");
    EXPECT_THAT(accepted.out, HasSubstr("same     gbuffer"));
    EXPECT_THAT(accepted.out, HasSubstr("changed  transparency: 'color' has hash"));
    EXPECT_EQ(newest_expectation("golden.strata")["also"], true);
}

TEST(Accept, ToOneCaptureByProcessesAtOnceLosesNothing) {
    record_panes_again();
    const auto all = techniques_of(Stage::transparency);
    std::vector<pid_t> running;
    for (std::size_t i = 0; i < 2; ++i)
        running.push_back(
            start(STRATA_BINARY_DIR "/strata", "accept panes.strata --to golden.strata --use " + std::string(all[i]->name)));
    for (const pid_t process : running) EXPECT_EQ(code_of(process), 0);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(strata("replay golden.strata --expect --use " + std::string(all[i]->name)).code, 0) << all[i]->name;
}

/// Both verbs refuse it, and leave the other capture as it is.
TEST(Expect, AnotherCaptureThatDoesNotFitIsRefusedInWords) {
    record_panes_again();
    ASSERT_EQ(strata("record three_panes --size 32x18 -o small.strata").code, 0);
    Recorder recorder = must(Recorder::create(folder() / "two.strata"));
    for (int i = 0; i < 2; ++i) must(recorder.record(must(must(Capture::open(folder() / "panes.strata")).frame(0))));
    must(recorder.finish());
    std::ofstream(folder() / "text.strata") << "no capture";
    const std::string before = bytes_of_golden();
    for (const std::string verb : {"-v accept --to ", "-v replay --expect-from "}) {
        SCOPED_TRACE(verb);
        EXPECT_THAT(strata(verb + "nowhere.strata panes.strata"), Refuses(3, "file.cannot_open", "file=nowhere.strata"));
        EXPECT_THAT(strata(verb + "text.strata panes.strata"), Refuses(3, "capture.not_a_capture", "file=text.strata"));
        EXPECT_THAT(strata(verb + "golden.strata two.strata"),
                    Refuses(2, "expect.no_frame", "file=golden.strata frame=1 frames=1"));
        EXPECT_THAT(strata(verb + "golden.strata small.strata"), Refuses(2, "expect.other_size", "frame=0 width=32 height=18"));
    }
    EXPECT_EQ(bytes_of_golden(), before);
    EXPECT_EQ(strata("accept two.strata --frames 0 --to golden.strata").code, 0);
    EXPECT_EQ(strata("replay two.strata --frames 0 --expect-from golden.strata").code, 0);
}

TEST(Accept, KeepsImagesLaterWhenAskedTo) {
    for (const std::string with_images : {"accept panes.strata --with-images", "accept panes.strata --also --with-images"}) {
        SCOPED_TRACE(with_images);
        record_panes();
        ASSERT_EQ(strata("accept panes.strata").code, 0);
        EXPECT_THAT(strata(with_images).out, HasSubstr("images kept"));
        EXPECT_THAT(strata(with_images).out, HasSubstr("nothing changed"));
    }
}

TEST(Accept, OfACaptureThatCannotBeReplacedIsAnErrorAndLeavesIt) {
    record_panes();
    EXPECT_EQ(strata("accept nowhere.strata").code, 3);
    EXPECT_EQ(strata("accept panes.strata --frames 7").code, 2);
    EXPECT_EQ(strata("accept panes.strata --use nothing/here").code, 2);
}

TEST(Expect, ADivergenceIsExitOneAndNamesTheFirstPass) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    expect_otherwise("transparency", "color");
    const Finished diverged = strata("-v replay panes.strata --json");
    EXPECT_THAT(diverged, Refuses(1, "replay.diverges", "divergence=\"transparency: 'color'"));
    EXPECT_EQ(json::parse(diverged.out)["error"]["id"], "replay.diverges");
    const json verdict = json::parse(diverged.out)["frames"][0]["expectation"];
    EXPECT_EQ(verdict["agreement"], "diverges");
    EXPECT_EQ(verdict["first_divergence"]["pass"], "transparency");
    EXPECT_EQ(strata("replay panes.strata --no-expect").code, 0);
}

TEST(Expect, AToleranceIsMetWithKeptImages) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata --with-images").code, 0);
    expect_otherwise("transparency", "color");  // another hash, the same image
    EXPECT_EQ(strata("replay panes.strata").code, 1);
    const Finished tolerated = strata("replay panes.strata --tolerance 0.001");
    EXPECT_EQ(tolerated.code, 0);
    EXPECT_THAT(tolerated.err, HasSubstr("within tolerance"));
}

TEST(Expect, ADivergenceSaysOfHowManyAcceptedResults) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    expect_otherwise("transparency", "color", {{"also", true}});
    EXPECT_EQ(strata("replay panes.strata").code, 0);
    expect_otherwise("transparency", "color", {{"also", false}});
    expect_otherwise("transparency", "color", {{"also", true}});
    const Finished diverged = strata("replay panes.strata --json");
    EXPECT_EQ(diverged.code, 1);
    EXPECT_THAT(diverged.err, HasSubstr(", the newest of 2 accepted results"));
    EXPECT_EQ(json::parse(diverged.out)["frames"][0]["expectation"]["first_divergence"]["accepted_results"], 2);
}

TEST(Expect, AnAcceptedResultWithAMalformedKeyIsExitThree) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    expect_otherwise("transparency", "color", {{"also", "yes"}});
    for (const char* verb : {"replay", "accept", "validate"})
        EXPECT_THAT(strata(fmt::format("-v {} panes.strata", verb)), Refuses(3, "expectation.cannot_read")) << verb;
}

TEST(Expect, ACaptureRecordedAgainFindsTheResultsOfAnother) {
    record_panes_again();
    const std::string replay = "-v replay panes.strata --expect-from golden.strata";
    const std::string command = "accept 'panes.strata' --frames 0 --to 'golden.strata'";
    EXPECT_THAT(strata(replay), Refuses(6, "replay.no_expectation", "command=\"strata " + command));
    ASSERT_EQ(strata("accept golden.strata --with-images").code, 0);
    EXPECT_EQ(strata("replay panes.strata --expect").code, 6);
    EXPECT_THAT(strata(replay).err, HasSubstr("bit for bit as expected"));
    std::filesystem::rename(folder() / "golden.strata", folder() / "panes.strata");
    expect_otherwise("transparency", "color");
    std::filesystem::rename(folder() / "panes.strata", folder() / "golden.strata");
    record_panes();
    EXPECT_THAT(strata(replay), Refuses(1, "replay.diverges", "divergence=\"transparency: 'color' differs in 0 of"));
    EXPECT_THAT(strata(replay + " --tolerance 0.001").err, HasSubstr("within tolerance"));
    EXPECT_THAT(strata(replay + " --no-expect"), Refuses(2, "options.not_applicable", "option=--no-expect"));
}

TEST(Expect, OtherChoicesAreExitSixWithTheCommandThatAcceptsThem) {
    record_panes();
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    const std::string other = " --use " + std::string(techniques_of(Stage::transparency)[1]->name);
    const Finished missing = strata("-v replay panes.strata" + other);
    EXPECT_THAT(strata("replay panes.strata --json" + other).err, HasSubstr("\"transparency\":{\"color\":\""));
    const std::string command = "accept 'panes.strata' --frames 0" + other;
    EXPECT_THAT(missing, Refuses(6, "replay.no_expectation", "command=\"strata " + command));
    ASSERT_EQ(strata(command).code, 0);
    EXPECT_EQ(strata("replay panes.strata" + other).code, 0);
    EXPECT_EQ(strata("replay panes.strata").code, 0);
}

TEST(Expect, ACaptureWithoutExpectationsReplaysUnlessTheyAreDemanded) {
    record_panes();
    EXPECT_EQ(strata("replay panes.strata").code, 0);
    EXPECT_EQ(strata("replay panes.strata --expect").code, 6);
    EXPECT_EQ(strata("replay panes.strata --tolerance 1").code, 6);
    EXPECT_EQ(strata("replay panes.strata --expect --no-expect").code, 2);
}

TEST(Expect, ExpectationsThatWereCutOffAreMissing) {
    record_panes();
    const auto recorded = std::filesystem::file_size(folder() / "panes.strata");
    ASSERT_EQ(strata("accept panes.strata").code, 0);
    std::filesystem::resize_file(folder() / "panes.strata", recorded + 100);  // within the expectation, which stands behind
    const Finished cut = strata("replay panes.strata --allow-partial --tolerance 1");
    EXPECT_EQ(cut.code, 6);
    EXPECT_THAT(cut.err, HasSubstr("what follows is left out"));
}

TEST(Expect, AnExpectationThatIsNoneIsExitThree) {
    record_panes();
    must(append_expectation(folder() / "panes.strata", "display 1234"));
    EXPECT_EQ(strata("replay panes.strata").code, 3);
    EXPECT_EQ(strata("replay panes.strata --no-expect").code, 0);
}

TEST(MemoryBudget, IsGivenWithItsUnitAndRefusedWithNumbers) {
    record_panes();
    const Finished kept = strata("replay panes.strata --json --memory-budget 256MiB");
    ASSERT_EQ(kept.code, 0) << kept.err;
    const json memory = json::parse(kept.out)["frames"][0]["memory"];
    EXPECT_LE(memory["device_peak_bytes"], 256 << 20);
    EXPECT_GT(memory["stages"]["gbuffer"]["peak_bytes"], 0);
    EXPECT_GT(memory["host_peak_bytes"], 0);
    EXPECT_THAT(strata("-v report panes.strata --memory-budget 64KiB"), Refuses(4, "memory.budget", "budget=\"0.1 MiB\""));
}

TEST(ReplayJson, NamesStepsByIndexAndHashesEveryPass) {
    record_panes();
    const Finished replayed = strata("replay panes.strata --json --time 3");
    ASSERT_EQ(replayed.code, 0) << replayed.err;
    const json frame = json::parse(replayed.out)["frames"][0];
    EXPECT_EQ(frame["steps"][1]["index"], 1);
    for (const json& step : frame["steps"]) EXPECT_TRUE(step["gpu_ms"].contains("mad")) << step;
    ASSERT_GE(frame["passes"].size(), 3u);
    for (const json& pass : frame["passes"])
        for (const auto& [image, hash] : pass["hash"].items()) EXPECT_EQ(hash.get<std::string>().size(), 32u) << image;
}

}  // namespace
}  // namespace strata
