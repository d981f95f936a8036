// What a tile's list of lights must hold, in double: a light that reaches the tile's frustum is on it, one that is far outside is
// not (docs/algorithms/lighting.md 1.4). The model asks a copy of the shader's tests in float, so comparing the two cannot find a
// mistake in both. Hulls and lights are placed here by other arithmetic: lights are built around a point of the hull that they
// light.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/lighting/tiled/cull_mirror.h"
#include "tests/support/random_lights.h"

namespace strata::lighting {
namespace {

using glm::dvec2;
using glm::dvec3;

// A point this near the edge of what a light reaches, relative to its distance from the eye and the light, decides nothing.
constexpr double undecided = 1e-6;

struct SlabOfDepth {
    double nearest, farthest;
};

/// A tile's frustum between two depths, from the pinhole camera alone.
struct TileHull {
    dvec2 low, high;  ///< x / z and y / z
    SlabOfDepth depth;

    dvec3 at(const dvec3& share) const {
        const double z = std::lerp(depth.nearest, depth.farthest, share.z);
        return {z * std::lerp(low.x, high.x, share.x), z * std::lerp(low.y, high.y, share.y), z};
    }
    std::array<dvec3, 8> corners() const {
        std::array<dvec3, 8> all;
        for (std::size_t i = 0; i < 8; ++i) all[i] = at(dvec3(i & 1, i >> 1 & 1, i >> 2));
        return all;
    }
};

TileHull hull_of(const ViewRecord& view, const glm::uvec2& tile, const SlabOfDepth& depth) {
    const auto ray = [&](double x, double y) {
        const dvec2 ndc(2 * x / view.extent.x - 1, 1 - 2 * y / view.extent.y);
        return (ndc - dvec2(view.ndc_offset)) / dvec2(view.ndc_scale);
    };
    const dvec2 first = ray(16. * tile.x, 16. * tile.y);
    const dvec2 last =
        ray(std::min(16. * (tile.x + 1), double(view.extent.x)), std::min(16. * (tile.y + 1), double(view.extent.y)));
    return {{first.x, last.y}, {last.x, first.y}, depth};
}

/// A tile with its surfaces in one or two slabs of depth.
struct TileCase {
    CullScene scene;
    TiledParams params{.half_z = 1, .classify = 1};
    glm::uvec2 tile{0};
    TileSurfaces surfaces;
    std::vector<TileHull> hulls;

