// Why rays can be believed: a box by hand, brute force, and agreement with the rasterizer.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "passes/reference/directions.h"
#include "passes/reference/rays.h"
#include "passes/reference/shade.h"
#include "passes/reference/triangles.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The cube from -1 to 1 around `center`, fronts outside.
std::uint32_t add_box(Frame& frame, const glm::dvec3& center) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    const std::uint32_t draw = tiny::add_mesh(frame, mesh);
    frame.draws[draw].to_world[3] = glm::dvec4(center, 1);
    return draw;
}

TEST(Rays, MeetABoxWhereItIs) {
    Frame frame = tiny::frame(8, 8);
    add_box(frame, {0, 0, 5});
    const RayScene scene(frame, RayMask::opaque);
    const std::optional<Hit> front = scene.closest({0.3, 0.2, 0}, {0, 0, 2}, 0, infinity);
    ASSERT_TRUE(front);
    EXPECT_NEAR(front->distance, 2, 1e-12) << "distances are in lengths of the direction";
    EXPECT_TRUE(front->front_facing);
    const std::optional<Hit> inside = scene.closest({0.3, 0.2, 5}, {0, 1, 0}, 0, infinity);
    ASSERT_TRUE(inside);
    EXPECT_NEAR(inside->distance, 0.8, 1e-12);
    EXPECT_FALSE(inside->front_facing);
    EXPECT_FALSE(scene.closest({1.1, 0, 0}, {0, 0, 1}, 0, infinity));
    EXPECT_FALSE(scene.closest({0, 0, 0}, {0, 0, -1}, 0, infinity));
}

TEST(Rays, AreClearBetweenBeginAndEnd) {
    Frame frame = tiny::frame(8, 8);
    add_box(frame, {0, 0, 5});
    const RayScene scene(frame, RayMask::opaque);
    EXPECT_TRUE(scene.clear({0, 0, 0}, {0, 0, 1}, 0, 4));
    EXPECT_FALSE(scene.clear({0, 0, 0}, {0, 0, 1}, 0, 4.001));
    EXPECT_TRUE(scene.clear({0, 0, 0}, {0, 0, 1}, 4, 6));
    EXPECT_FALSE(scene.clear({0, 0, 0}, {0, 0, 1}, 4.5, infinity));
    EXPECT_TRUE(scene.clear({0, 0, 0}, {0, 0, 1}, 6.001, infinity));
}

TEST(Rays, SlipThroughNoSharedEdge) {
    Frame frame = tiny::frame(8, 8);
    add_box(frame, {0, 0, 5});
    const RayScene scene(frame, RayMask::opaque);
    tiny::Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const double along = random.between(-1, 1);
        EXPECT_FALSE(scene.clear({along, -along, 0}, {0, 0, 1}, 0, infinity)) << "diagonal of a face";
        EXPECT_FALSE(scene.clear(glm::dvec3(along, 1, 4) - glm::dvec3(0, 1, -1), {0, 1, -1}, 0, infinity)) << "edge of the box";
    }
}

TEST(Rays, ShadowCastersLeaveOutWhatCastsNone) {
    Frame frame = tiny::frame(8, 8);
    frame.draws[add_box(frame, {0, 0, 5})].casts_shadow = false;
    EXPECT_TRUE(RayScene(frame, RayMask::shadow_casters).clear({0, 0, 0}, {0, 0, 1}, 0, infinity));
    EXPECT_FALSE(RayScene(frame, RayMask::opaque).clear({0, 0, 0}, {0, 0, 1}, 0, infinity));
    tiny::material(frame, 0).alpha_mode = AlphaMode::blend;
    EXPECT_TRUE(RayScene(frame, RayMask::opaque).clear({0, 0, 0}, {0, 0, 1}, 0, infinity));
}

TEST(Rays, PassThroughTheHolesOfAMask) {
    Frame frame = tiny::frame(8, 8);
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.address = AddressMode::clamp;
    for (const int alpha : {0, 255}) {
        for (const int channel : {255, 255, 255, alpha}) texture.texels.push_back(static_cast<std::byte>(channel));
    }
    frame.textures = {texture};
    const std::uint32_t draw = tiny::add_quad(frame, {.left = 0, .top = 0, .right = 8, .bottom = 8}, 3, AlphaMode::mask);
    tiny::material(frame, draw).base_color_texture.texture = 0;
    const RayScene scene(frame, RayMask::opaque);
    EXPECT_TRUE(scene.clear({0, 0, 0}, tiny::under(frame, 2, 3, 1), 0, infinity));
    EXPECT_FALSE(scene.clear({0, 0, 0}, tiny::under(frame, 6, 3, 1), 0, infinity));
}

