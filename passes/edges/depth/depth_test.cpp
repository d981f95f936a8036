// Facts of four depths on a plane, on the model: docs/algorithms/deferred.md 3.2, D4.
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/reference/shade.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::edges {

Technique depth();

namespace {

/// Depth where the sample is: one plane, or two that meet in a crease at x.
using DepthAt = double (*)(const glm::dvec2& at);

ImageSet surface(DepthAt depth_at) {
    ImageSet before{{"depth_layers", ReferenceImage(1, 1, 4)},
                    {"surface_normal", ReferenceImage(1, 1, 4, glm::dvec4(0, 0, -1, 4))},
                    {"surface_color", ReferenceImage(1, 1, 4, glm::dvec4(.5))},
                    {"surface_material", ReferenceImage(1, 1, 4)},
                    {"emission", ReferenceImage(1, 1, 4, glm::dvec4(0, 0, 0, 1))}};
    for (std::uint32_t sample = 0; sample < 4; ++sample)
        before.at("depth_layers").at(0, 0, sample).x = double(float(depth_at(sample_position(4, sample))));
    return before;
}

double mark_of(const ImageSet& before, std::string_view paired_with = "nothing") {
    static const Technique technique = depth();
    const Frame frame = one_pixel(4);
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("paired_with", paired_with));
    const ImageSet result = technique.model({frame, before}, settings);
    EXPECT_FALSE(result.at("edges").undecided[0]);
    return result.at("edges").at(0, 0).x;
}

TEST(DepthEdges, OppositeSamplesHaveOneMiddle) {
    const auto at = [](std::uint32_t sample) { return sample_position(4, sample); };
    EXPECT_EQ(at(0) + at(3), glm::dvec2(1));
    EXPECT_EQ(at(1) + at(2), glm::dvec2(1));
}

TEST(DepthEdges, APlaneIsPlainHoweverSteep) {
    EXPECT_EQ(mark_of(surface([](const glm::dvec2&) { return .03; })), 0);
    EXPECT_EQ(mark_of(surface([](const glm::dvec2& at) { return .03 + .01 * at.x - .02 * at.y; })), 0);
}

TEST(DepthEdges, AStepIsAnEdgeWhicheverSampleItIs) {
    for (std::uint32_t sample = 0; sample < 4; ++sample) {
        ImageSet before = surface([](const glm::dvec2&) { return .03; });
        before.at("depth_layers").at(0, 0, sample).x = .0301;
        EXPECT_EQ(mark_of(before), 1) << sample;
    }
}

// 0 and 1 before, 2 and 3 behind: what one pair gains the other loses.
TEST(DepthEdges, AStepThatHalvesTheParallelogramIsMissed) {
    EXPECT_EQ(mark_of(surface([](const glm::dvec2& at) { return at.y < .5 ? .03 : .01; })), 0);
    EXPECT_EQ(mark_of(surface([](const glm::dvec2& at) { return at.x < .5 ? .03 : .01; })), 0);
}

TEST(DepthEdges, PaintOnOnePlaneIsMissedUnlessMaterialsAreComparedToo) {
    ImageSet before = surface([](const glm::dvec2&) { return .03; });
    before.at("surface_color").at(0, 0, 2) = glm::dvec4(.9);
    EXPECT_EQ(mark_of(before), 0);
    EXPECT_EQ(mark_of(before, "normal"), 0);
    EXPECT_EQ(mark_of(before, "material"), 1);
    before = surface([](const glm::dvec2&) { return .03; });
    before.at("surface_normal").at(0, 0, 2) = {0, 1, 0, 4};
    EXPECT_EQ(mark_of(before, "material"), 0);
    EXPECT_EQ(mark_of(before, "normal"), 1);
}

TEST(DepthEdges, TheSkyIsPlain) {
    ImageSet before = surface([](const glm::dvec2&) { return 0.; });
    EXPECT_EQ(mark_of(before), 0);
    before.at("depth_layers").at(0, 0, 1).x = .5;
    EXPECT_EQ(mark_of(before), 1);
}

}  // namespace
}  // namespace strata::edges
