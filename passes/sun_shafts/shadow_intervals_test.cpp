// Facts of exact shadow intervals: a plate by hand, swarms of triangles against rays to the sun, a masked card, closed forms.
#include "passes/sun_shafts/shadow_intervals.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"
#include "passes/reference/rays.h"
#include "tests/support/one_pixel.h"

namespace strata::sun_shafts {
namespace {

/// A frame in whose view space the sun shines along a direction, with one mesh of triangles.
Frame frame_of(const std::vector<glm::vec3>& corners, const glm::vec3& sun) {
    Frame frame = one_pixel(1);
    frame.sun.direction = glm::normalize(sun);
    frame.sun.irradiance = glm::vec3(1);
    frame.sun.shadow.casts = true;
    Mesh mesh;
    mesh.positions = corners;
    for (std::uint32_t i = 0; i < corners.size(); ++i) mesh.indices.push_back(i);
    frame.meshes.push_back(mesh);
    frame.materials.push_back({.lighting_model = LightingModel::lambert, .double_sided = true});
    frame.draws.push_back({});
    return frame;
}

/// A square plate of half 1 in the plane y = 2 around z = 5.
std::vector<glm::vec3> plate() { return {{-1, 2, 4}, {1, 2, 4}, {1, 2, 6}, {-1, 2, 4}, {1, 2, 6}, {-1, 2, 6}}; }

bool contains(const std::vector<Interval>& parts, double t) {
    for (const Interval& part : parts)
        if (t > part.begin && t < part.end) return true;
    return false;
}

double distance_to_end(const std::vector<Interval>& parts, double t) {
    double least = HUGE_VAL;
    for (const Interval& part : parts) least = std::min({least, std::abs(t - part.begin), std::abs(t - part.end)});
    return least;
}

TEST(ShadowIntervals, UnderAPlateAreWhereTheSunsRaysThroughItsSidesMeetTheRay) {
    const Frame straight = frame_of(plate(), {0, -1, 0}), leaning = frame_of(plate(), {0, -1, -.5f});
    const auto under = ShadowVolumes(straight).shadows({0, 0, 1}, 10);
    ASSERT_EQ(under.size(), 1u) << "two triangles touch";
    EXPECT_NEAR(under[0].begin, 4, 1e-12);
    EXPECT_NEAR(under[0].end, 6, 1e-12);
    const auto before = ShadowVolumes(leaning).shadows({0, 0, 1}, 10);
    ASSERT_EQ(before.size(), 1u);
    EXPECT_NEAR(before[0].begin, 3, 1e-7) << "2 m below, the shadow is 1 m nearer";
    EXPECT_NEAR(before[0].end, 5, 1e-7);
    EXPECT_TRUE(ShadowVolumes(frame_of(plate(), {0, 1, 0})).shadows({0, 0, 1}, 10).empty()) << "the sun is below";
}

TEST(ShadowIntervals, EndWithTheRayAndBeginWhereItPassesThroughTheCaster) {
    const Frame frame = frame_of(plate(), {0, -1, 0});
    const ShadowVolumes volumes(frame);
    const auto cut = volumes.shadows({0, 0, 1}, 5);
    ASSERT_EQ(cut.size(), 1u);
    EXPECT_EQ(cut[0].end, 5);
    // Up at 2 in 5: the ray is under the plate from z = 4 and above it from z = 5 on.
    const glm::dvec3 up = glm::normalize(glm::dvec3(0, 2, 5));
    const auto through = volumes.shadows(up, 20);
    ASSERT_EQ(through.size(), 1u);
    EXPECT_NEAR(through[0].begin * up.z, 4, 1e-12);
    EXPECT_NEAR(through[0].end * up.z, 5, 1e-12);
}

TEST(ShadowIntervals, OfARayAlongTheSunsBeginAtTheCaster) {
    const std::vector<glm::vec3> wall = {{-1, -1, 7}, {1, -1, 7}, {0, 1, 7}};
    const auto behind = ShadowVolumes(frame_of(wall, {0, 0, 1})).shadows({0, 0, 1}, 10);
    ASSERT_EQ(behind.size(), 1u);
    EXPECT_NEAR(behind[0].begin, 7, 1e-12);
    const auto before = ShadowVolumes(frame_of(wall, {0, 0, -1})).shadows({0, 0, 1}, 10);
    ASSERT_EQ(before.size(), 1u);
    EXPECT_EQ(before[0].begin, 0);
    EXPECT_NEAR(before[0].end, 7, 1e-12);
}

TEST(ShadowIntervals, OfASwarmOfTrianglesAreWhereRaysToTheSunAreBlocked) {
    std::mt19937 random(7);
    const auto unit = [&] { return std::uniform_real_distribution<float>(-1, 1)(random); };
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 150; ++i) {
        const glm::vec3 center(4 * unit(), 4 * unit(), 6 + 5 * unit());
        for (int corner = 0; corner < 3; ++corner) corners.push_back(center + glm::vec3(unit(), unit(), unit()));
    }
    const Frame frame = frame_of(corners, {.4f, -1, .3f});
    const ShadowVolumes volumes(frame);
    const RayScene scene(frame, RayMask::shadow_casters);
    const glm::dvec3 to_sun = -glm::normalize(glm::dvec3(frame.sun.direction));
    std::size_t shadowed = 0, asked = 0;
    for (int ray = 0; ray < 60; ++ray) {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(.5 * unit(), .5 * unit(), 1));
        const auto parts = volumes.shadows(direction, 12);
        for (int i = 0; i < 150; ++i) {
            const double t = 6 + 6 * double(unit());
            if (distance_to_end(parts, t) < 1e-6) continue;
            const bool is_blocked = !scene.clear(t * direction, to_sun, 0, 1e9);
            ASSERT_EQ(contains(parts, t), is_blocked) << "ray " << ray << " at " << t;
            shadowed += is_blocked;
            ++asked;
        }
    }
    EXPECT_GT(shadowed, asked / 10);
    EXPECT_LT(shadowed, asked * 9 / 10);
}