// Nearest plane hit inside the triangle, by signed volumes: another formula than the one under test.
double brute_force(std::span<const glm::dvec3> corners, const glm::dvec3& origin, const glm::dvec3& direction) {
    double nearest = infinity;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const glm::dvec3 a = corners[i] - origin, b = corners[i + 1] - origin, c = corners[i + 2] - origin;
        const double u = glm::dot(direction, glm::cross(b, c)), v = glm::dot(direction, glm::cross(c, a)),
                     w = glm::dot(direction, glm::cross(a, b));
        const bool inside = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
        const double distance = glm::dot(a, glm::cross(b, c)) / (u + v + w);
        if (inside && distance > 0) nearest = std::min(nearest, distance);
    }
    return nearest;
}

TEST(Rays, FindTheSameTriangleAsBruteForce) {
    Frame frame = tiny::frame(8, 8);
    tiny::Random random(9);
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 center = random.inside(-5, 5);
        for (int k = 0; k < 3; ++k) corners.emplace_back(glm::vec3(center + random.inside(-0.7, 0.7)));
    }
    tiny::add_triangles(frame, corners);
    const RayScene scene(frame, RayMask::opaque);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 origin = random.inside(-6, 6), direction = random.inside(-1, 1);
        const double expected = brute_force(corners, origin, direction);
        const std::optional<Hit> hit = scene.closest(origin, direction, 0, infinity);
        ASSERT_EQ(hit.has_value(), expected < infinity) << i;
        EXPECT_EQ(scene.clear(origin, direction, 0, infinity), !hit.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(hit->distance, expected, 1e-9 * expected);
        glm::dvec3 at(0);
        for (int k = 0; k < 3; ++k)
            at += hit->barycentric[k] * corners[std::size_t(hit->triangle) * 3 + static_cast<std::size_t>(k)];
        EXPECT_LT(glm::length(at - (origin + hit->distance * direction)), 1e-9);
    }
    EXPECT_GT(hits, 500);
}

TEST(Rays, AgreeWithTheRasterizer) {
    Frame frame = tiny::frame(48, 32, 4, 0.7);
    add_box(frame, {0.5, 0.2, 4});
    add_box(frame, {-1.1, -0.4, 5});
    for (Material& material : frame.materials) material.double_sided = false;
    const VisiblePoints visible = visible_points(frame, opaque_draws(frame));
    const RayScene scene(frame, RayMask::opaque);
    int compared = 0;
    for (const RasterPoint& p : visible.points) {
        if (p.undecided) continue;
        const glm::dvec2 at = glm::dvec2(p.x, p.y) + sample_position(4, p.sample);
        const std::optional<Hit> hit = scene.closest({0, 0, 0}, pixel_ray(frame, at.x, at.y), 0, infinity);
        ASSERT_EQ(hit.has_value(), p.draw != no_index) << p.x << ", " << p.y << ", sample " << p.sample;
        if (!hit) continue;
        ++compared;
        EXPECT_TRUE(hit->front_facing);
        EXPECT_EQ(hit->draw, p.draw);
        EXPECT_NEAR(0.125 / hit->distance, p.depth, 1e-9);
    }
    EXPECT_GT(compared, 1000);
}

/// SplitMix64 in another language: of each point the second coordinate is drawn first.
TEST(directions, of_a_key_are_the_same_whatever_compiles_them) {
    DrawnNumbers random(7, 3);
    const std::vector<glm::dvec2> points = stratified(2, random);
    const glm::dvec2 wanted[] = {{.009278509072661978, .11895177508782928},
                                 {.5212756449939613, .3421989227982008},
                                 {.4243109307750641, .5606470553210525},
                                 {.9338147775314007, .8658950211570345}};
    ASSERT_EQ(points.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(points[i], wanted[i]) << i;
}

}  // namespace
}  // namespace strata
