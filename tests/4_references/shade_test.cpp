// Why the light of the reference can be believed: the numbers of docs/algorithms/lighting.md T0.1, T0.2 and of
// docs/algorithms/deferred.md 2.2.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "passes/reference/brdf.h"
#include "passes/reference/lights.h"
#include "passes/reference/shade.h"
#include "tests/4_references/hemisphere.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

using std::numbers::pi;

struct PositionOracle {
    glm::dvec2 pixel;
    double z;
    glm::dvec3 position;
};

TEST(PixelRay, ReachesThePositionsOfDeferredChapter22) {
    Frame frame = tiny::frame(1920, 1080, 1, std::tan(67.5 * pi / 360));
    const std::array<PositionOracle, 3> oracles = {{{{0, 0}, 10, {-11.872545, 6.675600, 10}},
                                                    {{1919, 1079}, 10, {11.872545, -6.675600, 10}},
                                                    {{960, 540}, 100, {0.061868, -0.061868, 100}}}};
    for (const PositionOracle& oracle : oracles) {
        const glm::dvec3 position = oracle.z * pixel_ray(frame, oracle.pixel.x + 0.5, oracle.pixel.y + 0.5);
        EXPECT_LT(glm::length(position - oracle.position), 2e-6);
    }
}

TEST(PixelRay, GoesAgainstTheJitter) {
    Frame frame = tiny::frame(100, 50);
    frame.view.jitter = {2.0f / 100, 2.0f / 50};
    const glm::dvec3 moved = pixel_ray(frame, 31.5, 17.5);
    frame.view.jitter = {};
    EXPECT_LT(glm::length(moved - pixel_ray(frame, 30.5, 16.5)), 1e-7);
}

TEST(SamplePosition, IsVulkansStandardPattern) {
    glm::dvec2 sum(0);
    for (std::uint32_t i = 0; i < 4; ++i) sum += sample_position(4, i);
    EXPECT_EQ(sum, glm::dvec2(2));
    EXPECT_EQ(sample_position(4, 1), glm::dvec2(0.875, 0.375));
    EXPECT_EQ(sample_position(1, 0), glm::dvec2(0.5));
}

// What one watt per steradian from straight above makes of a white Lambert surface, times pi and the squared distance.
double attenuation(const Frame& frame, const Light& light, double distance) {
    SurfacePoint surface;
    surface.model = LightingModel::lambert;
    surface.position = {0, 0, 5};
    Light moved = light;
    moved.position = {0, 0, 5 - distance};
    return reflected(frame, surface, moved).x * pi * distance * distance;
}

TEST(Lights, EndSmoothlyAtTheirRangeT01) {
    const Frame frame = tiny::frame(8, 8);
    Light light;
    light.range = 4;
    const std::array<std::pair<double, double>, 4> oracles = {
        {{1, 0.99220276}, {2, 0.87890625}, {3, 0.46730042}, {3.6, 0.11826721}}};
    for (const auto& [distance, expected] : oracles) EXPECT_NEAR(attenuation(frame, light, distance), expected, 1e-8);
    EXPECT_EQ(attenuation(frame, light, 4), 0);
    EXPECT_EQ(attenuation(frame, light, 4.5), 0);
}

TEST(Lights, ARoundSpotFadesFromItsInnerToItsOuterAngleT02) {
    const Frame frame = tiny::frame(8, 8);
    Light light;
    light.type = LightType::round_spot;
    light.range = 1e6f;
    light.inner_angle = static_cast<float>(30 * pi / 180);
    light.outer_angle = static_cast<float>(45 * pi / 180);
    const std::array<std::pair<double, double>, 5> oracles = {
        {{30, 1}, {35, 0.49709274}, {40, 0.13754228}, {44, 0.00592540}, {45, 0}}};
    for (const auto& [degrees, expected] : oracles) {
        const double angle = degrees * pi / 180;
        light.direction = {static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle))};
        EXPECT_NEAR(attenuation(frame, light, 2), expected, 2e-6) << degrees;
    }
}

TEST(Lights, TheSunShinesAlongItsDirection) {
    Frame frame = tiny::frame(8, 8);
    frame.sun.direction = {0, 0.6f, 0.8f};
    frame.sun.irradiance = glm::vec3(2);
    SurfacePoint surface;
    surface.model = LightingModel::lambert;
    surface.position = {1, 2, 5};
    EXPECT_NEAR(reflected(frame, surface, sun_light(frame)).x, 2 * 0.8 / pi, 1e-7);
    surface.normal = {0, 0, 1};
    EXPECT_EQ(reflected(frame, surface, sun_light(frame)).x, 0);
}

TEST(Lights, AreSeenFromWhereverTheEyeStands) {
    Frame frame = tiny::frame(8, 8);
    frame.view.origin = {1e7, -2e6, 3e6};
    frame.view.to_view = glm::dmat3(0, 0, -1, 0, 1, 0, 1, 0, 0);  // looks along -x
    Light light;
    light.position = frame.view.origin + glm::dvec3(-3, 0, 0);
    SurfacePoint surface;
    surface.model = LightingModel::lambert;
    surface.position = {0, 0, 5};
    EXPECT_LT(glm::length(to_view(frame, light.position) - glm::dvec3(0, 0, 3)), 1e-9);
    const double window = std::pow(1 - std::pow(0.2, 4), 2);
    EXPECT_NEAR(reflected(frame, surface, light).x, window / 4 / pi, 1e-9);
}

