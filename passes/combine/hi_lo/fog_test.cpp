// Facts of fog on the model: the ramp of docs/algorithms/deferred.md 8.2, view depth and distance, the background behind it; and
// what frames without fog pay.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/weather.h"
#include "passes/combine/truth.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::combine {

Technique hi_lo();
ImageSet hi_lo_model(const StageInput&, const Settings&);

namespace {

constexpr double surface_depth = 2;

Settings fog_with(const std::vector<std::pair<std::string_view, std::string_view>>& sets) {
    static const Technique technique = hi_lo();
    Settings settings(technique.params);
    for (const auto& [name, value] : sets) EXPECT_TRUE(settings.set(name, value)) << name << '=' << value;
    return settings;
}

/// A surface of radiance 1 that reflects nothing, two meters of view depth away.
ImageSet glowing_surface() {
    return {{"surface_normal", ReferenceImage(1, 1, 1, {0, 0, -1, surface_depth})},
            {"surface_color", ReferenceImage(1, 1, 1, {0, 0, 0, 1})},
            {"surface_material", ReferenceImage(1, 1, 1, {double(LightingModel::lambert), 0, 1, 0})},
            {"emission", ReferenceImage(1, 1, 1, glm::dvec4(1))},
            {"color", ReferenceImage(1, 1, 1)}};
}

/// A pixel in fog so dense that its surface is this many mean free paths of view depth away.
Frame in_fog(double free_paths) {
    Frame frame = one_pixel(1);
    frame.fog = {.density = float(free_paths / surface_depth), .color = {0, 0, 0}};
    return frame;
}

double fogged_color(const Frame& frame, const Settings& settings) {
    return hi_lo_model({frame, glowing_surface()}, settings).at("color").at(0, 0).x;
}

TEST(HiLoFog, LinearFogIsARampBetweenItsEnds) {
    const Settings settings = fog_with({{"fog", "linear"}, {"fog_near", "1"}, {"fog_far", "3"}});
    for (const glm::dvec2 row :
         {glm::dvec2(.5, 1), glm::dvec2(1, 1), glm::dvec2(1.5, .75), glm::dvec2(2, .5), glm::dvec2(3, 0), glm::dvec2(30, 0)})
        EXPECT_NEAR(fogged_color(in_fog(row.x), settings), row.y, 1e-6) << row.x << " mean free paths";
}

/// Along a row of lamps as much light arrives through either fog: the reason for the default of fog_far.
TEST(HiLoFog, LinearFogLetsAsMuchLightThroughAsExponentialFogOverAllDepths) {
    const Settings linear = fog_with({{"fog", "linear"}});
    double through = 0, widest = 0, where = 0;
    constexpr double step = .01;
    for (double x = step / 2; x < 12; x += step) {
        const double remains = fogged_color(in_fog(x), linear), apart = std::abs(remains - std::exp(-x));
        through += remains * step;
        if (apart > widest) where = x;
        widest = std::max(widest, apart);
    }
    EXPECT_NEAR(through, 1, 1e-4);
    EXPECT_NEAR(widest, .5 - std::log(2) / 2, 1e-4) << "where the slopes are equal";
    EXPECT_NEAR(where, std::log(2), step);
}

TEST(HiLoFog, EndsInTheWrongOrderAreAWallAtTheNearOne) {
    const Settings settings = fog_with({{"fog", "linear"}, {"fog_near", "3"}, {"fog_far", "1"}});
    EXPECT_NEAR(fogged_color(in_fog(2.9), settings), 1, 1e-9);
    EXPECT_NEAR(fogged_color(in_fog(3.1), settings), 0, 1e-9);
}

/// At 45 degrees off the axis the way is the square root of 2 times as long as the depth.
TEST(HiLoFog, IsMeasuredAlongViewDepthOrTheWayOfTheLight) {
    Frame frame = in_fog(1);
    frame.view.jitter.x = -1;
    const double root = std::sqrt(2.);
    frame.view.projection[0][0] = 1;
    for (const auto& [path, recorded] : {std::pair(FogPath::view_depth, std::exp(-1)), {FogPath::distance, std::exp(-root)}}) {
        frame.fog.path = path;
        EXPECT_NEAR(combine_truth({frame, glowing_surface()}).at("color").at(0, 0).x, recorded, 1e-6);
        EXPECT_NEAR(fogged_color(frame, fog_with({})), recorded, 1e-6);
        EXPECT_NEAR(fogged_color(frame, fog_with({{"fog_distance", "view_depth"}})), std::exp(-1), 1e-6);
        EXPECT_NEAR(fogged_color(frame, fog_with({{"fog_distance", "distance"}})), std::exp(-root), 1e-6);
    }
    EXPECT_NEAR(fogged_color(frame, fog_with({{"fog", "linear"}, {"fog_distance", "distance"}})), 1 - root / 2, 1e-6);
}

TEST(HiLoFog, BlendsIntoTheBackgroundByTheSquareOfItsShare) {
    Frame frame = in_fog(std::log(2));
    frame.fog.color = glm::vec3(.5f);
    frame.background = glm::vec3(.1f);
    // Half fog, .75; and a quarter of the background.
    EXPECT_NEAR(fogged_color(frame, fog_with({{"fog_sky", "blended"}})), .75 * .75 + .25 * .1, 1e-6);
    EXPECT_NEAR(fogged_color(frame, fog_with({})), .75, 1e-6);
    frame.fog.density = 100;
    EXPECT_NEAR(fogged_color(frame, fog_with({{"fog_sky", "blended"}})), .1, 1e-6) << "no edge before the sky";
}

/// The constant of the step that combines, as the frame fixes it.
std::uint32_t fixed_constant(const Frame& frame, const std::string& name) {
    const Features features = frame_features(frame);
    FrameImages images;
    images.recorded = &frame;
    images.features = &features;
    images.extent = {1, 1};
    Graph graph;
    hi_lo().declare(graph, images, fog_with({{"fog", "linear"}}));
    const std::vector<Fixed>& constants = graph.steps().back().fixed;
    const auto found = std::ranges::find(constants, name, &Fixed::name);
    return found == constants.end() ? no_index : std::get<std::uint32_t>(found->value);
}

TEST(HiLoFog, IsLeftOutOfTheShaderWhereTheFrameHasNone) {
    EXPECT_EQ(fixed_constant(one_pixel(1), "has_fog"), 0u);
    EXPECT_EQ(fixed_constant(in_fog(1), "has_fog"), 1u);
    EXPECT_EQ(fixed_constant(in_fog(1), "fog"), 1u);
}

}  // namespace
}  // namespace strata::combine
