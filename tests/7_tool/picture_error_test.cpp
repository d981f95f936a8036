// Errors of the picture that later stages make of a technique's outputs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/stages.h"
#include "replay/report/picture_error.h"
#include "replay/report/report.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The truth takes the place of the stage's outputs: what is exact differs from it by float rounding, if at all.
TEST(PictureErrors, AreThoseThatLaterStagesLeave) {
    const auto session = scenario_session("interpenetrating_panes");
    ReportRequest wanted{.error_at = ErrorAt::picture, .techniques = {"sorted_lists", "alpha_blend"}, .repeats = 1};
    const Report report = must(make_report(*session, wanted));
    ASSERT_EQ(report.rows.size(), 2u);
    EXPECT_EQ(report.rows[0].technique, "transparency/sorted_lists");
    const std::vector<Metric>& exact = report.rows[0].accuracy.technique_errors;
    EXPECT_EQ(exact.front().name, "display rmse");
    for (const Metric& metric : exact) EXPECT_LT(metric.value, 1e-3) << metric.name;
    EXPECT_GT(report.rows[1].accuracy.technique_errors.front().value, .01);
    EXPECT_GT(*report.rows[1].accuracy.flip, .01);
    EXPECT_GT(report.rows[1].accuracy.touched.front().value, report.rows[1].accuracy.technique_errors.front().value);
    EXPECT_LT(report.rows[1].accuracy.touched_share, 1);
    EXPECT_EQ(nlohmann::json::parse(as_json(report))["error_at"], "picture");
    wanted.stage = Stage::combine;
    wanted.techniques = {};
    EXPECT_THAT(make_report(*session, wanted), FailsWith("report.stage_makes_picture", Field("stage", "combine")));
}

/// A stage without light is judged by what its errors do to the picture, and says its own figures beside.
TEST(PictureErrors, RankStagesThatMakeNoLight) {
    const auto session = scenario_session("materials");
    const Report surfaces = must(make_report(*session, {.stage = Stage::gbuffer, .techniques = {"compact"}, .repeats = 1}));
    EXPECT_EQ(surfaces.error_at, ErrorAt::picture);
    EXPECT_EQ(ranking_metric(surfaces.rows.at(0)).name, display_rmse);
    EXPECT_EQ(surfaces.rows.at(0).accuracy.stage_errors.front().name, "normal angle rms");
    EXPECT_EQ(nlohmann::json::parse(as_json(surfaces))["rows"][0]["stage_error"][0]["metric"], "normal angle rms");
    EXPECT_THAT(as_csv(surfaces), HasSubstr(",gbuffer normal angle rms,"));
    const ReportRequest asked{.error_at = ErrorAt::stage, .stage = Stage::gbuffer, .techniques = {"compact"}, .repeats = 1};
    const Report of_stage = must(make_report(*session, asked));
    EXPECT_EQ(of_stage.error_at, ErrorAt::stage);
    EXPECT_EQ(ranking_metric(of_stage.rows.at(0)).value, surfaces.rows.at(0).accuracy.stage_errors.front().value);

    const Report draws = must(make_report(*session, {.stage = Stage::culling, .techniques = {"frustum"}, .repeats = 1}));
    EXPECT_EQ(draws.error_at, ErrorAt::stage);
    EXPECT_THAT(as_text(draws), HasSubstr("\nerrors are of the stage, not of the picture: no image can take the place of what "
                                          "culling gives: later stages read buffers of culling/frustum\n"));
    for (const Stage stage : {Stage::lighting, Stage::combine}) {
        const Report light = must(make_report(*session, {.stage = stage, .defaults_only = true, .repeats = 1}));
        EXPECT_EQ(light.error_at, ErrorAt::stage) << info(stage).name;
        EXPECT_EQ(light.no_picture, "");
    }
}

/// A shadow that is missing is an error where the truth is dark, as in the picture without the lights that cast shadows: touched
/// are all pixels that these lights reach.
TEST(PictureErrors, OfShadowsAreOverAllPixelsThatTheirLightsReach) {
    std::vector<Frame> frames = scenario_frames("sun_and_boxes");
    frames[0].view.width = 96, frames[0].view.height = 54;
    frames.resize(3, frames.front());
    frames[1].sun.shadow.casts = false;
    frames[2].sun.irradiance = glm::vec3(0);
    for (const Frame& frame : frames) ASSERT_TRUE(frame.lights.empty());
    const auto session = session_of(std::move(frames));
    std::vector<ReferenceImage> pictures;
    for (const std::size_t frame : {1u, 2u}) {
        Request request{.outputs = {"display"}};
        request.variant.frame = frame;
        pictures.push_back(in_double(must(session->run(request)).images.at("display")));
    }
    std::size_t reached = 0;
    for (std::size_t i = 0; i < pictures[0].texels.size(); ++i) reached += pictures[0].texels[i] != pictures[1].texels[i];
    const Report report = must(make_report(*session, {.stage = Stage::shadows, .techniques = {"pcf"}, .repeats = 1}));
    EXPECT_NEAR(report.rows.at(0).accuracy.touched_share, double(reached) / double(pictures[0].texels.size()), 1e-9);
}

