// Where a G-buffer's attributes are shaded: at the pixel's center, for all samples of a triangle at once, or at every sample.
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "tests/support/agreement.h"
#include "tests/support/print.h"
#include "tests/support/session.h"
#include "tests/support/truths.h"

namespace strata::gbuffer {
namespace {

Accuracy judged(const std::string& technique, const char* scenario, const char* setting, Against against) {
    Request request = on_scenario(scenario, 4);
    request.choices = chosen({technique}, {setting});
    return must(session_of_scenarios().judge(request, Stage::gbuffer, against));
}

double metric(const Accuracy& accuracy, std::string_view name) {
    for (const Metric& metric : accuracy.technique_errors)
        if (metric.name == name) return metric.value;
    throw std::logic_error("no figure " + std::string(name));
}

class EveryLayout : public testing::TestWithParam<const Technique*> {};

TEST_P(EveryLayout, ShadedAtTheSampleIsWhatItsModelSays) {
    for (const char* scenario : {"far_wall", "one_sphere"}) {
        Request request = on_scenario(scenario, 4);
        request.choices = chosen({std::string(GetParam()->name)}, {"attributes=sample"});
        const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::gbuffer, Against::model));
        expect_proven_within_tolerance(accuracy, *GetParam(), request, scenario);
    }
}

INSTANTIATE_TEST_SUITE_P(Layouts, EveryLayout, testing::ValuesIn(techniques_of(Stage::gbuffer)),
                         [](const auto& tested) { return as_identifier(std::string(tested.param->name)); });

/// Textures, their mips and normal maps; a mesh without normals has those of its faces, from derivatives of positions.
TEST(GBufferPlaces, TexturesAndNormalMapsAreTheSamplesToo) {
    for (const char* scenario : {"materials", "opaque_only"}) {
        Request request = on_scenario(scenario, 4);
        request.choices = chosen({"gbuffer/octahedral"}, {"attributes=sample"});
        const Accuracy accuracy = must(session_of_scenarios().judge(request, Stage::gbuffer, Against::model));
        expect_proven_within_tolerance(accuracy, **find_technique("gbuffer/octahedral"), request, scenario);
    }
}

/// At the rims of balls the pixel's center lies outside the triangle, and normals are extrapolated. There normals turn fastest
/// from pixel to pixel, and the device snaps corners to 1/256 of one: samples beside a side are .034 degrees off, others below
/// .02.
TEST(GBufferPlaces, NormalsAtRimsAreThoseOfTheTruthAtTheSampleAlone) {
    const Accuracy center = judged("gbuffer/octahedral", "materials", "attributes=center", Against::truth),
                   sample = judged("gbuffer/octahedral", "materials", "attributes=sample", Against::truth);
    EXPECT_GT(metric(center, "normal angle rms"), 1);
    EXPECT_LT(metric(sample, "normal angle rms"), .002);
    EXPECT_LT(metric(sample, "normal angle worst"), .05);
}

/// Samples lie sqrt(.125^2 + .375^2) = .395 of a pixel from its center. What is read at the center is so far beside the sample,
/// and a depth that is the sample's, read along the center's ray, would be, too (docs/algorithms/deferred.md 9, H20).
TEST(GBufferPlaces, PositionsLieUnderTheSampleWhereDepthIsTheSamples) {
    const Frame frame = scenario_frames("far_wall", 4).front();
    const double pixel = 2 / (double(frame.view.projection[0][0]) * frame.view.width);
    const double beside =
        metric(judged("gbuffer/octahedral", "far_wall", "attributes=center", Against::truth), "position across");
    EXPECT_GT(beside, .3 * pixel);
    EXPECT_LT(beside, .4 * pixel);
    const auto across = [&](const char* technique, const char* setting) {
        return metric(judged(technique, "far_wall", setting, Against::truth), "position across");
    };
    EXPECT_LT(across("gbuffer/octahedral", "attributes=sample"), 1e-9);
    EXPECT_LT(across("gbuffer/depth_rebuilt", "attributes=center"), 1e-9) << "depth is always the sample's";
    EXPECT_LT(across("gbuffer/compact", "attributes=center"), 1e-9);
    const double wide = across("gbuffer/wide", "attributes=sample");
    EXPECT_GT(wide, 1e-5) << "half floats of x and y miss the ray";
    EXPECT_LT(wide, 0x1p-11);
}

/// The models of later stages read the place out of decoded images, the shaders out of the layout.
TEST(GBufferPlaces, LaterStagesAndTheirModelsReadTheSamePlace) {
    for (const char* technique : {"gbuffer/depth_rebuilt", "gbuffer/wide"}) {
        Request request = on_scenario("sixteen_normals", 4);
        request.choices = chosen({technique}, {"attributes=sample"});
        for (const Stage stage : {Stage::lighting, Stage::combine}) {
            const Accuracy accuracy = must(session_of_scenarios().judge(request, stage, Against::model));
            expect_proven_within_tolerance(accuracy, *techniques_of(stage).front(), request, "sixteen_normals");
        }
    }
}

/// One sample is the pixel's center: nothing is shaded twice.
TEST(GBufferPlaces, OneSampleIsTheCenterToTheBit) {
    Session& session = session_of_scenarios();
    Request request = on_scenario("materials");
    const auto center = must(session.run(request));
    request.choices = chosen({}, {"attributes=sample"});
    EXPECT_EQ(must(session.run(request)).images.at("display").texels, center.images.at("display").texels);
}

}  // namespace
}  // namespace strata::gbuffer
