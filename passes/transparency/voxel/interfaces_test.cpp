// Facts about the slices of interface layers (docs/algorithms/transparency.md 6.13).
#include <algorithm>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/reference/ordering.h"
#include "passes/scene/scene_facts.h"
#include "passes/transparency/voxel/slices/depth_curve.h"
#include "passes/transparency/voxel/slices/depth_warp_model.h"
#include "passes/transparency/voxel/thick_fragments/segment_model.h"
#include "passes/transparency/voxel/volume/dimensions.h"
#include "tests/support/one_pixel.h"

namespace strata::transparency {
namespace {

/// A particle at 4 m, and with a layer another at 2 m in it.
Frame particle_and(std::uint32_t layer) {
    Frame frame = one_pixel(1);
    frame.emitters.push_back({.particles = {{.center = {0, 0, 4}}}});
    if (layer > 0) frame.emitters.push_back({.layer = layer, .particles = {{.center = {0, 0, 2}}}});
    return frame;
}

TEST(VoxelInterfaces, HaveSlicesInFrontOfTheWorlds) {
    const VoxelParams params{.slices = 128};
    const Frame without = particle_and(0), third = particle_and(3), last = particle_and(255);
    EXPECT_EQ(of_volume(params, SceneFacts(without)).slices, 128u);
    EXPECT_EQ(of_volume(params, SceneFacts(third)).slices, 131u);
    EXPECT_EQ(of_world(params, SceneFacts(third)).slices, 128u);
    const VoxelParams most{.slices = most_slices};
    EXPECT_EQ(of_volume(most, SceneFacts(last)).slices, most_slices);
    EXPECT_EQ(of_world(most, SceneFacts(last)).slices, most_slices - 255);
}

TEST(VoxelInterfaces, AreNotInTheRangeThatTheCurveCuts) {
    const VoxelParams params{.range = range_frame};
    const Frame alone = particle_and(0), both = particle_and(1);
    EXPECT_EQ(voxel_range(params, both).nearest, voxel_range(params, alone).nearest);
    EXPECT_EQ(voxel_range(params, both).nearest, 4);
    EXPECT_EQ(transparent_depth_range(both).nearest, both.view.near / 2) << "ordering begins at the layer";
    EXPECT_EQ(transparent_depth_range(both).farthest, transparent_depth_range(alone).farthest);
}

TEST(VoxelInterfaces, CoverNoSliceOfTheWorlds) {
    const DepthCurve curve{.slices = 64, .farthest = 8};
    const auto used = [&](const Frame& frame) { return transparent_coverage({}, frame, curve).used(splatting_linear); };
    EXPECT_EQ(used(particle_and(7)), used(particle_and(0)));
    Frame interface_alone = particle_and(7);
    interface_alone.emitters.erase(interface_alone.emitters.begin());
    EXPECT_EQ(std::ranges::count(used(interface_alone), true), 0);
}

}  // namespace
}  // namespace strata::transparency
