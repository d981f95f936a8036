// transparency/voxel with volume=sparse: blocks out of a pool, and the picture of a dense volume.
#include <algorithm>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/voxel/sparse/sparse_model.h"
#include "passes/transparency/voxel/thick_fragments/segment_model.h"
#include "passes/transparency/voxel/volume/dimensions.h"
#include "tests/5_techniques/voxel_name.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using namespace transparency;

constexpr std::uint64_t voxels_per_block = 64 * 4;  // with 8 bits

using Sets = std::vector<std::string>;

Sets both(Sets sets, const Sets& more) {
    sets.insert(sets.end(), more.begin(), more.end());
    return sets;
}

Request sparse_request(std::string_view scenario, const Sets& sets, std::uint32_t samples = 1) {
    Request request = on_scenario(scenario, samples);
    request.choices = chosen({voxel}, both({"volume=sparse"}, sets)), request.outputs = {"color"};
    return request;
}

Run sparse_run(std::string_view scenario, const Sets& sets, std::uint32_t samples = 1) {
    return must(session_of_scenarios().run(sparse_request(scenario, sets, samples)));
}

/// Of the stage, without those that have interface layers: there it would be adaptive.
std::vector<std::string_view> sparse_scenarios() {
    std::vector<std::string_view> scenarios;
    for (const std::string_view scenario : info(Stage::transparency).scenarios)
        if (!frame_features(scenario_frames(scenario).front()).has(Feature::interface_layers)) scenarios.push_back(scenario);
    return scenarios;
}

/// A curve that the number of slices does not bend.
const Sets unbent{"curve=linear", "linear=3"};

/// Whether a sparse volume was compared with the dense one of as many slices as it has.
bool expect_dense(std::string_view scenario, const Sets& sets, const Sets& sparse_sets) {
    const auto sparse = sparse_run(scenario, both(sets, sparse_sets));
    const std::uint64_t slices = counted(sparse, "virtual slices");
    if (slices < 32 || slices > 1024 || counted(sparse, "blocks") == 0) return false;
    Request request = sparse_request(scenario, both(sets, {"slices=" + std::to_string(slices)}));
    set(request, "volume=dense");
    EXPECT_TRUE(must(session_of_scenarios().run(request)).images.at("color").texels == sparse.images.at("color").texels)
        << scenario << " in " << slices << " slices, " << testing::PrintToString(both(sets, sparse_sets));
    return true;
}

TEST(ExhaustiveVoxelSparse, IsADenseVolumeOfAllItsVirtualSlices) {
    std::size_t compared = 0;
    for (const std::string_view scenario : sparse_scenarios())
        compared += expect_dense(scenario, unbent, {"slices=64", "thinnest=0.005"}) ? 1 : 0;
    EXPECT_GE(compared, 5u);
}

TEST(ExhaustiveVoxelSparse, IsADenseVolumeInEveryFormat) {
    const Sets combinations[] = {
        {"resolution=half", "sampling=bicubic"},
        {"resolution=quarter", "splatting=point", "sampling=point", "channels=rgb"},
        {"bits=16", "rounding=stochastic"},
        {"bits=10", "splat=saturating", "shift=1"},
        {"splat=words", "bits=32", "culling=full_screen"},
    };
    // In turn: every format on every scenario takes minutes, and the test above has one format on all.
    const char* const scenarios[] = {"smoke_grenade", "glass_and_smoke", "three_panes"};
    for (std::size_t i = 0; i < std::size(combinations); ++i)
        EXPECT_TRUE(expect_dense(scenarios[i % 3], both(unbent, combinations[i]), {"slices=64", "thinnest=0.01"})) << i;
}

TEST(ExhaustiveVoxelSparse, HalvesItsSlicesUntilThePoolSuffices) {
    std::size_t halved = 0;
    for (const std::string_view scenario : sparse_scenarios()) {
        const Sets sets = both(unbent, {"thinnest=0.002", "channels=rgb"});
        const auto large = sparse_run(scenario, both(sets, {"pool=256"})), small = sparse_run(scenario, both(sets, {"pool=1"}));
        EXPECT_LE(counted(small, "blocks"), 4096u) << scenario;
        EXPECT_LE(counted(small, "blocks"), counted(large, "blocks")) << scenario;
        EXPECT_EQ(counted(small, "uncovered"), 0u) << scenario;
        if (counted(small, "virtual slices") == counted(large, "virtual slices")) continue;
        EXPECT_GT(counted(large, "blocks"), 4096u) << scenario;
        if (expect_dense(scenario, sets, {"pool=1"})) ++halved;
    }
    EXPECT_GE(halved, 3u);
}

TEST(ExhaustiveVoxelSparse, NeverTakesMoreThanThePool) {
    const char* const splattings[] = {"splatting=linear", "splatting=point"};
    std::size_t turn = 0;  // either splatting with every pool, on every other scenario
    for (const std::string_view scenario : sparse_scenarios())
        for (const char* pool : {"pool=1", "pool=4", "pool=16"}) {
            const char* const splatting = splattings[turn++ % 2];
            const auto run = sparse_run(scenario, {pool, splatting, "thinnest=1e-5"}, 4);
            EXPECT_LE(counted(run, "blocks") * voxels_per_block, counted(run, "voxels")) << scenario << pool;
            EXPECT_LE(counted(run, "cleared"), counted(run, "blocks") * voxels_per_block) << scenario << pool;
            EXPECT_LE(counted(run, "integrated"), counted(run, "cleared")) << scenario << pool;
            EXPECT_EQ(counted(run, "uncovered"), 0u) << scenario << splatting;
        }
}

