// Facts of lookups under a sun that is 2 to 7 degrees high, over solids that rays meet in closed form: ground, wall, plate and
// sphere.
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "passes/reference/image.h"
#include "passes/reference/shade.h"
#include "passes/scene/shadow_views.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/ground_from_above.h"

namespace strata::shadows {

Technique pcf();

namespace low_sun {
namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double radius = 0.5;

struct Line {
    glm::dvec3 from, along;
};
/// Where a line meets a solid first, in lengths of `along`.
using Solid = std::function<std::optional<double>(const Line&)>;

std::optional<double> ground(const Line& line) { return -line.from.y / line.along.y; }

// Stands on the ground along z, 1 m high.
std::optional<double> wall(const Line& line) {
    const double t = -line.from.x / line.along.x, y = line.from.y + t * line.along.y;
    return y >= 0 && y <= 1 ? std::optional(t) : std::nullopt;
}

// Lies half a meter above the ground, 2 m long.
std::optional<double> plate(const Line& line) {
    const double t = (0.5 - line.from.y) / line.along.y;
    return std::abs(line.from.x + t * line.along.x) <= 1 ? std::optional(t) : std::nullopt;
}

// Rests on the ground.
std::optional<double> sphere(const Line& line) {
    const glm::dvec3 away = line.from - glm::dvec3(0, radius, 0);
    const double a = glm::dot(line.along, line.along), b = glm::dot(away, line.along),
                 inside = b * b - a * (glm::dot(away, away) - radius * radius);
    return inside >= 0 ? std::optional((-b - std::sqrt(inside)) / a) : std::nullopt;
}

// What a camera 10 m above the ground sees `wide` meters of, the sun along +x.
struct Scene {
    Frame frame;
    ImageSet before;

    Scene(double elevation, double wide, glm::uvec2 extent, const std::vector<Solid>& casters)
        : frame(ground_from_above(extent.x, extent.y, wide)) {
        add_slanted_sun(frame, (90 - elevation) * degree, 1024);
        before = {{"shadow_maps", map_of(casters)},
                  {"depth_layers", ReferenceImage(extent.x, extent.y)},
                  {"surface_normal", ReferenceImage(extent.x, extent.y)}};
        for (std::uint32_t i = 0; i < extent.x * extent.y; ++i) receive(i, height_above_ground, {0, 1, 0});
    }

    /// Pixel i sees a surface at a view depth.
    void receive(std::uint32_t i, double z, const glm::dvec3& world_normal) {
        before.at("depth_layers").texels[i].x = double(frame.view.near) / z;
        before.at("surface_normal").texels[i] = glm::dvec4(frame.view.to_view * world_normal, z);
    }

