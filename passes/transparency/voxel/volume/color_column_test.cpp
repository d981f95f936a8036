// Facts about words of three channels (docs/algorithms/transparency.md 6.4 and 6.6, V2 and V3 of 6.17).
#include "passes/transparency/voxel/volume/color_column.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>

#include <gtest/gtest.h>

namespace strata::transparency {
namespace {

VoxelParams packed_params(std::uint32_t splat, std::uint32_t bits = bits_8) {
    return {.slices = 4, .splat = splat, .bits = bits, .packing = packing_rgb10};
}

TEST(VoxelColorColumn, CarriesIntoTheNextChannelAtTheFifthFullAddition) {
    const VoxelParams params = packed_params(splat_overflow_minimum);
    const Column nothing(column_format(params));
    ColorColumn column(color_format(params));
    for (int i = 0; i < 4; ++i) column.add(1, {255, 0, 10});
    EXPECT_EQ(column.fields(1), glm::uvec3(1020, 0, 40));
    column.add(1, {255, 0, 10});
    EXPECT_EQ(column.fields(1), glm::uvec3(251, 1, 50));
    EXPECT_EQ(column.overflow(), glm::uvec3(1, no_overflow, no_overflow));
    EXPECT_EQ(column.integral(nothing),
              (std::vector{glm::uvec3(0), glm::uvec3(255, 1, 50), glm::uvec3(255, 1, 50), glm::uvec3(255, 1, 50)}));
}

TEST(VoxelColorColumn, ExceedsAChannelAt256) {
    ColorColumn column(color_format(packed_params(splat_overflow_minimum)));
    column.add(3, {0, 255, 0});
    EXPECT_EQ(column.overflow().y, no_overflow);
    column.add(3, {0, 1, 0});
    EXPECT_EQ(column.overflow(), glm::uvec3(no_overflow, 3, no_overflow));
}

TEST(VoxelColorColumn, AddsWhatIsGrayToEveryChannel) {
    for (const std::uint32_t splat : {splat_wrapping, splat_saturating, splat_overflow_minimum}) {
        const VoxelParams params = packed_params(splat);
        Column gray(column_format(params));
        ColorColumn colors(color_format(params));
        colors.add(0, {10, 0, 200}), gray.add(1, 60), colors.add(3, {1, 2, 3});
        EXPECT_EQ(colors.integral(gray), (std::vector{glm::uvec3(10, 0, 200), glm::uvec3(70, 60, 255), glm::uvec3(70, 60, 255),
                                                      glm::uvec3(71, 62, 255)}));
    }
}

TEST(VoxelColorColumn, IsFullWhereEitherSourceOverflows) {
    const VoxelParams params = packed_params(splat_overflow_minimum);
    Column gray(column_format(params));
    ColorColumn colors(color_format(params));
    colors.add(1, {200, 0, 0}), colors.add(1, {200, 0, 7}), gray.add(2, 255), gray.add(2, 1);
    EXPECT_EQ(colors.integral(gray), (std::vector{glm::uvec3(0), glm::uvec3(255, 0, 7), glm::uvec3(255), glm::uvec3(255)}));
}

TEST(VoxelColorColumn, KeepsThinGrayLayersOfMoreBits) {
    const VoxelParams params = packed_params(splat_overflow_minimum, bits_16);
    const ColumnFormat format = column_format(params);
    Column gray(format);
    for (int i = 0; i < 200; ++i) gray.add(0, split_code(format, {}, format.codes(-std::log1p(-.01)), .5).nearer);
    const glm::uvec3 sum = ColorColumn(color_format(params)).integral(gray)[0];
    EXPECT_EQ(sum, glm::uvec3(92));  // of 2.01 in steps of .0217; one by one of 8 bits they would be 0
    EXPECT_NEAR(color_format(params).transmittance(sum.x), .134, .0015);
    for (const std::uint32_t bits : {bits_8, bits_10, bits_16, bits_32})
        EXPECT_LT(std::uint64_t{color_scale(column_format(packed_params(splat_overflow_minimum, bits)))} *
                          column_format(packed_params(splat_overflow_minimum, bits)).full_code +
                      color_scale_one,
                  1ull << 32);
}

struct ColorAddition {
    std::uint32_t slice;
    glm::uvec3 codes;
};

std::vector<glm::uvec3> color_integral(std::uint32_t splat, std::span<const ColorAddition> additions) {
    ColorColumn column(color_format(packed_params(splat)));
    for (const ColorAddition& a : additions) column.add(a.slice, a.codes);
    return column.integral(Column(column_format(packed_params(splat))));
}

TEST(VoxelColorColumn, IsTheSameInEveryOrderAndOffByItsCarries) {
    std::mt19937 random(7);
    const auto code = [&] { return static_cast<std::uint32_t>(random() % 256); };
    for (int trial = 0; trial < 20000; ++trial) {
        std::vector<ColorAddition> additions(1 + random() % 24);
        for (ColorAddition& a : additions) a = {static_cast<std::uint32_t>(random() % 4), {code(), code() / 8, code() / 8}};
        const std::vector<glm::uvec3> once = color_integral(splat_overflow_minimum, additions);
        const std::vector<glm::uvec3> exact = color_integral(splat_saturating, additions);
        for (std::size_t slice = 0; slice < once.size(); ++slice) {
            ASSERT_EQ(once[slice].x, exact[slice].x);  // nothing is carried into the first channel
            // 24 additions of 255 are 5 carries.
            for (const int c : {1, 2}) ASSERT_LE(once[slice][c] - exact[slice][c], 5u) << trial;
        }
        std::ranges::shuffle(additions, random);
        ASSERT_EQ(color_integral(splat_overflow_minimum, additions), once) << trial;
    }
}

}  // namespace
}  // namespace strata::transparency
