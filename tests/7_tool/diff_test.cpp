// strata diff: what it says of captures, settings and images that are and are not the same.
#include <array>
#include <fstream>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/7_tool/process.h"
#include "tests/support/deep_exr.h"
#include "tests/support/file_text.h"
#include "tests/support/second_device.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Diff : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0); }
    static std::string contents(const std::string& name) { return file_text(folder() / name); }
    static bool exists(const std::string& name) { return std::filesystem::exists(folder() / name); }
};

/// The verdict on an image of a pass.
std::string verdict_of(const json& frame, const std::string& pass, const std::string& image) {
    for (const json& row : frame["passes"])
        for (const json& candidate : row["images"])
            if (row["pass"] == pass && candidate["image"] == image) return candidate["verdict"];
    return "absent";
}

TEST_F(Diff, OfACaptureAndItselfIsExitZero) {
    const Finished same = strata("diff panes.strata panes.strata");
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_THAT(same.out, HasSubstr("\nsame: 0 of "));
}

TEST_F(Diff, OfTwoTechniquesNamesTheStageAndWhatStayedTheSame) {
    const Finished other = strata("-v diff panes.strata --use transparency/weighted --json");
    EXPECT_THAT(other, Refuses(1, "diff.over_tolerance", "frame=0 pass=transparency image=color"));
    const json diff = json::parse(other.out), frame = diff["frames"][0];
    EXPECT_EQ(frame["first_difference"]["pass"], "transparency");
    EXPECT_EQ(verdict_of(frame, "combine", "color"), "same");
    EXPECT_EQ(verdict_of(frame, "transparency", "color"), "over");
    EXPECT_EQ(diff["rerun"], "strata diff panes.strata --use transparency/weighted --json");
}

/// The one image of a pass, as `rows` of JSON have it.
json only_image(const Finished& made, const std::string& pass) {
    const json diff = json::parse(made.out);
    for (const json& row : diff["frames"][0]["passes"])
        if (row["pass"] == pass && row.contains("images") && row["images"].size() == 1) return row["images"][0];
    return {};
}

// Sorted lists are exact but for rounding, and the truth never runs on a device.
TEST_F(Diff, WithATruthIsThatWithAnExactTechniqueAtTheStageAndAtThePicture) {
    const std::string weighted = "diff panes.strata --use transparency/weighted --json ";
    const std::string with_exact = weighted + "--use-a transparency/sorted_lists --images ";
    const auto expect_equal = [](const json& truth, const json& exact) {
        EXPECT_EQ(truth["verdict"], "over");
        for (const char* figure : {"rmse", "relative_rmse", "worst", "share_over_limit"})
            EXPECT_NEAR(truth["error"][figure].get<double>(), exact["error"][figure].get<double>(), 1e-5) << figure;
        EXPECT_GT(truth["error"]["rmse"], 1e-3);
        EXPECT_NEAR(truth["flip"]["mean"].get<double>(), exact["flip"]["mean"].get<double>(), 1e-4);
        EXPECT_NEAR(truth["error"]["worst_pixel"]["a"].get<double>(), exact["error"]["worst_pixel"]["a"].get<double>(), 1e-5);
    };
    const std::string limit = " --limit 1e-5";
    const Finished at_stage = strata(weighted + "--error-at stage" + limit),
                   at_picture = strata(weighted + "--error-at picture" + limit);
    EXPECT_EQ(at_stage.code, 1) << at_stage.err;
    expect_equal(only_image(at_stage, "transparency"), only_image(strata(with_exact + "color" + limit), "transparency"));
    expect_equal(only_image(at_picture, "transparency"), only_image(strata(with_exact + "display" + limit), "combine at film"));
    EXPECT_EQ(strata("diff panes.strata --use transparency/sorted_lists --error-at picture --limit 1e-3").code, 0);
}

TEST_F(Diff, WithATruthHasTheErrorOfTheReport) {
    for (const std::string at : {"stage", "picture"}) {
        const json report =
            json::parse(strata("report panes.strata --techniques weighted --error-at " + at + " --repeats 1 --json").out);
        double error = 0;
        for (const json& row : report["rows"])
            if (row["technique"] == "transparency/weighted") error = row["ranking_error"];
        const Finished diff = strata("diff panes.strata --use transparency/weighted --error-at " + at);
        EXPECT_THAT(diff.out, HasSubstr(fmt::format("as a report has it: display rmse {:.3g} % of white over the ", 100 * error)))
            << at;
    }
}

