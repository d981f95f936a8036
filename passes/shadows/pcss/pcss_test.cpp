// Facts of soft shadows (docs/algorithms/lighting.md 6), computable by hand: taps, penumbrae, and whole lookups on the ground y =
// 0, which a camera 10 m above looks down on.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "passes/shadows/lookup.h"
#include "passes/shadows/pcss/soft_kernel.h"
#include "passes/shadows/shadow_map_params.h"
#include "passes/shadows/truth.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/ground_from_above.h"
#include "tests/support/traced_maps.h"

namespace strata::shadows {

Technique pcss();

namespace {

constexpr double height = height_above_ground;
constexpr std::uint32_t width = 256, rows = 4;

Frame ground(double wide) {
    Frame frame = ground_from_above(width, rows, wide);
    frame.materials.emplace_back();
    return frame;
}

struct Rectangle {
    double y = 0, left = -50, right = 50;  ///< from z = -50 to 50
};

void add_plate(Frame& frame, const Rectangle& at) {
    Mesh plate;
    for (const auto& [x, z] : {std::pair{at.left, -50.}, {at.right, -50.}, {at.right, 50.}, {at.left, 50.}}) {
        plate.positions.emplace_back(x, at.y, z);
        plate.normals.emplace_back(0, 1, 0);
    }
    plate.indices = {0, 1, 2, 0, 2, 3};
    frame.draws.push_back({.mesh = static_cast<std::uint32_t>(frame.meshes.size())});
    frame.meshes.push_back(plate);
}

Light soft_light(LightType type, double source_radius) {
    return {.type = type,
            .position = {0, 6, 0},
            .range = 20,
            .source_radius = float(source_radius),
            .outer_angle = 0.9f,
            .shadow = {.casts = true, .map_size = 512, .bias = 0.01f, .soft = true}};
}

void add_sun(Frame& frame, double angle, double angular_radius) {
    frame.sun.direction = {float(std::sin(angle)), float(-std::cos(angle)), 0};
    frame.sun.irradiance = {1, 1, 1};
    frame.sun.angular_radius = float(angular_radius);
    frame.sun.cascades = 1;
    frame.sun.shadow_distance = 20;
    frame.sun.shadow = {.casts = true, .map_size = 512, .bias = 0.01f, .soft = true};
}

/// The ground is what is seen, whatever lies above it.
ImageSet before(const Frame& frame, ReferenceImage maps) {
    const double device_depth = double(frame.view.near) / height;
    return {{"shadow_maps", std::move(maps)},
            {"depth_layers", ReferenceImage(width, rows, 1, glm::dvec4(device_depth, 0, 0, 1))},
            {"surface_normal", ReferenceImage(width, rows, 1, glm::dvec4(0, 0, -1, height))}};
}

struct Pictures {
    ReferenceImage soft, traced;
};

Pictures pictures(const Frame& frame, std::string_view name = "noise", double value = 0) {
    const ImageSet images = before(frame, traced_maps(frame));
    const Technique technique = pcss();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set(name, value));
    return {technique.model({frame, images}, settings).at("visibility"), shadows_truth({frame, images}).at("visibility")};
}

/// Where row 2 first rises above a level, meters on the ground, by the picture's width.
double rises_above(const ReferenceImage& image, double level, double wide) {
    for (std::uint32_t x = 0; x + 1 < width; ++x) {
        const double a = image.at(x, 2).x, b = image.at(x + 1, 2).x;
        if (a < level && b >= level) return (x + 0.5 + (level - a) / (b - a) - width / 2.0) * wide / width;
    }
    ADD_FAILURE() << "nothing rises above " << level;
    return 0;
}

double width_10_90(const ReferenceImage& image, double wide) {
    return rises_above(image, 0.9, wide) - rises_above(image, 0.1, wide);
}

/// Of a disc of diameter 1 that a straight edge uncovers: the distance from 10 to 90 % of its area.
double disc_10_90() {
    const auto uncovered = [](double x) {  // -1..1 across
        return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
    };
    double low = 0, high = 1;
    while (high - low > 1e-12) (uncovered(0.5 * (low + high)) < 0.9 ? low : high) = 0.5 * (low + high);
    return low;
}

bool all(const ReferenceImage& image, double value) {
    return std::ranges::all_of(image.texels, [=](const glm::dvec4& v) { return v.x == value; });
}

}  // namespace