TEST(VoxelSparse, TakesNothingOfThePoolWhereNothingIsSeen) {
    Request request = sparse_request("smoke_grenade", {});
    EXPECT_GT(counted(must(session_of_scenarios().run(request)), "blocks"), 0u);
    request.variant.eye.pan = 3.14159;
    const auto away = must(session_of_scenarios().run(request));
    EXPECT_EQ(counted(away, "blocks"), 0u);
    EXPECT_EQ(counted(away, "cleared"), 0u);
    EXPECT_EQ(counted(away, "drawn"), 0u);
}

TEST(ExhaustiveVoxelSparse, HalvesAsOftenAsTheModel) {
    const Settings settings(must(find_technique(voxel))->params);
    for (const std::string_view scenario : sparse_scenarios())
        for (const std::uint32_t pool : {1u, 4u, 16u}) {
            const Request request = sparse_request(scenario, {"thinnest=1e-5", fmt::format("pool={}", pool)});
            Frame frame = must(session_of_scenarios().frame(request.variant.frame));
            frame.view.width /= request.variant.extent_divisor, frame.view.height /= request.variant.extent_divisor;
            VoxelParams params = settings.as<VoxelParams>();
            params.volume = volume_sparse, params.thinnest = 1e-5f, params.pool = pool;
            const Extent extent{frame.view.width, frame.view.height};
            const std::uint32_t channels = channel_count(params.channels, frame_features(frame));
            const Extent columns = prepass_extent(extent, voxel_divisor(params, extent, channels));
            const auto finest = static_cast<std::uint32_t>(sparse_curve(params, voxel_range(params, frame), columns).slices);
            EXPECT_EQ(counted(must(session_of_scenarios().run(request)), "virtual slices"),
                      finest >> sparse_halvings(params, frame, columns, channels))
                << scenario << " " << pool;
        }
}

TEST(ExhaustiveVoxelSparse, IsWhatTheModelSaysInCombinations) {
    const Technique& technique = *must(find_technique(voxel));
    const Sets combinations[] = {
        {"pool=1"},
        {"pool=1", "resolution=half", "bits=16", "sampling=bicubic"},
        {"pool=2", "splatting=point", "sampling=point", "channels=mono", "thinnest=1e-5"},
        {"packing=rgb10", "splat=saturating", "resolution=quarter", "rounding=stochastic"},
        {"splat=multiply", "resolution=half"},
        {"range=fixed", "farthest=9", "curve=thickness", "near_thickness=0.05", "bits=10"},
    };
    for (const Sets& sets : combinations) {
        const Request request = sparse_request("glass_and_smoke", sets, 4);
        const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
        expect_within_tolerance(accuracy, technique, request, "glass_and_smoke");
    }
}

TEST(VoxelSparse, IsAdaptiveWhereInterfacesWantSlices) {
    const auto run = sparse_run("interface_layers", {});
    EXPECT_EQ(counted(run, "blocks"), 0u);
    EXPECT_GT(counted(run, "slices used"), 0u);
}

// The order in which tiles get their blocks is chance.
TEST(VoxelSparse, IsTheSameInEveryRun) {
    const auto session = scenario_session("particle_storm", 1);
    const auto color = [&](const char* prepared) {
        session->forget_memo();
        const Request request{.choices = chosen({voxel}, {"volume=sparse", "pool=4", prepared}), .outputs = {"color"}};
        return must(session->run(request)).images.at("color").texels;
    };
    for (const char* prepared : {"prepared=after_opaque", "prepared=before_opaque"}) {
        const auto first = color(prepared);
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(color(prepared) == first) << prepared;
    }
}

TEST(ExhaustiveVoxelSparse, IsCulledWithoutChangingAPixel) {
    for (const std::string_view scenario : sparse_scenarios())
        for (const char* resolution : {"resolution=full", "resolution=quarter"}) {
            const auto all = sparse_run(scenario, {resolution, "culling=off"});
            const auto culled = sparse_run(scenario, {resolution, "culling=quads_16"});
            EXPECT_TRUE(culled.images.at("color").texels == all.images.at("color").texels) << scenario << resolution;
            EXPECT_EQ(counted(culled, "drawn"), counted(all, "drawn")) << scenario << resolution;
        }
}

TEST(VoxelSparse, ShowsTheSliceThatOverflowsAsADenseVolumeDoes) {
    Request request = sparse_request("three_cards", both(unbent, {"range=fixed", "thinnest=10", "slices=64"}));
    request.outputs = {"color", voxel + ":overflow", voxel + ":saturation depth", voxel + ":thickness"};
    const auto sparse = must(session_of_scenarios().run(request));
    set(request, "volume=dense");
    set(request, "slices=" + std::to_string(counted(sparse, "virtual slices")));
    const auto dense = must(session_of_scenarios().run(request));
    EXPECT_GT(counted(sparse, "overflowed"), 0u);
    EXPECT_EQ(counted(sparse, "overflowed"), counted(dense, "overflowed"));
    for (const std::string& output : request.outputs)
        EXPECT_TRUE(sparse.images.at(output).texels == dense.images.at(output).texels) << output;
}

}  // namespace
}  // namespace strata
