// Facts about voxel transparency (docs/algorithms/transparency.md 6: 6.2 to 6.7, and of 6.17 V1 to V5, V7, V8 and V11).
#include "passes/transparency/voxel/model.h"
#include "passes/transparency/voxel/slices/depth_curve.h"
#include "passes/transparency/voxel/volume/column.h"
#include "passes/transparency/voxel/volume/dimensions.h"
#include "passes/transparency/voxel/volume/volume.h"
#include "tests/support/layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "passes/transparency/functions/model.h"

namespace strata::transparency {
namespace {

// The talk's unit is the inch.
constexpr double far_end = 32000, first_150_meters = 5905.512;

TEST(VoxelDepthCurve, HasTheSlicesOfTheChapter) {
    const DepthCurve curve{.slices = 128, .linear = 128, .farthest = far_end};
    EXPECT_NEAR(curve.slice_of(100), 13.3738, 5e-5);
    EXPECT_NEAR(curve.slice_of(1000), 50.4121, 5e-5);
    EXPECT_NEAR(curve.slice_of(first_150_meters), 89.2580, 5e-5);
    EXPECT_NEAR(curve.depth_of(64), 1899.901378, 1e-6);
    EXPECT_NEAR(std::log2(1 + far_end / curve.linear), 7.971544, 5e-7);
    for (double s = 0; s <= 128; s += .37) EXPECT_NEAR(curve.slice_of(curve.depth_of(s)), s, 1e-12);
}

struct ThicknessRow {
    double slices, linear;
    std::array<double, 6> inches;  ///< at 0, 12, 100, 1000, 5905.5 and 32000
};
constexpr ThicknessRow thickness_table[] = {
    {128, 128, {5.525, 6.043, 9.842, 48.69, 260.5, 1386.8}}, {256, 256, {4.836, 5.063, 6.725, 23.73, 116.4, 609.4}},
    {512, 512, {4.151, 4.248, 4.962, 12.26, 52.03, 263.6}},  {1024, 1024, {3.474, 3.514, 3.813, 6.866, 23.51, 112.0}},
    {128, 37.998, {2, 2.632, 7.263, 54.63, 312.8, 1686.3}},  {256, 86.553, {2, 2.277, 4.311, 25.11, 138.5, 741.4}},
    {512, 201.891, {2, 2.119, 2.991, 11.91, 60.50, 319.0}},  {1024, 487.759, {2, 2.049, 2.410, 6.100, 26.21, 133.2}},
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

TEST(VoxelDepthCurve, TakesTheTalksInchesInMeters) {
    constexpr DepthRange from_the_eye{0, 800};
    const VoxelParams params{.slices = 128, .curve = curve_slices, .near_thickness = .0508f, .farthest = 800};
    EXPECT_NEAR(depth_curve(params, from_the_eye).linear, 3.2512, 1e-12);
    VoxelParams thin = params;
    thin.curve = curve_thickness;
    EXPECT_NEAR(depth_curve(thin, from_the_eye).thickness_at(0), .0508, 1e-8);
    VoxelParams linear = params;
    linear.curve = curve_linear, linear.linear = 7;
    EXPECT_EQ(depth_curve(linear, from_the_eye).linear, 7);
}

ColumnFormat format_of(std::uint32_t splat, std::uint32_t bits = bits_8, std::uint32_t slices = 128) {
    return column_format({.slices = slices, .splat = splat, .bits = bits});
}

double depth_of_alpha(double alpha) { return alpha < 1 ? -std::log1p(-alpha) : HUGE_VAL; }

/// Of one fragment in one slice.
std::uint32_t code_of(double alpha, std::uint32_t bits = bits_8, double rounding = .5) {
    const ColumnFormat format = format_of(splat_overflow_minimum, bits);
    return split_code(format, {}, format.codes(depth_of_alpha(alpha)), rounding).nearer;
}

TEST(VoxelCode, IsTheChaptersOfEightBits) {
    const ColumnFormat format = format_of(splat_overflow_minimum);
    EXPECT_NEAR(1 / format.codes_per_depth(), .0217304, 5e-8);
    EXPECT_EQ(code_of(.5), 32u);
    EXPECT_NEAR(format.transmittance(32), .498888, 5e-7);
    EXPECT_EQ(code_of(.1), 5u);
    EXPECT_NEAR(format.transmittance(5), .897042, 5e-7);
    EXPECT_EQ(code_of(.9), 106u);
    EXPECT_EQ(code_of(.9961), 255u);
    EXPECT_EQ(code_of(1), 255u);
    EXPECT_EQ(code_of(.01), 0u);
    EXPECT_EQ(code_of(.010805), 0u);
    EXPECT_EQ(code_of(.010807), 1u);
    EXPECT_EQ(format.transmittance(255), 0);
}

TEST(VoxelCode, OfMoreBitsKeepsThinLayers) {
    EXPECT_EQ(code_of(.01, bits_16), 59u);  // .01005034 of 11.09 in 65535 steps
    EXPECT_EQ(code_of(.01, bits_32), 760u);
    EXPECT_EQ(code_of(.01, bits_10), 1u);  // and nothing below .0034
    EXPECT_EQ(code_of(.5, bits_10), 102u);
    EXPECT_EQ(code_of(1, bits_10), 1023u);
    for (const std::uint32_t bits : {bits_8, bits_10, bits_16, bits_32}) {
        const ColumnFormat format = format_of(splat_words, bits);
        EXPECT_NEAR(format.transmittance(format.codes(depth_of_alpha(.5))), .5, 1e-12);
        EXPECT_EQ(format.field_bits, 32u);
    }
}

TEST(VoxelCode, RoundedAtRandomIsRightOnAverage) {
    const ColumnFormat format = format_of(splat_overflow_minimum);
    double sum = 0, squares = 0;
    constexpr int pixels = 2000;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
        std::uint32_t codes = 0;
        for (std::uint32_t layer = 0; layer < 200; ++layer)
            codes += code_of(.01, bits_8, random_rounding({pixel % 50, pixel / 50}, 1, 2 * layer));
        const double through = format.transmittance(codes);
        sum += through, squares += through * through;
    }
    const double mean = sum / pixels;
    EXPECT_NEAR(mean, .1352, 2e-3);
    EXPECT_NEAR(std::sqrt(squares / pixels - mean * mean), .021, 2e-3);
}

TEST(VoxelCode, IsNotLostByTheSplitBetweenSlices) {
    const ColumnFormat format = format_of(splat_overflow_minimum);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < 10000; ++i) {
        const double codes = 255 * share(random), rounding = share(random);
        const SplitCode split = split_code(format, slice_place(128 * share(random), 128, splatting_linear), codes, rounding);
        ASSERT_EQ(split.nearer + split.farther, std::min(255u, std::uint32_t(codes + rounding)));
        ASSERT_LT(split.slice + (split.farther ? 1 : 0), 128u);
    }
    // 50 layers of .02, .364 in truth; halves rounded on their own would leave .419.
    EXPECT_NEAR(format.transmittance(50. * code_of(.02)), .337, 1e-3);
}

TEST(VoxelColumn, CarriesAnOverflowAwayFromTheEye) {
    Column column(format_of(splat_overflow_minimum, bits_8, 4));
    const std::uint32_t before[] = {64, 128, 192, 32}, after[] = {64, 128, 64, 33};
    for (std::uint32_t slice = 0; slice < 4; ++slice) column.add(slice, before[slice]);
    EXPECT_EQ(column.overflow(), no_overflow);
    column.add(2, 128);
    for (std::uint32_t slice = 0; slice < 4; ++slice) EXPECT_EQ(column.field(slice), after[slice]);
    EXPECT_EQ(column.overflow(), 2u);
    EXPECT_EQ(column.integral(), (std::vector<std::uint32_t>{64, 192, 255, 255}));
}

TEST(VoxelColumn, IsFullAt255AndOverflowsAt256) {
    Column column(format_of(splat_overflow_minimum, bits_8, 8));
    column.add(5, 200), column.add(5, 55);
    EXPECT_EQ(column.overflow(), no_overflow);
    column.add(5, 1);
    EXPECT_EQ(column.overflow(), 5u);
}

struct Addition {
    std::uint32_t slice, code;
};

Column filled(const ColumnFormat& format, std::span<const Addition> additions) {
    Column column(format);
    for (const Addition& a : additions) column.add(a.slice, a.code);
    return column;
}

TEST(VoxelColumn, IntegratesWhateverOverflowsAsIfItSaturated) {
    std::mt19937 random(12);
    for (int trial = 0; trial < 100000; ++trial) {
        std::vector<Addition> additions(1 + random() % 12);
        for (Addition& a : additions) a = {static_cast<std::uint32_t>(random() % 8), static_cast<std::uint32_t>(random() % 256)};
        const auto integral = [&](std::uint32_t splat) { return filled(format_of(splat, bits_8, 8), additions).integral(); };
        ASSERT_EQ(integral(splat_overflow_minimum), integral(splat_saturating)) << trial;
        ASSERT_EQ(integral(splat_words), integral(splat_saturating)) << trial;
    }
}

TEST(VoxelColumn, IsTheSameInEveryOrder) {
    std::mt19937 random(3);
    for (const std::uint32_t splat : {splat_words, splat_wrapping, splat_saturating, splat_overflow_minimum})
        for (int trial = 0; trial < 500; ++trial) {
            std::vector<Addition> additions(20);
            for (Addition& a : additions)
                a = {static_cast<std::uint32_t>(random() % 8), static_cast<std::uint32_t>(random() % 200)};
            const ColumnFormat format = format_of(splat, bits_8, 8);
            const std::vector<std::uint32_t> once = filled(format, additions).integral();
            std::ranges::shuffle(additions, random);
            ASSERT_EQ(filled(format, additions).integral(), once) << splat;
        }
}

TEST(VoxelColumn, WithoutTheMinimumIsWrongBehindAnOverflow) {
    const std::array additions{Addition{2, 192}, Addition{2, 128}};
    EXPECT_EQ(filled(format_of(splat_wrapping, bits_8, 4), additions).integral(), (std::vector<std::uint32_t>{0, 0, 64, 65}));
}

TEST(VoxelColumn, HoldsThreeSlicesOfTenBitsInAWord) {
    const ColumnFormat format = format_of(splat_overflow_minimum, bits_10, 8);
    EXPECT_EQ(format.slices_per_word(), 3u);
    EXPECT_EQ(format.words(), 3u);
    Column column(format);
    column.add(2, 1023), column.add(3, 5), column.add(7, 9);
    EXPECT_EQ(column.overflow(), no_overflow);
    column.add(2, 1);  // the carry leaves the word's 30 bits and is seen by nobody
    EXPECT_EQ(column.overflow(), 2u);
    EXPECT_EQ(column.field(3), 5u);
    EXPECT_EQ(column.integral(), (std::vector<std::uint32_t>{0, 0, 1023, 1023, 1023, 1023, 1023, 1023}));
}

/// Inclusive sums of one fragment of 1 at s, not rounded.
std::vector<double> step_at(double s, std::uint32_t splatting, std::uint32_t slices = 16) {
    std::vector<double> integral(slices, 0.);
    const SlicePlace place = slice_place(s, slices, splatting);
    for (std::uint32_t k = place.slice; k < slices; ++k) integral[k] = k == place.slice ? 1 - place.share : 1;
    return integral;
}

struct Span {
    double low = 1, high = 0;
};
/// Of a fragment at every phase within a slice: what is read of it `slices_behind` it.
Span read_behind(double slices_behind, std::uint32_t splatting, std::uint32_t sampling, double bias) {
    Span span;
    constexpr int phases = 4000;
    for (int i = 0; i < phases; ++i) {
        const double s = 6 + double(i) / phases;
        const double read = sampled_integral(step_at(s, splatting), s + slices_behind + bias, sampling);
        span = {std::min(span.low, read), std::max(span.high, read)};
    }
    return span;
}

TEST(VoxelSampling, HidesAEventFromItselfByAsMuchAsTheTableSays) {
    constexpr double biases[] = {-1, -1.5, -2, -2.5, -3};
    constexpr double linear[] = {.25, .0625, 0, 0, 0}, bicubic[] = {.261, .0888, .0176, .0011, 0};
    for (std::size_t i = 0; i < std::size(biases); ++i) {
        EXPECT_EQ(read_behind(0, splatting_point, sampling_point, biases[i]).high, 0);
        EXPECT_NEAR(read_behind(0, splatting_linear, sampling_linear, biases[i]).high, linear[i], 1e-6);
        EXPECT_NEAR(read_behind(0, splatting_linear, sampling_bicubic, biases[i]).high, bicubic[i], 5e-4);
    }
    EXPECT_EQ(sampling_bias(sampling_point), -1);
    EXPECT_EQ(sampling_bias(sampling_linear), -2);
    EXPECT_EQ(sampling_bias(sampling_bicubic), -2.5);
}

struct BehindRow {
    double slices;
    Span point, linear, bicubic;
};
constexpr BehindRow behind_table[] = {
    {.5, {0, 1}, {0, .0625}, {0, .018}}, {1, {1, 1}, {0, .25}, {.021, .089}}, {1.5, {1, 1}, {.4375, .5625}, {.167, .261}},
    {2, {1, 1}, {.75, 1}, {.47, .53}},   {3, {1, 1}, {1, 1}, {.911, .979}},   {4, {1, 1}, {1, 1}, {.999, 1}},
};

TEST(VoxelSampling, HidesWhatIsBehindByAsMuchAsTheTableSays) {
    const auto expect = [](double slices, Span got, Span wanted) {
        EXPECT_NEAR(got.low, wanted.low, 1e-3) << slices;
        EXPECT_NEAR(got.high, wanted.high, 1e-3) << slices;
    };
    for (const BehindRow& row : behind_table) {
        expect(row.slices, read_behind(row.slices, splatting_point, sampling_point, -1), row.point);
        expect(row.slices, read_behind(row.slices, splatting_linear, sampling_linear, -2), row.linear);
        expect(row.slices, read_behind(row.slices, splatting_linear, sampling_bicubic, -2.5), row.bicubic);
    }
}

TEST(VoxelSampling, ReadsNothingInFrontOfTheVolume) {
    const std::vector<double> integral = step_at(0, splatting_linear);
    for (const std::uint32_t sampling : {sampling_point, sampling_linear, sampling_bicubic})
        EXPECT_EQ(sampled_integral(integral, sampling_bias(sampling), sampling), 0);
}

TEST(VoxelSampling, ReadsNothingButFullSlicesFromTheChaptersDistanceOn) {
    std::mt19937 random(5);
    for (const std::uint32_t sampling : {sampling_point, sampling_linear, sampling_bicubic})
        for (int trial = 0; trial < 200; ++trial) {
            const ColumnFormat format = format_of(splat_overflow_minimum, bits_8, 32);
            Column column(format);
            for (int i = 0; i < 12; ++i)
                column.add(static_cast<std::uint32_t>(4 + random() % 16), static_cast<std::uint32_t>(40 + random() % 80));
            const std::vector<std::uint32_t> codes = column.integral();
            const auto full = double(std::ranges::find(codes, 255u) - codes.begin());
            const auto through = [&](double s) {
                const std::vector<double> integral(codes.begin(), codes.end());
                return format.transmittance(sampled_integral(integral, s + sampling_bias(sampling), sampling));
            };
            const double zero = full + slices_to_zero({.sampling = sampling});
            EXPECT_GT(through(zero - .5), 0);
            for (double s = zero; s < 32; s += .01) ASSERT_EQ(through(s), 0) << sampling;
        }
}

struct Settled {
    ColumnFormat format;
    std::uint32_t splatting = splatting_point, sampling = sampling_point;
};

/// A pixel whose fragments lie at slice coordinates depth.
double blend(const Settled& settled, std::span<const Fragment> fragments) {
    Column column(settled.format);
    for (const Fragment& f : fragments)
        column.add(split_code(settled.format, slice_place(f.depth, settled.format.slices, settled.splatting),
                              settled.format.codes(depth_of_alpha(f.alpha)), .5));
    const std::vector<std::uint32_t> codes = column.integral();
    const std::vector<double> integral(codes.begin(), codes.end());
    const Transmittance function = [&](const Fragment& f) {
        const double at = f.depth + sampling_bias(settled.sampling);
        return glm::dvec3(settled.format.transmittance(sampled_integral(integral, at, settled.sampling)));
    };
    return function_blend(fragments, glm::dvec3(0), function).x;
}

TEST(Voxel, HasAsManyColumnsAsFitIntoHalfAGibibyte) {
    const VoxelParams params{.slices = 128, .splat = splat_overflow_minimum, .bits = bits_8, .resolution = 0};
    EXPECT_EQ(voxel_divisor(params, {1920, 1080, 1}, 1), 1u);  // 265 MB
    EXPECT_EQ(voxel_divisor(params, {1920, 1080, 1}, 3), 2u);
    EXPECT_EQ(voxel_divisor(params, {3840, 2160, 1}, 1), 2u);
    VoxelParams packed = params;
    packed.packing = packing_rgb10;
    EXPECT_EQ(4 * voxel_words(params, 3), 384u);         // bytes of a texel
    EXPECT_EQ(4 * voxel_words(packed, 3), 128u + 512u);  // docs/algorithms/transparency.md 6.14 has 512 more, for the integral
    EXPECT_EQ(voxel_words(packed, 1), voxel_words(params, 1));
    EXPECT_EQ(voxel_divisor(packed, {1920, 1080, 1}, 3), 2u);
    VoxelParams eighth = params;
    eighth.resolution = 3;
    EXPECT_EQ(voxel_divisor(eighth, {3840, 2160, 1}, 3), 8u);
}

TEST(Voxel, AveragesWhatSharesASliceAndSortsWhatDoesNot) {
    const Settled point{format_of(splat_overflow_minimum, bits_32)};
    EXPECT_NEAR(blend(point, std::array{layer(5.2, .5, 1), layer(5.7, .5, 0)}), .375, 1e-9);
    EXPECT_NEAR(blend(point, std::array{layer(5.9, .5, 1), layer(6.1, .5, 0)}), .5, 1e-6);
    const Settled cards{format_of(splat_overflow_minimum)};
    EXPECT_NEAR(blend(cards, std::array{layer(5.2, 1, 1), layer(5.7, 1, 0)}), .5, 1e-9);
    EXPECT_EQ(blend(cards, std::array{layer(5.9, 1, 0), layer(6.1, 1, 1)}), 0);
}

TEST(Voxel, BlendsTheRampOfTwentyLayersAsFarAs255LevelsGo) {
    std::vector<Fragment> ramp;
    for (int i = 0; i < 20; ++i) ramp.push_back(layer(3.5 + 5 * i, .3, i / 19.));
    EXPECT_NEAR(blend({format_of(splat_overflow_minimum)}, ramp), .12324, 2e-3);
    EXPECT_NEAR(blend({format_of(splat_overflow_minimum, bits_32)}, ramp), .121869, 2e-3);  // docs/algorithms/transparency.md R7
}

TEST(Voxel, SeesThinSmokeInFrontOfACard) {
    const std::array fragments{layer(40.3, .1, 1), layer(80.6, 1, 0)};
    EXPECT_NEAR(blend({format_of(splat_overflow_minimum)}, fragments), .1003, 1e-4);
}

/// Slices are even over the ray's [0, 1].
double area_to_the_exact_steps(const Settled& settled, std::span<const Fragment> fragments) {
    Column column(settled.format);
    const double n = settled.format.slices;
    for (const Fragment& f : fragments)
        column.add(split_code(settled.format, slice_place(f.depth * n, settled.format.slices, settled.splatting),
                              settled.format.codes(depth_of_alpha(f.alpha)), .5));
    const std::vector<std::uint32_t> codes = column.integral();
    const std::vector<double> integral(codes.begin(), codes.end());
    constexpr int samples = 20000;
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
        const double d = (i + .5) / samples, at = d * n + sampling_bias(settled.sampling);
        double exact = 1;
        for (const Fragment& f : fragments) exact *= f.depth < d ? 1 - f.alpha : 1;
        sum += std::abs(settled.format.transmittance(sampled_integral(integral, at, settled.sampling)) - exact);
    }
    return sum / samples;
}