TEST(ShadowIntervals, OfAMaskedCardHaveItsHoles) {
    Frame frame = frame_of(plate(), {0, -1, 0});
    Texture stripes{.name = "stripes", .width = 8, .height = 1};
    for (int i = 0; i < 8; ++i)
        for (const int value : {255, 255, 255, i % 2 == 0 ? 255 : 0}) stripes.texels.push_back(std::byte(value));
    frame.textures.push_back(stripes);
    for (const glm::vec3& corner : frame.meshes[0].positions) frame.meshes[0].uv0.emplace_back((corner.z - 4) / 2, .5f);
    frame.materials[0].alpha_mode = AlphaMode::mask;
    frame.materials[0].mask_cutoff = .5f;
    frame.materials[0].base_color_texture.texture = 0;
    const ShadowVolumes volumes(frame);
    const RayScene scene(frame, RayMask::shadow_casters);
    const auto parts = volumes.shadows({0, 0, 1}, 10);
    EXPECT_GE(parts.size(), 4u);
    for (double t = 3.5; t < 6.5; t += .01137) {
        if (distance_to_end(parts, t) > 1e-6) {
            EXPECT_EQ(contains(parts, t), !scene.clear({0, 0, t}, {0, 1, 0}, 0, 1e9)) << t;
        }
    }
}

TEST(ShadowIntervals, ScatterWhatTheClosedFormsSay) {
    EXPECT_NEAR(scattered_share({}, 20, .05), .63212056, 5e-9);
    const std::vector<Interval> second_half{{10, 20}};
    EXPECT_NEAR(scattered_share(second_half, 20, .05), 1 - std::exp(-.5), 1e-15);
    const std::vector<Interval> all{{0, 20}};
    EXPECT_EQ(scattered_share(all, 20, .05), 0);
    const std::vector<Interval> thin{{1, 1 + 1e-9}};
    EXPECT_NEAR((scattered_share({}, 2, 1) - scattered_share(thin, 2, 1)) / 1e-9, std::exp(-1.), 1e-6);
}

}  // namespace
}  // namespace strata::sun_shafts
