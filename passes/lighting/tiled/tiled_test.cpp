// Facts of tiled lighting on its CPU mirror (lighting chapter 1.9, 2.10 and 3.5): cells, which lights reach them, lists and
// masks. What the device makes of them is in tests/5_techniques.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "capture_format/frame.h"
#include "passes/lighting/tiled/cull_mirror.h"
#include "passes/lighting/tiled/culling.h"
#include "passes/lighting/tiled/modes.h"
#include "passes/reference/blockers.h"
#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {
namespace {

/// Half its height is 1 at z = 1.
ViewRecord view_of(glm::uvec2 extent, glm::vec2 offset = {0, 0}) {
    return {.ndc_scale = {float(extent.y) / float(extent.x), 1}, .ndc_offset = offset, .extent = extent};
}

const ViewRecord wide = view_of({1280, 720});

TEST(TileCell, HasTheRaysOfTheChapter) {
    const Cell<float> corner = tile_cell(wide, {0, 0}, 16, {1, 1});
    EXPECT_NEAR(corner.corners[0].x, -1.7777778, 1e-6);
    EXPECT_NEAR(corner.corners[1].x, -1.7333333, 1e-6);
    EXPECT_NEAR(corner.corners[2].y, .9555556, 1e-6);
    EXPECT_NEAR(corner.corners[0].y, 1, 1e-6);
    const Cell<float> middle = tile_cell(wide, {40, 22}, 16, {1, 1});
    EXPECT_NEAR(middle.corners[0].x, 0, 1e-6);
    EXPECT_NEAR(middle.corners[3].x, .0444444, 1e-6);
    EXPECT_NEAR(middle.corners[0].y, .0222222, 1e-6);
    EXPECT_NEAR(middle.corners[3].y, -.0222222, 1e-6);
}

TEST(TileCell, EndsWithThePicture) {
    // 1080 rows are 67.5 tiles.
    const Cell<float> last = tile_cell(view_of({1920, 1080}), {119, 67}, 16, {1, 2});
    EXPECT_NEAR(last.corners[3].x, 1920. / 1080, 1e-6);
    EXPECT_NEAR(last.corners[3].y, -1, 1e-6);
    EXPECT_NEAR(last.corners[0].y - last.corners[2].y, 8 * 2. / 1080, 1e-6);
}

TEST(TileCell, KeepsAndDropsSpheresAsTheChapterSays) {
    const Cell<float> cell = tile_cell(wide, {40, 22}, 16, {10, 20});
    EXPECT_TRUE(sphere_touches({-1, 0, 15}, 1, cell));
    EXPECT_FALSE(sphere_touches({-1, 0, 15}, .999f, cell));
    // Off a corner: all six planes keep it, the cell's box drops it at a distance of 1.0557310.
    const glm::vec3 off_corner(-.8f, 1.1333333f, 15);
    for (const glm::vec4& plane : cell.planes) EXPECT_GT(glm::dot(glm::vec3(plane), off_corner) + plane.w, -1);
    EXPECT_FALSE(sphere_touches(off_corner, 1, cell));
    EXPECT_FALSE(sphere_touches(off_corner, 1.0557f, cell));
    EXPECT_TRUE(sphere_touches(off_corner, 1.0558f, cell));
}

TEST(TileCell, KeepsAndDropsConesAsTheChapterSays) {
    const Cone cone{{0, 0, 1}, float(std::cos(std::numbers::pi / 6)), 10};
    EXPECT_FALSE(cone_touches(cone, {5, 0, 5}, 1.83f));
    EXPECT_TRUE(cone_touches(cone, {5, 0, 5}, 1.8302f));
}

TEST(TileCell, OfAJitteredViewHoldsWhatItsPixelsSee) {
    for (const glm::vec2 offset : {glm::vec2(.01f, -.02f), glm::vec2(-.3f, .25f)}) {
        const ViewRecord view = view_of({160, 90}, offset);
        for (const glm::dvec3 p : {glm::dvec3(1, 2, 10), glm::dvec3(-4, .5, 10), glm::dvec3(0, 0, 10)}) {
            const glm::dvec2 ndc = glm::dvec2(view.ndc_scale) * glm::dvec2(p) / p.z + glm::dvec2(view.ndc_offset);
            const glm::vec2 pixel((ndc.x + 1) / 2 * 160, (1 - ndc.y) / 2 * 90);
            const glm::vec3 again = view_ray(view, pixel) * 10.f;
            EXPECT_NEAR(again.x, p.x, 1e-5);
            EXPECT_NEAR(again.y, p.y, 1e-5);
            const Cell<float> cell = tile_cell(view, glm::uvec2(pixel) / 16u, 16, {9, 11});
            for (const glm::vec4& plane : cell.planes) EXPECT_GE(glm::dot(glm::vec3(plane), again) + plane.w, -1e-5);
        }
    }
}

class Numbers {
public:
    explicit Numbers(unsigned seed) : random_(seed) {}
    float from(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    std::uint32_t below(std::uint32_t n) { return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(random_); }
    glm::vec3 box(float half) { return {from(-half, half), from(-half, half), from(-half, half)}; }
    glm::vec3 direction() {
        for (;;)
            if (const glm::vec3 v = box(1); glm::dot(v, v) < 1 && glm::dot(v, v) > .01f) return glm::normalize(v);
    }
    glm::vec3 across(const glm::vec3& axis) {
        for (;;)
            if (const glm::vec3 v = glm::cross(axis, direction()); glm::dot(v, v) > .01f) return glm::normalize(v);
    }

private:
    std::mt19937 random_;
};

LightRecord omni(const glm::vec3& position, float range) {
    return {.position = position,
            .type = static_cast<uint>(LightType::omni),
            .direction = {0, -1, 0},
            .range = range,
            .intensity = glm::vec3(1),
            .axis_u = {1, 0, 0},
            .texture = no_index,
            .features = feature_omni,
            .shadow = no_index,
            .visibility_layer = no_index};
}

LightRecord random_light(Numbers& numbers) {
    LightRecord light = omni(numbers.box(12) + glm::vec3(0, 0, 12), numbers.from(.5f, 15));
    light.type = numbers.below(static_cast<uint>(LightType::directional) + 1);
    light.direction = numbers.direction();
    light.axis_u = numbers.across(light.direction);
    const float outer = numbers.from(.02f, 1.5f);
    light.cos_outer = std::cos(outer);
    light.cos_inner = std::cos(outer * numbers.from(0, 1));
    light.tan_half = {std::tan(outer), std::tan(numbers.from(.02f, 1.5f))};
    return light;
}

/// Whether the light's own formulas may light the point, in double.
bool may_light(const LightRecord& light, const glm::dvec3& p) {
    const glm::dvec3 off = p - glm::dvec3(light.position), direction(light.direction), u(light.axis_u);
    const double d = glm::length(off), ahead = glm::dot(off, direction);
    switch (static_cast<LightType>(light.type)) {
        case LightType::directional:
            return true;
        case LightType::round_spot:
            return d < double(light.range) && ahead > double(light.cos_outer) * d;
        case LightType::square_spot:
            return d < double(light.range) && ahead > 0 && std::abs(glm::dot(off, u)) < ahead * double(light.tan_half.x) &&
                   std::abs(glm::dot(off, glm::cross(direction, u))) < ahead * double(light.tan_half.y);
        case LightType::disc:
        case LightType::rectangle:
            return d < double(light.range) && ahead > 0;
        default:
            return d < double(light.range);
    }
}

glm::vec3 random_point(Numbers& numbers, const ViewRecord& view, glm::uvec2 tile, glm::vec2 z) {
    const glm::vec2 first = glm::vec2(tile) * 16.f, last = glm::min(first + 16.f, glm::vec2(view.extent));
    const glm::vec2 pixel(numbers.from(first.x, last.x), numbers.from(first.y, last.y));
    return view_ray(view, pixel) * numbers.from(z.x, z.y);
}

TEST(TileCulling, NeverDropsALightThatLightsAPointOfTheCell) {
    Numbers numbers(1);
    const ViewRecord view = view_of({160, 90});
    std::array<std::size_t, 8> kept{}, all{}, lit{};
    for (int i = 0; i < 60000; ++i) {
        const LightRecord light = random_light(numbers);
        const glm::uvec2 tile(numbers.below(10), numbers.below(6));
        const float near = numbers.from(.2f, 20), far = near + numbers.from(0, 1) * numbers.from(0, 10);
        const Cell<float> cell = tile_cell(view, tile, 16, {near, far});
        const bool touches = light_touches({light, {}, cell_slack(light, cell)}, cell);
        bool any = false;
        for (int k = 0; k < (touches ? 400 : 24) && !any; ++k)
            any = may_light(light, random_point(numbers, view, tile, {near, far}));
        ASSERT_TRUE(touches || !any) << "light " << i << " of type " << light.type;
        kept[light.type] += touches, lit[light.type] += any, ++all[light.type];
    }
    for (std::size_t type = 0; type < static_cast<std::size_t>(LightType::directional); ++type) {
        EXPECT_LT(kept[type], all[type]) << type;
        // What is kept needlessly.
        EXPECT_LT(double(kept[type] - lit[type]), .4 * double(kept[type])) << type;
    }
}

TEST(TileCulling, TestsConesPyramidsAndHalfBoxesTighterThanTheirSpheres) {
    Numbers numbers(2);
    const ViewRecord view = view_of({160, 90});
    std::array<std::size_t, 8> as_sphere{}, as_itself{};
    for (int i = 0; i < 20000; ++i) {
        LightRecord light = random_light(numbers);
        const Cell<float> cell = tile_cell(view, {numbers.below(10), numbers.below(6)}, 16, {5, numbers.from(5, 8)});
        const std::uint32_t type = light.type;
        as_itself[type] += light_touches({light, {}, cell_slack(light, cell)}, cell);
        light.type = static_cast<uint>(LightType::omni);
        as_sphere[type] += light_touches({light, {}, cell_slack(light, cell)}, cell);
    }
    for (const LightType type : {LightType::round_spot, LightType::square_spot, LightType::rectangle, LightType::disc})
        EXPECT_LT(double(as_itself[std::size_t(type)]), .8 * double(as_sphere[std::size_t(type)])) << int(type);
}

TEST(TileCulling, DropsWhatAClipPlaneHidesAndTestsWhatItCuts) {
    const Cell<float> cell = tile_cell(wide, {40, 22}, 16, {10, 20});
    LightRecord light = omni({0, 0, 15}, 5);
    light.clips = 1;
    const auto reach = [&](float z) {
        const std::vector<ClipPlaneRecord> planes{{{0, 0, 1}, -z}};
        const TouchedBy by{light, planes, cell_slack(light, cell)};
        return std::pair(light_touches(by, cell), is_straddled(by, cell));
    };
    EXPECT_EQ(reach(9), std::pair(true, false));
    EXPECT_EQ(reach(15), std::pair(true, true));
    EXPECT_EQ(reach(21), std::pair(false, true));
}

// One tile whose surfaces are at z = 10 and z = 20, unless said otherwise.
struct OneTile {
    CullScene scene{.view = view_of({16, 16})};
    TiledParams params{.half_z = 1, .classify = 1};
    TileSurfaces surfaces{.depths = {10, 20}};

