// Facts of whole lookups: a camera 10 m above the ground y = 0 looks down, maps are drawn by solving for planes by hand.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/reference/image.h"
#include "passes/scene/scene_facts.h"
#include "passes/shadows/judge.h"
#include "passes/shadows/shadows.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/ground_from_above.h"

namespace strata::shadows {

Technique pcf();

namespace {

constexpr double height = height_above_ground;
constexpr double degree = 3.14159265358979323846 / 180;
constexpr std::uint32_t width = 256, rows = 4;

// 8 m of the ground.
Frame ground(double angle) {
    Frame frame = ground_from_above(width, rows, 8);
    add_slanted_sun(frame, angle, 512);
    return frame;
}

// A part of a horizontal plane: |x|, |z| <= half.
struct Plate {
    double y, half;
};

// Depth in the map of where the ray of texel (x, y) meets the plate.
std::optional<double> depth_of(const Frame& frame, const ShadowView& view, glm::dvec2 uv, const Plate& plate) {
    const glm::dmat4 to_view = glm::inverse(view.view_to_map);
    const auto at = [&](double depth) {
        const glm::dvec4 p = to_view * glm::dvec4(uv, depth, 1);
        return frame.view.origin + glm::transpose(frame.view.to_view) * glm::dvec3(p) / p.w;
    };
    const glm::dvec3 near = at(1), step = at(0.5) - near;
    const glm::dvec3 hit = near + step * ((plate.y - near.y) / step.y);
    if (std::max(std::abs(hit.x), std::abs(hit.z)) > plate.half) return std::nullopt;
    const glm::dvec4 m = view.view_to_map * glm::dvec4(frame.view.to_view * (hit - frame.view.origin), 1);
    return m.z / m.w;
}

ReferenceImage draw_maps(const Frame& frame, const std::vector<Plate>& plates) {
    const auto views = shadow_views(frame);
    ReferenceImage maps(views[0].size, views[0].size, static_cast<std::uint32_t>(views.size()), glm::dvec4(0, 0, 0, 1));
    for (std::uint32_t slot = 0; slot < views.size(); ++slot) {
        for (std::uint32_t i = 0; i < maps.width * maps.height; ++i) {
            const glm::dvec2 uv = (glm::dvec2(i % maps.width, i / maps.width) + 0.5) / double(views[slot].size);
            double& nearest = maps.at(i % maps.width, i / maps.width, slot).x;
            for (const Plate& plate : plates) {
                nearest = std::max(nearest, double(float(depth_of(frame, views[slot], uv, plate).value_or(0))));
            }
        }
    }
    return maps;
}

ImageSet before(const Frame& frame, ReferenceImage maps) {
    const double device_depth = double(frame.view.near) / height;
    ReferenceImage normal(width, rows, 1, glm::dvec4(0, 0, -1, height));
    return {{"shadow_maps", std::move(maps)},
            {"depth_layers", ReferenceImage(width, rows, 1, glm::dvec4(device_depth, 0, 0, 1))},
            {"surface_normal", std::move(normal)}};
}

ReferenceImage visibility(const Frame& frame, const ImageSet& input, double kernel, double slope_limit) {
    const Technique technique = pcf();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("kernel", kernel));
    EXPECT_TRUE(settings.set("slope_limit", slope_limit));
    return technique.model({frame, input}, settings).at("visibility");
}

double world_x(double pixel) { return (pixel - width / 2.0) * 8 / width; }

// Where the visibility of row 2 passes `level` between pixel centers, world x, left to right.
std::vector<double> crossings(const ReferenceImage& image, double level) {
    std::vector<double> found;
    for (std::uint32_t x = 0; x + 1 < width; ++x) {
        const double a = image.at(x, 2).x, b = image.at(x + 1, 2).x;
        if ((a < level) != (b < level)) found.push_back(world_x(x + 0.5 + (level - a) / (b - a)));
    }
    return found;
}

FrameImages images_of(const SceneFacts& facts) {
    return {.recorded = &facts.frame(), .facts = &facts, .extent = {width, rows}, .makes_unused = true};
}

DrawList one_caster(Graph& graph) {
    return {.commands = graph.create("commands", 20), .indices = graph.create("indices", 12), .count = 1};
}

}  // namespace