    std::vector<std::uint32_t> listed() const {
        std::vector<std::uint32_t> lights;
        for (const ListedLight& light : cull_tile(scene, params, tile, surfaces).lights) lights.push_back(light.light);
        return lights;
    }
    bool lists(const LightRecord& light) {
        scene.lights = {light};
        return !listed().empty();
    }
};

/// Any tile, those cut off by the picture's edge among them, of any camera; surfaces at one depth, between two, or in two slabs.
TileCase random_case(Numbers& numbers) {
    constexpr std::array<glm::uvec2, 4> extents{{{160, 90}, {1920, 1080}, {33, 17}, {16, 16}}};
    TileCase c;
    const glm::uvec2 extent = extents[numbers.below(4)];
    c.scene.view = view_of(extent, {numbers.from(-.1f, .1f), numbers.from(-.1f, .1f)});
    c.tile = {numbers.below((extent.x + 15) / 16), numbers.below((extent.y + 15) / 16)};
    const float nearest = std::exp(numbers.from(-2, 5)), deep = nearest * numbers.from(.5f, 3);
    const std::uint32_t kind = numbers.below(3);
    c.surfaces.depths = {nearest};
    if (kind > 0) c.surfaces.depths.push_back(nearest + deep);
    // Two slabs are wide apart: no rounding decides on which side of the middle a depth is.
    if (kind > 1) c.surfaces.depths.insert(c.surfaces.depths.end(), {nearest + .2f * deep, nearest + .9f * deep});
    const auto slab = [&](float a, float b) { c.hulls.push_back(hull_of(c.scene.view, c.tile, {double(a), double(b)})); };
    if (kind == 0) slab(nearest, nearest);
    if (kind == 1) slab(nearest, nearest), slab(nearest + deep, nearest + deep);
    if (kind == 2) slab(nearest, nearest + .2f * deep), slab(nearest + .9f * deep, nearest + deep);
    return c;
}

/// Inside, on a face, on an edge or a corner.
dvec3 point_of(Numbers& numbers, const TileHull& hull) {
    dvec3 share;
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t where = numbers.below(3);
        share[i] = where == 0 ? 0 : where == 1 ? 1 : double(numbers.from(0, 1));
    }
    return hull.at(share);
}

struct Frame3 {
    dvec3 ahead, u, v;
};
Frame3 axes_of(const LightRecord& light) {
    const dvec3 ahead(light.direction), u(light.axis_u);
    return {ahead, u, glm::cross(ahead, u)};
}

/// By how much the point is inside what the light reaches, relative to all distances: below 0 it is outside.
double reaches(const LightRecord& light, const dvec3& p) {
    const dvec3 off = p - dvec3(light.position);
    const double d = glm::length(off), scale = d + glm::length(p) + double(light.range);
    const Frame3 axes = axes_of(light);
    const double ahead = glm::dot(off, axes.ahead);
    double inside = double(light.range) - d;
    switch (static_cast<LightType>(light.type)) {
        case LightType::round_spot:  // the distance to the cone's side
            inside = std::min(inside, ahead * std::sqrt(1 - double(light.cos_outer) * double(light.cos_outer)) -
                                          double(light.cos_outer) * std::sqrt(std::max(d * d - ahead * ahead, 0.)));
            break;
        case LightType::square_spot:
            inside = std::min({inside, ahead * double(light.tan_half.x) - std::abs(glm::dot(off, axes.u)),
                               ahead * double(light.tan_half.y) - std::abs(glm::dot(off, axes.v))});
            break;
        case LightType::disc:
        case LightType::rectangle:
            inside = std::min(inside, ahead);
            break;
        default:
            break;
    }
    return inside / scale;
}

/// A light of any type that just reaches the point from anywhere, mostly by the edge of its range, cone or pyramid.
LightRecord light_reaching(Numbers& numbers, const dvec3& p) {
    constexpr double just = 1 - 1e-5;
    LightRecord light = omni({0, 0, 0}, std::exp(numbers.from(-2, 5)));
    light.type = numbers.below(static_cast<uint>(LightType::directional));
    const dvec3 ahead(numbers.direction());
    const dvec3 u(numbers.across(glm::vec3(ahead))), v = glm::cross(ahead, u);
    light.direction = glm::vec3(ahead), light.axis_u = glm::vec3(u);
    const double outer = numbers.from(.05f, 1.5f), wide = std::tan(double(numbers.from(.05f, 1.4f)));
    light.cos_outer = float(std::cos(outer));
    light.tan_half = {float(std::tan(outer)), float(wide)};
    const auto part = [&] { return numbers.below(2) == 0 ? just : double(numbers.from(0, 1)); };
    const auto side = [&] { return numbers.below(2) == 0 ? -1. : 1.; };
    dvec3 towards;
    switch (static_cast<LightType>(light.type)) {
        case LightType::round_spot: {
            const double from_axis = part() * outer, around = numbers.from(0, 6.2831853f);
            towards = std::cos(from_axis) * ahead + std::sin(from_axis) * (std::cos(around) * u + std::sin(around) * v);
            break;
        }
        case LightType::square_spot:
            towards = ahead + side() * part() * std::tan(outer) * u + side() * part() * wide * v;
            break;
        case LightType::disc:
        case LightType::rectangle:
            towards = (1 - part() * just) * ahead + dvec3(numbers.across(glm::vec3(ahead)));
            break;
        default:
            towards = dvec3(numbers.direction());
    }
    light.position = glm::vec3(p - part() * double(light.range) * glm::normalize(towards));
    return light;
}

TEST(TileListProperty, ALightThatReachesTheTilesFrustumIsOnItsList) {
    Numbers numbers(11);
    std::array<std::uint32_t, 8> asked{};
    for (int i = 0; i < 60000; ++i) {
        TileCase c = random_case(numbers);
        const dvec3 p = point_of(numbers, c.hulls[numbers.below(static_cast<std::uint32_t>(c.hulls.size()))]);
        const LightRecord light = light_reaching(numbers, p);
        if (reaches(light, p) < undecided) continue;  // rounded to float it may fall short
        ++asked[light.type];
        ASSERT_TRUE(c.lists(light)) << "case " << i << ": a light of type " << light.type << " reaches " << p.x << ", " << p.y
                                    << ", " << p.z;
    }
    for (std::size_t type = 0; type < static_cast<std::size_t>(LightType::directional); ++type)
        EXPECT_GT(asked[type], 3000u) << "type " << type;
}

/// Unit normals of a hull's four sides, outwards, from its corners.
std::array<dvec3, 4> side_normals(const TileHull& hull) {
    const auto outwards = [](double x, double y, double z) { return glm::normalize(dvec3(x, y, z)); };
    return {outwards(-1, 0, hull.low.x), outwards(1, 0, -hull.high.x), outwards(0, -1, hull.low.y), outwards(0, 1, -hull.high.y)};
}

// Touching a side, an edge between sides or a corner from straight outside: the only point that a sphere reaches is that one.
TEST(TileListProperty, ASphereThatReachesOnePointOfTheFrustumIsListedAndOneThatJustMissesASideIsNot) {
    Numbers numbers(12);
    std::uint32_t reached = 0, missed = 0;
    for (int i = 0; i < 30000; ++i) {
        TileCase c = random_case(numbers);
        const TileHull& hull = c.hulls.front();
        const std::array<dvec3, 4> sides = side_normals(hull);
        const std::uint32_t across = numbers.below(2), up = numbers.below(2);
        const bool on_edge = numbers.below(2) == 0;
        const dvec3 p = hull.at({double(across), on_edge ? double(up) : double(numbers.from(0, 1)), double(numbers.from(0, 1))});
        dvec3 out = sides[across];
        if (on_edge) out = glm::normalize(out + double(numbers.from(0, 1)) * sides[2 + up]);
        const double range = std::exp(double(numbers.from(-2, 3)));
        const auto sphere = [&](double distance) { return omni(glm::vec3(p + distance * out), float(range)); };
        if (reaches(sphere(.9999 * range), p) > undecided) {
            ++reached;
            ASSERT_TRUE(c.lists(sphere(.9999 * range))) << "case " << i;
        }
        // Farther from the plane of one side than it reaches, by more than float may round.
        if (on_edge || range < .01 * glm::length(p)) continue;
        ++missed;
        ASSERT_FALSE(c.lists(sphere(1.01 * range))) << "case " << i;
    }
    EXPECT_GT(reached, 20000u);
    EXPECT_GT(missed, 5000u);
}

double distance_to_box(const TileHull& hull, const dvec3& p) {
    const auto corners = hull.corners();
    dvec3 low = corners[0], high = corners[0];
    for (const dvec3& corner : corners) low = glm::min(low, corner), high = glm::max(high, corner);
    return glm::length(p - glm::clamp(p, low, high));
}

TEST(TileListProperty, ALightThatEndsFarOutsideTheTilesBoxesIsNotListed) {
    Numbers numbers(13);
    std::uint32_t outside = 0;
    for (int i = 0; i < 30000; ++i) {
        TileCase c = random_case(numbers);
        LightRecord light = random_light(numbers);
        if (light.type == static_cast<uint>(LightType::directional)) continue;
        const auto is_far = [&](const TileHull& hull) {
            return distance_to_box(hull, dvec3(light.position)) > double(light.range) + 1e-3 * hull.depth.farthest + .01;
        };
        if (!std::ranges::all_of(c.hulls, is_far)) continue;
        ++outside;
        ASSERT_FALSE(c.lists(light)) << "case " << i << ": a light of type " << light.type;
    }
    EXPECT_GT(outside, 10000u);
}

TEST(TileListProperty, ALightThatShinesStraightAwayFromTheTileIsNotListed) {
    Numbers numbers(14);
    constexpr std::array aimed{LightType::round_spot, LightType::square_spot, LightType::disc, LightType::rectangle};
    std::uint32_t asked = 0;
    for (int i = 0; i < 10000; ++i) {
        TileCase c = random_case(numbers);
        // Behind the eye and shining on: all of every hull is behind it, seen within a right angle of straight back.
        const double depth = c.hulls.back().depth.farthest;
        LightRecord light = omni(glm::vec3(0, 0, 1.1 * depth + .1), float(3 * depth));
        light.type = static_cast<uint>(aimed[numbers.below(4)]);
        light.direction = {0, 0, 1};
        light.cos_outer = std::cos(.5f);
        light.tan_half = {.5f, .5f};
        ++asked;
        ASSERT_FALSE(c.lists(light)) << "case " << i << ": a light of type " << light.type;
    }
    EXPECT_GT(asked, 0u);
}

/// So many lights that surely reach the tile, in random places of a list of others that surely do not.
std::vector<std::uint32_t> add_lights(Numbers& numbers, TileCase& c, std::uint32_t reaching) {
    const TileHull& hull = c.hulls.front();
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; expected.size() < reaching; ++i) {
        const dvec3 p = hull.at({.5, .5, .5});
        const double size = hull.depth.farthest;
        const bool is_far = numbers.below(3) == 0;
        const dvec3 away = is_far ? dvec3(0, 0, 50 * size) : dvec3(numbers.box(.1f)) * size;
        c.scene.lights.push_back(omni(glm::vec3(p + away), float(.5 * size)));
        if (!is_far) expected.push_back(i);
    }
    return expected;
}

TEST(TileListProperty, TheFlagOfTooManyLightsIsSetBeyond64ThatReachTheTileAndNotAt64) {
    Numbers numbers(15);
    for (const std::uint32_t reaching : {0u, 1u, 62u, 63u, 64u, 65u, 66u, 127u, 128u, 129u, 200u})
        for (int i = 0; i < 20; ++i) {
            TileCase c = random_case(numbers);
            const std::vector<std::uint32_t> expected = add_lights(numbers, c, reaching);
            EXPECT_EQ(c.listed(), expected);
            for (const std::uint32_t policy : {overflow_batch, overflow_drop}) {
                c.params.overflow = policy;
                const MirroredTile tile = cull_tile(c.scene, c.params, c.tile, c.surfaces);
                EXPECT_EQ(tile.overflow, reaching > 64 ? overflow_lights : 0u) << reaching;
                EXPECT_EQ(tile.touching, reaching);
            }
            const std::vector<std::uint32_t> first_64(expected.begin(),
                                                      expected.begin() + std::min<std::ptrdiff_t>(64, reaching));
            EXPECT_EQ(c.listed(), first_64) << "dropping keeps the first, in the order of their numbers";
        }
}

}  // namespace
}  // namespace strata::lighting