/// The picture with every pixel shaded once, and with every sample shaded: edges can change what differs between them.
TEST(PictureErrors, OfEdgesAreOverThePixelsThatShadingPerSampleChanges) {
    std::vector<Frame> frames = scenario_frames("corners");
    frames[0].view.width = 64, frames[0].view.height = 36, frames[0].view.samples = 4;
    const auto session = session_of(std::move(frames));
    Request request{.outputs = {"edges", "display"}};
    request.choices = chosen({"edges/all_samples"});
    const auto every_sample = must(session->run(request));
    const ReferenceImage marked = in_double(every_sample.images.at("edges"));
    const ReferenceImage none(marked.width, marked.height, marked.layers);
    const ReferenceImage a = in_double(every_sample.images.at("display")),
                         b = in_double(must(session->run_from(request, Stage::edges, {{"edges", none}})).images.at("display"));
    std::size_t changed = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) changed += a.texels[i] != b.texels[i];
    const Report report = must(make_report(*session, {.stage = Stage::edges, .techniques = {"tolerant"}, .repeats = 1}));
    EXPECT_GT(changed, 0u);
    EXPECT_EQ(report.rows.at(0).accuracy.touched_share, double(changed) / double(a.texels.size()));
}

/// Silhouettes between pixels show one side or the other: that is no error, so the page does not point there.
TEST(PictureErrors, TheWorstPixelIsNoneThatRoundingDecides) {
    std::vector<Frame> frames = scenario_frames("courtyard");
    frames[0].view.width = 240, frames[0].view.height = 135;
    const auto session = session_of(std::move(frames));
    const ImageSet truth = must(session->truth({}, Stage::gbuffer));
    const ReferenceImage display = must(picture_truth(*session, {}, Stage::gbuffer, truth)).display;
    ASSERT_GT(std::ranges::count(display.undecided, true), 0);
    const ReportRequest wanted{.stage = Stage::gbuffer, .techniques = {"wide"}, .repeats = 1, .wants_pictures = true};
    const Report report = must(make_report(*session, wanted));
    const RowPicture& picture = report.rows.at(0).picture.value();
    EXPECT_GT(picture.worst_off, 0);
    EXPECT_LT(picture.worst_off, .02);
    EXPECT_FALSE(display.undecided[display.index(picture.worst_x, picture.worst_y)]);
}

/// A stop while pictures are made loses no row.
TEST(Report, KeepsItsRowsWhenItIsStoppedAtThePictures) {
    const auto session = scenario_session("three_panes");
    std::stop_source source;
    session->stop_when(source.get_token());
    const ReportRequest wanted{.techniques = {"weighted", "alpha_blend"},
                               .repeats = 1,
                               .wants_pictures = true,
                               .on_row = [&](const Measurement&, std::size_t place, std::size_t of) {
                                   if (place == of) source.request_stop();
                               }};
    const Report report = must(make_report(*session, wanted));
    ASSERT_EQ(report.rows.size(), 2u);
    EXPECT_TRUE(report.rows[1].is_measured());
    EXPECT_EQ(report.stopped, "stopped before all pictures were made");
}

/// The smoke's errors in the picture: a pixel that rounding may have otherwise is judged.
TEST(PictureErrors, CountPixelsThatRoundingDecidesWithWhatItAllows) {
    std::vector<Frame> frames = scenario_frames("smoke_grenade");
    frames[0].view.width = 64, frames[0].view.height = 36;
    const auto session = session_of(std::move(frames));
    ReportRequest request{.techniques = {"alpha_blend"}, .repeats = 1};
    const Report of_stage = must(make_report(*session, request));
    request.error_at = ErrorAt::picture;
    const Report of_picture = must(make_report(*session, request));
    for (const Report* report : {&of_stage, &of_picture}) {
        const Accuracy& accuracy = report->rows.at(0).accuracy;
        EXPECT_GT(accuracy.undecided_share, 0);
        EXPECT_EQ(accuracy.unjudged_share, 0);
        ASSERT_TRUE(accuracy.undecided_bound);
        EXPECT_EQ(accuracy.undecided_bound->name, report == &of_stage ? "relative rmse" : "display rmse");
        EXPECT_LT(accuracy.undecided_bound->value, .01);
        EXPECT_THAT(as_text(*report), HasSubstr("their error is the distance to what it allows, which hides at most"));
        EXPECT_THAT(as_text(*report), Not(HasSubstr("left out of the errors")));
    }
}

TEST(PictureErrors, OfPixelsThatRoundingLeavesOpenAreNotZeros) {
    const auto session = scenario_session("three_panes");
    ReferenceImage display(64, 36);
    display.undecided.assign(display.texels.size(), true);
    Accuracy accuracy{.technique_errors = {{"rmse", "radiance", 0}}, .flip = 0};
    ASSERT_TRUE(judge_picture(*session, {}, {.display = display, .touched = display}, accuracy));
    EXPECT_THAT(accuracy.not_supported, HasSubstr("no pixel can be judged: rounding decides"));
    EXPECT_TRUE(accuracy.technique_errors.empty());
    EXPECT_FALSE(accuracy.flip);
}

}  // namespace
}  // namespace strata