TEST(pcf, moves_the_shadow_of_a_square_by_its_height_times_the_tangent) {
    for (const double angle : {0.0, 20 * degree, 35 * degree}) {
        const Frame frame = ground(angle);
        const double texel = shadow_views(frame)[0].texel, along = texel / std::cos(angle);
        const ReferenceImage image = visibility(frame, before(frame, draw_maps(frame, {{3, 1}, {0, 100}})), 1, 4);
        const auto edges = crossings(image, 0.5);
        ASSERT_EQ(edges.size(), 2u);
        EXPECT_NEAR(edges[0], -1 + 3 * std::tan(angle), 0.5 * along + 8.0 / width);
        EXPECT_NEAR(edges[1], 1 + 3 * std::tan(angle), 0.5 * along + 8.0 / width);
        // 4 x 4 texels cross an edge as a ramp of 3 texels; levels of 1/6 and 5/6 are 2 texels apart.
        const auto low = crossings(image, 1.0 / 6), high = crossings(image, 5.0 / 6);
        EXPECT_NEAR(high[1] - low[1], 2 * along, 0.5 * along);
    }
}

TEST(pcf, leaves_a_plane_without_acne_from_0_to_80_degrees) {
    for (double angle = 0; angle <= 80; angle += 10) {
        const Frame frame = ground(angle * degree);
        const ImageSet input = before(frame, draw_maps(frame, {{0, 1000}}));
        for (const double kernel : {0, 1, 2}) {
            const ReferenceImage image = visibility(frame, input, kernel, 6);
            EXPECT_TRUE(std::all_of(image.texels.begin(), image.texels.end(), [](const auto& v) { return v.x == 1; }))
                << angle << " degrees, kernel " << kernel;
        }
    }
}

TEST(pcf, without_a_slope_bias_has_acne) {
    const Frame frame = ground(60 * degree);
    const ReferenceImage image = visibility(frame, before(frame, draw_maps(frame, {{0, 1000}})), 2, 0);
    EXPECT_TRUE(std::any_of(image.texels.begin(), image.texels.end(), [](const auto& v) { return v.x < 1; }));
}

TEST(pcf, is_exactly_0_under_a_roof_and_exactly_1_beyond_the_shadow_distance) {
    Frame frame = ground(20 * degree);
    const auto all = [](const ReferenceImage& image, double value) {
        return std::all_of(image.texels.begin(), image.texels.end(), [=](const auto& v) { return v.x == value; });
    };
    const ImageSet input = before(frame, draw_maps(frame, {{3, 1000}}));
    EXPECT_TRUE(all(visibility(frame, input, 2, 4), 0));
    frame.sun.shadow_distance = 9;
    EXPECT_TRUE(all(visibility(frame, input, 2, 4), 1));
}

TEST(pcf, fades_to_lit_over_the_last_tenth_of_the_shadow_distance) {
    Frame frame = ground(20 * degree);
    frame.sun.shadow_distance = 10.5f;  // the ground is .5 m before the end of a split from .1 m to 10.5 m
    const ReferenceImage image = visibility(frame, before(frame, draw_maps(frame, {{3, 1000}})), 1, 4);
    EXPECT_NEAR(image.at(100, 2).x, 1 - 0.5 / (0.1 * 10.4), 1e-6);
}

