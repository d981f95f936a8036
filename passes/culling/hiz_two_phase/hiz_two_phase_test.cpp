// Facts of two-phase occlusion culling: bounds of spheres, the pyramid of farthest depths, and what hides what. A view of 90
// degrees each way, 64 pixels wide: the point (x, y, z) is seen at 32 + 32 (x, -y) / z.
#include "passes/culling/hiz_two_phase/model.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/view.h"
#include "captures/scenarios.h"
#include "passes/culling/judge.h"
#include "passes/culling/truth.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::culling {

Technique hiz_two_phase();

namespace {

constexpr double right_angle = 1.57079632679489661923;

Frame view_of_90_degrees(std::uint32_t samples = 1) {
    Frame frame;
    frame.view.projection = perspective(right_angle, 1, 0.1);
    frame.view.width = frame.view.height = 64;
    frame.view.samples = samples;
    frame.materials.resize(2);
    frame.materials[0].double_sided = frame.materials[1].double_sided = true;
    frame.materials[1].alpha_mode = AlphaMode::mask;
    return frame;
}

/// A square that faces the eye, `half` wide each way from its center: seen whole, its sphere is sqrt(2) half around it.
void add_square(Frame& frame, glm::dvec3 center, double half, std::uint32_t material = 0) {
    Mesh square;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
        square.positions.emplace_back(corner, 0);
        square.normals.emplace_back(0, 0, -1);
    }
    square.indices = {0, 1, 2, 0, 2, 3};
    const glm::dmat4 place = glm::translate(glm::dmat4(1), center);
    frame.draws.push_back({.mesh = static_cast<std::uint32_t>(frame.meshes.size()),
                           .material = material,
                           .to_world = glm::scale(place, glm::dvec3(half))});
    frame.meshes.push_back(square);
}

Settings with(std::initializer_list<std::pair<std::string_view, double>> values = {}) {
    static const Technique technique = hiz_two_phase();
    Settings settings(technique.params);
    for (const auto& [name, value] : values) EXPECT_TRUE(settings.set(name, value)) << name;
    return settings;
}

std::vector<bool> drawn(const Frame& frame, const Settings& settings = with()) {
    const ImageSet before;
    const ImageSet result = hiz_two_phase_model({frame, before}, settings);
    std::vector<bool> drawn;
    for (std::size_t i = 0; i < frame.draws.size(); ++i) {
        EXPECT_FALSE(result.at("visible").undecided[i]) << i;
        drawn.push_back(result.at("visible").texels[i].x == 1);
    }
    return drawn;
}

std::vector<double> random_depths(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> depth(0, 1);
    std::vector<double> depths(count);
    std::ranges::generate(depths, [&] { return depth(random); });
    return depths;
}

/// Least depth over pixels, both ends included, one by one.
double least_depth(const std::vector<double>& depths, std::uint32_t width, const PixelRange& pixels) {
    double least = 1e300;
    for (int y = pixels.first.y; y <= pixels.last.y; ++y)
        for (int x = pixels.first.x; x <= pixels.last.x; ++x)
            least = std::min(least, depths[std::size_t(y) * width + std::size_t(x)]);
    return least;
}

const std::pair<std::uint32_t, std::uint32_t> odd_extents[] = {{1, 1}, {1, 9}, {5, 3}, {13, 7}, {53, 31}, {160, 90}, {257, 129}};

}  // namespace

TEST(hiz_two_phase, a_texel_of_the_pyramid_is_the_farthest_of_the_pixels_it_covers_and_of_no_others) {
    for (const auto& [width, height] : odd_extents) {
        const std::vector<double> depths = random_depths(std::size_t(width) * height);
        const DepthPyramid pyramid(width, height, depths);
        const glm::ivec2 end(width - 1, height - 1);
        for (std::size_t n = 0; n < pyramid.levels().size(); ++n) {
            const DepthPyramid::Level& level = pyramid.levels()[n];
            const int side = 1 << n;
            for (std::uint32_t y = 0; y < level.height; ++y)
                for (std::uint32_t x = 0; x < level.width; ++x) {
                    const glm::ivec2 first = glm::ivec2(x, y) * side;
                    ASSERT_LE(first.x, end.x) << "a texel without a pixel";
                    EXPECT_EQ(level.at(x, y), least_depth(depths, width, {first, glm::min(first + side - 1, end)}))
                        << width << "x" << height << " level " << n;
                }
        }
        EXPECT_EQ(pyramid.levels().back().depth.size(), 1u);
    }
}