TEST_F(Diff, WithATruthIsOfOneReplayAndOneStage) {
    ASSERT_EQ(strata("replay panes.strata -o out").code, 0);
    const std::string weighted = "panes.strata --use transparency/weighted ";
    const std::array<Refusal, 11> refusals = {
        {{"panes.strata --error-at picture", 2, "diff.choose_stage", "at=picture stages=none"},
         {"panes.strata --stage extinction --error-at stage", 2, "stage.no_technique", "stage=extinction"},
         {"panes.strata --stage extinction --error-at picture", 2, "stage.no_technique", "stage=extinction"},
         {"panes.strata --stage culling --error-at stage", 2, "diff.stage_makes_no_light", "stage=culling"},
         {weighted + "--error-at picture --flip-limit .1 --percent 1", 2, "options.not_applicable", "option=--percent"},
         {weighted + "--use gbuffer/compact --error-at stage", 2, "diff.choose_stage", "at=stage stages=2"},
         {"panes.strata panes.strata --stage transparency --error-at stage", 2, "options.not_applicable", "option=B"},
         {weighted + "--use-a transparency/moments --error-at stage", 2, "options.not_applicable", "option=--use-a"},
         {"panes.strata --stage lens --error-at stage", 2, "stage.not_needed", "stage=lens"},
         {"panes.strata --stage combine --error-at picture", 2, "report.stage_makes_picture", "stage=combine"},
         {"out/panes.f0000.exr --stage lens --error-at stage", 2, "diff.no_truth_of_image", "file=out/panes.f0000.exr"}}};
    expect_refusals("diff", refusals);
}

TEST_F(Diff, OfTwoDevicesOpensBothAndSaysWhichTheyAre) {
    const Finished same = strata("diff panes.strata --gpu-a 0 --gpu-b llvmpipe --json");
    EXPECT_EQ(same.code, 0) << same.err;
    const json diff = json::parse(same.out);
    EXPECT_THAT(diff["b"]["device"]["name"].get<std::string>(), HasSubstr("llvmpipe"));
    EXPECT_EQ(diff["a"]["device"], diff["b"]["device"]);
    EXPECT_THAT(strata("-v diff panes.strata --gpu-b no_such_device"), Refuses(2, "device.unknown", "device=no_such_device"));
    const Finished lacking = strata("diff panes.strata --use transparency/weighted --memory-budget 1KiB");
    EXPECT_EQ(lacking.code, 4) << lacking.err;
}

TEST_F(Diff, OfTwoIndependentDevicesNamesBothAndTheFirstPassThatDiverges) {
    if (second_driver().empty()) GTEST_SKIP() << no_second_driver;
    const std::string both = "export VK_ADD_DRIVER_FILES=" + second_driver();
    const std::string devices = fmt::format("--gpu-a llvmpipe --gpu-b {}", second_gpu());
    const Finished other = strata_after(both, "diff panes.strata --json " + devices);
    EXPECT_EQ(other.code, 1) << other.err;
    const json diff = json::parse(other.out), frame = diff["frames"][0];
    EXPECT_THAT(diff["a"]["device"]["name"].get<std::string>(), HasSubstr("llvmpipe"));
    EXPECT_THAT(diff["b"]["device"]["name"].get<std::string>(), HasSubstr(second_gpu()));
    EXPECT_FALSE(frame["first_difference"].is_null());
    // Two roundings of the same arithmetic: nothing that an eye sees.
    EXPECT_EQ(strata_after(both, "diff panes.strata --limit 0.05 " + devices).code, 0);
    EXPECT_EQ(strata_after(both, "replay panes.strata --repeats 2 --gpu " + second_gpu()).code, 0);
    const Finished chromatic = strata_after(both, "record red_and_green_glass --size 16x9 -o glass.strata");
    ASSERT_EQ(chromatic.code, 0) << chromatic.err;
    const Finished refused = strata_after(both, "replay glass.strata --use alpha_blend --gpu " + second_gpu());
    EXPECT_EQ(refused.code, 4);
    EXPECT_THAT(refused.err, HasSubstr("dual_source_blending"));
}

