// Facts of z-binning: which lights a bin of depth holds.
#include <gtest/gtest.h>

#include "passes/lighting/z_binned/z_bins.h"

namespace strata::lighting {
namespace {

/// Bins of one meter from 0 on.
constexpr ZBinsPush push{0, 0, 0, 32, spacing_uniform, 16, 1};
constexpr ZHeader header{.everywhere = 0, .near = 0, .far = 32, .scale = 1};

// docs/algorithms/lighting.md 1.9, T1.5.
TEST(ZBins, HoldTheFirstAndTheLastLightThatReachesThem) {
    const DepthReach lights[] = {{5, 6}, {5.5f, 9}, {20, 21}};
    const auto bins = mirror_bins(lights, header, push);
    EXPECT_EQ(bins[5], (BinRange{0, 1}));
    EXPECT_EQ(bins[7], (BinRange{1, 1}));
    EXPECT_EQ(bins[12], BinRange{});
    EXPECT_EQ(bins[20], (BinRange{2, 2}));
}

TEST(ZBins, KeepLightsThatAreEverywhereOutOfTheirRanges) {
    ZHeader with_sun = header;
    with_sun.everywhere = 1;
    const DepthReach lights[] = {{-z_largest, -z_largest}, {5, 6}};
    const auto bins = mirror_bins(lights, with_sun, push);
    EXPECT_EQ(bins[5], (BinRange{1, 1}));
    EXPECT_EQ(bins[4], BinRange{});
}

TEST(ZBins, HoldLightsBehindTheEyeAndBeyondTheEndInTheirFirstAndLast) {
    const DepthReach lights[] = {{-3, 0.5f}, {31, 80}};
    const auto bins = mirror_bins(lights, header, push);
    EXPECT_EQ(bins.front(), (BinRange{0, 0}));
    EXPECT_EQ(bins.back(), (BinRange{1, 1}));
}

// docs/algorithms/lighting.md 1.5: 4096 lights are 128 words or 512 bytes a tile, 3.98 MiB at 1080p; 4096 bins of 4 bytes are 16
// KiB.
TEST(ZBins, TakeTheMemoryThatTheChapterStates) {
    constexpr double tiles = 120 * 68, bytes_of_a_tile = 4096 / 8;
    EXPECT_NEAR(tiles * bytes_of_a_tile / (1 << 20), 3.98, 0.005);
    EXPECT_EQ(4096 * sizeof(uint), 16u << 10);
}

}  // namespace
}  // namespace strata::lighting
