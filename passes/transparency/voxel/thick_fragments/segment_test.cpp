// Facts about thick fragments (docs/algorithms/transparency.md 6.5, thick objects).
#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/transparency/voxel/thick_fragments/segment_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

namespace strata::transparency {
namespace {

/// Slices 1 m thick; as even as a logarithm gets.
DepthCurve even(double slices) { return {.slices = slices, .linear = 1e9, .farthest = slices}; }

ColumnFormat column_format_of(std::uint32_t slices, std::uint32_t bits) {
    return column_format({.slices = slices, .bits = bits});
}

/// The integral of a column that holds one fragment: a segment, or a point.
std::vector<double> integral_of(const ColumnFormat& format, double depth, double meters, std::uint32_t splatting, double tau) {
    const DepthCurve curve = even(format.slices);
    Column column(format);
    if (const auto segment = segment_at(curve, depth, meters, splatting)) {
        std::uint32_t slice = static_cast<std::uint32_t>(segment->first);
        for (const std::uint32_t code : segment->codes_of_slices(format.codes(tau), .5)) column.add(slice++, code);
    } else {
        const SlicePlace place = slice_place(curve.slice_of(depth), format.slices, splatting);
        column.add(split_code(format, place, format.codes(tau), .5));
    }
    const std::vector<std::uint32_t> sums = column.integral();
    return {sums.begin(), sums.end()};
}

TEST(VoxelSegment, HidesInEverySliceAsMuchAsReachesThere) {
    // tau 1 over 8 slices, from 3.3 to 11.3.
    const ColumnFormat format = column_format_of(16, bits_8);
    const std::vector<double> integral = integral_of(format, 7.3, 8, splatting_linear, 1);
    for (std::size_t k = 0; k < 16; ++k) {
        const double share = std::clamp((double(k) + 1 - 3.3) / 8, 0., 1.);
        EXPECT_NEAR(integral[k] / format.codes_per_depth(), share, 1.001 / format.codes_per_depth()) << k;
    }
    EXPECT_EQ(integral[2], 0);
    EXPECT_EQ(integral[15], 46) << "the unsplit code of tau 1";
}

TEST(VoxelSegment, ConvergesToTheAreaUnderItsTransmittance) {
    double before = 1;
    for (const std::uint32_t slices : {8u, 32u, 128u}) {
        const ColumnFormat format = column_format_of(slices, bits_32);
        const std::vector<double> integral = integral_of(format, slices / 2., slices, splatting_point, 1);
        double area = 0;
        for (const double codes : integral) area += format.transmittance(codes) / slices;
        const double error = std::abs(area - (1 - std::exp(-1)));
        EXPECT_LT(error, before / 3);
        before = error;
    }
    EXPECT_LT(before, 3e-3);
}

TEST(VoxelSegment, AddsUpToTheUnsplitCode) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    const ColumnFormat format = column_format_of(64, bits_8);
    for (int trial = 0; trial < 2000; ++trial) {
        const double codes = format.codes(7 * unit(random)), rounding = unit(random);
        const auto segment = segment_at(even(64), 70 * unit(random), .01 + 20 * unit(random), splatting_point);
        ASSERT_TRUE(segment);
        const std::vector<std::uint32_t> parts = segment->codes_of_slices(codes, rounding);
        EXPECT_EQ(std::accumulate(parts.begin(), parts.end(), 0u), split_code(format, {}, codes, rounding).nearer);
        EXPECT_GE(segment->first, 0);
        EXPECT_LT(segment->last, 64);
    }
}

TEST(VoxelSegment, IsAPointWhereItIsNotDeep) {
    EXPECT_FALSE(segment_at(even(16), 5, 0, splatting_point));
    EXPECT_FALSE(segment_at(even(16), 5, .9, splatting_linear)) << "a linear splat is one slice deep";
    EXPECT_TRUE(segment_at(even(16), 5, 1.1, splatting_linear));
    const auto within = segment_at(even(16), 5.5, .5, splatting_point);
    ASSERT_TRUE(within);
    EXPECT_EQ(within->codes_of_slices(32, .5), std::vector<std::uint32_t>{32});
}

TEST(VoxelSegment, SeesNothingOfItself) {
    const ColumnFormat format = column_format_of(32, bits_8);
    for (double depth = 8; depth < 9; depth += .01) {
        const auto segment = segment_at(even(32), depth, 5.7, splatting_linear);
        const std::vector<double> integral = integral_of(format, depth, 5.7, splatting_linear, 2);
        const double codes = format.codes(2);
        for (const std::uint32_t sampling : {sampling_point, sampling_linear, sampling_bicubic}) {
            const auto seen = [&](int slice) {
                const double own = segment->code_behind(segment->first, codes, .5) - segment->code_behind(slice + 1, codes, .5);
                return without_own(format, integral[static_cast<std::size_t>(slice)], own);
            };
            EXPECT_EQ(sampled_integral(seen, depth, sampling), 0) << depth;
        }
    }
}

TEST(VoxelSegment, LeavesFullWhatIsFull) {
    const ColumnFormat format = column_format_of(32, bits_8);
    EXPECT_EQ(without_own(format, 255, 100), 255);
    EXPECT_EQ(without_own(format, 90, 100), 0);
}

/// The most that T changes at 16.3 while a fragment of alpha .5 moves past by sixteenths of a slice.
double unsteadiness(double meters, std::uint32_t splatting, std::uint32_t sampling) {
    const ColumnFormat format = column_format_of(32, bits_32);
    double worst = 0, last = 1;
    for (double depth = 24; depth > 8; depth -= 1. / 16) {
        const std::vector<double> integral = integral_of(format, depth, meters, splatting, std::log(2));
        const double t = format.transmittance(sampled_integral(integral, 16.3 + sampling_bias(sampling), sampling));
        worst = std::max(worst, std::abs(t - last));
        last = t;
    }
    return worst;
}

TEST(VoxelSegment, ComesInTheSteadierTheDeeperItIs) {
    EXPECT_NEAR(unsteadiness(0, splatting_point, sampling_point), .5, 1e-4);
    EXPECT_NEAR(unsteadiness(0, splatting_linear, sampling_linear), .0341, 2e-4);
    EXPECT_NEAR(unsteadiness(2, splatting_linear, sampling_linear), .0172, 2e-4);
    EXPECT_NEAR(unsteadiness(4, splatting_linear, sampling_linear), .0094, 2e-4);
    EXPECT_NEAR(unsteadiness(8, splatting_linear, sampling_linear), .0050, 2e-4);
}

/// A soft particle and a hard one at 4 m, a soft one in an interface.
Frame three_particles() {
    Frame frame;
    frame.emitters = {{.soft_depth_fade = .5f, .particles = {{.center = {0, 0, 4}}}},
                      {.particles = {{.center = {0, 0, 4}}}},
                      {.soft_depth_fade = .5f, .layer = 1, .particles = {{.center = {0, 0, 4}}}}};
    return frame;
}

TEST(VoxelSegment, IsAsDeepAsASoftParticleFades) {
    VoxelParams params{.thickness = thickness_segment};
    EXPECT_EQ(thickness_of(params, three_particles(), 0), .5);
    EXPECT_EQ(thickness_of(params, three_particles(), 1), 0);
    EXPECT_EQ(thickness_of(params, three_particles(), 2), 0);
    EXPECT_EQ(voxel_range(params, three_particles()).nearest, 3.75f);
    EXPECT_NEAR(double(voxel_range(params, three_particles()).farthest), 4.254, 1e-6) << "a flat range is a thousandth deep";
    params.splat = splat_multiply;
    EXPECT_EQ(thickness_of(params, three_particles(), 0), 0);
    params = {};
    EXPECT_EQ(thickness_of(params, three_particles(), 0), 0);
    EXPECT_EQ(voxel_range(params, three_particles()).nearest, 4);
}

}  // namespace
}  // namespace strata::transparency