TEST(soft_taps, of_a_disc_of_eight_are_where_the_golden_angle_puts_them) {
    EXPECT_NEAR(glm::distance(disc_tap(0, 8, 0), glm::dvec2(0.25, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::distance(disc_tap(1, 8, 0), glm::dvec2(-0.31929, 0.292496)), 0, 1e-5);
    EXPECT_NEAR(glm::distance(disc_tap(2, 8, 0), glm::dvec2(0.048872, -0.556877)), 0, 1e-5);
}

TEST(soft_taps, see_half_of_a_half_plane_through_the_center) {
    for (const std::int64_t n : {8, 16, 32, 64}) {
        for (double angle = 0; angle < 6.28; angle += 0.1) {
            std::int64_t inside = 0;
            for (std::int64_t i = 0; i < n; ++i) inside += disc_tap(i, n, angle).x > 0 ? 1 : 0;
            EXPECT_LE(std::abs(inside - n / 2), n == 8 ? 1 : 2) << n << " taps turned by " << angle;
        }
    }
}

TEST(soft_taps, four_bilinear_ones_half_a_texel_apart_are_the_tent_of_three_texels) {
    ReferenceImage map(64, 64);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 32; ++x) map.at(x, y).x = 1;
    const auto tent = [&](double x) {
        double sum = 0;
        for (const glm::dvec2 step : {glm::dvec2(-0.5, -0.5), glm::dvec2(0.5, -0.5), glm::dvec2(-0.5, 0.5), glm::dvec2(0.5, 0.5)})
            sum += filter_map(map, {.size = 64, .u = glm::dvec2(x, 20.5) + step, .depth = 0.5}, 2).lit / 4;
        return sum;
    };
    EXPECT_EQ(tent(30.5), 0);
    EXPECT_EQ(tent(31.5), 0.25);
    EXPECT_EQ(tent(32.5), 0.75);
    EXPECT_EQ(tent(33.5), 1);
}

TEST(penumbra, grows_with_the_gap_by_similar_triangles) {
    EXPECT_EQ(penumbra(1, 10, 5), 1);
    EXPECT_EQ(penumbra(1, 10, 2), 4);
    EXPECT_EQ(penumbra(1, 10, 10), 0);
    EXPECT_NEAR(penumbra(1, 10, 10 - 1e-6), 1e-7, 1e-12);
    EXPECT_EQ(sun_penumbra(0.01, 30, 10), 0.2);
}

TEST(penumbra, is_measured_on_the_receiver_and_is_the_same_in_texels_there_and_on_the_blocker) {
    SoftLookup soft{.at = {.size = 512, .depth = 0.2 / 10}, .source = 0.1, .near = 0.2, .texel = 0.005};
    const double on_receiver = penumbra(0.1, 10, 5), on_blocker = 0.1 * (10 - 5) / 10.0;
    EXPECT_EQ(on_blocker / on_receiver, 5.0 / 10);  // the plane that a width by zR alone would mean
    EXPECT_NEAR(2 * disc_radius(soft, 0.2 / 5), on_receiver / (0.005 * 10), 1e-12);
    EXPECT_NEAR(2 * disc_radius(soft, 0.2 / 5), on_blocker / (0.005 * 5), 1e-12);
}

TEST(penumbra, is_one_texel_at_least_and_64_at_most) {
    SoftLookup soft{.at = {.size = 512, .depth = 0.02}, .source = 0.1, .near = 0.2, .texel = 0.005};
    EXPECT_EQ(disc_radius(soft, 0.0200001), 0.5);
    EXPECT_EQ(disc_radius(soft, 1), 32);
}

TEST(pcss, makes_penumbrae_as_wide_as_the_lights_disc_does) {
    struct Case {
        double gap, radius;
    };
    for (const LightType type : {LightType::round_spot, LightType::omni}) {
        for (const Case& c : {Case{0.5, 1}, {1, 0.6}, {2, 0.3}, {5, 0.1}}) {
            const double full = 2 * c.radius * c.gap / (6 - c.gap), wide = 4 * full;
            Frame frame = ground(wide);
            add_plate(frame, {.y = c.gap, .right = 0});
            frame.lights = {soft_light(type, c.radius)};
            const auto [soft, traced] = pictures(frame);
            const double truth = width_10_90(traced, wide), texel = shadow_views(frame)[0].texel * 6;
            EXPECT_NEAR(truth, disc_10_90() * full, 0.03 * full) << c.gap << " m";
            EXPECT_NEAR(width_10_90(soft, wide), truth, 0.15 * truth) << c.gap << " m";
            EXPECT_NEAR(rises_above(soft, 0.5, wide), 0, 0.5 * texel + wide / width) << c.gap << " m";
        }
    }
}

TEST(pcss, makes_the_suns_penumbrae_wider_with_the_gap_alone) {
    for (const double gap : {1, 2, 4}) {
        const double full = 2 * std::tan(0.05) * gap, wide = 4 * full;
        Frame frame = ground(wide);
        add_plate(frame, {.y = gap, .right = 0});
        add_sun(frame, 0, 0.05);
        const auto [soft, traced] = pictures(frame);
        EXPECT_NEAR(width_10_90(traced, wide), disc_10_90() * full, 0.03 * full) << gap;
        EXPECT_NEAR(width_10_90(soft, wide), disc_10_90() * full, 0.15 * full) << gap;
    }
}

TEST(pcss, leaves_the_edge_of_a_slanted_suns_shadow_where_it_is) {
    for (const double angle : {0.0, 0.35, 0.6}) {
        Frame frame = ground(4);
        add_plate(frame, {.y = 3, .right = -3 * std::tan(angle)});
        add_sun(frame, angle, 0.03);
        const double along = shadow_views(frame)[0].texel / std::cos(angle);
        EXPECT_NEAR(rises_above(pictures(frame).soft, 0.5, 4), 0, 0.5 * along + 4.0 / width) << angle;
    }
}

TEST(pcss, leaves_a_plane_without_acne_from_0_to_80_degrees_however_wide_the_kernel) {
    for (int degrees = 0; degrees <= 80; degrees += 20) {
        Frame frame = ground(8);
        add_plate(frame, {});
        add_sun(frame, degrees * std::numbers::pi / 180, 0.2);
        EXPECT_TRUE(all(pictures(frame).soft, 1)) << degrees << " degrees";
    }
}

TEST(pcss, is_exactly_0_where_every_tap_is_blocked_and_exactly_1_where_none_is) {
    for (const double noise : {0, 1}) {
        Frame frame = ground(2);
        add_plate(frame, {});
        frame.lights = {soft_light(LightType::omni, 0.1)};
        EXPECT_TRUE(all(pictures(frame, "noise", noise).soft, 1));
        add_plate(frame, {.y = 1});
        EXPECT_TRUE(all(pictures(frame, "noise", noise).soft, 0));
    }
}

TEST(pcss, leaks_less_than_two_texels_under_a_lip_of_20_cm) {
    Frame frame = ground(2);
    add_plate(frame, {});
    add_plate(frame, {.y = 0.2, .right = 0});
    add_sun(frame, std::numbers::pi / 4, 0.00465);
    const double texel = shadow_views(frame)[0].texel * std::sqrt(2.0);
    EXPECT_NEAR(rises_above(pictures(frame).soft, 0.5, 2), 0.2, 2 * texel);
}

TEST(pcss, shades_across_the_seam_of_two_faces_as_if_there_were_none) {
    Frame frame = ground(2);
    frame.view.origin.x = 6;  // over the seam of the faces -y and +x: as far to the side of the light as below it
    add_plate(frame, {.y = 3, .left = 2.9, .right = 3.1});
    frame.lights = {soft_light(LightType::omni, 0.03)};
    const auto [soft, traced] = pictures(frame);
    EXPECT_NEAR(rises_above(soft, 0.5, 2), 0.2, 0.5 * shadow_views(frame)[0].texel * 6 + 2.0 / width);
    EXPECT_EQ(soft.at(width / 2, 2).x, 0);
    double most = 0;
    for (std::uint32_t x = 0; x < width; ++x) most = std::max(most, std::abs(soft.at(x, 2).x - traced.at(x, 2).x));
    EXPECT_LT(most, 0.3);
}

TEST(pcss, filters_a_light_that_is_not_soft_with_the_fixed_kernel) {
    Frame frame = ground(8);
    add_plate(frame, {.y = 2, .right = 0});
    frame.lights = {soft_light(LightType::round_spot, 0.3)};
    frame.lights[0].shadow.soft = false;
    const ImageSet images = before(frame, traced_maps(frame));
    const Technique technique = pcss();
    const Settings settings(technique.params);
    const ReferenceImage fixed =
        visibility_model({frame, images}, settings.as<ShadowMapParams>().filter, fixed_lookup).at("visibility");
    EXPECT_EQ(pictures(frame).soft.texels, fixed.texels);
    EXPECT_FALSE(all(fixed, 1));
}

}  // namespace strata::shadows