TEST(Hemisphere, AUniformOneReflectsTheBaseColor) {
    Frame frame = tiny::frame(8, 8);
    frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(1)};
    SurfacePoint surface;
    surface.base_color = {0.7, 0.4, 0.1};
    tiny::Random random(2);
    for (int i = 0; i < 20; ++i) {
        surface.normal = toward(random.between(0, 1), random.between(0, 6));
        EXPECT_LT(glm::length(hemisphere_light(frame, surface) - surface.base_color), 1e-12);
    }
}

TEST(Hemisphere, LambertUnderAUniformSkyReflectsTheSame) {
    SurfacePoint surface;
    surface.model = LightingModel::lambert;
    surface.base_color = glm::dvec3(0.7);
    const double share = reflected_share({.polar = 50, .azimuthal = 20}, [&](const glm::dvec3& l) {
        return brdf(surface, l, {0, 0, -1}).x;
    });
    EXPECT_NEAR(share, 0.7, 1e-12);
}

TEST(Hemisphere, UpIsTheWorlds) {
    Frame frame = tiny::frame(8, 8);
    frame.view.to_view = glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0);  // looks straight down: world +y is view -z
    frame.hemisphere = {.sky = glm::vec3(1, 0, 0), .ground = glm::vec3(0, 1, 0)};
    SurfacePoint surface;
    EXPECT_LT(glm::length(hemisphere_light(frame, surface) - glm::dvec3(1, 0, 0)), 1e-12);
    surface.occlusion = 0.5;
    EXPECT_NEAR(hemisphere_light(frame, surface).x, 0.5, 1e-12);
}

TEST(Fog, HalvesWhatIsAHalfLifeAway) {
    Frame frame = tiny::frame(8, 8);
    frame.fog = {.density = static_cast<float>(std::numbers::ln2 / 10), .color = {1, 0.5f, 0}};
    EXPECT_NEAR(fog_at(frame, 10).remains, 0.5, 1e-7);
    EXPECT_LT(glm::length(fog_at(frame, 20).added - glm::dvec3(0.75, 0.375, 0)), 1e-7);
    EXPECT_EQ(fog_at(frame, 0).remains, 1);
}

TEST(Fog, LiesBeforeAPointForItsDepthOrItsDistance) {
    EXPECT_EQ(fog_way(FogPath::view_depth, {3, 0, 4}), 4);
    EXPECT_EQ(fog_way(FogPath::distance, {3, 0, 4}), 5);
}

// A white metal under a white sky and over black ground, integrated over its GGX lobe.
double sky_in_metal(const SurfacePoint& surface, const glm::dvec3& up) {
    const glm::dvec3 v = glm::normalize(-surface.position);
    const auto from_sky = [&](const glm::dvec3& l) { return glm::dot(l, up) > 0 ? brdf(surface, l, v).x : 0; };
    return reflected_share({2000, 500}, [&](const glm::dvec3& l) { return .5 * (from_sky(l) + from_sky({l.x, -l.y, l.z})); });
}

TEST(HemisphereLight, IsInMetalsWhatTheirLobeSeesOfIt) {
    Frame frame = tiny::frame(8, 8);
    frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(0)};
    double worst = 0;
    for (const double roughness : {.2, .5, .8, 1.})
        for (const double cosine : {1., .7, .3})
            for (const glm::dvec3 up :
                 {glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0), glm::dvec3(.6, 0, -.8), glm::dvec3(-.6, .64, -.48)}) {
                SurfacePoint surface;
                surface.model = LightingModel::ggx;
                surface.roughness = roughness;
                surface.metallic = 1;
                surface.position = -5. * toward(cosine, 0);
                const glm::dvec3 side = glm::normalize(glm::cross(up, glm::dvec3(.1, .9, .3)));
                frame.view.to_view = glm::dmat3(side, up, glm::cross(side, up));
                const double got = hemisphere_light(frame, surface).x, wanted = sky_in_metal(surface, up);
                worst = std::max(worst, std::abs(got - wanted));
                EXPECT_NEAR(got, wanted, .04) << roughness << ' ' << cosine << ' ' << up.x << ' ' << up.y;
            }
    EXPECT_GT(worst, 1e-6) << "a fitted lobe is not exact";
}

TEST(HemisphereLight, ShowsAMirrorTheGroundBelowTheHorizonAndTheSkyAboveIt) {
    Frame frame = tiny::frame(8, 8);
    frame.view.to_view = glm::dmat3(1);
    frame.hemisphere = {.sky = {0, 0, 1}, .ground = {1, 0, 0}};
    SurfacePoint mirror;
    mirror.model = LightingModel::ggx;
    mirror.roughness = 0;
    mirror.metallic = 1;
    mirror.base_color = glm::dvec3(1);
    for (const double height : {-1., 1.}) {
        mirror.normal = glm::normalize(glm::dvec3(0, .2 * height, -1));  // the eye is at the origin, the mirror before it
        mirror.position = {0, 0, 5};
        const glm::dvec3 seen = hemisphere_light(frame, mirror);
        EXPECT_NEAR(height > 0 ? seen.z : seen.x, 1, .02);
        EXPECT_NEAR(height > 0 ? seen.x : seen.z, 0, .02);
    }
}

}  // namespace
}  // namespace strata
