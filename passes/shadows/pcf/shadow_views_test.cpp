// Facts of where shadow maps look from (docs/algorithms/lighting.md 6.4 and 6.5).
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/scene/shadow_views.h"

namespace strata::shadows {

namespace {

Frame sunny() {
    Frame frame;
    frame.view.projection = perspective(1.0, 16.0 / 9, 0.1);
    frame.view.to_view = glm::dmat3({1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    frame.view.origin = {3, 2, 5};
    frame.sun.direction = glm::normalize(glm::vec3(0.3f, -0.8f, 0.2f));
    frame.sun.irradiance = {3, 3, 3};
    frame.sun.shadow = {.casts = true, .map_size = 512, .bias = 0.02f};
    return frame;
}

Light spot(float outer_angle) {
    return {.type = LightType::round_spot,
            .position = {1, 4, -2},
            .direction = {0, -1, 0},
            .axis_u = {1, 0, 0},
            .outer_angle = outer_angle,
            .shadow = {.casts = true, .map_size = 256}};
}

// (u, v, depth) of a world position.
glm::dvec3 in_map(const Frame& frame, const ShadowView& view, const glm::dvec3& world) {
    const glm::dvec4 m = view.view_to_map * glm::dvec4(frame.view.to_view * (world - frame.view.origin), 1);
    return glm::dvec3(m) / m.w;
}

// Corner of the picture at a view depth, view space.
glm::dvec3 corner(const Frame& frame, int i, double z) {
    const double x = i & 1 ? 1 : -1, y = i & 2 ? 1 : -1;
    return z * glm::dvec3(x / double(frame.view.projection[0][0]), y / double(frame.view.projection[1][1]), 1);
}

}  // namespace

TEST(cascades, are_split_between_logarithmic_and_uniform) {
    const auto half = cascade_ends(0.5, 200, 4, 0.5);
    EXPECT_NEAR(half[0], 26.305534, 1e-6);
    EXPECT_NEAR(half[1], 55.125, 1e-9);
    EXPECT_NEAR(half[2], 97.4231798, 1e-7);
    EXPECT_EQ(half[3], 200);
    const auto logarithmic = cascade_ends(0.5, 200, 4, 0.75);
    EXPECT_NEAR(logarithmic[0], 14.270801, 1e-6);
    EXPECT_NEAR(logarithmic[1], 32.5625, 1e-9);
    EXPECT_NEAR(logarithmic[2], 71.0722697, 1e-7);
}

TEST(cascades, hold_their_part_of_the_view_with_room_for_the_widest_kernel) {
    const Frame frame = sunny();
    const auto views = shadow_views(frame);
    ASSERT_EQ(views.size(), 3u);
    EXPECT_EQ(views[0].range_begin, double(frame.view.near));
    EXPECT_EQ(views[2].range_end, 60);
    for (std::size_t c = 0; c < views.size(); ++c) {
        const double blended = c == 0 ? 0 : cascade_blend * (views[c - 1].range_end - views[c - 1].range_begin);
        for (int i = 0; i < 4; ++i) {
            for (const double z : {views[c].range_begin - blended, views[c].range_end}) {
                const glm::dvec4 m = views[c].view_to_map * glm::dvec4(corner(frame, i, z), 1);
                EXPECT_GT(std::min(m.x, m.y) * views[c].size, 5);
                EXPECT_LT(std::max(m.x, m.y) * views[c].size, views[c].size - 5.0);
                EXPECT_GE(m.z, 0);
                EXPECT_LE(m.z, 1);
            }
        }
    }
}

TEST(cascades, keep_their_texels_on_the_world_when_the_camera_moves) {
    Frame frame = sunny();
    const glm::dvec3 landmark(7, 1, -11);
    const auto before = shadow_views(frame);
    frame.view.origin += glm::dvec3(0.137, 0.021, -1.234);
    const auto after = shadow_views(frame);
    for (std::size_t c = 0; c < before.size(); ++c) {
        const glm::dvec3 moved = (in_map(frame, after[c], landmark) * 512.0);
        Frame old = sunny();
        const glm::dvec3 steps = (moved - in_map(old, before[c], landmark) * 512.0) / 4.0;
        EXPECT_NEAR(steps.x, std::round(steps.x), 1e-8);
        EXPECT_NEAR(steps.y, std::round(steps.y), 1e-8);
        EXPECT_EQ(before[c].texel, after[c].texel);
    }
}

TEST(cascades, keep_the_size_of_their_texels_when_the_camera_turns) {
    Frame frame = sunny();
    const auto before = shadow_views(frame);
    const double c = std::cos(0.7), s = std::sin(0.7);
    frame.view.to_view = glm::dmat3({c, 0, s}, {0, 1, 0}, {s, 0, -c});
    const auto after = shadow_views(frame);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i].texel, after[i].texel);
}

TEST(cascades, reach_towards_the_sun_as_far_as_there_are_casters) {
    Frame frame = sunny();
    Mesh point;
    point.positions = {{0, 0, 0}};
    frame.meshes.push_back(point);
    frame.materials.emplace_back();
    Draw high;
    high.to_world[3] = glm::dvec4(frame.view.origin - 500.0 * glm::dvec3(frame.sun.direction), 1);
    frame.draws.push_back(high);
    for (const ShadowView& view : shadow_views(frame)) {
        const double depth = in_map(frame, view, glm::dvec3(high.to_world[3])).z;
        EXPECT_LT(depth, 1);
        EXPECT_GT(depth, 0.99);
        EXPECT_LT(in_map(frame, view, frame.view.origin).z, depth);
    }
}

TEST(spot_maps, look_along_the_cone_and_hold_its_rim) {
    Frame frame = sunny();
    frame.sun.irradiance = {};
    frame.lights = {spot(0.5f)};
    const auto views = shadow_views(frame);
    ASSERT_EQ(views.size(), 1u);
    const glm::dvec3 center = in_map(frame, views[0], {1, 0, -2});
    EXPECT_NEAR(center.x, 0.5, 1e-12);
    EXPECT_NEAR(center.y, 0.5, 1e-12);
    EXPECT_NEAR(center.z, 0.05 / 4, 1e-8);  // whatever the range of 10 m
    const double rim = std::tan(0.5) * 4;
    EXPECT_NEAR(in_map(frame, views[0], {1 + rim, 0, -2}).x * 256, 256 - 8, 1e-4);
    EXPECT_NEAR(views[0].texel * 240, 2 * std::tan(0.5), 1e-6);
}

TEST(spot_maps, hold_casters_near_a_light_that_shines_far) {
    Frame frame = sunny();
    frame.sun.irradiance = {};
    frame.lights = {spot(0.5f)};
    for (const float range : {2.f, 10.f, 101.f, 1e6f}) {
        frame.lights[0].range = range;
        EXPECT_NEAR(in_map(frame, shadow_views(frame)[0], {1, 4 - 0.05, -2}).z, 1, 1e-6) << range;
    }
}

TEST(spot_maps, never_open_wider_than_170_degrees) {
    Frame frame = sunny();
    frame.lights = {spot(1.57f)};
    EXPECT_NEAR(shadow_views(frame).back().texel * 240, 2 * std::tan(85 * 3.14159265358979 / 180), 1e-9);
}

TEST(omni_maps, are_six_and_hold_every_direction_with_room_for_the_widest_kernel) {
    Frame frame = sunny();
    frame.sun.irradiance = {};
    frame.lights = {spot(0.5f)};
    frame.lights[0].type = LightType::omni;
    const auto views = shadow_views(frame);
    ASSERT_EQ(views.size(), 6u);
    for (int i = 0; i < 1000; ++i) {  // a lattice of directions
        const glm::dvec3 direction(i % 10 - 4.5, i / 10 % 10 - 4.5, i / 100 - 4.5);
        const std::uint32_t face = cube_face(direction);
        const glm::dvec3 at = in_map(frame, views[face], frame.lights[0].position + direction);
        EXPECT_GE(std::min(at.x, at.y) * 256, 8 - 1e-6);
        EXPECT_LE(std::max(at.x, at.y) * 256, 248 + 1e-6);
        EXPECT_GT(at.z, 0);
    }
    EXPECT_EQ(cube_face({1, 1, -1}), 0u);
    EXPECT_EQ(cube_face({0.5, -2, 1}), 3u);
    EXPECT_EQ(cube_face({0.5, 1, -2}), 5u);
    const double rim = 3;  // 45 degrees off the axis is where the next face begins
    EXPECT_NEAR(in_map(frame, views[3], {1 + rim, 4 - rim, -2}).z, 0.05 / rim, 1e-8);  // whatever the range of 10 m
}

TEST(omni_maps, stay_where_they_are_in_the_world_when_the_camera_turns) {
    Frame frame = sunny();
    frame.lights = {spot(0.5f)};
    frame.lights[0].type = LightType::sphere;
    const auto before = shadow_views(frame);
    const glm::dvec3 landmark(2, 1, -1.5);
    const glm::dvec3 seen = in_map(frame, before.back(), landmark);
    const double c = std::cos(0.7), s = std::sin(0.7);
    frame.view.to_view = glm::dmat3({c, 0, s}, {0, 1, 0}, {s, 0, -c});
    frame.view.origin += glm::dvec3(1, 2, 3);
    EXPECT_NEAR(glm::distance(in_map(frame, shadow_views(frame).back(), landmark), seen), 0, 1e-9);
}

TEST(shadow_views, move_receivers_by_as_many_meters_as_their_light_says) {
    Frame frame = sunny();
    frame.lights = {spot(0.5f)};
    frame.lights[0].shadow.bias = 0.05f;
    const auto views = shadow_views(frame);
    ASSERT_EQ(views.size(), 4u);
    for (const ShadowView& view : views) {
        const bool is_suns = view.size == frame.sun.shadow.map_size;
        EXPECT_EQ(view.bias, double(is_suns ? 0.02f : 0.05f));
    }
}

TEST(shadow_views, carry_the_width_of_the_source) {
    Frame frame = sunny();
    frame.sun.angular_radius = 0.1f;
    frame.lights = {spot(0.5f)};
    frame.lights[0].source_radius = 0.25f;
    frame.lights[0].shadow.soft = true;
    const auto views = shadow_views(frame);
    EXPECT_NEAR(views.front().source_width, 2 * std::tan(0.1), 1e-8);
    EXPECT_FALSE(views.front().soft);
    EXPECT_EQ(views.back().source_width, 0.5);
    EXPECT_TRUE(views.back().soft);
}

TEST(shadow_views, are_made_for_lights_that_shine_and_cast_and_have_maps) {
    Frame frame = sunny();
    frame.lights = {spot(0.5f), spot(0.5f), spot(0.5f), spot(0.5f)};
    frame.lights[0].type = LightType::tube;
    frame.lights[1].intensity = {};
    frame.lights[2].shadow.casts = false;
    const auto views = shadow_views(frame);
    ASSERT_EQ(views.size(), 4u);
    EXPECT_EQ(views[3].light, 3u);  // the sun is light 0; what does not shine is on no list
    EXPECT_EQ(shadowed_lights(views), (std::vector<std::uint32_t>{0, 3}));
    frame.sun.irradiance = {};
    EXPECT_EQ(shadow_views(frame).front().light, 2u);
}

}  // namespace strata::shadows
