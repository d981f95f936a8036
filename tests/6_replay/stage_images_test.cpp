// Images as a stage leaves them, where a later one draws over them: what rows, truths that stand in and pictures are made of. A
// lens that blooms draws over the color of transparency, rain over the surfaces of a G-buffer.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/reference/difference.h"
#include "replay/report/flicker.h"
#include "replay/report/report.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// Three panes as they are, and behind a lens that blooms much.
std::vector<Frame> plain_and_blooming(std::uint32_t width, std::uint32_t height) {
    std::vector<Frame> frames(2, scenario_frames("three_panes").front());
    for (Frame& frame : frames) frame.view.width = width, frame.view.height = height;
    frames[1].lens.bloom = .4f, frames[1].lens.bloom_threshold = .1f;
    return frames;
}

TEST(StageImages, AreAsTheStageLeavesThemAndOutputsAreThoseOfTheFramesEnd) {
    const auto session = session_of(plain_and_blooming(64, 36));
    const Request plain{.variant = {.frame = 0}, .outputs = {"color"}}, blooming{.variant = {.frame = 1}, .outputs = {"color"}};
    const ReferenceImage wanted = in_double(must(session->run(plain)).images.at("color"));
    for (int turn = 0; turn < 2; ++turn)  // the second meets what the first left in the memo
        EXPECT_EQ(must(session->stage_images(blooming, Stage::transparency)).at("color").texels, wanted.texels);
    EXPECT_GT(difference(in_double(must(session->run(blooming)).images.at("color")), wanted).relative, .05);
    EXPECT_THAT(session->stage_images(plain, Stage::lens), FailsWith("stage.not_needed", Field("stage", "lens")));
}

TEST(StageImages, OfAStandInAreTheTruthOfALargeFrameBehindALens) {
    const auto session = session_of(plain_and_blooming(700, 330));
    const Report report =
        must(make_report(*session, {.base = {.variant = {.frame = 1}}, .techniques = {"sorted_lists"}, .repeats = 1}));
    ASSERT_THAT(report.truths.front().is, testing::HasSubstr("stands in"));
    for (const Measurement& row : report.rows)
        if (row.technique == "transparency/sorted_lists") {
            EXPECT_LT(ranking_metric(row).value, 1e-6);
        }
}

TEST(StageImages, AreWhatRowsOfAPageShowBesideTheTruth) {
    const auto session = session_of(plain_and_blooming(64, 36));
    const Report report = must(make_report(
        *session,
        {.base = {.variant = {.frame = 1}}, .techniques = {"sorted_lists", "weighted"}, .repeats = 1, .wants_pictures = true}));
    for (const Measurement& row : report.rows) {
        if (row.technique == "transparency/sorted_lists") {
            EXPECT_LT(row.picture->worst_off, 1e-4);
        }
        if (row.technique == "transparency/weighted") {
            EXPECT_GT(row.picture->worst_off, .01);
        }
    }
}

// Surfaces in rain are wet: darker, with other normals than the G-buffer's own.
TEST(StageImages, FlickerAgainstTheTruthOfTheirOwnStage) {
    const auto session = session_of(scenario_frames("roof_in_rain"));
    const ReportRequest wanted{.stage = Stage::gbuffer, .flicker = Walk{.frames = 3, .dolly = .05}};
    const std::vector<Request> rows{{.choices = chosen({"gbuffer/octahedral"})}};
    EXPECT_LT(must(measure_flicker(*session, wanted, rows, {})).front().error, 2e-3);
}

}  // namespace
}  // namespace strata
