// Facts of the hemisphere through the talk's table of materials (docs/algorithms/deferred.md 8.3), on the model.
#include <gtest/gtest.h>

#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/lighting/material_table_model.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::combine {

Technique hi_lo();
ImageSet hi_lo_model(const StageInput&, const Settings&);

namespace {

struct SkyLit {
    glm::dvec3 normal{0, 0, -1};
    double base_color = 1, metallic = 0, occlusion = 1;
};

/// A GGX surface of roughness 1 straight ahead, under a sky of 1 and the ground given, +y up.
double color_under_sky(const SkyLit& surface, float ground = 0, std::string_view hemisphere = "table") {
    static const Technique technique = hi_lo();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("hemisphere", hemisphere));
    Frame frame = one_pixel(1);
    frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(ground)};
    const ImageSet before{
        {"surface_normal", ReferenceImage(1, 1, 1, {surface.normal, 2})},
        {"surface_color", ReferenceImage(1, 1, 1, glm::dvec4(glm::dvec3(surface.base_color), 1))},
        {"surface_material", ReferenceImage(1, 1, 1, {double(LightingModel::ggx), surface.metallic, surface.occlusion, 0})},
        {"emission", ReferenceImage(1, 1, 1, {0, 0, 0, 1})},
        {"color", ReferenceImage(1, 1, 1)}};
    return hi_lo_model({frame, before}, settings).at("color").at(0, 0).x;
}

TEST(HemisphereByTable, IsTheRecordedOneOnOpenSurfacesThatFaceTheEye) {
    EXPECT_NEAR(color_under_sky({}), .5, 1e-9);
    EXPECT_NEAR(color_under_sky({.base_color = .6}, 1), .6, 1e-9);
}

/// Occlusion stands in for the cosine of the light: its power of .75 on rough surfaces, 1 on metal.
TEST(HemisphereByTable, TakesOcclusionToThePowerOfItsSlice) {
    EXPECT_NEAR(color_under_sky({.occlusion = .5}, 1), std::pow(.5, .75), .004);
    EXPECT_NEAR(color_under_sky({.occlusion = .5}, 1, "recorded"), .5, 1e-9);
    EXPECT_NEAR(color_under_sky({.metallic = 1, .occlusion = .25}, 1), .25, .004) << "a metal scatters its color";
}

/// At n.v = .2 the halfway cosine is .96. Of the mirrored direction (0, .392, .92) the height becomes -.216: mostly ground.
TEST(HemisphereByTable, MirrorsAtGrazingAnglesAndMostlyGround) {
    const SkyLit surface{.normal = {0, std::sqrt(.96), -.2}, .base_color = 0};
    const double highlight =
        .04 * double(lighting::gloss_rough) * lighting::material_in_table(lighting::slice_rough, 1, .96).shares.y;
    ASSERT_GT(highlight, .05);
    const glm::dvec3 mirrored = glm::normalize(glm::dvec3(0, 2 * .4 * std::sqrt(.96) - 1, .92));
    EXPECT_NEAR(color_under_sky(surface), highlight * (.5 + .5 * mirrored.y), 1e-6);
    EXPECT_LT(mirrored.y, 0);
    EXPECT_NEAR(color_under_sky({.base_color = 0}, 1), 0, 1e-9) << "nothing is mirrored straight back";
}

}  // namespace
}  // namespace strata::combine
