// Traced ambient visibility: the target of ambient occlusion, against closed forms; and its judge.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "captures/scenarios/shapes.h"
#include "passes/occlusion/judge.h"
#include "passes/occlusion/truth.h"
#include "passes/reference/estimated_image.h"
#include "passes/reference/place_code.h"
#include "passes/stage_input.h"
#include "tests/4_references/estimates.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {

namespace {

using std::numbers::pi, occlusion::MaterialRule;

constexpr double endless = 1e9;

/// A sample that lies at the origin, a meter before an eye of whose pixels all see it; where it faces +y, they see it edge on.
ReferenceImage traced(Frame frame, double radius, const TracedDirections& directions, std::uint32_t size = 1,
                      const glm::dvec3& normal = {0, 1, 0}) {
    const Frame narrow = tiny::frame(size, size, 1, 1e-9);
    frame.view = narrow.view;
    frame.view.origin = {0, 0, -1};
    const ImageSet before{{"surface_normal", ReferenceImage(size, size, 1, {normal, 1})},
                          {"surface_material", ReferenceImage(size, size, 1, {double(LightingModel::lambert), 0, 1, 0})}};
    return traced_visibility({frame, before}, radius, directions);
}

/// Samples of a plane that faces the eye have one normal and one depth; what tells them apart is where in the pixel they lie.
TEST(EstimatedImage, IsMadeForEveryPlaceInThePixelThatASampleHas) {
    const ReferenceImage normal(1, 1, 4, {0, 0, -1, 2});
    ReferenceImage material(1, 1, 4, {double(LightingModel::lambert), 0, 1, 0});
    const Frame frame = tiny::frame(1, 1, 4);
    const auto x_of = [&](std::uint32_t sample) {
        const auto place = [](const SurfacePoint& at, const DrawnNumbers&) { return at.position; };
        return estimated_image(frame, {normal, material}, 1, glm::dvec4(0), place).at(0, 0, sample).x;
    };
    for (std::uint32_t sample = 0; sample < 4; ++sample) EXPECT_EQ(x_of(sample), 0) << "the pixel's center";
    for (std::uint32_t sample = 0; sample < 4; ++sample)
        material.at(0, 0, sample).w = place_code(sample_position(4, sample) - 0.5);
    // The pixel is 4 m wide at a depth of 2 m.
    for (std::uint32_t sample = 0; sample < 4; ++sample)
        EXPECT_NEAR(x_of(sample), 4 * (sample_position(4, sample).x - 0.5), 1e-6) << "sample " << sample;
}

double visibility(const Frame& frame, double radius) { return traced(frame, radius, {.side = 128, .batches = 1}).at(0, 0).x; }

/// center +- u +- v.
void add_rectangle(Frame& frame, const glm::dvec3& center, const glm::dvec3& u, const glm::dvec3& v) {
    const std::array corners{center - u - v, center + u - v, center + u + v, center - u - v, center + u + v, center - u + v};
    tiny::add_triangles(frame, corners);
}

/// Walls that stand at these distances, the first across x, the second across z, on an endless floor.
Frame walls(std::span<const double> distances) {
    Frame frame = tiny::frame(1, 1);
    add_rectangle(frame, {0, 0, 0}, {1e4, 0, 0}, {0, 0, 1e4});
    for (std::size_t i = 0; i < distances.size(); ++i) {
        glm::dvec3 center(0), along(0);
        center[i == 0 ? 0 : 2] = distances[i];
        along[i == 0 ? 2 : 0] = 1e4;
        add_rectangle(frame, center, along, {0, 1e4, 0});
    }
    return frame;
}

Frame ball(const glm::dvec3& center, float radius) {
    Frame frame = walls({});
    Mesh mesh = scenario::sphere(radius, 128);
    for (glm::vec3& position : mesh.positions) position += glm::vec3(center);
    tiny::add_mesh(frame, std::move(mesh));
    return frame;
}

/// What a wall at c radii takes: the integral over azimuths a of (1 - c^2 / cos^2 a) / 2 pi.
double taken_by_wall(double c) { return (std::acos(c) - c * std::sqrt(1 - c * c)) / pi; }

}  // namespace

TEST(traced_visibility, of_a_plane_is_exactly_1) {
    for (const double radius : {.1, 2.0, endless}) EXPECT_EQ(visibility(walls({}), radius), 1);
}

TEST(traced_visibility, before_an_endless_wall_is_a_half_wherever_the_wall_stands) {
    for (const double distance : {.3, 3.0}) EXPECT_NEAR(visibility(walls(std::array{distance}), endless), .5, .001);
}