TEST_F(Diff, FindsTheStepThatDiffersFirst) {
    ASSERT_EQ(strata("record three_panes --seed 1 -o a.strata").code, 0);
    ASSERT_EQ(strata("record red_and_green_glass --size 64x36 -o b.strata").code, 0);
    const Finished other = strata("diff a.strata b.strata --json");
    ASSERT_EQ(other.code, 1) << other.err;
    const json first = json::parse(other.out)["frames"][0]["first_difference"];
    EXPECT_THAT(first["step"].get<std::string>(), HasSubstr("step ")) << first;
}

TEST_F(Diff, ToleranceTurnsADifferenceIntoASuccess) {
    EXPECT_EQ(strata("diff panes.strata --use transparency/weighted --limit 0.2").code, 0);
    EXPECT_EQ(strata("diff panes.strata --use transparency/weighted --limit 0.2 --hard-limit 0.01").code, 1);
    EXPECT_EQ(strata("diff panes.strata --use transparency/weighted --flip-limit 0.2").code, 0);
    EXPECT_EQ(strata("diff panes.strata --use-a transparency/weighted --use-b transparency/weighted").code, 2);
    EXPECT_EQ(strata("diff panes.strata panes.strata --use-a transparency/weighted --use-b transparency/weighted").code, 0);
}

TEST_F(Diff, OfAnotherGbufferLayoutComparesWhatItHoldsAndNotItsBits) {
    const Finished other = strata("diff panes.strata --use gbuffer/packed --limit 0.01 --json");
    EXPECT_EQ(other.code, 0) << other.err;
    const json frame = json::parse(other.out)["frames"][0];
    EXPECT_EQ(verdict_of(frame, "gbuffer", "gbuffer0"), "not compared");
    EXPECT_NE(verdict_of(frame, "gbuffer", "surface_normal"), "not compared");
}

TEST_F(Diff, OfACaptureAndItsOwnReplaysImagesIsExitZero) {
    ASSERT_EQ(strata("replay panes.strata -o out").code, 0);
    const Finished same = strata("diff panes.strata out/panes.f0000.exr");
    EXPECT_EQ(same.code, 0) << same.err;
    EXPECT_EQ(strata("diff panes.strata out/panes.f0000.exr --use-a transparency/weighted").code, 1);
    EXPECT_EQ(strata("diff out/panes.f0000.exr out/panes.f0000.exr").code, 0);
    EXPECT_EQ(strata("diff out/panes.f0000.png out/panes.f0000.png").code, 0);
    EXPECT_EQ(strata("diff out/panes.f0000.png out/panes.f0000.exr").code, 2);
}

TEST_F(Diff, IsRelativeToAWhicheverSideIsReplayed) {
    ASSERT_EQ(strata("replay panes.strata -o out").code, 0);
    const auto error_of = [](const std::string& command) {
        const json made = json::parse(strata(command).out);
        EXPECT_EQ(made["reference"], "a");
        for (const json& image : made["frames"][0]["passes"][0]["images"])
            if (image["image"] == "color") return image["error"];
        return json();
    };
    const json replay_first = error_of("diff panes.strata out/panes.f0000.exr --use-a weighted --json"),
               image_first = error_of("diff out/panes.f0000.exr panes.strata --use weighted --json");
    EXPECT_EQ(replay_first["rmse"], image_first["rmse"]);
    EXPECT_NE(replay_first["relative_rmse"], image_first["relative_rmse"]);
    EXPECT_EQ(replay_first["worst_pixel"]["a"], image_first["worst_pixel"]["b"]);
    EXPECT_THAT(strata("diff out/panes.f0000.exr panes.strata").out, HasSubstr("relative errors are relative to A"));
    EXPECT_THAT(strata("-v diff out/panes.f0000.exr panes.strata --use-a weighted"),
                Refuses(2, "options.not_applicable", "option=--use-a reason=\"A is an image"));
}

TEST_F(Diff, OfTwoSizesIsExitTwoWithBothShapes) {
    ASSERT_EQ(strata("record three_panes --size 65x36 -o wider.strata").code, 0);
    const Finished refused = strata("-v diff panes.strata wider.strata");
    EXPECT_THAT(refused, Refuses(2, "image.shapes_differ", "a=\"64 x 36"));
    EXPECT_THAT(refused, Refuses(2, "image.shapes_differ", "b=\"65 x 36"));
}