    MirroredTile cull() const { return cull_tile(scene, params, {0, 0}, surfaces); }
};

TEST(TileLists, HalfZDropsWhatLiesBetweenTwoSurfaces) {
    OneTile tile;
    tile.scene.lights = {omni({0, 0, 15}, 4), omni({0, 0, 11}, 2), omni({0, 0, 19}, 2)};
    EXPECT_EQ(tile.cull().touching, 2u);
    tile.params.half_z = 0;
    EXPECT_EQ(tile.cull().touching, 3u);
    tile.surfaces.depths = {15, 15};  // a flat cell is legal
    EXPECT_EQ(tile.cull().touching, 1u);
}

TEST(TileLists, AnEmptyTileHasNoLightsAndAPixelIsATile) {
    OneTile tile;
    tile.scene.lights = {omni({0, 0, 10}, 4)};
    tile.surfaces.depths.clear();
    EXPECT_TRUE(tile.cull().empty);
    tile.scene.view = view_of({1, 1});
    tile.surfaces.depths = {10};
    EXPECT_FALSE(tile.cull().empty);
    EXPECT_EQ(tile.cull().lights.size(), 1u);
}

TEST(TileLists, HoldEveryLightInIndexOrderHoweverMany) {
    for (const std::size_t n : {1, 31, 32, 33, 63, 64, 65, 255, 256, 257, 4095, 4096}) {
        OneTile tile;
        tile.scene.lights.assign(n, omni({0, 0, 10}, 4));
        const MirroredTile all = tile.cull();
        ASSERT_EQ(all.lights.size(), n);
        for (std::uint32_t i = 0; i < n; ++i) ASSERT_EQ(all.lights[i].light, i);
        EXPECT_EQ(all.records, (n + 63) / 64);
        EXPECT_EQ(all.overflow, n > 64 ? overflow_lights : 0u);
        tile.params.overflow = overflow_drop;
        const MirroredTile some = tile.cull();
        EXPECT_EQ(some.lights.size(), std::min<std::size_t>(n, 64));
        EXPECT_EQ(some.touching, n);
        EXPECT_EQ(some.overflow, all.overflow);
    }
}

TEST(TileLists, DroppingLosesTheLastOf65) {
    OneTile tile;
    tile.scene.lights.assign(65, omni({0, 0, 10}, 4));
    tile.params.overflow = overflow_drop;
    const MirroredTile culled = tile.cull();
    EXPECT_EQ(culled.lights.back().light, 63u);
    EXPECT_EQ(culled.touching - culled.lights.size(), 1u);
}

/// Between the light at z = 5 and surfaces from 10 to 20: it covers all of the tile if it is large.
BlockerRecord blocker_at(float z, float half) {
    return {.normal = {0, 0, -1}, .half_u = half, .center = {0, 0, z}, .half_v = half, .u = {1, 0, 0}};
}

OneTile tile_with_blockers(std::uint32_t lights, std::uint32_t blockers, float half) {
    OneTile tile;
    for (std::uint32_t i = 0; i < blockers; ++i) {
        tile.scene.blockers.push_back(blocker_at(6, half));
        tile.scene.light_blockers.push_back({.blocker = i});
    }
    for (std::uint32_t i = 0; i < lights; ++i) {
        LightRecord light = omni({0, 0, 5}, 40);
        light.blockers = blockers;
        tile.scene.lights.push_back(light);
    }
    return tile;
}

TEST(TileBlockers, KillALightTheyHideFromAllOfTheTile) {
    OneTile tile = tile_with_blockers(1, 1, 100);
    const MirroredTile hidden = tile.cull();
    EXPECT_EQ(hidden.killed, 1u);
    EXPECT_TRUE(hidden.lights.empty());
    EXPECT_EQ(hidden.spectrum, 0u) << "what does not shine needs nothing";
    EXPECT_EQ(hidden.blocker_classes, (std::array<std::uint32_t, 3>{0, 0, 1}));
    tile.params.blockers = blockers_off;
    EXPECT_EQ(tile.cull().lights, (std::vector<ListedLight>{{0, 0, 0}}));
}

TEST(TileBlockers, AreTestedByPixelsWhereTheirShadowHasAnEdge) {
    OneTile tile = tile_with_blockers(1, 1, .5f);
    EXPECT_EQ(tile.cull().lights, (std::vector<ListedLight>{{0, 1, 0}}));
    EXPECT_EQ(tile.cull().spectrum, feature_omni | feature_blockers);
    tile.params.blockers = blockers_tile_only;
    EXPECT_EQ(tile.cull().lights, (std::vector<ListedLight>{{0, 0, 0}}));
    EXPECT_EQ(tile.cull().spectrum, feature_omni);
    tile.scene.blockers[0].center = {50, 0, 6};
    tile.params.blockers = blockers_per_pixel;
    EXPECT_EQ(tile.cull().lights, (std::vector<ListedLight>{{0, 0, 0}})) << "its shadow is elsewhere";
}

TEST(TilePortals, KeepALightAliveAndCancelTheirBlockerWhereTheyContainTheTile) {
    OneTile tile = tile_with_blockers(1, 1, 100);
    tile.scene.light_blockers[0].portals = 1;
    tile.scene.lights[0].portals = 1;
    BlockerPortalRecord portal{.center = {0, 0}, .half_extent = {50, 50}, .turn = {1, 0}, .blocker = 0};
    tile.scene.blocker_portals = {portal};
    EXPECT_EQ(tile.cull().lights, (std::vector<ListedLight>{{0, 0, 0}})) << "all of the tile is behind the portal";
    tile.scene.blocker_portals[0].half_extent = {.5f, .5f};
    EXPECT_EQ(tile.cull().lights, (std::vector<ListedLight>{{0, 1, 1}})) << "a part of it is";
    EXPECT_EQ(tile.cull().spectrum, feature_omni | feature_blockers | feature_portals);
    tile.scene.blocker_portals[0].center = {80, 0};
    EXPECT_EQ(tile.cull().killed, 1u) << "none of it is";
}

TEST(TilePairs, BeyondTheirLimitAreLeftToThePixels) {
    const MirroredTile culled = tile_with_blockers(16, 17, 100).cull();
    EXPECT_EQ(culled.blocker_pairs, 272u);
    EXPECT_EQ(culled.overflow, overflow_blocker_pairs);
    // 256 pairs are 15 lights and 1 blocker of the last: one is enough to kill it, too.
    EXPECT_EQ(culled.killed, 16u);
    EXPECT_EQ(culled.blocker_classes[2], 256u);
    const MirroredTile far = tile_with_blockers(17, 17, .5f).cull();
    EXPECT_EQ(far.blocker_pairs, 289u);
    EXPECT_EQ(far.lights.back().blockers, 0x1ffffu) << "no pair of the last light found a place";
    EXPECT_EQ(far.overflow, overflow_blocker_pairs);
}

TEST(TilePairs, OfPortalsBeyondTheirLimitAreLeftToThePixels) {
    OneTile tile = tile_with_blockers(9, 1, 100);
    tile.scene.light_blockers[0].portals = 0xffffffffu;
    for (LightRecord& light : tile.scene.lights) light.portals = 32;
    tile.scene.blocker_portals.assign(32, {.center = {80, 0}, .half_extent = {1, 1}, .turn = {1, 0}, .blocker = 0});
    const MirroredTile culled = tile.cull();
    EXPECT_EQ(culled.portal_pairs, 288u);
    EXPECT_EQ(culled.overflow, overflow_portal_pairs);
    EXPECT_EQ(culled.killed, 8u) << "their portals are known to be elsewhere; those of the last are not";
    EXPECT_EQ(culled.lights, (std::vector<ListedLight>{{8, 1, 0xffffffffu}}));
}

/// The blockers and portals of a light that the masks leave, for the test of a point in double.
LightBlockers asked(const CullScene& scene, const LightRecord& light, std::uint32_t blockers, std::uint32_t portals) {
    LightBlockers result;
    for (std::uint32_t i = 0; i < light.portals; ++i) {
        const BlockerPortalRecord& p = scene.blocker_portals[light.first_portal + i];
        result.portals.push_back({p.center, p.half_extent, p.turn, p.blocker});
    }
    for (std::uint32_t i = 0; i < light.blockers; ++i) {
        const LightBlockerRecord& use = scene.light_blockers[light.first_blocker + i];
        const BlockerRecord& b = scene.blockers[use.blocker];
        if ((blockers >> i & 1) == 0) continue;
        const PlacedBlocker shape{b.center, b.normal, b.u, double(b.half_u), double(b.half_v), b.one_sided != 0};
        result.blockers.push_back({shape, use.blocker, use.portals & portals});
    }
    return result;
}

/// 1 to 64 lights with up to 32 blockers and 32 portals each.
OneTile random_tile(Numbers& numbers) {
    OneTile tile;
    tile.scene.view = view_of({160, 90});
    const std::uint32_t most = 1 + numbers.below(numbers.below(4) == 0 ? 32 : 4);
    for (std::uint32_t i = 1 + numbers.below(numbers.below(8) == 0 ? 64 : 6); i > 0; --i) {
        LightRecord light = random_light(numbers);
        light.first_blocker = static_cast<uint>(tile.scene.light_blockers.size());
        light.first_portal = static_cast<uint>(tile.scene.blocker_portals.size());
        light.blockers = numbers.below(most + 1);
        for (std::uint32_t b = 0; b < light.blockers; ++b) {
            BlockerRecord blocker = blocker_at(0, 0);
            blocker.normal = numbers.direction();
            blocker.u = numbers.across(blocker.normal);
            blocker.center = numbers.box(6) + glm::vec3(0, 0, 10);
            blocker.half_u = numbers.from(.2f, 12), blocker.half_v = numbers.from(.2f, 12);
            blocker.one_sided = numbers.below(4) == 0;
            LightBlockerRecord use{.blocker = static_cast<uint>(tile.scene.blockers.size())};
            for (std::uint32_t k = numbers.below(3); k > 0 && light.portals < 32; --k) {
                const float turn = numbers.from(0, 6.2831853f);
                use.portals |= 1u << light.portals++;
                tile.scene.blocker_portals.push_back({.center = {numbers.from(-8, 8), numbers.from(-8, 8)},
                                                      .half_extent = {numbers.from(0, 6), numbers.from(0, 6)},
                                                      .turn = {std::cos(turn), std::sin(turn)},
                                                      .blocker = use.blocker});
            }
            tile.scene.blockers.push_back(blocker);
            tile.scene.light_blockers.push_back(use);
        }
        tile.scene.lights.push_back(light);
    }
    return tile;
}

glm::dvec4 homogeneous(const LightRecord& light) {
    const bool directional = light.type == static_cast<uint>(LightType::directional);
    return directional ? glm::dvec4(-glm::dvec3(light.direction), 0) : glm::dvec4(light.position, 1);
}

struct Compared {
    std::size_t points = 0, lights = 0, killed = 0, blockers_asked = 0, blockers_listed = 0;
};

/// What a point of the tile gets from each light, with all blockers and with those that culling left.
void compare_at(const OneTile& tile, const MirroredTile& culled, const glm::dvec3& p, Compared& compared) {
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < tile.scene.lights.size(); ++i) {
        const LightRecord& light = tile.scene.lights[i];
        const bool lit = may_light(light, p) && lets_through(asked(tile.scene, light, ~0u, ~0u), homogeneous(light), p);
        bool lit_by_list = false;
        if (next < culled.lights.size() && culled.lights[next].light == i) {
            const ListedLight& listed = culled.lights[next++];
            lit_by_list = may_light(light, p) &&
                          lets_through(asked(tile.scene, light, listed.blockers, listed.portals), homogeneous(light), p);
        }
        ASSERT_EQ(lit_by_list, lit) << "light " << i;
        ++compared.points;
    }
}

TEST(TileBlockers, LeaveEveryPointItsLightWhateverTheyAre) {
    Numbers numbers(3);
    Compared compared;
    for (int i = 0; i < 5000; ++i) {
        SCOPED_TRACE(i);
        OneTile tile = random_tile(numbers);
        const glm::uvec2 at(numbers.below(10), numbers.below(6));
        const float near = numbers.from(1, 15), far = near + numbers.from(0, 1) * numbers.from(0, 10);
        std::vector<glm::dvec3> points;
        tile.surfaces.depths.clear();
        for (int k = 0; k < 12; ++k) {
            const glm::vec3 p = random_point(numbers, tile.scene.view, at, {near, far});
            tile.surfaces.depths.push_back(p.z);
            points.push_back(off_surface(p, numbers.direction()));
        }
        const MirroredTile culled = cull_tile(tile.scene, tile.params, at, tile.surfaces);
        for (const glm::dvec3& p : points) compare_at(tile, culled, p, compared);
        if (HasFatalFailure()) return;
        compared.lights += culled.touching, compared.killed += culled.killed;
        for (const ListedLight& listed : culled.lights) {
            compared.blockers_asked += std::size_t(std::popcount(listed.blockers));
            compared.blockers_listed += tile.scene.lights[listed.light].blockers;
        }
    }
    EXPECT_GT(compared.killed, compared.lights / 25);
    EXPECT_LT(compared.blockers_asked, compared.blockers_listed / 2);
    EXPECT_GT(compared.points, 250000u);
    RecordProperty("points", int(compared.points));
}

// Chapter 2.9.
TEST(TileMemory, IsTheChaptersForAFrame) {
    EXPECT_EQ(tile_memory({1920, 1080, 1}, 64).record_bytes, 8160u * 656);
    EXPECT_EQ(tile_memory({3840, 2160, 1}, 64).record_bytes, 32400u * 656);
    EXPECT_EQ(tile_memory({1280, 720, 1}, 65).record_bytes, 2u * 3600 * 656);
    const TileMemory many = tile_memory({1920, 1080, 1}, 4096);
    EXPECT_LE(many.record_bytes, 64u << 20);
    EXPECT_EQ(many.candidate_bytes, 15u * 9 * 4097 * 4);
}

TiledParams with_modes(std::vector<std::uint32_t> masks) {
    TiledParams params{};
    std::uint32_t* const fields[] = {&params.mode_0, &params.mode_1, &params.mode_2, &params.mode_3, &params.mode_4};
    for (std::size_t i = 0; i < masks.size(); ++i) *fields[i] = masks[i];
    params.modes = static_cast<uint>(masks.size());
    return params;
}

std::uint32_t chosen_features(const ModeOrder& order, std::uint32_t spectrum) {
    for (std::uint32_t i = 0; i < order.count; ++i)
        if ((spectrum & ~order.modes[i] & every_light_feature) == 0) return order.modes[i] & every_light_feature;
    return 0;
}

TEST(ShadingModes, AreTheCheapestThatServeWhateverTheirOrder) {
    std::vector<std::uint32_t> masks = {every_light_feature, 0, feature_shadows, feature_blockers | feature_portals,
                                        feature_shadows | feature_blockers};
    std::ranges::sort(masks);
    do {
        const ModeOrder order = mode_order(with_modes(masks), every_light_feature);
        EXPECT_EQ(order.count, 5u);
        EXPECT_EQ(chosen_features(order, 0), 0u);
        EXPECT_EQ(chosen_features(order, feature_shadows), feature_shadows);
        EXPECT_EQ(chosen_features(order, feature_portals), feature_blockers | feature_portals);
        EXPECT_EQ(chosen_features(order, feature_blockers), feature_blockers | feature_portals);
        EXPECT_EQ(chosen_features(order, feature_tube), every_light_feature);
        for (std::uint32_t i = 0; i < order.count; ++i)
            EXPECT_EQ(masks[order.modes[i] >> 16], order.modes[i] & every_light_feature);
    } while (std::ranges::next_permutation(masks).found);
}

TEST(ShadingModes, AlwaysHaveOneOfAllFeatures) {
    const TiledParams none = with_modes({feature_omni});
    EXPECT_EQ(mode_features(none), (std::vector<std::uint32_t>{feature_omni, every_light_feature}));
    EXPECT_EQ(mode_features(with_modes({every_light_feature})).size(), 1u);
    TiledParams uniform = with_modes({feature_omni, 0});
    uniform.branches = branches_uniform;
    EXPECT_EQ(mode_features(uniform), (std::vector<std::uint32_t>{every_light_feature}));
}

TEST(ShadingModes, ThatAFrameCannotCallForAreLeftOut) {
    TiledParams params = with_modes({every_light_feature, feature_omni, feature_omni | feature_shadows, feature_tube});
    EXPECT_EQ(mode_order(params, feature_omni).count, 2u);
    EXPECT_EQ(mode_order(params, feature_omni | feature_shadows).count, 3u);
    params.force = every_light_feature;
    EXPECT_EQ(mode_order(params, feature_omni).count, 1u);
}

}  // namespace
}  // namespace strata::lighting