TEST(hiz_two_phase, a_160_by_90_picture_has_nine_levels_of_19244_texels) {
    const DepthPyramid pyramid(160, 90, std::vector<double>(160 * 90, 0.5));
    std::size_t texels = 0;
    for (const DepthPyramid::Level& level : pyramid.levels()) texels += level.depth.size();
    EXPECT_EQ(pyramid.levels().size(), 9u);  // 160x90 80x45 40x23 20x12 10x6 5x3 3x2 2x1 1x1
    EXPECT_EQ(texels, 14400u + 3600 + 920 + 240 + 60 + 15 + 6 + 2 + 1);
}

TEST(hiz_two_phase, a_lookup_is_never_nearer_than_the_farthest_pixel_and_exact_where_the_range_is_small) {
    std::mt19937 random(3);
    for (const auto& [width, height] : odd_extents) {
        const std::vector<double> depths = random_depths(std::size_t(width) * height);
        const DepthPyramid pyramid(width, height, depths);
        for (int i = 0; i < 200; ++i) {
            const auto pair = [&](std::uint32_t size) {
                const int a = int(random() % size), b = int(random() % size);
                return std::pair{std::min(a, b), std::max(a, b)};
            };
            const auto [left, right] = pair(width);
            const auto [top, bottom] = pair(height);
            const PixelRange pixels{{left, top}, {right, bottom}};
            const double exact = least_depth(depths, width, pixels);
            double finer = 0;
            for (const int across : {2, 4, 8, 16}) {
                const double found = pyramid.farthest(pixels, std::uint32_t(across));
                EXPECT_LE(found, exact);
                EXPECT_GE(found, finer) << "more texels of finer levels see less beyond the range";
                if (std::max(right - left, bottom - top) < across) {
                    EXPECT_EQ(found, exact);
                }
                finer = found;
            }
        }
    }
}

TEST(hiz_two_phase, a_sphere_of_3_m_at_5_m_is_seen_under_three_quarters) {
    // The tangents lean by asin(3/5) from the axis: 4 m long, slope 3/4.
    const auto bounds = bounds_in_picture(view_of_90_degrees().view, {{0, 0, 5}, 3});
    ASSERT_TRUE(bounds);
    EXPECT_NEAR(bounds->low.x, 32 - 24, 1e-6);
    EXPECT_NEAR(bounds->high.x, 32 + 24, 1e-6);
    EXPECT_NEAR(bounds->low.y, 32 - 24, 1e-6);
    EXPECT_NEAR(bounds->high.y, 32 + 24, 1e-6);
    EXPECT_NEAR(bounds->nearest, 0.1 / 2, 1e-9);
}

TEST(hiz_two_phase, a_sphere_of_5_m_at_5_and_12_m_reaches_from_the_axis_to_120_119ths) {
    // 13 m away, tangents of 12 m: the angle of (5, 12) doubles to one whose tangent is 120/119, and vanishes on the other side.
    const auto bounds = bounds_in_picture(view_of_90_degrees().view, {{5, 0, 12}, 5});
    ASSERT_TRUE(bounds);
    EXPECT_NEAR(bounds->low.x, 32, 1e-5);
    EXPECT_NEAR(bounds->high.x, 32 + 32 * 120.0 / 119, 1e-5);
}

TEST(hiz_two_phase, bounds_hold_every_point_of_a_sphere_and_touch_it_on_all_four_sides) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    Frame frame = view_of_90_degrees();
    frame.view.width = 320, frame.view.height = 180;
    frame.view.jitter = {0.01f, -0.02f};
    const glm::dmat4 p(frame.view.projection);
    for (int i = 0; i < 50; ++i) {
        const Sphere sphere{{8 * unit(random), 8 * unit(random), 6 + 4 * unit(random)}, 0.6 + 0.5 * unit(random)};
        const auto bounds = bounds_in_picture(frame.view, sphere);
        ASSERT_TRUE(bounds);
        glm::dvec2 low(1e300), high(-1e300);
        for (int turn = 0; turn < 720; ++turn)
            for (int tilt = 0; tilt <= 360; ++tilt) {
                const double a = turn * right_angle / 180, b = tilt * right_angle / 180;
                const glm::dvec3 at =
                    sphere.center + sphere.radius * glm::dvec3(std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), std::cos(b));
                const glm::dvec2 ndc(p[0][0] * at.x / at.z + double(frame.view.jitter.x),
                                     p[1][1] * at.y / at.z + double(frame.view.jitter.y));
                const glm::dvec2 pixel = (ndc * 0.5 + 0.5) * glm::dvec2(320, 180);
                low = glm::min(low, pixel);
                high = glm::max(high, pixel);
            }
        const double tolerance = 1e-3 * glm::length(bounds->high - bounds->low);
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GE(low[axis], bounds->low[axis] - 1e-9);
            EXPECT_LE(high[axis], bounds->high[axis] + 1e-9);
            EXPECT_LE(low[axis], bounds->low[axis] + tolerance);
            EXPECT_GE(high[axis], bounds->high[axis] - tolerance);
        }
    }
}

