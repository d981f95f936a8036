// A stage's outputs replaced by given images: what later stages make of a truth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/stages.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// What the own pass of a stage gave, in double.
ImageSet outputs_of(Session& session, const Request& request, Stage stage) {
    ImageSet outputs;
    for (const PassImages& pass : must(session.pass_images(request)))
        if (pass.stage == stage && pass.at == stage)
            for (const auto& [name, image] : pass.images) outputs.emplace(name, in_double(image));
    return outputs;
}

/// The way there and back loses no bit: halves and floats fit into the floats that are uploaded.
TEST(GivenOutputs, OfAStageItselfAreThePictureOfThePlainReplay) {
    Session& session = session_of_scenarios();
    for (const std::uint32_t samples : {1u, 4u}) {
        const Request request = on_scenario("glass_and_smoke", samples);
        const auto plain = must(session.run(request));
        for (const Stage stage : {Stage::transparency, Stage::lighting}) {
            const ImageSet outputs = outputs_of(session, request, stage);
            ASSERT_FALSE(outputs.empty());
            const auto given = must(session.run_from(request, stage, outputs));
            EXPECT_EQ(given.images.at("display").texels, plain.images.at("display").texels) << name(stage) << " at " << samples;
        }
    }
}

/// A G-buffer without its layout's codes: its surfaces are given as floats, and make the picture that the layout makes.
TEST(GivenOutputs, OfAGBufferAreItsDecodedSurfaces) {
    Session& session = session_of_scenarios();
    for (const char* technique : {"gbuffer/octahedral", "gbuffer/wide", "gbuffer/compact"}) {
        Request request = on_scenario("sixteen_normals", 4);
        request.choices = chosen({technique});
        const ReferenceImage plain = in_double(must(session.run(request)).images.at("display"));
        Request decoded = request;
        decoded.outputs = {"surface_normal", "surface_color", "surface_material", "emission", "depth_layers"};
        ImageSet surfaces;
        for (const auto& [name, image] : must(session.run(decoded)).images) surfaces.emplace(name, in_double(image));
        const ReferenceImage given = in_double(must(session.run_from(request, Stage::gbuffer, surfaces)).images.at("display"));
        double worst = 0;
        for (std::size_t i = 0; i < plain.texels.size(); ++i)
            worst = std::max(worst, glm::length(glm::dvec3(given.texels[i] - plain.texels[i])));
        // A place in the pixel is given in steps of 1/4096: that of a position in half floats is not exact.
        EXPECT_LE(worst, std::string_view(technique) == "gbuffer/wide" ? 2e-3 : 0) << technique;
    }
}

/// Shadow maps are filtered behind the G-buffer: there the images are given, and lights that reach everything cast no shadow.
TEST(GivenOutputs, OfShadowsTakeThePlaceOfTheFilteredMaps) {
    std::vector<Frame> frames = scenario_frames("spot_and_box");
    frames.push_back(frames.front());
    frames[1].sun.shadow.casts = false;
    for (Light& light : frames[1].lights) light.shadow.casts = false;
    const auto session = session_of(std::move(frames));
    Request request;
    request.outputs = {"visibility", "display"};
    const auto plain = must(session->run(request));
    const ReferenceImage visibility = in_double(plain.images.at("visibility"));
    const auto picture_with = [&](const ReferenceImage& given) {
        return must(session->run_from(request, Stage::shadows, {{"visibility", given}})).images.at("display").texels;
    };
    EXPECT_EQ(picture_with(visibility), plain.images.at("display").texels);
    ReferenceImage lit(visibility.width, visibility.height, visibility.layers, glm::dvec4(1));
    const auto all_lit = picture_with(lit);
    EXPECT_NE(all_lit, plain.images.at("display").texels);
    Request without_shadows;
    without_shadows.variant.frame = 1;
    without_shadows.outputs = {"display"};
    EXPECT_EQ(all_lit, must(session->run(without_shadows)).images.at("display").texels);
}

TEST(GivenOutputs, ReachThePicture) {
    Session& session = session_of_scenarios();
    const Request request = on_scenario("one_pane");
    ImageSet outputs = outputs_of(session, request, Stage::transparency);
    outputs.at("color").at(5, 7) += glm::dvec4(1, 0, 0, 0);
    const ReferenceImage plain = in_double(must(session.run(request)).images.at("display"));
    const auto run = must(session.run_from(request, Stage::transparency, outputs));
    const ReferenceImage given = in_double(run.images.at("display"));
    for (std::uint32_t y = 0; y < plain.height; ++y)
        for (std::uint32_t x = 0; x < plain.width; ++x) EXPECT_EQ(given.at(x, y) != plain.at(x, y), x == 5 && y == 7);
    for (const CounterRecord& counter : run.counters) EXPECT_THAT(counter.technique, Not(HasSubstr("transparency")));
}

TEST(GivenOutputs, AreRefusedWhereLaterStagesReadMore) {
    Session& session = session_of_scenarios();
    const Request request = on_scenario("glass_and_smoke");
    const auto run = [&](Stage stage, const ImageSet& outputs) { return session.run_from(request, stage, outputs); };
    EXPECT_THAT(run(Stage::culling, {}), FailsWith("stage.buffers_are_read", Field("stage", "culling")));
    EXPECT_THAT(run(Stage::gbuffer, {}), FailsWith("stage.output_not_given", Field("stage", "gbuffer")));
    EXPECT_THAT(run(Stage::transparency, {}), FailsWith("stage.output_not_given", Field("image", "color")));
    EXPECT_THAT(run(Stage::transparency, {{"color", ReferenceImage(3, 3)}}), FailsWith("stage.output_of_another_shape"));
    EXPECT_THAT(run(Stage::rain, {}), FailsWith("stage.not_needed", Field("stage", "rain")));
    Request filtered_by_lighting = on_scenario("spot_and_box");
    filtered_by_lighting.choices = chosen({"lighting/tiled"}, {"tiled:shadows=inline"});
    EXPECT_THAT(session.run_from(filtered_by_lighting, Stage::shadows, {}),
                FailsWith("stage.only_left_outputs_are_read", Field("image", "shadow_maps")));
}

}  // namespace
}  // namespace strata
