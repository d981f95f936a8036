// Facts of tiled lighting on its CPU mirror (docs/algorithms/lighting.md 1.9, 2.10 and 3.5): lists, masks, memory, modes. What
// the device makes of them is in tests/5_techniques.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/lighting/tiled/cull_mirror.h"
#include "passes/lighting/tiled/culling.h"
#include "passes/lighting/tiled/modes.h"
#include "passes/reference/blockers.h"
#include "tests/support/random_lights.h"

namespace strata::lighting {
namespace {

// One tile whose surfaces are at z = 10 and z = 20, unless said otherwise.
struct OneTile {
    CullScene scene{{}, view_of({16, 16})};
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
    for (const std::size_t n : {1u, 31u, 32u, 33u, 63u, 64u, 65u, 255u, 256u, 257u, 4095u, 4096u}) {
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
        const glm::dvec3 normal(b.normal), u(b.u);
        const PlacedBlocker shape{b.center,         normal,          u, glm::cross(normal, u), double(b.half_u),
                                  double(b.half_v), b.one_sided != 0};
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

// docs/algorithms/lighting.md 2.9.
TEST(TileMemory, IsTheChaptersForAFrame) {
    EXPECT_EQ(tile_memory({1920, 1080, 1}, 64).record_bytes, 8160u * 656);
    EXPECT_EQ(tile_memory({3840, 2160, 1}, 64).record_bytes, 32400u * 656);
    EXPECT_EQ(tile_memory({1280, 720, 1}, 65).record_bytes, 2u * 3600 * 656);
    const TileMemory many = tile_memory({1920, 1080, 1}, 4096);
    EXPECT_LE(many.record_bytes, 64u << 20);
    EXPECT_FALSE(many.lists_every_light) << "8160 tiles of 64 batches are 326 MiB";
    EXPECT_TRUE(tile_memory({1280, 720, 1}, 65).lists_every_light);
    EXPECT_FALSE(tile_memory({16, 16, 1}, most_listed + 1).lists_every_light);
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

std::vector<std::uint32_t> subsets_of(std::uint32_t features) {
    std::vector<std::uint32_t> subsets{features};
    while (subsets.back() != 0) subsets.push_back((subsets.back() - 1) & features);
    return subsets;
}

TEST(ShadingModes, AreTheCheapestThatServeWhateverTheirOrder) {
    std::vector<std::uint32_t> masks = {every_light_feature, 0, feature_shadows, feature_blockers | feature_portals,
                                        feature_shadows | feature_blockers};
    std::ranges::sort(masks);
    const std::vector<std::uint32_t> all = subsets_of(every_light_feature);
    do {
        const ModeOrder order = mode_order(with_modes(masks), all);
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
    EXPECT_EQ(mode_order(params, subsets_of(feature_omni)).count, 1u);
    EXPECT_EQ(mode_order(params, subsets_of(feature_omni | feature_shadows)).count, 2u);
    EXPECT_EQ(mode_order(params, subsets_of(feature_omni | feature_tube)).count, 3u)
        << "both in one tile: the mode of all features";
    params.force = every_light_feature;
    EXPECT_EQ(mode_order(params, subsets_of(feature_omni)).count, 1u);
}

TEST(ShadingModes, OfAFrameEndWithOneThatServesEveryTile) {
    const TiledParams params = with_modes({every_light_feature, feature_omni, feature_omni | feature_shadows, feature_tube});
    for (const std::uint32_t features : subsets_of(feature_omni | feature_shadows | feature_tube | feature_cloth)) {
        const ModeOrder order = mode_order(params, subsets_of(features));
        ASSERT_GT(order.count, 0u);
        EXPECT_EQ(features & ~order.modes[order.count - 1] & every_light_feature, 0u) << features;
    }
}

// A room of omni lights, all with shadows, and one tube: no tile has shadows without an omni light.
TEST(ShadingModes, ThatNoTilesLightsCallForAreLeftOut) {
    const TiledParams params = with_modes({every_light_feature, feature_shadows | feature_tube, feature_omni | feature_shadows});
    EXPECT_EQ(mode_order(params, std::vector<std::uint32_t>{0, feature_omni, feature_omni | feature_shadows}).count, 1u);
}

}  // namespace
}  // namespace strata::lighting
