// Facts of the talk's light buffer: surfaces out of a table of materials, and highlights without color
// (docs/algorithms/deferred.md 1.5, 1.6).
#include <gtest/gtest.h>

#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "passes/lighting/brute_force/brute_force.shared.h"
#include "passes/lighting/brute_force/light_buffer_model.h"
#include "passes/reference/lights.h"
#include "tests/support/one_pixel.h"

namespace strata::lighting {
namespace {

using std::numbers::pi;

/// Two meters before the eye, facing it.
SurfacePoint surface(double roughness, double metallic, LightingModel model = LightingModel::ggx) {
    SurfacePoint point;
    point.position = {0, 0, 2};
    point.metallic = metallic;
    point.roughness = roughness;
    point.model = model;
    return point;
}

/// From the eye, so that the surface's highlight is at its middle.
Light sun(const glm::vec3& irradiance) {
    Light light;
    light.type = LightType::directional;
    light.direction = {0, 0, 1};
    light.intensity = irradiance;
    return light;
}

glm::dvec3 lit(const SurfacePoint& point, const glm::vec3& irradiance, const BruteForceParams& params) {
    return accumulated(one_pixel(1), point, sun(irradiance), params).radiance;
}

constexpr BruteForceParams colored{.materials = materials_recorded, .specular = specular_colored},
    white{.materials = materials_recorded, .specular = specular_white},
    table{.materials = materials_table, .specular = specular_colored};

TEST(LightBuffer, WhiteHighlightsAreOffByTheLightsColorLessItsMean) {
    const SurfacePoint mirror = surface(.5, 1);  // all it reflects is highlight
    const double bright = lit(mirror, {1, 1, 1}, colored).x;
    ASSERT_GT(bright, .1);
    const glm::dvec3 red = lit(mirror, {1, 0, 0}, white) - lit(mirror, {1, 0, 0}, colored);
    EXPECT_NEAR(red.x / bright, -2. / 3, 1e-9);
    EXPECT_NEAR(red.y / bright, 1. / 3, 1e-9);
    const glm::dvec3 warm = lit(mirror, {1, .7f, .4f}, white) - lit(mirror, {1, .7f, .4f}, colored);
    EXPECT_NEAR(warm.x / bright, -.3, 1e-6);
    EXPECT_NEAR(warm.z / bright, .3, 1e-6);
}

TEST(LightBuffer, WhiteHighlightsLeaveWhiteLightsAndDiffuseSurfacesAsTheyAre) {
    for (const LightingModel model :
         {LightingModel::ggx, LightingModel::burley, LightingModel::plain_burley, LightingModel::multiscatter_ggx,
          LightingModel::lambert, LightingModel::cloth, LightingModel::skin}) {
        const SurfacePoint point = surface(.5, 0, model);
        EXPECT_NEAR(lit(point, glm::vec3(2), white).y, lit(point, glm::vec3(2), colored).y, 1e-12);
    }
    const SurfacePoint chalk = surface(.5, 0, LightingModel::lambert);
    EXPECT_NEAR(lit(chalk, {1, 0, 0}, white).y, 0, 1e-12);
}

TEST(LightBuffer, WhiteHighlightsKeepTheDiffuseLayersColor) {
    for (const LightingModel model :
         {LightingModel::ggx, LightingModel::burley, LightingModel::plain_burley, LightingModel::multiscatter_ggx}) {
        SurfacePoint green = surface(1, 0, model);
        green.base_color = {0, .5, 0};
        // All that a red light gets back from green is highlight, a third of which is left in each channel.
        const glm::dvec3 from_red = lit(green, {1, 0, 0}, white);
        EXPECT_NEAR(from_red.x, from_red.z, 1e-12);
        EXPECT_NEAR(3 * from_red.x, lit(green, {1, 0, 0}, colored).x, 1e-12);
    }
}

TEST(LightBuffer, MakesAMaterialOfBaseColorAndGloss) {
    // Straight before the eye all shares are 1, but for the rough slice's .5 (127 / 255 in bytes).
    const double dielectric = .04;
    SurfacePoint point = surface(.2, 0);
    point.base_color = {.5, .25, 0};
    EXPECT_NEAR(lit(point, glm::vec3(1), table).x * pi, .5 + double(gloss_phong) * dielectric, 1e-6);
    EXPECT_NEAR(lit(point, glm::vec3(1), table).z * pi, double(gloss_phong) * dielectric, 1e-6);
    point.roughness = .5;
    EXPECT_NEAR(lit(point, glm::vec3(1), table).z * pi, double(gloss_blinn) * dielectric, 1e-6);
    point.roughness = .8;
    EXPECT_NEAR(lit(point, glm::vec3(1), table).z * pi, double(gloss_rough) * dielectric * 127 / 255, 1e-6);
    point.model = LightingModel::lambert;
    EXPECT_EQ(lit(point, glm::vec3(1), table).z, 0);
    const SurfacePoint metal = surface(.2, 1);
    EXPECT_NEAR(lit(metal, glm::vec3(1), table).x * pi, 1 + 1, 1e-6)
        << "a metal scatters its color, and 8 bits of gloss end at 1";
}

}  // namespace
}  // namespace strata::lighting
