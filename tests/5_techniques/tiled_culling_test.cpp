// What tiled lighting's culling wrote on the device, tile by tile, against its mirror on the CPU: the same lights, the same masks
// of blockers and portals, the same spectra (docs/algorithms/lighting.md 9, step 3).
#include <array>
#include <map>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/lighting/tiled/cull_mirror.h"
#include "passes/scene/scene_facts.h"
#include "passes/shaders/light_features.shared.h"
#include "replay/scene/scene_records.h"
#include "tests/5_techniques/light_scenes.h"

namespace strata {
namespace {

using namespace lighting;

CullScene scene_of(const Frame& frame) {
    const SceneFacts facts(frame);
    const SceneRecords records = scene_records(facts);
    return {records, records.view, feature_shadows};
}

struct Tiles {
    glm::uvec2 count{0};
    std::vector<TileSurfaces> surfaces;
};

std::uint32_t model_feature(double model) {
    if (model == double(LightingModel::cloth)) return feature_cloth;
    if (model == double(LightingModel::skin)) return feature_skin;
    return model == double(LightingModel::hair) ? feature_hair : 0;
}

/// What is lit in each tile, from the decoded G-buffer.
Tiles tiles_of(const Run& run) {
    const ReferenceImage normal = in_double(run.images.at("surface_normal")),
                         material = in_double(run.images.at("surface_material"));
    const bool has_edges = run.images.contains("edges");
    const ReferenceImage edges = has_edges ? in_double(run.images.at("edges")) : ReferenceImage();
    Tiles tiles{{(normal.width + 15) / 16, (normal.height + 15) / 16}, {}};
    tiles.surfaces.resize(std::size_t{tiles.count.x} * tiles.count.y);
    for (std::uint32_t y = 0; y < normal.height; ++y)
        for (std::uint32_t x = 0; x < normal.width; ++x) {
            TileSurfaces& tile = tiles.surfaces[y / 16 * tiles.count.x + x / 16];
            const std::uint32_t samples = has_edges && edges.at(x, y).x == 0 ? 1 : normal.layers;
            for (std::uint32_t i = 0; i < samples; ++i) {
                const double z = normal.at(x, y, i).w, model = material.at(x, y, i).x;
                if (z <= 0 || model == double(LightingModel::unlit)) continue;
                tile.depths.push_back(float(z));
                tile.models |= model_feature(model);
            }
        }
    return tiles;
}

using Lists = std::map<std::uint32_t, std::vector<ListedLight>>;  // by tile

/// From the two tables, whose rows are the same lights.
Lists lists_of(const Run& run) {
    const auto &blockers = run.tables.at("lighting/tiled:lists").rows, &portals = run.tables.at("lighting/tiled:portals").rows;
    EXPECT_EQ(blockers.size(), portals.size());
    const auto mask = [](const std::vector<double>& row) {
        return static_cast<std::uint32_t>(row[2]) | static_cast<std::uint32_t>(row[3]) << 16;
    };
    Lists lists;
    for (std::size_t i = 0; i < std::min(blockers.size(), portals.size()); ++i)
        lists[static_cast<std::uint32_t>(blockers[i][0])].push_back(
            {static_cast<std::uint32_t>(blockers[i][1]), mask(blockers[i]), mask(portals[i])});
    return lists;
}

Run culled(const Frame& frame, std::vector<std::string> sets) {
    Request request{.choices = chosen({"lighting/tiled"}, std::move(sets))};
    request.outputs = {"light", "edges", "surface_normal", "surface_material"};
    for (const char* table : {":lists", ":portals", ":spectra"}) request.outputs.push_back(std::string("lighting/tiled") + table);
    return must(session_of_scenarios().run(frame, std::span(&request, 1))).front();
}

struct Totals {
    std::uint64_t touching = 0, kept = 0, killed = 0;
    std::array<std::uint64_t, 3> blockers{}, portals{};
    std::map<std::uint32_t, std::uint64_t> spectra;
    std::size_t undecided = 0;
};

void add(const MirroredTile& tile, Totals& totals) {
    totals.touching += tile.touching, totals.kept += tile.lights.size(), totals.killed += tile.killed;
    for (std::size_t i = 0; i < 3; ++i) {
        totals.blockers[i] += tile.blocker_classes[i];
        totals.portals[i] += tile.portal_classes[i];
    }
    ++totals.spectra[tile.spectrum];
}

/// Every tile; what the settings say must be what the parameters are.
Totals compare(const Frame& frame, const Run& run, const TiledParams& params) {
    const CullScene scene = scene_of(frame);
    const Tiles tiles = tiles_of(run);
    const Lists lists = lists_of(run);
    Totals totals;
    for (std::uint32_t i = 0; i < tiles.surfaces.size(); ++i) {
        const MirroredTile tile = cull_tile(scene, params, {i % tiles.count.x, i / tiles.count.x}, tiles.surfaces[i]);
        if (tile.empty) {
            EXPECT_FALSE(lists.contains(i)) << "tile " << i << " is empty";
            continue;
        }
        add(tile, totals);
        totals.undecided += tile.undecided > 0;
        if (tile.undecided > 0) continue;
        const auto found = lists.find(i);
        const std::vector<ListedLight> listed = found == lists.end() ? std::vector<ListedLight>() : found->second;
        // The table has the first lights of a tile.
        EXPECT_LE(listed.size(), tile.lights.size()) << "tile " << i;
        EXPECT_EQ(listed.empty(), tile.lights.empty()) << "tile " << i;
        for (std::size_t k = 0; k < std::min(listed.size(), tile.lights.size()); ++k) {
            EXPECT_EQ(listed[k].light, tile.lights[k].light) << "tile " << i << ", place " << k;
            EXPECT_EQ(listed[k].blockers, tile.lights[k].blockers) << "tile " << i << ", light " << listed[k].light;
            EXPECT_EQ(listed[k].portals, tile.lights[k].portals) << "tile " << i << ", light " << listed[k].light;
        }
    }
    return totals;
}

void expect_counted(const Run& run, const Totals& totals) {
    EXPECT_LT(double(totals.undecided), .2 * double(count_of(run, "tiles")));
    if (totals.undecided > 0) return;
    EXPECT_EQ(count_of(run, "lights touching"), totals.touching);
    EXPECT_EQ(count_of(run, "lights kept"), totals.kept);
    EXPECT_EQ(count_of(run, "lights killed"), totals.killed);
    const char* const names[] = {"none", "partial", "full"};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(count_of(run, fmt::format("blockers {}", names[i])), totals.blockers[i]);
        EXPECT_EQ(count_of(run, fmt::format("portals {}", names[i])), totals.portals[i]);
    }
    std::map<std::uint32_t, std::uint64_t> spectra;
    double before = INFINITY;
    for (const std::vector<double>& row : run.tables.at("lighting/tiled:spectra").rows) {
        spectra[static_cast<std::uint32_t>(row[0])] += static_cast<std::uint64_t>(row[1]);
        EXPECT_LE(row[1], before) << "most tiles first";
        before = row[1];
    }
    EXPECT_EQ(spectra, totals.spectra);
}

TEST(ExhaustiveTiledCulling, FindsWhatItsMirrorFindsInEveryScenario) {
    for (const std::string_view scenario : lit_scenarios())
        for (const std::uint32_t samples : {1u, 4u}) {
            SCOPED_TRACE(fmt::format("{} at {} samples", scenario, samples));
            const Frame frame = at_most_96(scenario, samples);
            const auto run = culled(frame, {});
            expect_counted(run, compare(frame, run, {.half_z = 1, .classify = 1}));
        }
}

TEST(TiledCulling, FindsWhatItsMirrorFindsOfRandomLightsAndBlockers) {
    std::uint64_t killed = 0, listed = 0;
    for (unsigned seed = 1; seed <= 16; ++seed) {
        SCOPED_TRACE(seed);
        Frame frame = dark_frame("lights_room");
        RandomLights random(100 + seed);
        for (std::uint32_t i = 1 + random.numbers.below(seed % 4 == 0 ? 80 : 10); i > 0; --i)
            random.add_blocked_light(frame, seed % 4 == 1 ? 32 : 4);
        const std::uint32_t half_z = seed % 2;
        const auto run =
            culled(frame, {half_z != 0 ? "half_z=on" : "half_z=off", seed % 3 == 0 ? "prefilter=on" : "prefilter=off"});
        const Totals totals = compare(frame, run, {.half_z = half_z, .classify = 1});
        expect_counted(run, totals);
        killed += totals.killed, listed += totals.kept;
    }
    EXPECT_GT(killed, 0u);
    EXPECT_GT(listed, killed);
}

TEST(TiledCulling, ListsTheSameWithAndWithoutAPrefilter) {
    const Frame frame = at_most_96("hall_of_lights_512", 1);
    const auto all = culled(frame, {"prefilter=off"}), some = culled(frame, {"prefilter=on"});
    EXPECT_EQ(lists_of(some), lists_of(all));
    EXPECT_EQ(count_of(some, "lights touching"), count_of(all, "lights touching"));
    EXPECT_EQ(differing_texels(some, all), 0u);
}

}  // namespace
}  // namespace strata