TEST(hiz_two_phase, a_sphere_that_reaches_over_the_near_plane_has_no_bounds_and_is_drawn) {
    const View view = view_of_90_degrees().view;
    EXPECT_FALSE(bounds_in_picture(view, {{0, 0, 1}, 0.91}));
    ASSERT_TRUE(bounds_in_picture(view, {{0, 0, 1}, 0.89}));
    EXPECT_NEAR(bounds_in_picture(view, {{0, 0, 1}, 0.89})->nearest, 0.1 / 0.11, 1e-6);
    Frame frame = view_of_90_degrees();
    add_square(frame, {0, 0, 0.2}, 0.5);  // fills the view; its sphere holds the eye
    add_square(frame, {0, 0, 3}, 2.5);    // behind it, and its sphere, too, begins before the near plane
    add_square(frame, {0, 0, 3}, 1);
    EXPECT_EQ(drawn(frame), (std::vector<bool>{true, true, false}));
}

TEST(hiz_two_phase, a_pixel_counts_when_a_sample_of_it_lies_in_the_bounds) {
    const auto columns = [](std::uint32_t samples, double low, double high) {
        const PixelRange pixels = pixels_of(view_of_90_degrees(samples).view, {{low, 0}, {high, 64}, 0});
        return std::pair{pixels.first.x, pixels.last.x};
    };
    EXPECT_EQ(columns(1, 3.4, 4.6), (std::pair{3, 4}));
    EXPECT_EQ(columns(1, 3.6, 4.6), (std::pair{4, 4}));
    EXPECT_EQ(columns(4, 3.6, 4.4), (std::pair{3, 4}));  // samples at 3.875 and 4.125
    EXPECT_EQ(columns(4, 3.9, 4.4), (std::pair{4, 4}));
    EXPECT_EQ(columns(1, -9, 100), (std::pair{0, 63}));
    const auto [first, last] = columns(1, 3.6, 4.4);
    EXPECT_LT(last, first);
}

TEST(hiz_two_phase, what_lies_between_samples_is_culled_for_nobody_could_draw_it) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame frame = view_of_90_degrees(samples);
        add_square(frame, {0, 0, 32}, 0.03);      // 0.06 pixels around a corner of four pixels
        add_square(frame, {0.5, 0.5, 32}, 0.03);  // around a center, and between the four of it: bounds know their box alone
        EXPECT_EQ(drawn(frame), (std::vector<bool>{false, true}));
    }
}

TEST(hiz_two_phase, a_wall_hides_what_is_wholly_behind_it_and_nothing_that_looks_past_it) {
    Frame frame = view_of_90_degrees();
    add_square(frame, {0, 0, 10}, 5);
    add_square(frame, {0, 0, 20}, 2);   // behind
    add_square(frame, {10, 0, 20}, 2);  // behind its edge
    add_square(frame, {0, 0, 11}, 2);   // its sphere, 2.8 m, reaches before the wall
    add_square(frame, {0, 0, 5}, 1);    // before it
    EXPECT_EQ(drawn(frame), (std::vector<bool>{true, false, true, true, true}));
    std::ranges::reverse(frame.draws);  // the order of draws means nothing
    EXPECT_EQ(drawn(frame), (std::vector<bool>{true, true, true, false, true}));
}

TEST(hiz_two_phase, masked_draws_hide_nothing_and_are_hidden_like_others) {
    Frame frame = view_of_90_degrees();
    add_square(frame, {0, 0, 10}, 3, 1);
    add_square(frame, {0, 0, 20}, 2);
    EXPECT_EQ(drawn(frame), (std::vector<bool>{true, true}));
    add_square(frame, {0, 0, 4}, 3.9);
    EXPECT_EQ(drawn(frame), (std::vector<bool>{false, false, true}));
}

TEST(hiz_two_phase, the_back_of_a_one_sided_wall_hides_nothing) {
    Frame frame = view_of_90_degrees();
    add_square(frame, {0, 0, 10}, 5);
    add_square(frame, {0, 0, 20}, 2);
    frame.materials[0].double_sided = false;
    frame.draws[1].material = 1;
    std::vector<bool> hides;
    for (int turn = 0; turn < 2; ++turn) {
        hides.push_back(!drawn(frame)[1]);
        std::swap(frame.meshes[0].indices[1], frame.meshes[0].indices[2]);
        std::swap(frame.meshes[0].indices[4], frame.meshes[0].indices[5]);
    }
    EXPECT_NE(hides[0], hides[1]);
}

