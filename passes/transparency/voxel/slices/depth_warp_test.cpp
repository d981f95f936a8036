// Facts about the table that leaves empty slices out (docs/algorithms/transparency.md 6.10, 6.11; of 6.17 V6 and V9).
#include "passes/transparency/voxel/slices/depth_warp_model.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string_view>

#include <gtest/gtest.h>

#include "passes/transparency/voxel/volume/column.h"

namespace strata::transparency {
namespace {

Coverage coverage_of(std::string_view used) {
    Coverage coverage(static_cast<std::uint32_t>(used.size()));
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v] == '1') coverage.take(double(v) + .1, double(v) + .9);
    return coverage;
}

std::string text(const DepthWarp& warp) {
    std::string used;
    for (std::uint32_t v = 0; v < warp.virtual_slices(); ++v) used += warp.is_used(v) ? '1' : '0';
    return used;
}

constexpr std::string_view example = "0011100001100001";

TEST(VoxelDepthWarp, CountsTheSlicesOfTheChaptersExample) {
    const DepthWarp warp = depth_warp(coverage_of(example), 6, splatting_point);
    EXPECT_EQ(warp.counts, (std::vector<std::uint32_t>{0, 0, 1, 2, 3, 3, 3, 3, 3, 4, 5, 5, 5, 5, 5, 6}));
    EXPECT_EQ(warp.halvings, 0u);
    EXPECT_EQ(warp.physical(1), -1);
    EXPECT_EQ(warp.physical(2), 0);
    EXPECT_EQ(warp.physical(7), 2);
    EXPECT_EQ(warp.physical(99), 5);
}

TEST(VoxelDepthWarp, HalvesTheSlicesUntilTheyFit) {
    EXPECT_EQ(text(depth_warp(coverage_of(example), 5, splatting_point)), "01101101");
    const DepthWarp four = depth_warp(coverage_of(example), 4, splatting_point);
    EXPECT_EQ(text(four), "1111");
    EXPECT_EQ(four.halvings, 2u);
}

TEST(VoxelDepthWarp, EndsWhateverIsCovered) {
    Coverage everything(8192);
    everything.take(0, 8192);
    for (const std::uint32_t physical : {32u, 100u, 1024u}) {
        const DepthWarp warp = depth_warp(everything, physical, splatting_linear);
        EXPECT_LE(warp.counts.back(), physical);
        EXPECT_GT(2 * warp.virtual_slices(), physical);
    }
}

TEST(VoxelDepthWarp, KeepsTheSlicesOfALinearSplatAtEveryResolution) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 256);
    for (int trial = 0; trial < 2000; ++trial) {
        const double from = place(random), to = trial % 2 ? from : std::min(256., from + .1 * place(random));
        Coverage coverage(256);
        coverage.take(from, to);
        for (double scale = 1; scale >= 1. / 8; scale /= 2, coverage = coverage.coarser()) {
            const std::vector<bool> used = coverage.used(splatting_linear);
            const SlicePlace first = slice_place(from * scale, coverage.slices(), splatting_linear);
            const SlicePlace last = slice_place(to * scale, coverage.slices(), splatting_linear);
            const std::uint32_t end = last.slice + (last.share > 0 ? 2 : 1);
            for (std::uint32_t v = first.slice; v < end; ++v) ASSERT_TRUE(used[v]) << from << " to " << to << " at " << scale;
            // And little beside: a half is known, not where in it.
            ASSERT_LE(std::ranges::count(used, true), end - first.slice + 1);
        }
    }
}

/// Inclusive sums of random codes in the used slices of the virtual volume, and packed.
struct TwoVolumes {
    std::vector<double> all, packed;
};
TwoVolumes random_volumes(const DepthWarp& warp, std::mt19937& random) {
    TwoVolumes volumes;
    double sum = 0;
    for (std::uint32_t v = 0; v < warp.virtual_slices(); ++v) {
        if (warp.is_used(v)) volumes.packed.push_back(sum += double(random() % 256) / 255);
        volumes.all.push_back(sum);
    }
    return volumes;
}

TEST(VoxelDepthWarp, ReadsWhatTheVirtualVolumeHolds) {
    std::mt19937 random(6);
    for (int trial = 0; trial < 200; ++trial) {
        std::string used(64, '0');
        for (char& slice : used) slice = random() % 3 == 0 ? '1' : '0';
        const DepthWarp warp = depth_warp(coverage_of(used), 64, splatting_point);
        const TwoVolumes volumes = random_volumes(warp, random);
        const auto at_physical = [&](int slice) {
            return slice < 0 ? 0. : volumes.packed[std::min(static_cast<std::size_t>(slice), volumes.packed.size() - 1)];
        };
        const auto at_virtual = [&](int slice) { return at_physical(warp.physical(slice)); };
        for (double s = -2; s < 66; s += .013) {
            for (const std::uint32_t sampling : {sampling_point, sampling_linear, sampling_bicubic})
                ASSERT_EQ(sampled_integral(at_virtual, s, sampling), sampled_integral(volumes.all, s, sampling)) << used << s;
            // One filtered read of packed texels, at 9e-16 in docs/algorithms/transparency.md 6.10.
            const double q = warp.packed(s - .5), k = std::floor(q), f = q - k;
            const double filtered = (1 - f) * at_physical(static_cast<int>(k)) + f * at_physical(static_cast<int>(k) + 1);
            ASSERT_NEAR(filtered, sampled_integral(volumes.all, s, sampling_linear), 1e-12) << used << s;
        }
    }
}

TEST(VoxelDepthWarp, BiasedAfterTheTableWouldReadAcrossEmptySlices) {
    const DepthWarp warp = depth_warp(coverage_of("1110000000000001"), 8, splatting_point);
    const std::vector<double> packed = {1, 2, 3, 4};
    const double s = 15.5;  // the center of the last slice: 12 empty ones in front of it
    EXPECT_EQ(packed[static_cast<std::size_t>(warp.physical(static_cast<int>(s - 2)))], 3);
    EXPECT_EQ(packed[static_cast<std::size_t>(warp.packed(s - .5) - 2)], 2);
}

TEST(VoxelDepthWarp, CutsNoFinerThanAskedAndNotCoarserThanADenseVolume) {
    VoxelParams params{.slices = 128, .volume = volume_adaptive, .thinnest = .001f, .curve = curve_linear, .linear = 10};
    EXPECT_EQ(depth_curve(params, {1, 5}).slices, 2048);  // 1.6 mm; .8 would be 4096
    EXPECT_EQ(depth_curve(params, {1, 50}).slices, 8192);
    params.thinnest = 10;
    EXPECT_EQ(depth_curve(params, {1, 5}).slices, 128);
    params.slices = 100;
    EXPECT_EQ(depth_curve(params, {1, 5}).slices, 128);
    params.volume = volume_dense;
    EXPECT_EQ(depth_curve(params, {1, 5}).slices, 100);
}

}  // namespace
}  // namespace strata::transparency