TEST(pcf, shades_under_a_spot_by_similar_triangles) {
    Frame frame = ground(0);
    frame.sun.irradiance = {};
    frame.lights = {{.type = LightType::round_spot,
                     .position = {0, 6, 0},
                     .range = 20,
                     .outer_angle = 0.9f,
                     .shadow = {.casts = true, .map_size = 512, .bias = 0.01f}}};
    const ReferenceImage image = visibility(frame, before(frame, draw_maps(frame, {{3, 1}, {0, 100}})), 1, 4);
    const auto edges = crossings(image, 0.5);  // half way down from the light: twice as large on the ground
    const double texel = shadow_views(frame)[0].texel * 6;
    ASSERT_EQ(edges.size(), 2u);
    EXPECT_NEAR(edges[0], -2, 0.5 * texel + 8.0 / width);
    EXPECT_NEAR(edges[1], 2, 0.5 * texel + 8.0 / width);
}

TEST(pcf, draws_each_map_into_the_corner_of_its_own_layer) {
    Frame frame = ground(0);
    frame.sun.cascades = 3;
    frame.lights = {{.type = LightType::round_spot, .shadow = {.casts = true, .map_size = 256}}};
    Graph graph;
    const SceneFacts facts(frame);
    FrameImages images = images_of(facts);
    images.casters = one_caster(graph);
    const Technique technique = pcf();
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_EQ(graph.shape(images.shadow_maps).layers, 4u);
    EXPECT_EQ(graph.shape(images.shadow_maps).extent.width, 512u);
    ASSERT_EQ(graph.steps().size(), 5u);  // a clear and four maps
    EXPECT_EQ(std::get<DrawWork>(graph.steps().back().work).viewport->width, 256u);
    EXPECT_EQ(graph.steps().back().attachments.front().part.layer, 3u);
}

TEST(pcf, draws_maps_that_share_a_layer_into_their_squares_of_it) {
    Frame frame = ground(0);
    frame.sun.irradiance = {};
    frame.lights = {{.type = LightType::omni, .position = {0, 2, 0}, .range = 1, .shadow = {.casts = true, .map_size = 256}}};
    Graph graph;
    const SceneFacts facts(frame);
    FrameImages images = images_of(facts);
    images.casters = one_caster(graph);
    const Technique technique = pcf();
    Settings settings(technique.params);
    ASSERT_TRUE(settings.set("allocation", "need"));
    technique.declare(graph, images, settings);
    // 320 pixels per slope: 1 m of range 8 m away is 2 / sqrt(63) of them, 81.
    EXPECT_EQ(graph.shape(images.shadow_maps).layers, 6u);
    EXPECT_EQ(graph.shape(images.shadow_maps).extent.width, 128u);
    frame.lights.push_back(frame.lights[0]);
    frame.lights[1].range = 0.2f;  // 16 pixels
    Graph two;
    const SceneFacts facts_of_two(frame);
    images = images_of(facts_of_two);
    images.casters = one_caster(two);
    technique.declare(two, images, settings);
    EXPECT_EQ(two.shape(images.shadow_maps).layers, 7u);  // six maps of 32 texels share the seventh
    ASSERT_EQ(two.steps().size(), 13u);
    const Step& last = two.steps().back();
    EXPECT_EQ(last.attachments.front().part.layer, 6u);
    EXPECT_EQ(std::get<DrawWork>(last.work).viewport->width, 128u);
    CastPush push{};
    std::memcpy(&push, last.push.data(), sizeof(push));
    EXPECT_EQ(push.record, 12u + 11u) << "records of need follow those of own";
    EXPECT_EQ(push.viewport, 128u);
}

TEST(pcf, does_nothing_where_no_light_has_a_map) {
    Frame frame = ground(0);
    frame.sun.shadow.casts = false;
    Graph graph;
    const SceneFacts facts(frame);
    FrameImages images = images_of(facts);
    const Technique technique = pcf();
    const Settings settings(technique.params);
    technique.declare(graph, images, settings);
    technique.at_other_stages.front().declare(graph, images, settings);
    EXPECT_TRUE(graph.steps().empty());
    EXPECT_FALSE(images.visibility);
}

}  // namespace strata::shadows