struct AreaRow {
    std::uint32_t slices;
    std::array<double, 4> point, linear;  ///< of the rays A to D of docs/algorithms/transparency.md 9.3
};
// The linear rows of that table are those of halves rounded on their own (.0643 and .0315 of ray C, .0450 and .0127 of D): what
// is lost one by one happens to make up for what a single rounding adds. Ours keep the unsplit code and are held against a second
// program.
constexpr AreaRow area_table[] = {
    {32, {.0068, .0215, .1058, .0200}, {.0340, .0423, .1359, .0453}},
    {128, {.0068, .0040, .0946, .0140}, {.0081, .0113, .1024, .0151}},
};

std::array<std::vector<Fragment>, 4> canonical_rays() {
    std::array<std::vector<Fragment>, 4> rays;
    rays[0] = {layer(.43, .9, 1)};
    for (const double d : {.1, .3, .5005, .7, .9}) rays[1].push_back(layer(d, .5, 1));
    for (int i = 0; i < 100; ++i) rays[2].push_back(layer((i + .5) / 100, -std::expm1(-.03), 1));
    for (int i = 0; i < 20; ++i) rays[3].push_back(layer(.2 + .2 * (i + .5) / 20, -std::expm1(-.1), 1));
    rays[3].push_back(layer(.8, -std::expm1(-10.), 1));
    return rays;
}

TEST(Voxel, LeavesTheAreaOfTheChapterOnTheCanonicalRays) {
    const std::array rays = canonical_rays();
    for (const AreaRow& row : area_table)
        for (std::size_t r = 0; r < rays.size(); ++r) {
            const ColumnFormat format = format_of(splat_overflow_minimum, bits_8, row.slices);
            EXPECT_NEAR(area_to_the_exact_steps({format}, rays[r]), row.point[r], 2e-3) << row.slices << "ABCD"[r];
            EXPECT_NEAR(area_to_the_exact_steps({format, splatting_linear, sampling_linear}, rays[r]), row.linear[r], 2e-3)
                << row.slices << "ABCD"[r];
        }
}

}  // namespace
}  // namespace strata::transparency