TEST(traced_visibility, before_a_wall_of_the_same_mesh_is_a_half_however_near_it_stands) {
    for (const double distance : {1e-4, 1e-3, .1}) {
        Frame frame = tiny::frame(1, 1);
        std::vector<glm::dvec3> corners;
        for (const glm::dvec3& away :
             {glm::dvec3(-1e4, 0, 0), glm::dvec3(0, 0, -1e4)}) {  // the floor, and the wall towards the eye
            const glm::dvec3 low(distance, -1e4, 0), high(distance, 1e4, 0);
            for (const glm::dvec3& corner : {low, high, high + away, low, high + away, low + away}) corners.push_back(corner);
        }
        tiny::add_triangles(frame, corners);
        EXPECT_NEAR(traced(frame, endless, {.side = 128, .batches = 1}, 1, {0, 0, -1}).at(0, 0).x, .5, .002) << distance;
    }
}

TEST(traced_visibility, of_coincident_planes_is_1) {
    Frame frame = tiny::frame(1, 1);
    add_rectangle(frame, {0, 0, 0}, {1, .3, 0}, {-.3, 1, 0});
    add_rectangle(frame, {.1, .2, 0}, {2, .7, 0}, {.7, -2, 0});
    // Turned, each lies before and behind the other by what doubles round.
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), .4, glm::normalize(glm::dvec3(1, 2, .5)));
    for (Draw& draw : frame.draws) draw.to_world = turn;
    const glm::dvec3 normal = -glm::dvec3(turn[2]);
    const ReferenceImage many = traced(frame, endless, {.side = 32, .batches = 1}, 8, normal);
    for (const glm::dvec4& texel : many.texels) EXPECT_EQ(texel.x, 1);
}

TEST(traced_visibility, before_a_wall_within_the_radius_is_what_the_closed_form_says) {
    for (const double distance : {.25, 1.0, 1.8, 2.1}) {
        const double taken = distance < 2 ? taken_by_wall(distance / 2) : 0;
        EXPECT_NEAR(visibility(walls(std::array{distance}), 2), 1 - taken, .0015) << distance;
    }
}

TEST(traced_visibility, in_a_corner_of_a_room_is_a_quarter_and_within_a_radius_what_both_walls_leave) {
    EXPECT_NEAR(visibility(walls(std::array{1.0, 1.0}), endless), .25, .001);
    EXPECT_NEAR(visibility(walls(std::array{.2, 3.0}), endless), .25, .001);
    // Each wall up to the corner's azimuth, 45 degrees, of both together.
    const double c = .5, both = (pi / 4 + std::acos(c) - c * c - c * std::sqrt(1 - c * c)) / pi;
    EXPECT_NEAR(visibility(walls(std::array{1.0, 1.0}), 2), 1 - both, .0015);
}

TEST(traced_visibility, under_a_ball_is_1_less_its_form_factor) {
    EXPECT_NEAR(visibility(ball({0, 1, 0}, .5f), endless), 1 - .25, .001) << "(s / h)^2";
    EXPECT_NEAR(visibility(ball({1, 1, 0}, .5f), endless), 1 - .25 / std::pow(2, 1.5), .001) << "s^2 h / d^3";
    EXPECT_EQ(visibility(ball({0, 1, 0}, .5f), .45), 1) << "the ball is farther than the radius";
}

TEST(traced_visibility, is_stopped_by_both_faces_and_by_masked_surfaces_where_they_are_solid) {
    for (const double side : {1.0, -1.0}) {
        Frame frame = walls({});
        add_rectangle(frame, {0, 1, 0}, {1e4, 0, 0}, {0, 0, side * 1e4});
        tiny::material(frame, 1).double_sided = false;
        EXPECT_NEAR(visibility(frame, endless), 0, .001);
        tiny::material(frame, 1).alpha_mode = AlphaMode::mask;
        tiny::material(frame, 1).base_color.w = tiny::material(frame, 1).mask_cutoff / 2;
        EXPECT_EQ(visibility(frame, endless), 1);
    }
}

TEST(traced_visibility, knows_its_standard_error) {
    constexpr std::uint32_t size = 24;
    const ReferenceImage image = traced(walls(std::array{1.0}), 2, {.side = 4, .batches = 8}, size);
    const double wanted = 1 - taken_by_wall(.5);
    double squares = 0, expected = 0;
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        squares += std::pow(image.texels[i].x - wanted, 2) / (size * size);
        expected += std::pow(image.standard_error[i].x, 2) / (size * size);
    }
    EXPECT_NEAR(std::sqrt(squares) / std::sqrt(expected), 1, .15);
    EXPECT_EQ(traced(walls({}), 2, {}).standard_error[0].x, 0);
}

