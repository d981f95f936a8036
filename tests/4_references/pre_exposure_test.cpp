// The factor that brings a frame's light to the order of 1, by hand.
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "captures/scenarios.h"
#include "passes/reference/white_radiance.h"
#include "passes/scene/pre_exposure.h"

namespace strata {
namespace {

Frame in_the_sun(float irradiance, float exposure) {
    Frame frame;
    frame.sun.irradiance = glm::vec3(irradiance);
    frame.view.exposure = exposure;
    return frame;
}

Frame beside(const Light& light) {
    Frame frame;
    frame.lights.push_back(light);
    return frame;
}

}  // namespace

TEST(PreExposure, IsTheExposureWhereThatFits) {
    EXPECT_EQ(pre_exposure(in_the_sun(3, 1)), 1);
    EXPECT_EQ(pre_exposure(in_the_sun(3, .25f)), .25);
    EXPECT_EQ(pre_exposure(in_the_sun(1e5f, 1e-5f)), double(1e-5f));
    EXPECT_EQ(pre_exposure(in_the_sun(0, 7)), 7) << "without light";
}

TEST(PreExposure, IsOneOverWhiteWhereTheExposureDoesNotFit) {
    EXPECT_NEAR(pre_exposure(in_the_sun(1e5f, 1)), std::numbers::pi / 1e5, 1e-12);
    EXPECT_NEAR(pre_exposure(in_the_sun(1e-5f, 1)), std::numbers::pi / 1e-5, 1e-1);
    EXPECT_NEAR(pre_exposure(in_the_sun(3, 1e-45f)), std::numbers::pi / 3, 1e-7) << "no normal float";
}

/// A lamp of 800 lumens is 64 cd; at a quarter of its range of 8 m a white surface has 64 / (4 pi). So it has in front of 2 m^2
/// of a radiance of 32; without an area it has nothing.
TEST(PreExposure, KnowsWhiteUnderEveryLight) {
    EXPECT_FALSE(white_level({}));
    EXPECT_NEAR(*white_level(beside({.type = LightType::omni, .intensity = glm::vec3(64), .range = 8})),
                64 / (4 * std::numbers::pi), 1e-6);
    EXPECT_NEAR(*white_level(beside({.type = LightType::directional, .intensity = glm::vec3(0, 2, 1)})), 2 / std::numbers::pi,
                1e-6);
    Light panel{.type = LightType::rectangle, .intensity = glm::vec3(32), .range = 8};
    EXPECT_FALSE(white_level(beside(panel)));
    panel.half_extent = {1, .5f};
    EXPECT_NEAR(*white_level(beside(panel)), 64 / (4 * std::numbers::pi), 1e-6);
    panel.range = 0;
    EXPECT_FALSE(white_level(beside(panel)));
    EXPECT_NEAR(*white_level(beside({.type = LightType::directional, .intensity = glm::vec3(-3)})), 3 / std::numbers::pi, 1e-6)
        << "a dark";
    Frame sky;
    sky.hemisphere.sky = glm::vec3(.5f, .7f, 900);
    EXPECT_NEAR(*white_level(sky), 900, 1e-3);
    EXPECT_FALSE(white_level(in_the_sun(std::numeric_limits<float>::infinity(), 1)));
}

/// The reference derives it apart.
TEST(PreExposure, KnowsTheWhiteThatTheReferenceFinds) {
    for (const Scenario& scenario : scenarios()) {
        const Frame frame = scenario.build(0, {.width = 64, .height = 36});
        const double white = white_radiance(frame);
        EXPECT_NEAR(white_level(frame).value_or(0), white, 1e-6 * white) << scenario.name;
    }
}

TEST(PreExposure, TimesTheLightIsTheSameInEveryUnit) {
    for (const float irradiance : {3.f, 2000.f})
        for (const float k : {1e-6f, 1e-3f, 10.f, 1e6f}) {
            const double one = pre_exposure(in_the_sun(irradiance, .7f)) * double(irradiance);
            const double other = pre_exposure(in_the_sun(irradiance * k, .7f / k)) * double(irradiance * k);
            EXPECT_NEAR(other / one, 1, 1e-6) << k;
        }
}

/// What a renderer multiplies is multiplied once, and exposed radiance stays.
TEST(PreExposure, ScalesAllThatIsRadiance) {
    Frame frame = in_the_sun(8, 2);
    frame.lights = {{.intensity = glm::vec3(4)}};
    frame.hemisphere = {.sky = glm::vec3(16), .ground = glm::vec3(32)};
    frame.background = glm::vec3(64);
    frame.fog = {.density = 1, .color = glm::vec3(128)};
    frame.materials = {{.base_color = glm::vec4(1), .emissive = glm::vec3(256)}};
    frame.emitters.resize(1);
    frame.emitters[0].particles = {{.color = glm::vec3(512), .emissive = glm::vec3(1024)}};
    pre_expose(frame, .25);
    EXPECT_EQ(frame.pre_exposure, .25);
    EXPECT_EQ(frame.view.exposure, 8);
    const Particle& particle = frame.emitters[0].particles[0];
    const std::array got{frame.sun.irradiance, frame.lights[0].intensity, frame.hemisphere.sky,        frame.hemisphere.ground,
                         frame.background,     frame.fog.color,           frame.materials[0].emissive, particle.color,
                         particle.emissive};
    const std::array wanted{2.f, 1.f, 4.f, 8.f, 16.f, 32.f, 64.f, 128.f, 256.f};
    for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i], glm::vec3(wanted[i])) << i;
    EXPECT_EQ(frame.materials[0].base_color, glm::vec4(1)) << "reflectance is no radiance";
}

}  // namespace strata
