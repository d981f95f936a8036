// Facts about voxel transparency (transparency chapter 6: 6.2 to 6.7, and of 6.17 V1 to V5, V7 and V8).
#include "passes/transparency/voxel/depth_curve.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace strata::transparency {
namespace {

// The talk's unit is the inch.
constexpr double far_end = 32000, first_150_metres = 5905.512;

TEST(VoxelDepthCurve, HasTheSlicesOfTheChapter) {
    const DepthCurve curve{.slices = 128, .linear = 128, .farthest = far_end};
    EXPECT_NEAR(curve.slice_of(100), 13.3738, 5e-5);
    EXPECT_NEAR(curve.slice_of(1000), 50.4121, 5e-5);
    EXPECT_NEAR(curve.slice_of(first_150_metres), 89.2580, 5e-5);
    EXPECT_NEAR(curve.depth_of(64), 1899.901378, 1e-6);
    EXPECT_NEAR(std::log2(1 + far_end / curve.linear), 7.971544, 5e-7);
    for (double s = 0; s <= 128; s += .37) EXPECT_NEAR(curve.slice_of(curve.depth_of(s)), s, 1e-12);
}

struct ThicknessRow {
    double slices, linear;
    std::array<double, 6> inches;  ///< at 0, 12, 100, 1000, 5905.5 and 32000
};
constexpr ThicknessRow thickness_table[] = {
    {128, 128, {5.525, 6.043, 9.842, 48.69, 260.5, 1386.8}},   {256, 256, {4.836, 5.063, 6.725, 23.73, 116.4, 609.4}},
    {512, 512, {4.151, 4.248, 4.962, 12.26, 52.03, 263.6}},    {1024, 1024, {3.474, 3.514, 3.813, 6.866, 23.51, 112.0}},
    {128, 37.998, {2, 2.632, 7.263, 54.63, 312.8, 1686.3}},    {256, 86.553, {2, 2.277, 4.311, 25.11, 138.5, 741.4}},
    {512, 201.891, {2, 2.119, 2.991, 11.91, 60.50, 319.0}},    {1024, 487.759, {2, 2.049, 2.410, 6.100, 26.21, 133.2}},
};

TEST(VoxelDepthCurve, HasTheThicknessesOfTheChapter) {
    constexpr double depths[] = {0, 12, 100, 1000, 5905.5, far_end};
    for (const ThicknessRow& row : thickness_table) {
        const DepthCurve curve{.slices = row.slices, .linear = row.linear, .farthest = far_end};
        for (std::size_t i = 0; i < row.inches.size(); ++i)
            EXPECT_NEAR(curve.thickness_at(depths[i]), row.inches[i], 6e-4 * row.inches[i])
                << row.slices << " slices, a " << row.linear << ", at " << depths[i];
    }
}

TEST(VoxelDepthCurve, KeepsTheNearestSliceAsThickAsAsked) {
    for (const ThicknessRow& row : thickness_table)
        if (row.slices != row.linear) {
            EXPECT_NEAR(linear_of_thickness(row.slices, far_end, 2), row.linear, 5e-4);
        }
    // More than even slices would need: they are as good as even, and reach to the end.
    EXPECT_NEAR(linear_of_thickness(128, 100, 1), 1000, 1e-6);
}

TEST(VoxelDepthCurve, TakesTheTalksInchesInMetres) {
    const VoxelParams params{.slices = 128, .curve = curve_slices, .near_thickness = .0508f, .farthest = 800};
    EXPECT_NEAR(depth_curve(params).linear, 3.2512, 1e-12);
    VoxelParams thin = params;
    thin.curve = curve_thickness;
    EXPECT_NEAR(depth_curve(thin).thickness_at(0), .0508, 1e-8);
}

}  // namespace
}  // namespace strata::transparency
