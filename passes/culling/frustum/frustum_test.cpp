// Facts of frustum culling: a view of 90 degrees each way has the sides x = +-z and y = +-z, at z = .1 the near plane.
#include <cmath>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::culling {

Technique frustum();

namespace {

constexpr double right_angle = 1.57079632679489661923;

Frame view_of_90_degrees() {
    Frame frame;
    frame.view.projection = perspective(right_angle, 1, 0.1);
    frame.view.width = frame.view.height = 64;
    Mesh corners{.name = "opposite corners of a cube"};
    corners.positions = {{-1, -1, -1}, {1, 1, 1}};
    frame.meshes.push_back(corners);
    frame.materials.resize(2);
    frame.materials[1].alpha_mode = AlphaMode::blend;
    return frame;
}

void add_sphere(Frame& frame, glm::dvec3 center, double radius, std::uint32_t material = 0) {
    const glm::dmat4 place = glm::translate(glm::dmat4(1), center);
    frame.draws.push_back({.material = material, .to_world = glm::scale(place, glm::dvec3(radius / std::sqrt(3.0)))});
}

std::vector<bool> drawn(const Frame& frame) {
    const Technique technique = frustum();
    const ImageSet before;
    const ImageSet result = technique.model({frame, before}, Settings(technique.params));
    std::vector<bool> drawn;
    for (std::size_t i = 0; i < 8; ++i) drawn.push_back(result.at("visible").texels[i].x == 1);
    return drawn;
}

const double to_side = std::sqrt(2.0);  // meters along x to get one meter away from x = z

}  // namespace

TEST(frustum_culling, a_sphere_that_touches_a_side_stays_and_one_behind_it_goes) {
    Frame frame = view_of_90_degrees();
    add_sphere(frame, {10 + to_side, 0, 10}, 1);
    add_sphere(frame, {10 + 1.001 * to_side, 0, 10}, 1);
    add_sphere(frame, {-10 - to_side, 0, 10}, 1);
    add_sphere(frame, {0, 10 + 1.001 * to_side, 10}, 1);
    add_sphere(frame, {0, -10 - to_side, 10}, 1);
    const auto result = drawn(frame);
    EXPECT_TRUE(result[0]);
    EXPECT_FALSE(result[1]);
    EXPECT_TRUE(result[2]);
    EXPECT_FALSE(result[3]);
    EXPECT_TRUE(result[4]);
}

TEST(frustum_culling, the_near_plane_culls_and_there_is_no_far_plane) {
    Frame frame = view_of_90_degrees();
    add_sphere(frame, {0, 0, -0.91}, 1);  // ends at z = .09
    add_sphere(frame, {0, 0, -0.89}, 1);  // ends at z = .11
    add_sphere(frame, {0, 0, 1e7}, 1);
    const auto result = drawn(frame);
    EXPECT_FALSE(result[0]);
    EXPECT_TRUE(result[1]);
    EXPECT_TRUE(result[2]);
}

TEST(frustum_culling, the_planes_move_with_the_jitter) {
    Frame frame = view_of_90_degrees();
    add_sphere(frame, {-11, 0, 10}, 0.1);
    add_sphere(frame, {0, 11, 10}, 0.1);
    EXPECT_FALSE(drawn(frame)[0]);
    EXPECT_FALSE(drawn(frame)[1]);
    frame.view.jitter = {0.2f, 0.2f};  // the picture moves right and down: more is seen on the left and above
    EXPECT_TRUE(drawn(frame)[0]);
    EXPECT_TRUE(drawn(frame)[1]);
}

TEST(frustum_culling, texels_stand_for_opaque_draws_alone) {
    Frame frame = view_of_90_degrees();
    add_sphere(frame, {0, 0, -10}, 1);
    add_sphere(frame, {0, 0, 10}, 1, 1);  // blended: no opaque draw
    add_sphere(frame, {0, 0, 10}, 1);
    const auto result = drawn(frame);
    EXPECT_FALSE(result[0]);
    EXPECT_TRUE(result[1]);
    EXPECT_FALSE(result[2]);
}

TEST(frustum_culling, commands_keep_their_number_and_stand_in_a_buffer_of_their_own) {
    Graph graph;
    FrameImages images;
    images.all_opaque = {
        .commands = graph.create("commands", 100), .indices = graph.create("indices", 12), .first = 3, .count = 2};
    const Technique technique = frustum();
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_NE(images.opaque.commands.id, images.all_opaque.commands.id);
    EXPECT_EQ(graph.record(images.opaque.commands).bytes, 40u);
    EXPECT_EQ(images.opaque.indices, images.all_opaque.indices);
    EXPECT_EQ(images.opaque.first, 0u);
    EXPECT_EQ(images.opaque.count, 2u);
}

TEST(frustum_culling, a_frame_without_opaque_draws_is_left_alone) {
    Graph graph;
    FrameImages images;
    const Technique technique = frustum();
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_TRUE(images.visible);
    EXPECT_EQ(images.opaque.count, 0u);
}

}  // namespace strata::culling
