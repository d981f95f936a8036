// A stage's outputs replaced by given images: what later stages make of a truth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
}

}  // namespace
}  // namespace strata