TEST_F(Diff, WritesPicturesAndJunitAndRemovesPicturesThatNoLongerHold) {
    const std::string picture = "out/panes.f0000.transparency.color.diff.png";
    ASSERT_EQ(strata("diff panes.strata --use transparency/weighted -o out --junit out/diff.xml").code, 1);
    EXPECT_TRUE(exists(picture));
    EXPECT_THAT(contents("out/diff.xml"), HasSubstr(picture));
    EXPECT_THAT(contents("out/diff.xml"), HasSubstr("<failure"));
    ASSERT_EQ(strata("diff panes.strata panes.strata -o out --junit out/diff.xml").code, 0);
    EXPECT_FALSE(exists(picture));
    EXPECT_THAT(contents("out/diff.xml"), Not(HasSubstr("<failure")));
}

TEST_F(Diff, OfOneImageIsRefusedAndSoAreLimitsOnWhatImagesDoNotHold) {
    ASSERT_EQ(strata("replay panes.strata -o out").code, 0);
    const std::string png = "out/panes.f0000.png", two = png + " " + png + " ";
    for (const std::string of_b :
         {"", " --use weighted", " --use nonsense", " --set weight=w9", " --use-a weighted", " --gpu-b 0"})
        expect_refusals("diff", std::array{Refusal{png + of_b, 2, "diff.nothing_to_compare", "file=" + png}});
    const Refusal refusals[] = {{two + "--ulps 3", 2, "options.not_applicable", "option=--ulps"},
                                {two + "--tone-mapper hable", 2, "options.not_applicable", "option=--tone-mapper"},
                                {two + "--exposures 1,2", 2, "options.not_applicable", "option=--exposures"},
                                {two + "--exposures 2,1", 2, "options.malformed", "value=2,1 option=--exposures"}};
    expect_refusals("diff", refusals);
    EXPECT_EQ(strata("diff " + two + "--ppd 40").code, 0);
    EXPECT_EQ(strata("diff out/panes.f0000.exr out/panes.f0000.exr --ulps 3 --tone-mapper hable").code, 0);
    EXPECT_EQ(strata("diff panes.strata --gpu-a 0 --gpu-b 0").code, 0);  // a device may be compared with itself
}

TEST_F(Diff, OfImagesAtTwoPlacesOfTheirPicturesIsExitTwoWithBothWindows) {
    std::ofstream(folder() / "a.exr", std::ios::binary) << flat_file(4, 2);
    std::ofstream(folder() / "b.exr", std::ios::binary) << flat_file(4, 2, {3, 1});
    EXPECT_THAT(strata("-v diff a.exr b.exr"),
                Refuses(2, "image.windows_differ", "a=\"(0, 0) to (3, 1)\" b=\"(3, 1) to (6, 2)\""));
    EXPECT_EQ(strata("diff b.exr b.exr").code, 0);
}

TEST_F(Diff, OfAPngThatEndsTooEarlySaysSo) {
    ASSERT_EQ(strata("replay panes.strata -o out").code, 0);
    const std::string whole = contents("out/panes.f0000.png");
    std::ofstream(folder() / "cut.png", std::ios::binary) << whole.substr(0, whole.size() / 2);
    EXPECT_THAT(strata("-v diff cut.png out/panes.f0000.png"), Refuses(3, "image.cannot_read", "file=cut.png"));
}

TEST_F(Diff, WhatCannotBeComparedIsASentence) {
    ASSERT_EQ(strata("record three_panes --frames 2 -o two.strata").code, 0);
    ASSERT_EQ(strata("replay panes.strata -o out").code, 0);
    for (const char* wrong :
         {"panes.strata", "panes.strata two.strata", "panes.strata panes.strata --frames 1", "two.strata out/panes.f0000.exr",
          "out/panes.f0000.png panes.strata", "panes.strata out/panes.f0000.png", "panes.strata --use no/such",
          "panes.strata panes.strata --limit -1"}) {
        const Finished failed = strata(std::string("diff ") + wrong);
        EXPECT_EQ(failed.code, 2) << wrong;
        EXPECT_FALSE(failed.err.empty()) << wrong;
    }
    std::ofstream(folder() / "broken.png") << "no picture";
    for (const char* broken : {"panes.strata nowhere.strata", "panes.strata nowhere.exr", "broken.png broken.png"})
        EXPECT_EQ(strata(std::string("diff ") + broken).code, 3) << broken;
}

}  // namespace
}  // namespace strata
