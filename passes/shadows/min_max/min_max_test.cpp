// Facts of min-max shadow maps: which steps they need, and how receivers that follow planes are lit. Bounds have facts of their
// own (passes/shadows/bounds).
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/reference/image.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/ground_from_above.h"

namespace strata::shadows {

Technique min_max();

namespace {

constexpr double height = height_above_ground;
constexpr double degree = 3.14159265358979323846 / 180;
constexpr std::uint32_t width = 128, rows = 4;

// 8 m of the ground.
Frame ground(double angle) {
    Frame frame = ground_from_above(width, rows, 8);
    add_slanted_sun(frame, angle, 256);
    return frame;
}

/// The map of the ground alone, whose depth is affine, and of a roof at y = 3 over x < 0.
ReferenceImage map_of(const Frame& frame, bool has_roof) {
    const ShadowView view = shadow_views(frame)[0];
    const glm::dmat4 to_view = glm::inverse(view.view_to_map);
    const auto world = [&](const glm::dvec2& uv, double depth) {
        return frame.view.origin + glm::transpose(frame.view.to_view) * glm::dvec3(to_view * glm::dvec4(uv, depth, 1));
    };
    ReferenceImage map(view.size, view.size, 1, glm::dvec4(0, 0, 0, 1));
    for (std::uint32_t i = 0; i < view.size * view.size; ++i) {
        const glm::dvec2 uv = (glm::dvec2(i % view.size, i / view.size) + 0.5) / double(view.size);
        const glm::dvec3 far = world(uv, 0), step = world(uv, 1) - far;
        double depth = -far.y / step.y;
        if (has_roof && (far + (3 - far.y) / step.y * step).x < 0) depth = (3 - far.y) / step.y;
        map.texels[i].x = double(float(depth));
    }
    return map;
}

ReferenceImage visibility(const Frame& frame, ReferenceImage map, std::string_view form) {
    const ImageSet input = {{"shadow_maps", std::move(map)},
                            {"depth_layers", ReferenceImage(width, rows, 1, glm::dvec4(double(frame.view.near) / height))},
                            {"surface_normal", ReferenceImage(width, rows, 1, glm::dvec4(0, 0, -1, height))}};
    const Technique technique = min_max();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("form", form));
    EXPECT_TRUE(settings.set("kernel", "8x8"));
    EXPECT_TRUE(settings.set("slope_limit", 0.0));
    return technique.model({frame, input}, settings).at("visibility");
}

double lit_share(const ReferenceImage& image) {
    return double(std::ranges::count(image.texels, 1.0, [](const glm::dvec4& v) { return v.x; })) / double(image.texels.size());
}

/// Names of the steps behind the G-buffer.
std::vector<std::string> steps_of(std::string_view form, std::string_view kernel, Shape& bounds) {
    Frame frame = ground(0);
    frame.lights = {{.type = LightType::round_spot, .shadow = {.casts = true, .map_size = 256}}};
    const SceneFacts facts(frame);
    Graph graph;
    FrameImages images{.recorded = &facts.frame(), .facts = &facts, .extent = {width, rows}, .makes_unused = true};
    const Technique technique = min_max();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("form", form));
    EXPECT_TRUE(settings.set("kernel", kernel));
    technique.declare(graph, images, settings);
    const std::size_t before = graph.steps().size();
    technique.at_other_stages.front().declare(graph, images, settings);
    bounds = graph.shape(images.shadow_bounds);
    std::vector<std::string> names;
    for (const Step& step : graph.steps().subspan(before))
        if (!step.shaders.empty()) names.push_back(step.name.substr(step.name.rfind('/') + 1));
    return names;
}

}  // namespace

TEST(min_max, builds_bounds_of_every_map_and_asks_them) {
    using testing::ElementsAre;
    Shape bounds;
    EXPECT_THAT(steps_of("block", "4x4", bounds), ElementsAre("extremes.comp", "extremes.comp", "filter.comp"));
    EXPECT_EQ(bounds.format, Format::rg32f);
    EXPECT_EQ(bounds.extent.width, 64u);
    EXPECT_EQ(bounds.layers, 2u);
    EXPECT_THAT(steps_of("overlapping", "2x2", bounds), ElementsAre("extremes.comp", "extremes.comp", "filter.comp"));
    EXPECT_THAT(steps_of("overlapping", "8x8", bounds),
                ElementsAre("extremes.comp", "extremes.comp", "join.comp", "join.comp", "filter.comp"))
        << "windows of 12 texels are made of 3 x 3 blocks of 4";
    EXPECT_THAT(steps_of("hierarchical", "8x8", bounds),
                ElementsAre("extremes.comp", "extremes.comp", "halve.comp", "halve.comp", "filter.comp"));
    EXPECT_EQ(bounds.extent.width, 128u + 64u);
    EXPECT_EQ(bounds.extent.height, 128u);
    EXPECT_THAT(steps_of("slab", "4x4", bounds), ElementsAre("slabs.comp", "slabs.comp", "filter.comp"));
    EXPECT_EQ(bounds.format, Format::rgba32f);
}

TEST(min_max, with_planes_lights_tilted_ground_that_other_forms_leave_with_acne) {
    const Frame frame = ground(60 * degree);
    EXPECT_EQ(lit_share(visibility(frame, map_of(frame, false), "plane")), 1);
    EXPECT_LT(lit_share(visibility(frame, map_of(frame, false), "slab")), 0.5);
}

TEST(min_max, with_planes_shades_under_a_roof_as_other_forms_do) {
    const Frame frame = ground(30 * degree);
    const ReferenceImage plane = visibility(frame, map_of(frame, true), "plane");
    const double shadow_end = 3 * std::tan(30 * degree);
    for (std::uint32_t x = 0; x < width; ++x) {
        const double world_x = (x + 0.5 - width / 2.0) * 8 / width;
        if (std::abs(world_x - shadow_end) < 0.8) continue;
        EXPECT_EQ(plane.at(x, 2).x, world_x < shadow_end ? 0 : 1) << world_x;
    }
}

TEST(min_max, does_nothing_where_no_light_has_a_map) {
    Frame frame = ground(0);
    frame.sun.shadow.casts = false;
    Graph graph;
    const SceneFacts facts(frame);
    FrameImages images{.recorded = &facts.frame(), .facts = &facts, .extent = {width, rows}, .makes_unused = true};
    const Technique technique = min_max();
    const Settings settings(technique.params);
    technique.declare(graph, images, settings);
    technique.at_other_stages.front().declare(graph, images, settings);
    EXPECT_TRUE(graph.steps().empty());
    EXPECT_FALSE(images.shadow_bounds);
}

}  // namespace strata::shadows
