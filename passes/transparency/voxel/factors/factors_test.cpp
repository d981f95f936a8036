// Facts about slices that hold products (docs/algorithms/transparency.md 6.4, first row of its table).
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/transparency/voxel/factors/model.h"
#include "tests/support/one_pixel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace strata::transparency {
namespace {

double product(std::span<const double> factors, std::uint32_t bits) {
    double stored = 1;
    for (const double factor : factors) stored = multiplied(stored, factor, bits);
    return stored;
}

TEST(VoxelFactor, StallsWhereALayerTakesLessThanHalfAStep) {
    const std::vector<double> layers(1000, .99);
    // Of a blend that kept the layer's .99 as it is: 50 x .99 = 49.5 is 50 again. In steps of the format the layer is 252 / 255
    // first.
    double exact = 255;
    for (const double factor : layers) exact = std::nearbyint(exact * factor);
    EXPECT_EQ(exact, 50);
    EXPECT_NEAR(product(layers, bits_8) * 255, 42, 1e-9);
    EXPECT_NEAR(product(layers, bits_16) * 65535, 50, 1e-9);
    EXPECT_NEAR(product(layers, bits_32), std::pow(.99, 1000), 1e-12);
}

TEST(VoxelFactor, DependsOnTheOrderInWhichItIsRounded) {
    std::array layers{.3, .85, .9, .95};
    std::vector<double> found;
    do found.push_back(product(layers, bits_8));
    while (std::ranges::next_permutation(layers).found);
    const auto [least, most] = std::ranges::minmax(found);
    EXPECT_NEAR(.3 * .85 * .9 * .95 * 255, 55.6, .01);
    EXPECT_NEAR(least * 255, 55, 1e-9);
    EXPECT_NEAR(most * 255, 56, 1e-9);
}

TEST(VoxelFactor, KeepsThinLayersThatCodesLose) {
    // 1 - 1/255: half a step of the codes is .0109 of optical depth, so two of them are the least that is seen behind them.
    const ColumnFormat format = column_format({.slices = 32, .splat = splat_multiply, .bits = bits_8});
    const auto code = [&](std::size_t layers) {
        const std::vector<Multiplication> all(layers, {.slice = 3, .factor = 254. / 255});
        return column_of_factors(format, all, bits_8).field(3);
    };
    EXPECT_EQ(code(2), 0u);
    EXPECT_EQ(code(3), 1u);
    EXPECT_EQ(code(200), static_cast<std::uint32_t>(std::lround(std::log(255. / 127) * format.codes_per_depth())));
}

TEST(VoxelFactor, OfNothingIsFull) {
    for (const std::uint32_t bits : {bits_8, bits_16, bits_32}) {
        const ColumnFormat format = column_format({.slices = 32, .splat = splat_multiply, .bits = bits});
        const std::vector<Multiplication> card{{.slice = 5, .factor = 0}};
        const std::vector<std::uint32_t> integral = column_of_factors(format, card, bits).integral();
        EXPECT_EQ(integral[4], 0u);
        EXPECT_EQ(integral[5], format.full_code);
    }
}

/// A triangle from depth 1 to depth 9 and a particle at 5 that is sorted half a meter nearer.
Frame tilted_triangle_and_particle() {
    Frame frame = one_pixel(1);
    frame.materials.push_back({.alpha_mode = AlphaMode::blend});
    frame.meshes.push_back({.positions = {{0, 0, 1}, {1, 0, 2}, {0, 1, 9}}, .indices = {0, 1, 2}});
    frame.draws.push_back({.mesh = 0, .material = 0});
    frame.emitters.push_back({.particles = {{.center = {0, 0, 5}, .depth_offset = .5f}}});
    return frame;
}

TEST(VoxelFactor, IsInTheSliceOfTheTrianglesMeanDepth) {
    const std::vector<double> depths = depths_of_triangles(tilted_triangle_and_particle());
    ASSERT_EQ(depths.size(), 3u);
    EXPECT_NEAR(depths[0], 4, 1e-12);
    EXPECT_NEAR(depths[1], 4.5, 1e-12);
    EXPECT_NEAR(depths[2], 4.5, 1e-12);
}

}  // namespace
}  // namespace strata::transparency
