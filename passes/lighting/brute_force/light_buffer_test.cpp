// Facts of the talk's light buffer: its table of materials (docs/algorithms/deferred.md 1.6) and highlights without color (1.5).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

TEST(MaterialTable, HasTheSlicesOfTheChapter) {
    const double ld = std::pow(.5, 32), ls = .5;  // ls of n_h = 1
    EXPECT_NEAR(material_formula(slice_rough, ld, 1).y, .5 * std::pow(ls, 16), 1e-15);
    EXPECT_NEAR(material_formula(slice_rough, .0625, 1).x, .125, 1e-12);
    EXPECT_NEAR(material_formula(slice_blinn, 1, .9).y, .0797664430768, 1e-10);
    EXPECT_NEAR(material_formula(slice_phong, 1, .98).y, .269199, 1e-6);
    EXPECT_EQ(material_formula(slice_phong, 1, .995).y, 1);
    EXPECT_EQ(material_formula(slice_phong, .25, .5).x, .25);
    EXPECT_NEAR(material_formula(slice_metal, .7, .7 / std::pow(.7, 1. / 32)).y, std::pow(.7, 1. / 7), 1e-12);
}

TEST(MaterialTable, LosesAFactorOfTheRootOfEPerTexelInTheNarrowestLobe) {
    const double here = material_formula(slice_phong, 1, .985).y, next = material_formula(slice_phong, 1, .985 - 1. / 255).y;
    EXPECT_NEAR(next / here, std::exp(-.5), .01);
}

TEST(MaterialTable, HoldsBytesAtTheCentersOfItsTexels) {
    // Texel (95, 204) of the blinn slice: light 95 / 127, halfway 204 / 255.
    const double n_l = 95.5 / 128, n_h = 204.5 / 256;
    const glm::dvec2 exact = material_formula(slice_blinn, 95. / 127, 204. / 255);
    const glm::dvec2 kept = material_in_table(slice_blinn, n_l, n_h).shares;
    EXPECT_NEAR(kept.x, std::floor(255.5 * exact.x) / 255, 1e-12);
    EXPECT_NEAR(kept.y, std::floor(255.5 * exact.y) / 255, 1e-12);
    EXPECT_GT(kept.x, .7);
}

/// The largest error of what is specular, over lights at a cosine of .02 and more and halfway vectors within 45 degrees.
double worst_specular(std::uint32_t slice, double shift) {
    double worst = 0;
    for (double n_l = .02; n_l <= 1; n_l += .01)
        for (double n_h = .7; n_h <= 1; n_h += .001) {
            const double read = material_in_table(slice, n_l + shift / 128, n_h + shift / 256).shares.y;
            worst = std::max(worst, std::abs(read - material_formula(slice, n_l, n_h).y));
        }
    return worst;
}

/// Cosines taken for coordinates are half a texel off at the far end, where texel 255 stands for a cosine of 1: a quarter of the
/// narrow lobe. In the wide one it is less than what bytes and straight lines between them cost.
TEST(MaterialTable, IsOffByItsBytesAndByHalfATexelOfTheNarrowLobe) {
    EXPECT_NEAR(worst_specular(slice_rough, 0), .016, .002);
    EXPECT_NEAR(worst_specular(slice_blinn, 0), .048, .003);
    EXPECT_NEAR(worst_specular(slice_phong, 0), .225, .01);
}

/// pi over the integral of the specular part over lights, seen along the normal.
double gloss_of_formula(std::uint32_t slice) {
    constexpr int steps = 100'000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + .5) / steps * pi / 2;
        sum += material_formula(slice, std::cos(angle), std::cos(angle / 2)).y * std::sin(angle);
    }
    return 1 / (2 * sum * (pi / 2 / steps));
}

TEST(MaterialTable, GlossMakesEveryHighlightReflectAsMuchAsItsRecordedOne) {
    EXPECT_NEAR(gloss_of_formula(slice_rough), double(gloss_rough), .005);
    EXPECT_NEAR(gloss_of_formula(slice_blinn), double(gloss_blinn), .005);
    EXPECT_NEAR(gloss_of_formula(slice_phong), double(gloss_phong), .005);
    EXPECT_NEAR(gloss_of_formula(slice_metal), double(gloss_metal), .005);
}

TEST(MaterialTable, MakesAMaterialOfBaseColorAndGloss) {
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