TEST(hiz_two_phase, a_gap_at_a_single_sample_of_four_keeps_what_is_behind_it) {
    // The wall ends at x = 40.5: of the pixels before it all samples are covered, of pixel 40 two of four.
    const auto behind = [](double x) -> bool {
        Frame frame = view_of_90_degrees(4);
        add_square(frame, {-11.5, 0, 10}, 14.15625);  // from far left to 32 + 32 * 2.65625 / 10 = 40.5
        add_square(frame, {20 * (x - 32) / 32, 0, 20}, 0.2);
        return drawn(frame)[1];
    };
    EXPECT_FALSE(behind(39.5));
    EXPECT_TRUE(behind(40.0));
    EXPECT_TRUE(behind(40.5));
}

TEST(hiz_two_phase, sizes_are_told_apart_by_an_eighth_of_an_octave) {
    EXPECT_EQ(size_bin(0x1p-12), 0u);
    EXPECT_EQ(size_bin(0x1p-20), 0u);
    EXPECT_EQ(size_bin(1), 96u);
    EXPECT_EQ(size_bin(2), 104u);
    EXPECT_EQ(size_bin(15.9), 127u);
    EXPECT_EQ(size_bin(1e9), 127u);
    for (double size = 0x1p-12; size < 15; size *= 1.01) EXPECT_LE(size_bin(size), size_bin(size * 1.01));
}

TEST(hiz_two_phase, one_phase_knows_the_largest_occluders_alone) {
    Frame frame = view_of_90_degrees();
    add_square(frame, {-4, 0, 10}, 3.5);
    add_square(frame, {5, 0, 10}, 3);     // more than an eighth of an octave smaller
    add_square(frame, {-8, 0, 20}, 0.5);  // behind the first
    add_square(frame, {10, 0, 20}, 0.5);  // behind the second
    EXPECT_EQ(drawn(frame), (std::vector<bool>{true, true, false, false}));
    EXPECT_EQ(drawn(frame, with({{"phases", 0}, {"occluders", 2}})), (std::vector<bool>{true, true, false, false}));
    EXPECT_EQ(drawn(frame, with({{"phases", 0}, {"occluders", 1}})), (std::vector<bool>{true, true, false, true}));
}

TEST(hiz_two_phase, hides_no_visible_draw_of_a_city_and_most_of_those_that_are_not) {
    const Technique technique = hiz_two_phase();
    const Scenario& city = **find_scenario("city_of_boxes");
    for (const std::uint32_t samples : {1u, 4u})
        for (const std::uint32_t frame : {0u, 7u}) {
            const Frame built = city.build(frame, {.width = 160, .height = 90, .samples = samples, .frames = 8});
            const ImageSet before;
            const StageInput input{built, before};
            const auto metrics = culling_judge(hiz_two_phase_model(input, with()), culling_truth(input), input);
            EXPECT_EQ(metrics[0].value, 0) << frame;
            EXPECT_LE(metrics[2].value, 2.5 * metrics[3].value) << "drawn, of visible";
        }
}

TEST(hiz_two_phase, draws_depth_once_in_one_phase_and_twice_in_two_and_remembers_in_two_alone) {
    for (const double phases : {0, 1}) {
        Graph graph;
        FrameImages images{.extent = {160, 90}};
        images.all_opaque = {
            .commands = graph.create("commands", 100), .indices = graph.create("indices", 12), .first = 3, .count = 2};
        const Technique technique = hiz_two_phase();
        technique.declare(graph, images, with({{"phases", phases}}));
        std::size_t draws = 0, dispatches = 0;
        for (const Step& step : graph.steps()) {
            draws += std::holds_alternative<DrawWork>(step.work);
            dispatches += step.name.ends_with("pyramid.comp");
        }
        EXPECT_EQ(draws, phases == 0 ? 1u : 2u);
        EXPECT_EQ(dispatches, 2 * draws);  // 8 levels above the pixels, four at a time
        EXPECT_EQ(
            std::ranges::count_if(graph.buffers(), [](const BufferRecord& buffer) { return buffer.remembered.has_value(); }),
            phases == 0 ? 0 : 1);
        EXPECT_EQ(graph.record(images.opaque.commands).bytes, 40u);
        EXPECT_EQ(images.opaque.first, 0u);
        EXPECT_EQ(images.opaque.count, 2u);
    }
}

TEST(hiz_two_phase, a_frame_without_opaque_draws_is_left_alone) {
    Graph graph;
    FrameImages images;
    const Technique technique = hiz_two_phase();
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_TRUE(images.visible);
    EXPECT_EQ(images.opaque.count, 0u);
    EXPECT_EQ(graph.steps().size(), 1u);
}

}  // namespace strata::culling
