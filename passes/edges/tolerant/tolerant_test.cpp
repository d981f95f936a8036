// Facts of comparing surfaces against limits, on the model: each limit of docs/algorithms/deferred.md 3.2, just below and just
// above.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::edges {

Technique tolerant();

namespace {

/// A gray surface four meters before the eye that faces it.
ImageSet gray_surface() {
    return {{"depth_layers", ReferenceImage(1, 1, 4, glm::dvec4(.5, 0, 0, 1))},
            {"surface_normal", ReferenceImage(1, 1, 4, glm::dvec4(0, 0, -1, 4))},
            {"surface_color", ReferenceImage(1, 1, 4, glm::dvec4(.5, .5, .5, 1))},
            {"surface_material", ReferenceImage(1, 1, 4, glm::dvec4(double(LightingModel::ggx), 0, 1, 0))},
            {"emission", ReferenceImage(1, 1, 4, glm::dvec4(0, 0, 0, 1))}};
}

double mark_of(const ImageSet& before, const std::string& name = {}, double value = 0) {
    static const Technique technique = tolerant();
    const Frame frame = one_pixel(4);
    Settings settings(technique.params);
    EXPECT_TRUE(name.empty() || settings.set(name, value)) << name;
    const ImageSet result = technique.model({frame, before}, settings);
    EXPECT_FALSE(result.at("edges").undecided[0]);
    return result.at("edges").at(0, 0).x;
}

ImageSet turned(double degrees) {
    ImageSet before = gray_surface();
    const double angle = degrees * std::numbers::pi / 180;
    before.at("surface_normal").at(0, 0, 2) = {std::sin(angle), 0, -std::cos(angle), 4};
    return before;
}

ImageSet at_depth(double z) {
    ImageSet before = gray_surface();
    before.at("surface_normal").at(0, 0, 1).w = z;
    return before;
}

TEST(TolerantEdges, NormalsMayLeanByEightDegrees) {
    EXPECT_EQ(mark_of(turned(7.9)), 0);
    EXPECT_EQ(mark_of(turned(8.1)), 1);
    EXPECT_EQ(mark_of(turned(8.1), "normal_angle", 9), 0);
}

TEST(TolerantEdges, DepthsMayDifferByAHundredthOfTheNearerOne) {
    EXPECT_EQ(mark_of(at_depth(4.039)), 0);
    EXPECT_EQ(mark_of(at_depth(4.041)), 1);
    EXPECT_EQ(mark_of(at_depth(4 / 1.009)), 0);
    EXPECT_EQ(mark_of(at_depth(4 / 1.011)), 1);
    EXPECT_EQ(mark_of(at_depth(4.041), "depth_step", .02), 0);
}

TEST(TolerantEdges, ColorsMayDifferByATenthOverAllChannels) {
    ImageSet before = gray_surface();
    before.at("surface_color").at(0, 0, 3) = {.53, .47, .53, 1};
    EXPECT_EQ(mark_of(before), 0);
    before.at("surface_color").at(0, 0, 3) = {.54, .46, .53, 1};
    EXPECT_EQ(mark_of(before), 1);
    EXPECT_EQ(mark_of(before, "color_step", .2), 0);
}

// What the chapter's rule leaves out: a sign that shines has the base color of the wall it hangs on.
TEST(TolerantEdges, EmissionCountsAsColor) {
    ImageSet before = gray_surface();
    before.at("emission").at(0, 0, 1) = {2, 0, 0, 1};
    EXPECT_EQ(mark_of(before), 1);
}

TEST(TolerantEdges, AnotherLightingModelOrMetalMakesAnEdge) {
    ImageSet before = gray_surface();
    before.at("surface_material").at(0, 0, 1).x = double(LightingModel::cloth);
    EXPECT_EQ(mark_of(before), 1);
    before = gray_surface();
    before.at("surface_material").at(0, 0, 1).y = 1;
    EXPECT_EQ(mark_of(before), 1);
}

TEST(TolerantEdges, PartialCoverageMakesAnEdgeAndTheSkyNone) {
    ImageSet before = gray_surface();
    before.at("depth_layers").at(0, 0, 0).x = 0;
    EXPECT_EQ(mark_of(before), 1);
    for (std::uint32_t sample = 0; sample < 4; ++sample) before.at("depth_layers").at(0, 0, sample).x = 0;
    EXPECT_EQ(mark_of(before), 0);
}

TEST(TolerantEdges, AFloatOnTheLimitDecidesNothing) {
    static const Technique technique = tolerant();
    const Frame frame = one_pixel(4);
    const ImageSet result = technique.model({frame, at_depth(4.04)}, Settings(technique.params));
    EXPECT_TRUE(result.at("edges").undecided[0]);
}

}  // namespace
}  // namespace strata::edges
