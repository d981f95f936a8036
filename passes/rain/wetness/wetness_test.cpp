// Facts of wet surfaces, by hand: where the rain map lies, what colors become, what stays dry, how waves move.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/view.h"
#include "passes/rain/formulas.h"
#include "passes/rain/truth.h"
#include "passes/rain/wetness/rain_map.h"
#include "passes/rain/wetness/weather.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::rain {

Technique wetness();

namespace {

Frame rainy(glm::dvec3 eye = {0, 2, 0}, glm::dvec3 ahead = {1, -0.3, -2}) {
    Frame frame;
    frame.view = look_at({.eye = eye, .target = eye + ahead, .vertical_fov = 0.9, .width = 64, .height = 36});
    frame.rain = {.intensity = 1, .wetness = 1};
    return frame;
}

// --- the map ----------------------------------------------------------------------------------------------------------------

/// Where in its texel a point of the world lies, by the floats that the device has.
glm::dvec2 place_in_texel(const Frame& frame, const RainMap& map, const glm::dvec3& world) {
    const glm::vec4 p(frame.view.to_view * (world - frame.view.origin), 1);
    const glm::dvec2 texel(glm::dot(glm::vec4(map.u), p), glm::dot(glm::vec4(map.v), p));
    return texel - glm::floor(texel);
}

TEST(RainMap, StaysOnItsTexelsWhereverTheEyeGoes) {  // T-RN-1
    for (const glm::dvec3 home : {glm::dvec3(0), glm::dvec3(10'000, 35, -7'000)}) {
        const glm::dvec3 thing = home + glm::dvec3(1.2345, 0.5, -3.21);
        std::vector<glm::dvec2> places;
        for (const glm::dvec3 step : {glm::dvec3(0), {0.003, 0, 0}, {0.31, 0.02, -0.77}, {2.9, -1, 0.1}, {-3.3, 0.4, 1.9}}) {
            Frame frame = rainy(home + step);
            frame.rain.direction = glm::normalize(glm::vec3(0.2f, -1, 0.1f));
            places.push_back(place_in_texel(frame, rain_map(frame, {}, {.size = 256, .reach = 20}), thing));
        }
        for (const glm::dvec2 place : places)
            for (const double off : {place.x - places[0].x, place.y - places[0].y})
                EXPECT_LT(std::abs(off - std::round(off)), 1e-3);
    }
}

TEST(RainMap, IsAsLargeAsItsReachCallsForAndNoLargerWhereTheEyeTurns) {
    Frame frame = rainy();
    frame.view.projection = perspective(67.5 * std::numbers::pi / 180, 16. / 9, 0.1);
    const RainMap map = rain_map(frame, {}, {.size = 256, .radius = 0, .reach = 20});
    // a^2 + c^2 = 1.857 is above 1: the sphere stands around the far corners, not around the eye as well (28.58 m in 7.2).
    EXPECT_NEAR(map.texel, 2 * 20 * std::sqrt(1.857) / (256 - 6), 1e-3);
    for (const glm::dvec3 ahead : {glm::dvec3(0, -1, 0.01), {1, 0, 0}, {-1, 0.5, 3}}) {
        Frame turned = rainy({5, 2, 8}, ahead);
        turned.view.projection = frame.view.projection;
        EXPECT_EQ(rain_map(turned, {}, {.size = 256, .radius = 0, .reach = 20}).texel, map.texel);
    }
}

TEST(RainMap, HoldsEveryCasterInItsDepth) {
    const Frame frame = rainy();
    const std::array casters = {BoundingSphere{{0, 400, 30}, 2}, BoundingSphere{{10, -300, 3}, 5}};
    const RainMap map = rain_map(frame, casters, {});
    for (const BoundingSphere& caster : casters) {
        const double depth = glm::dot(map.depth, glm::dvec4(caster.center, 1)), half = caster.radius / map.range;
        EXPECT_GT(depth - half, -1e-9);
        EXPECT_LT(depth + half, 1);
    }
}

// --- time -------------------------------------------------------------------------------------------------------------------

TEST(RainTime, IsAsFineAfterAYearAsAtTheStart) {  // H18
    for (const double time : {0.125, 86'400.125, 31'536'000.125}) {
        const Turns turns = turns_of(time, 2);
        EXPECT_NEAR(turns.rest, 0.25, 1e-6) << time;
        EXPECT_EQ(turns.whole, static_cast<std::uint32_t>(std::uint64_t(2 * time))) << time;
    }
    EXPECT_EQ(std::nextafter(86'400.f * 3, HUGE_VALF) - 86'400.f * 3, 1.f / 64) << "what floats on the device would make of it";
    EXPECT_EQ(turns_of(-0.25, 1).whole, 0xffffffffu);
}

// --- colors -----------------------------------------------------------------------------------------------------------------

/// A surface before the eye whose normal points to `up` of the world.
SurfacePoint surface(const Frame& frame, glm::dvec3 normal, double albedo, double roughness) {
    SurfacePoint p;
    p.position = {0, 0, 5};
    p.normal = frame.view.to_view * glm::normalize(normal);
    p.base_color = glm::dvec3(albedo);
    p.roughness = roughness;
    return p;
}

constexpr Look still = {.ripple_height = 0, .flow_height = 0, .puddles = 0};

TEST(WetColor, OfXRayIsThatOfTheTable) {  // T-RN-5 and docs/algorithms/deferred.md 7.6
    const Frame frame = rainy();
    Look look = still;
    look.form = form_xray;
    struct Row {
        double g, factor, gloss;
    };
    for (const Row row : {Row{0, 1, 0}, {.04, .8, .032}, {.16, .6, .128}, {.25, .5, .2}, {.495, .5, .396}}) {
        const double albedo = row.g / .99;
        const SurfacePoint wet = wet_surface(frame, surface(frame, {0, 1, 0}, albedo, 1), look, 1);
        EXPECT_NEAR(wet.base_color.x, row.factor * albedo, 1e-6) << row.g;
        EXPECT_NEAR(1 - wet.roughness, row.gloss, 1e-6) << row.g;
    }
}

TEST(WetColor, OfPorousSurfacesIsDarkAndOfSmoothOnesAndMetalsStays) {
    const Frame frame = rainy();
    const SurfacePoint soaked = wet_surface(frame, surface(frame, {0, 1, 0}, .6, 1), still, 1);
    EXPECT_NEAR(soaked.base_color.x, .3, 1e-12);
    EXPECT_NEAR(soaked.roughness, .2, 1e-12);
    SurfacePoint metal = surface(frame, {0, 1, 0}, .6, 1);
    metal.metallic = 1;
    EXPECT_EQ(wet_surface(frame, metal, still, 1).base_color.x, .6);
    EXPECT_EQ(wet_surface(frame, surface(frame, {0, 1, 0}, .6, .5), still, 1).base_color.x, .6);
    EXPECT_NEAR(wet_surface(frame, surface(frame, {0, 1, 0}, .6, .7), still, 1).base_color.x, .45, 1e-12);
}

TEST(WetColor, StaysOnCeilingsAndComesWithTheSlope) {  // T-RN-6
    const Frame frame = rainy();
    const SurfacePoint ceiling = surface(frame, {0, -1, 0}, .6, 1);
    const SurfacePoint wet = wet_surface(frame, ceiling, {}, 1);
    EXPECT_EQ(wet.base_color, ceiling.base_color);
    EXPECT_EQ(wet.normal, ceiling.normal);
    EXPECT_EQ(slope_weight(-.55), 0);
    EXPECT_NEAR(slope_weight(-.5), .5, 1e-12);
    EXPECT_EQ(slope_weight(-.45), 1);
    EXPECT_EQ(wet_surface(frame, surface(frame, {0, 1, 0}, .6, 1), {}, 0).base_color.x, .6) << "under a roof";
}

// --- lookups and fading, by the technique's model -----------------------------------------------------------------------------

/// A floor seen from 20 m above, one surface per pixel.
struct Floor {
    Frame frame;
    ImageSet images;

    explicit Floor(double height = 20) {
        frame.view = look_at({.eye = {0, height, 0}, .target = {0, 0, 0}, .vertical_fov = .5, .width = 64, .height = 64});
        frame.rain = {.wetness = 1};
        const glm::dvec3 up = frame.view.to_view * glm::dvec3(0, 1, 0);
        images = {{"surface_normal", ReferenceImage(64, 64, 1, glm::dvec4(up, height))},
                  {"surface_color", ReferenceImage(64, 64, 1, glm::dvec4(1))},
                  {"surface_material", ReferenceImage(64, 64, 1, glm::dvec4(3, 0, 1, 0))}};
    }
    /// Roughness of every pixel, of a dry one 1.
    ReferenceImage roughness(const std::vector<std::pair<std::string_view, std::string_view>>& sets) const {
        const Technique technique = wetness();
        Settings settings(technique.params);
        for (const auto& [key, value] : sets) EXPECT_TRUE(settings.set(key, value)) << key;
        ReferenceImage color = technique.model({frame, images}, settings).at("surface_color");
        for (glm::dvec4& texel : color.texels) texel = glm::dvec4(texel.w);
        return color;
    }
};

/// 4 m by 4 m.
void add_roof(Frame& frame, float height = 3) {
    frame.materials.emplace_back();
    Mesh plate;
    for (const glm::vec2 corner : {glm::vec2(-2, -2), {-2, 2}, {2, 2}, {2, -2}})
        plate.positions.emplace_back(corner.x, height, corner.y);
    plate.indices = {0, 1, 2, 0, 2, 3};
    frame.meshes.push_back(plate);
    frame.draws.emplace_back();
}

TEST(RainLookup, UnderARoofIsDryOutsideIsWetAndTheEdgeRisesBetween) {  // T-RN-2
    Floor floor(18);
    add_roof(floor.frame);
    const ReferenceImage roughness = floor.roughness(
        {{"rain_map_size", "256"}, {"rain_radius", "4"}, {"rain_reach", "20"}, {"rain_fade", "0.95"}, {"puddles", "0"}});
    const RainMap map = rain_map(floor.frame, {}, {.size = 256, .radius = 4, .reach = 20});
    const double rim = 5 * map.texel;  // the disc's radius, and the texel that a tap falls into
    double before = -1;
    for (std::uint32_t x = 32; x < 64; ++x) {
        double sum = 0;
        for (std::uint32_t y = 28; y < 36; ++y) sum += (1 - roughness.at(x, y).x) / .8 / 8;
        const double beside = std::abs(pixel_ray(floor.frame, x + .5, 32).x) * 18 - 2;  // meters from the roof's edge
        if (std::abs(beside) > rim) {
            EXPECT_NEAR(sum, beside < 0 ? 0 : 1, .01) << beside;
        }
        EXPECT_GT(sum, before - .15) << beside << ": eight rows of four taps are an average with noise";
        before = std::max(before, sum);
    }
}

TEST(RainLookup, WithoutARadiusKnowsOnlyWetAndDry) {
    Floor floor;
    add_roof(floor.frame);
    const ReferenceImage roughness = floor.roughness({{"rain_radius", "0"}, {"puddles", "0"}});
    for (const glm::dvec4& texel : roughness.texels) EXPECT_TRUE(texel.x == 1 || std::abs(texel.x - .2) < .003) << texel.x;
}

TEST(RainLookup, FadesAsXRaysDoesWhereItIsToldTo) {  // docs/algorithms/deferred.md 7.4
    for (const auto& [z, fade] : {std::pair{5., 1.}, {8., .803}, {12.5, .25}, {16., .031}, {20., 0.}}) {
        const Floor floor(z);
        const ReferenceImage roughness = floor.roughness(
            {{"rain_beyond", "dry"}, {"rain_reach", "20"}, {"rain_fade", "0.25"}, {"puddles", "0"}, {"wet_form", "xray"}});
        EXPECT_NEAR(1 - roughness.at(32, 32).x, .8 * .99 * fade, .003) << z;
        EXPECT_NEAR(1 - floor.roughness({{"rain_reach", "20"}, {"puddles", "0"}}).at(32, 32).x, .8, .003) << "open beyond";
    }
}

// --- wind -------------------------------------------------------------------------------------------------------------------

TEST(RainDirections, AreTiltedByTheSpreadAllAroundTheRecordedOne) {
    const glm::dvec3 recorded = glm::normalize(glm::dvec3(.2, -1, .1));
    EXPECT_EQ(rain_directions(recorded, 1, .3), std::vector{recorded});
    for (const std::uint32_t count : {2u, 3u, 5u, 8u}) {
        glm::dvec3 sum(0);
        for (const glm::dvec3& direction : rain_directions(recorded, count, .3)) {
            EXPECT_NEAR(glm::dot(direction, recorded), std::cos(.3), 1e-12);
            sum += direction;
        }
        EXPECT_NEAR(glm::length(sum - recorded * (count * std::cos(.3))), 0, 1e-12) << count;
    }
}

/// The share of the rain that arrives on a pixel of the floor, of its roughness when wet.
double share_of(const glm::dvec4& roughness) { return (1 - roughness.x) / .8; }

constexpr double tilt = 15 * std::numbers::pi / 180;
constexpr double code = .004;  // of 8 bits of roughness

ReferenceImage in_wind(const Floor& floor, const std::string& directions) {
    return floor.roughness(
        {{"rain_directions", directions}, {"rain_radius", "0"}, {"rain_reach", "20"}, {"rain_fade", "0.95"}, {"puddles", "0"}});
}

TEST(RainInWind, ReachesWhatAsManyRaysDo) {
    Floor floor(18);
    add_roof(floor.frame);
    const double edge = 1.5 * rain_map(floor.frame, {}, {.size = 1024, .radius = 0, .reach = 20}).texel;
    for (const std::uint32_t count : {3u, 5u}) {
        const ReferenceImage roughness = in_wind(floor, std::to_string(count));
        std::size_t compared = 0, partly = 0;
        for (std::uint32_t y = 0; y < 64; ++y)
            for (std::uint32_t x = 0; x < 64; ++x) {
                const glm::dvec3 place = to_world(floor.frame, pixel_ray(floor.frame, x + .5, y + .5) * 18.);
                double open = 0;
                bool is_near_edge = false;
                for (const glm::dvec3& falls : rain_directions({0, -1, 0}, count, tilt)) {
                    const glm::dvec3 at_roof = place + falls * (3 / falls.y);
                    const double outside = std::max(std::abs(at_roof.x), std::abs(at_roof.z)) - 2;
                    is_near_edge = is_near_edge || std::abs(outside) < edge;
                    open += outside > 0 ? 1. / count : 0;
                }
                if (is_near_edge) continue;
                EXPECT_NEAR(share_of(roughness.at(x, y)), open, code) << count << " at " << x << ", " << y;
                ++compared;
                partly += open > .1 && open < .9;
            }
        EXPECT_GT(compared, 3500u);
        EXPECT_GT(partly, 300u);
    }
}

/// Of wind from all around, at a straight edge at height h: 1/2 + asin(x / w) / pi at x meters outside, w = h tan(tilt).
double share_at_edge(double outside, double height) {
    return .5 + std::asin(std::clamp(outside / (height * std::tan(tilt)), -1., 1.)) / std::numbers::pi;
}

TEST(RainInWind, HasAPenumbraAsWideAsTheRoofIsHigh) {
    // The truth has puddles, of which color tells nothing: a soaked white floor is .5.
    for (const float height : {3.f, 6.f}) {
        Floor floor(18);
        add_roof(floor.frame, height);
        const ReferenceImage roughness = in_wind(floor, "8");
        const ReferenceImage truth = rain_in_wind_truth({floor.frame, floor.images}).at("surface_color");
        for (std::uint32_t x = 32; x < 64; ++x) {
            const double outside = std::abs(pixel_ray(floor.frame, x + .5, 32).x) * 18 - 2,
                         wanted = share_at_edge(outside, height);
            // Eight directions meet the edge at 0, .707 and 1 w: steps of an eighth to a quarter around the curve.
            EXPECT_NEAR(share_of(roughness.at(x, 32)), wanted, .15) << height << " m, " << outside;
            EXPECT_NEAR(2 * (1 - truth.at(x, 32).x), wanted, .02) << height << " m, " << outside;
            if (std::abs(outside) > 1.05 * height * std::tan(tilt)) {
                EXPECT_NEAR(share_of(roughness.at(x, 32)), outside < 0 ? 0 : 1, code) << outside;
            }
        }
    }
}

/// Rain of directions all around the vertical falls on a wall from in front alone: half of it, however the wall is turned.
/// Nothing else is there that would shelter it.
TEST(RainInWind, ReachesAWallFromInFrontAlone) {
    for (const double yaw : {0., .1, .3, .55, .785398, 1.2}) {
        Floor wall(18);
        const glm::dvec3 normal = wall.frame.view.to_view * glm::dvec3(std::sin(yaw), 0, std::cos(yaw));
        wall.images.at("surface_normal") = ReferenceImage(64, 64, 1, glm::dvec4(normal, 18));
        for (const char* directions : {"4", "8"}) {
            const ReferenceImage roughness = in_wind(wall, directions);
            EXPECT_NEAR(share_of(roughness.at(32, 32)), .5, .02) << directions << " directions, yaw " << yaw;
        }
    }
}

// --- waves ------------------------------------------------------------------------------------------------------------------

TEST(Rings, AreLevelInTheMeanAndNoneWithoutDrops) {
    Frame frame = rainy();
    frame.time = 1.37;
    glm::dvec2 sum(0);
    double squares = 0;
    constexpr int side = 400;
    for (int i = 0; i < side * side; ++i) {
        const glm::dvec2 gradient = ring_gradient(frame, {.01 * (i % side), 0, .01 * (i / side)}, .002);
        sum += gradient;
        squares += glm::dot(gradient, gradient);
    }
    const double rms = std::sqrt(squares / (side * side));
    EXPECT_GT(rms, .03);
    EXPECT_LT(glm::length(sum) / (side * side), .02 * rms)
        << "a gradient's mean over 4 m is what heights differ by at their ends";
    frame.rain.intensity = 0;
    EXPECT_EQ(ring_gradient(frame, {.1, 0, .2}, .002), glm::dvec2(0));
}

TEST(Rings, DoNotJumpWhenTheNextDropFalls) {
    Frame frame = rainy();
    double worst = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec3 place(.001 * i, 0, .37);
        frame.time = 3 + .0005 * i;
        const glm::dvec2 before = ring_gradient(frame, place, .002);
        frame.time += 1e-7;
        worst = std::max(worst, glm::length(ring_gradient(frame, place, .002) - before));
    }
    EXPECT_LT(worst, 1e-4);
}

TEST(Streams, RunDownHalfAMeterPerSecondAndTurnNormalsAsideOnly) {
    Frame frame = rainy();
    Look look = still;
    look.flow_height = .003;
    double most = 0;
    for (int i = 0; i < 50; ++i) {
        SurfacePoint wall = surface(frame, {0, 0, 1}, .5, 1);
        const glm::dvec3 world(.07 * i, 2 + .13 * i, -4);
        const auto at = [&](const glm::dvec3& place, double time) {
            frame.time = time;
            wall.position = frame.view.to_view * (place - frame.view.origin);
            return glm::transpose(frame.view.to_view) * wet_surface(frame, wall, look, 1).normal;
        };
        const glm::dvec3 now = at(world, 100), later = at(world - glm::dvec3(0, .5 * .3, 0), 100.3);
        EXPECT_NEAR(glm::length(now - later), 0, 1e-9);
        EXPECT_NEAR(now.y, 0, 1e-15);
        most = std::max(most, std::abs(now.x));
    }
    EXPECT_GT(most, .02);
}

TEST(Puddles, CoverMoreTheWetterItIs) {
    std::array<double, 3> cover{};
    for (int i = 0; i < 10'000; ++i)
        for (std::size_t k = 0; k < cover.size(); ++k)
            cover[k] += puddle_at({.1 * (i % 100), 0, .1 * (i / 100)}, .25 + .25 * double(k)) / 10'000;
    EXPECT_LT(cover[0], .2);
    EXPECT_GT(cover[1], cover[0]);
    EXPECT_GT(cover[2], cover[1]);
    EXPECT_LT(cover[2], .9);
    EXPECT_EQ(puddle_at({1, 0, 2}, 0), 0);
}

}  // namespace
}  // namespace strata::rain
