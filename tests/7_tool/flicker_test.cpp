// Flicker of a report's rows while the eye walks: of covered area, and against the truth that each row approximates.
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"
#include "captures/cards.h"
#include "replay/report/flicker.h"
#include "tests/support/session.h"

namespace strata::flicker {
namespace {

TEST(CoverageFlicker, CountsThePixelsThatHaveMasksBeforeOrAfterAndNoSamplesThatChangePlaces) {
    using Pixels = std::vector<gbuffer::PixelCoverage>;
    CoverageFlicker flicker;
    flicker.add_frame(Pixels{{.got = .25, .wanted = .5}, {}, {.got = 1, .wanted = 1}, {}});
    EXPECT_EQ(flicker.mean(), 0);
    flicker.add_frame(Pixels{{.got = .25, .wanted = .5}, {}, {.got = .5, .wanted = .75}, {.got = .5}});
    EXPECT_DOUBLE_EQ(flicker.mean(), (0 + .25 + .5) / 3) << "the second pixel has no mask in either frame";
}

/// A striped card, seen at four samples from the side and a little more from the side.
Frame striped_card() {
    const std::vector<Card> cards{{.center = {0, 0, 3}, .half = 2, .tilt = .3, .alpha_mode = AlphaMode::mask}};
    Frame frame = frame_of_cards(cards, 32);
    frame.view.samples = 4;
    Texture& stripes = frame.textures.emplace_back(Texture{.width = 2, .height = 1, .mips = 1});
    for (const int value : {255, 255, 255, 255, 255, 255, 255, 0}) stripes.texels.push_back(std::byte(value));
    for (const glm::vec3& corner : frame.meshes[0].positions) frame.meshes[0].uv0.push_back(8.f * glm::vec2(corner));
    frame.materials[0].base_color_texture.texture = 0;
    return frame;
}

TEST(CoverageFlicker, IsLessForAlphaTestedAtEverySampleThanForOneTestPerPixel) {
    const auto session = session_of({striped_card()});
    const ReportRequest wanted{.stage = Stage::gbuffer, .flicker = Walk{.frames = 4, .dolly = .1, .pan = 2}};
    std::vector<Request> rows(2);
    rows[0].choices = chosen({"gbuffer/octahedral"}, {"masked=clip"});
    rows[1].choices = chosen({"gbuffer/octahedral"}, {"masked=per_sample"});
    const std::vector<MeasuredFlicker> flicker = must(measure_flicker(*session, wanted, rows, {}));
    ASSERT_TRUE(flicker[0].coverage && flicker[1].coverage);
    EXPECT_GT(*flicker[1].coverage, 0) << "four samples are not the area";
    EXPECT_LT(*flicker[1].coverage, .7 * *flicker[0].coverage);
}

TEST(RowFlicker, IsOfTheTruthThatTheRowApproximatesWhateverRowsStandBeside) {
    const auto session = scenario_session("corners", 4);
    const FrameVariant small{.extent_divisor = 4};
    const ReportRequest wanted{.base = {.variant = small}, .stage = Stage::occlusion, .flicker = Walk{.frames = 2, .dolly = .2}};
    std::vector<Request> rows(2, Request{.variant = small});
    rows[0].choices = chosen({"occlusion/ssao"});
    rows[1].choices = chosen({"occlusion/ssao"}, {"ao_radius=1m"});
    const std::vector<MeasuredFlicker> both = must(measure_flicker(*session, wanted, rows, {}));
    EXPECT_GT(both[1].error, 0);
    EXPECT_EQ(both[1].error, must(measure_flicker(*session, wanted, std::span(rows).subspan(1), {})).front().error);
}

}  // namespace
}  // namespace strata::flicker