TEST(traced_visibility, has_the_mean_of_the_closed_form_and_half_a_percent_of_bias_shows) {
    const double wanted = 1 - taken_by_wall(.5);
    const Biases found = biases(traced(walls(std::array{1.0}), 2, {.side = 32, .batches = 1}, 28), wanted);
    EXPECT_LE(found.false_alarms, 2) << "of 28 at a level of .01";
    EXPECT_EQ(found.noticed, 28) << "biases of .5 %";
    EXPECT_GT(found.probability, .001) << "the mean of all";
}

TEST(traced_visibility, has_a_truth_for_every_radius_and_rule) {
    const std::vector<TruthRow> rows = other_occlusion_truths();
    EXPECT_EQ(rows.size(), 7u);
    Frame frame = walls(std::array{.4});
    const Frame narrow = tiny::frame(1, 1, 1, 1e-9);
    frame.view = narrow.view;
    frame.view.origin = {0, 0, -1};
    const ImageSet before{{"surface_normal", ReferenceImage(1, 1, 1, {0, 1, 0, 1})},
                          {"surface_material", ReferenceImage(1, 1, 1, {double(LightingModel::lambert), 0, .9, 0})}};
    const double at_2 = occlusion_truth({frame, before}).at("occlusion").at(0, 0).x;
    for (std::size_t i = 0; i < occlusion::radii.size(); ++i)
        for (const MaterialRule rule : {MaterialRule::product, MaterialRule::darker}) {
            const auto row = std::ranges::find(rows, occlusion::truth_name(i, rule), &TruthRow::name);
            const double made = row == rows.end() ? at_2 : row->make({frame, before}).at("occlusion").at(0, 0).x;
            const double visible = traced_visibility({frame, before}, occlusion::radii[i]).at(0, 0).x;
            EXPECT_DOUBLE_EQ(made, rule == MaterialRule::product ? visible : std::min(1., visible / .9));
        }
}

TEST(occlusion_of, is_visibility_or_what_makes_the_product_with_the_material_the_darker_of_both) {
    EXPECT_EQ(occlusion_of(.4, .5, MaterialRule::product), .4);
    EXPECT_EQ(.5 * occlusion_of(.4, .5, MaterialRule::darker), .4);
    EXPECT_EQ(.5 * occlusion_of(.8, .5, MaterialRule::darker), .5);
    EXPECT_EQ(occlusion_of(.4, 0, MaterialRule::darker), .4) << "black whatever it is";
}

TEST(occlusion_judge, tells_the_size_the_sign_and_what_ambient_light_makes_of_an_error) {
    Frame frame = tiny::frame(4, 1);
    frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(1)};
    ImageSet before{{"surface_normal", ReferenceImage(4, 1, 1, {0, 0, -1, 1})},
                    {"surface_color", ReferenceImage(4, 1, 1, {1, 1, 1, 1})},
                    {"surface_material", ReferenceImage(4, 1, 1, {double(LightingModel::lambert), 0, 1, 0})}};
    before.at("surface_normal").at(3, 0).w = 0;  // no surface
    before.at("surface_color").at(1, 0) = {0, 0, 0, 1};
    ReferenceImage truth(4, 1, 1, glm::dvec4(.5, 0, 0, 1)), got = truth;
    got.at(0, 0).x = .8;
    got.at(1, 0).x = .1;
    got.at(3, 0).x = 7;
    const auto metrics = occlusion_judge({{"occlusion", got}}, {{"occlusion", truth}}, {frame, before});
    ASSERT_EQ(metrics.size(), 4u);
    EXPECT_NEAR(metrics[0].value, std::sqrt((.09 + .16) / 3), 1e-12) << metrics[0].name;
    EXPECT_NEAR(metrics[1].value, .4, 1e-12) << metrics[1].name;
    EXPECT_NEAR(metrics[2].value, -.1 / 3, 1e-12) << metrics[2].name;
    EXPECT_NEAR(metrics[3].value, .3 / std::sqrt(.5), 1e-12) << "black surfaces show no ambient light";
    got.at(0, 0).x = NAN;
    for (const Metric& metric : occlusion_judge({{"occlusion", got}}, {{"occlusion", truth}}, {frame, before}))
        EXPECT_EQ(metric.value, HUGE_VAL) << metric.name;
    truth = ReferenceImage(4, 1, 1, glm::dvec4(0, 0, 0, 1));
    got = ReferenceImage(4, 1, 1, glm::dvec4(.5, 0, 0, 1));
    EXPECT_NEAR(occlusion_judge({{"occlusion", got}}, {{"occlusion", truth}}, {frame, before})[3].value, .5 * std::sqrt(2. / 3),
                1e-12)
        << "where the truth is dark everywhere the error is the light's own";
}

}  // namespace strata