    ReferenceImage visibility(std::optional<double> slope_limit = {}, double kernel = 1) const {
        const Technique technique = pcf();
        Settings settings(technique.params);
        EXPECT_TRUE(settings.set("kernel", kernel));
        if (slope_limit) {
            EXPECT_TRUE(settings.set("slope_limit", *slope_limit));
        }
        return technique.model({frame, before}, settings).at("visibility");
    }

private:
    ReferenceImage map_of(const std::vector<Solid>& casters) const {
        const ShadowView view = shadow_views(frame)[0];
        const glm::dmat4 to_view = glm::inverse(view.view_to_map);
        const auto world = [&](const glm::dvec2& uv, double depth) {
            return frame.view.origin + glm::transpose(frame.view.to_view) * glm::dvec3(to_view * glm::dvec4(uv, depth, 1));
        };
        ReferenceImage map(view.size, view.size, 1, glm::dvec4(0, 0, 0, 1));
        for (std::uint32_t i = 0; i < view.size * view.size; ++i) {
            const glm::dvec2 uv = (glm::dvec2(i % view.size, i / view.size) + 0.5) / double(view.size);
            const glm::dvec3 near = world(uv, 1);
            for (const Solid& caster : casters)
                if (const auto t = caster({near, world(uv, 0) - near}))
                    map.texels[i].x = std::max(map.texels[i].x, double(float(1 - *t)));
        }
        return map;
    }
};

constexpr std::uint32_t width = 384;
constexpr double wide = 24, pixel = wide / width;

Scene on_the_ground(double elevation, const Solid& caster) { return {elevation, wide, {width, 4}, {ground, caster}}; }

double mean(const ReferenceImage& image) {
    double sum = 0;
    for (const glm::dvec4& texel : image.texels) sum += texel.x;
    return sum / double(image.texels.size());
}

/// From world x on, where the ground is less than half lit, or half lit again.
double next_crossing(const ReferenceImage& image, double from, bool into_shadow) {
    for (auto x = std::uint32_t(std::ceil((from + wide / 2) / pixel)); x < width; ++x)
        if ((image.at(x, 2).x < 0.5) == into_shadow) return (x + 0.5) * pixel - wide / 2;
    return wide / 2;
}

}  // namespace

TEST(LowSun, LeavesFlatGroundLitDownTo3Degrees) {
    for (const double elevation : {7., 5., 3.}) {
        const Scene scene = on_the_ground(elevation, ground);
        for (const double kernel : {0., 1., 2.})
            EXPECT_GT(mean(scene.visibility({}, kernel)), 0.98) << elevation << " degrees, kernel " << kernel;
        EXPECT_LT(mean(scene.visibility(4)), mean(scene.visibility()) - 0.015) << elevation;
    }
}

// The shadow of a wall begins at its foot, that of a sphere at its tangent through the ground: -r tan(elevation / 2).
TEST(LowSun, DetachesNoShadowFartherThanTheMovedReceiverDoes) {
    std::string gaps;
    for (const double elevation : {7., 3.}) {
        const double tangent_point = -radius * std::tan(0.5 * elevation * degree);
        for (const auto& [caster, begin] : {std::pair<Solid, double>{wall, 0}, {sphere, tangent_point}}) {
            const Scene scene = on_the_ground(elevation, caster);
            const double gap = next_crossing(scene.visibility(), begin, true) - begin,
                         moved = next_crossing(scene.visibility(4), begin, true) - begin;
            gaps += std::to_string(gap) + " was " + std::to_string(moved) + ", ";
            EXPECT_LE(gap, moved + 1.5 * pixel) << elevation;
        }
    }
    RecordProperty("gaps", gaps);
}

TEST(LowSun, PutsTheShadowOfAPlateWhereItFalls) {
    const double elevation = 7, shift = 0.5 / std::tan(elevation * degree);
    const Scene scene = on_the_ground(elevation, plate);
    const double half_texel = 0.5 * shadow_views(scene.frame)[0].texel / std::sin(elevation * degree);
    const ReferenceImage image = scene.visibility();
    const double begin = next_crossing(image, 0.5 * shift, true);
    EXPECT_NEAR(begin, shift - 1, half_texel + pixel);
    EXPECT_NEAR(next_crossing(image, begin, false), shift + 1, half_texel + pixel);
}

TEST(LowSun, LeavesNoMoreAcneOnASphereThanTheMovedReceiverDoes) {
    for (const double elevation : {7., 3.}) {
        constexpr std::uint32_t edge = 96;
        Scene scene(elevation, 1.2, {edge, edge}, {ground, sphere});
        std::vector<std::uint32_t> lit;
        for (std::uint32_t i = 0; i < edge * edge; ++i) {
            const glm::dvec3 to =
                glm::transpose(scene.frame.view.to_view) * pixel_ray(scene.frame, i % edge + 0.5, i / edge + 0.5);
            const auto z = sphere({scene.frame.view.origin, to});
            if (!z) continue;
            const glm::dvec3 normal = (scene.frame.view.origin + *z * to - glm::dvec3(0, radius, 0)) / radius;
            scene.receive(i, *z, normal);
            if (glm::dot(normal, -glm::dvec3(scene.frame.sun.direction)) > 0) lit.push_back(i);
        }
        const auto darkness = [&](const ReferenceImage& image) {
            double sum = 0;
            for (const std::uint32_t i : lit) sum += 1 - image.texels[i].x;
            return sum / double(lit.size());
        };
        const double dark = darkness(scene.visibility()), moved = darkness(scene.visibility(4));
        EXPECT_LE(dark, moved) << elevation;
        EXPECT_LT(dark, 0.01) << elevation;
    }
}

}  // namespace low_sun
}  // namespace strata::shadows
