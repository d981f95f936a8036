// Facts of the lens as a whole: which steps a frame pays for, and the order of its effects.
#include <utility>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/lens.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/lens/lens.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::lens {

Technique camera();
ImageSet camera_model(const StageInput&, const Settings&);

namespace {

/// The steps that the lens declares for a frame.
std::vector<std::string> steps_for(const Lens& lens, const std::vector<std::pair<std::string, std::string>>& sets = {}) {
    const Technique technique = camera();
    Settings settings(technique.params);
    for (const auto& [name, value] : sets) EXPECT_TRUE(settings.set(name, value));
    Frame frame = one_pixel(1);
    frame.lens = lens;
    const Features features = frame_features(frame);
    Graph graph;
    FrameImages images;
    images.recorded = &frame;
    images.features = &features;
    images.extent = {64, 36};
    images.color = graph.create("color", {.extent = images.extent, .format = Format::rgba32f});
    technique.at_other_stages.front().declare(graph, images, settings);
    technique.declare(graph, images, settings);
    std::vector<std::string> names;
    for (const Step& step : graph.steps()) names.push_back(step.name);
    return names;
}

using Names = std::vector<std::string>;

TEST(Lens, DeclaresTheStepsOfTheEffectsThatAFrameAsksFor) {
    EXPECT_EQ(steps_for({}), Names{});
    EXPECT_EQ(steps_for({.distortion = true}), Names{"lens/distortion/radial.comp"});
    EXPECT_EQ(steps_for({.auto_exposure = true}),
              (Names{"lens/exposure/held.comp", "lens/exposure/meter.comp", "lens/exposure/adapt.comp"}));
    EXPECT_EQ(steps_for({.focus_distance = 1, .aperture = .1f}),
              (Names{"lens/depth_of_field/reach.comp", "lens/depth_of_field/spread.comp", "lens/depth_of_field/gather.comp"}));
    EXPECT_EQ(steps_for({.bloom = 1}, {{"bloom_reach", "0.03"}}), (Names{"lens/bloom/bright.comp", "lens/bloom/add.comp"}));
}

TEST(Lens, BlursThenBendsThenGlows) {
    const Names steps =
        steps_for({.bloom = 1, .aperture = .1f, .distortion = true}, {{"focus", "xray"}, {"bloom_reach", "0.03"}});
    EXPECT_EQ(steps, (Names{"lens/depth_of_field/xray.comp", "lens/distortion/radial.comp", "lens/bloom/bright.comp",
                            "lens/bloom/add.comp"}));
}

TEST(Lens, HandsOnWhatItFoundWhereAllIsSwitchedOff) {
    EXPECT_EQ(steps_for({.bloom = 1, .auto_exposure = true}, {{"bloom", "off"}, {"exposure", "off"}}),
              (Names{"clear exposure", "copy color to color"}));
}

TEST(Lens, GlowsByTheExposureThatItFound) {
    const Technique technique = camera();
    Frame frame = one_pixel(1);
    frame.lens = {.bloom = 1, .bloom_threshold = 0, .auto_exposure = true};
    const ImageSet result =
        camera_model({frame, {{"color", ReferenceImage(1, 1, 1, glm::dvec4(.5))}}}, Settings(technique.params));
    EXPECT_NEAR(result.at("exposure").at(0, 0).x, 1.538296, 1e-6);
    EXPECT_NEAR(result.at("color").at(0, 0).x, 1, 1e-12) << "a constant picture glows by itself";
    frame.lens.bloom_threshold = 1;
    const ImageSet dim = camera_model({frame, {{"color", ReferenceImage(1, 1, 1, glm::dvec4(.5))}}}, Settings(technique.params));
    EXPECT_EQ(dim.at("color").at(0, 0).x, .5) << ".77 after exposure is below the threshold";
}

}  // namespace
}  // namespace strata::lens
