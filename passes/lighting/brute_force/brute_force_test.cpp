// Facts of brute-force lighting, on its model: one Lambert pixel two meters away that faces the eye.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
#include "tests/support/one_pixel.h"

namespace strata::lighting {

ImageSet brute_force_model(const StageInput&, const Settings&);

namespace {

constexpr double depth = 2;

/// Base color 1, so that the Lambert radiance is irradiance / pi.
ImageSet white_wall(std::uint32_t samples) {
    return {{"surface_normal", ReferenceImage(1, 1, samples, {0, 0, -1, depth})},
            {"surface_color", ReferenceImage(1, 1, samples, {1, 1, 1, 1})},
            {"surface_material", ReferenceImage(1, 1, samples, {double(LightingModel::lambert), 0, 1, 0})}};
}

double lit(const Frame& frame, const ImageSet& before, std::uint32_t sample = 0) {
    return brute_force_model({frame, before}, {}).at("light").at(0, 0, sample).x;
}

/// Between the eye and the wall, a meter before it.
Light lamp(LightType type) {
    Light light;
    light.type = type;
    light.position = {0, 0, depth - 1};
    light.direction = {0, 0, 1};
    return light;
}

TEST(BruteForceLighting, TheSunGivesItsIrradianceOverPi) {
    Frame frame = one_pixel(1);
    frame.sun.direction = {0, 0, 1};
    frame.sun.irradiance = glm::vec3(3);
    EXPECT_NEAR(lit(frame, white_wall(1)), 3 / std::numbers::pi, 1e-7);
    frame.sun.direction = {0, 0.6f, 0.8f};
    EXPECT_NEAR(lit(frame, white_wall(1)), 0.8 * 3 / std::numbers::pi, 1e-6);
}

TEST(BruteForceLighting, OmniLightsEndAtTheirRange) {
    Frame frame = one_pixel(1);
    frame.lights = {lamp(LightType::omni)};
    // The distance is one meter: range = 1 / (d / r).
    for (const glm::dvec2 row : {glm::dvec2(0.25, 0.99220276), glm::dvec2(0.5, 0.87890625), glm::dvec2(0.75, 0.46730042),
                                 glm::dvec2(0.9, 0.11826721), glm::dvec2(1, 0)}) {
        frame.lights[0].range = float(1 / row.x);
        EXPECT_NEAR(lit(frame, white_wall(1)) * std::numbers::pi, row.y, 1e-6) << "at " << row.x << " of the range";
    }
}

TEST(BruteForceLighting, LightsOfGltfEndAsKhrLightsPunctualRecommends) {
    Frame frame = one_pixel(1);
    frame.lights = {lamp(LightType::omni)};
    frame.lights[0].window = RangeWindow::quartic;
    for (const glm::dvec2 row : {glm::dvec2(0.25, 0.99609375), glm::dvec2(0.5, 0.9375), glm::dvec2(0.75, 0.68359375),
                                 glm::dvec2(0.9, 0.3439), glm::dvec2(1, 0)}) {
        frame.lights[0].range = float(1 / row.x);
        EXPECT_NEAR(lit(frame, white_wall(1)) * std::numbers::pi, row.y, 1e-6) << "at " << row.x << " of the range";
    }
}

TEST(BruteForceLighting, SpotsFadeBetweenTheirCones) {
    Frame frame = one_pixel(1);
    frame.lights = {lamp(LightType::round_spot)};
    frame.lights[0].range = 1e6f;
    frame.lights[0].inner_angle = float(std::numbers::pi / 6);
    frame.lights[0].outer_angle = float(std::numbers::pi / 4);
    for (const glm::dvec2 row : {glm::dvec2(30, 1), glm::dvec2(35, 0.49709274), glm::dvec2(40, 0.13754228),
                                 glm::dvec2(44, 0.00592540), glm::dvec2(45, 0)}) {
        const double angle = row.x * std::numbers::pi / 180;
        frame.lights[0].direction = glm::vec3(float(std::sin(angle)), 0, float(std::cos(angle)));
        EXPECT_NEAR(lit(frame, white_wall(1)) * std::numbers::pi, row.y, 2e-6) << row.x << " degrees off the axis";
    }
}

TEST(BruteForceLighting, LightsAddUpAndDarksTakeAway) {
    Frame frame = one_pixel(1);
    frame.lights = {lamp(LightType::omni), lamp(LightType::omni)};
    const double both = lit(frame, white_wall(1));
    frame.lights[1].intensity = glm::vec3(-0.5f);
    EXPECT_NEAR(lit(frame, white_wall(1)), both / 4, 1e-12);
}

/// Where the wall of the pixel sees the light x to the side and 2 m before it, with a blocker half way whose halves are 1 m.
Frame behind_blocker(double x) {
    Frame frame = one_pixel(1);
    frame.blockers = {{.center = {-x, 0, depth - 1}}};
    frame.portals = {{.center = {-x, 0, depth - 1}, .half_u = 0.25f, .half_v = 0.25f}};
    frame.lights = {lamp(LightType::omni)};
    frame.lights[0].position = {-x, 0, depth - 2};
    frame.lights[0].range = 1e6f;
    frame.lights[0].blockers = {0};
    frame.lights[0].portals = {0};
    return frame;
}

TEST(BruteForceLighting, ABlockerLetsLightThroughItsPortalAndPastItsEdges) {  // docs/algorithms/lighting.md T2.2b
    for (const glm::dvec2 row :
         {glm::dvec2(0, 0.25), glm::dvec2(0.4, 0.23571651), glm::dvec2(0.6, 0), glm::dvec2(2.1, 0.08200418)})
        EXPECT_NEAR(lit(behind_blocker(row.x), white_wall(1)) * std::numbers::pi, row.y, 1e-7) << row.x << " m aside";
    Frame dark = behind_blocker(0.6);
    dark.lights[0].intensity = glm::vec3(-1);
    EXPECT_EQ(lit(dark, white_wall(1)), 0) << "a dark is stopped, too";
}

TEST(BruteForceLighting, VisibilityScalesTheLightItBelongsTo) {
    Frame frame = one_pixel(1);
    frame.lights = {lamp(LightType::omni), lamp(LightType::round_spot)};
    frame.lights[1].shadow.casts = true;
    ImageSet before = white_wall(1);
    const double open = lit(frame, before);
    before["visibility"] = ReferenceImage(1, 1, 1, glm::dvec4(0.25));
    EXPECT_NEAR(lit(frame, before), open / 2 * 1.25, 1e-9) << "omni lights have no map";
}

TEST(BruteForceLighting, PlainPixelsAreShadedOnceForAllSamples) {
    Frame frame = one_pixel(4);
    frame.lights = {lamp(LightType::omni)};
    ImageSet before = white_wall(4);
    before["surface_color"].at(0, 0, 3) = {0.5, 0.5, 0.5, 1};
    before["edges"] = ReferenceImage(1, 1, 1, glm::dvec4(0));
    EXPECT_EQ(lit(frame, before, 3), lit(frame, before, 0));
    before["edges"] = ReferenceImage(1, 1, 1, glm::dvec4(1));
    EXPECT_NEAR(lit(frame, before, 3), 0.5 * lit(frame, before, 0), 1e-12);
}

TEST(BruteForceLighting, BackgroundAndUnlitSurfacesReflectNothing) {
    Frame frame = one_pixel(1);
    frame.lights = {lamp(LightType::omni)};
    ImageSet before = white_wall(1);
    before["surface_material"].at(0, 0).x = double(LightingModel::unlit);
    EXPECT_EQ(lit(frame, before), 0);
    before = white_wall(1);
    before["surface_normal"].at(0, 0) = glm::dvec4(0);
    EXPECT_EQ(lit(frame, before), 0);
}

TEST(BruteForceLighting, LightTooBrightForAHalfFloatStaysFinite) {
    Frame frame = one_pixel(1);
    frame.lights = {lamp(LightType::omni)};
    frame.lights[0].intensity = glm::vec3(1e9f);
    EXPECT_EQ(lit(frame, white_wall(1)), 65504);
}

}  // namespace
}  // namespace strata::lighting
