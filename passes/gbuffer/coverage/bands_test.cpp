// From alpha to samples: the table of docs/algorithms/deferred.md 4.2 to the digit, and what layers over each other hide.
#include "passes/gbuffer/coverage/bands.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <vector>

#include "passes/gbuffer/coverage/coverage.shared.h"
#include "tests/support/mean_coverages.h"

namespace strata::gbuffer {
namespace {

constexpr std::uint32_t band_modes[] = {masked_a2c_1, masked_a2c_2, masked_a2c_or, masked_full_step, masked_unbiased};

/// A fraction, so that alphas and steps which no float holds stay what they are.
struct Fraction {
    long numerator = 0, denominator = 1;
    friend Fraction operator+(Fraction a, Fraction b) {
        return {a.numerator * b.denominator + b.numerator * a.denominator, a.denominator * b.denominator};
    }
    long floor() const { return numerator >= 0 ? numerator / denominator : -((-numerator + denominator - 1) / denominator); }
};

/// The chapter's formulas at 4 samples and alpha k / 16.
long exact_count(std::uint32_t mode, long k, long p) {
    const Fraction bands{5 * k, 16};
    Fraction at = bands;
    if (mode == masked_a2c_2 || mode == masked_a2c_or) at = bands + Fraction{-5 * p * 2, 10 * 4 * 3};  // p (.2 / 4) / 3
    if (mode == masked_full_step) at = bands + Fraction{5 * (2 * p - 3), 2 * 20};
    if (mode == masked_unbiased) at = Fraction{4 * k, 16} + Fraction{2 * p + 1, 8};
    return std::clamp(at.floor(), 0l, 4l);
}

/// Over an aligned tile of 4 x 4 pixels.
double exact_coverage(std::uint32_t mode, long k) {
    long covered = 0;
    for (long y = 0; y < 4; ++y)
        for (long x = 0; x < 4; ++x) covered += exact_count(mode, k, mode == masked_a2c_or ? (x | y) & 3 : (x + y) & 3);
    return double(covered) / 64;
}

double mean_coverage(std::uint32_t mode, double alpha, std::uint32_t samples = 4) {
    double covered = 0;
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 4; ++x)
            covered += std::popcount(sample_mask(mode, samples, alpha, {.x = x, .y = y, .draw = 5, .triangle = 9}));
    return covered / (16 * samples);
}

TEST(CoverageBands, MeanCoverageOfConstantAlphaIsTheTableOfTheChapter) {
    for (const MeanCoverages& row : mean_coverages)
        for (std::size_t i = 0; i < table_alphas.size(); ++i) {
            EXPECT_EQ(exact_coverage(row.mode, long(table_alphas[i])), row.at[i]) << row.mode << " at " << table_alphas[i];
            EXPECT_EQ(mean_coverage(row.mode, double(table_alphas[i]) / 16), row.at[i]) << row.mode;
        }
}

TEST(CoverageBands, CountsInDoubleAreThoseOfFractions) {
    for (const std::uint32_t mode : band_modes)
        for (std::uint32_t k = 0; k <= 16; ++k)
            for (std::uint32_t p = 0; p < 4; ++p)
                EXPECT_EQ(sample_count(mode, 4, k / 16.0, p), std::uint32_t(exact_count(mode, long(k), long(p)))) << mode;
}

TEST(CoverageBands, MeansOverAllAlphasAndLargestErrorsAreThoseOfTheChapter) {
    struct Metrics {
        std::uint32_t mode;
        double mean, worst;
    };
    constexpr int steps = 20000;
    for (const Metrics& wanted : {Metrics{masked_a2c_1, .5, .2},
                                  {masked_a2c_2, .475, .2},
                                  {masked_a2c_or, .4625, .201},
                                  {masked_full_step, .5, .125},
                                  {masked_unbiased, .5, .0312}}) {
        double sum = 0, worst = 0;
        for (int i = 0; i < steps; ++i) {
            const double alpha = (i + .5) / steps, got = mean_coverage(wanted.mode, alpha);
            sum += got;
            worst = std::max(worst, std::abs(got - alpha));
        }
        EXPECT_NEAR(sum / steps, wanted.mean, 1e-4) << wanted.mode;
        EXPECT_NEAR(worst, wanted.worst, 1e-3) << wanted.mode;
    }
}

TEST(CoverageBands, AtOneSamplePlainBandsPartAtAHalfAndUnbiasedOnesDither) {
    for (int i = 0; i <= 64; ++i) {
        const double alpha = i / 64.0;
        EXPECT_EQ(sample_mask(masked_a2c_1, 1, alpha, {.x = 3}), std::uint32_t(std::min(1.0, std::floor(2 * alpha))));
    }
    for (std::uint32_t k = 0; k <= 16; k += 4) EXPECT_EQ(mean_coverage(masked_unbiased, k / 16.0, 1), k / 16.0);
}

TEST(CoverageBands, AlphaOneCoversEverySampleAndAlphaZeroNone) {
    for (const std::uint32_t mode : band_modes)
        for (const std::uint32_t samples : {1u, 4u})
            for (std::uint32_t place = 0; place < 64; ++place) {
                const BandPlace at{.x = place % 8, .y = place / 8, .draw = place, .triangle = place * 3};
                EXPECT_EQ(sample_mask(mode, samples, 1, at), (1u << samples) - 1) << mode;
                EXPECT_EQ(sample_mask(mode, samples, 0, at), 0u) << mode;
            }
}

/// What two layers of an alpha over each other cover.
double union_of_two(std::uint32_t mode, double alpha) {
    constexpr std::uint32_t edge = 64;
    double covered = 0;
    for (std::uint32_t y = 0; y < edge; ++y)
        for (std::uint32_t x = 0; x < edge; ++x)
            covered += std::popcount(sample_mask(mode, 4, alpha, {.x = x, .y = y, .draw = 1}) |
                                     sample_mask(mode, 4, alpha, {.x = x, .y = y, .draw = 2}));
    return covered / (4 * edge * edge);
}

TEST(CoverageBands, TwoLayersOfAHalfHideAHalfWithOnePatternAndThreeQuartersHashed) {
    for (const std::uint32_t mode : {masked_a2c_1, masked_a2c_2, masked_a2c_or}) EXPECT_EQ(union_of_two(mode, .5), .5) << mode;
    // Of a pixel .5, .75 or 1 with the shares 1/4, 1/2, 1/4: a standard deviation of .177, over 64 x 64 pixels .0028.
    EXPECT_NEAR(union_of_two(masked_unbiased, .5), .75, 4 * .0028);
}

TEST(CoverageBands, HashedPatternsTakeEverySampleAsOften) {
    std::array<int, 4> taken{};
    constexpr int pixels = 64 * 64;
    for (std::uint32_t i = 0; i < pixels; ++i) {
        const std::uint32_t mask = sample_mask(masked_unbiased, 4, .25, {.x = i % 64, .y = i / 64, .draw = 3, .triangle = 12});
        ASSERT_EQ(std::popcount(mask), 1);
        ++taken[std::size_t(std::countr_zero(mask))];
    }
    // A binomial of p = 1/4: standard deviation 27.7.
    for (const int count : taken) EXPECT_NEAR(count, pixels / 4, 4 * 27.7);
}

TEST(CoverageBands, FixedPatternsLeanToOneSideAsTheChapterSays) {
    struct Lean {
        std::uint32_t mask;
        double x, y;
    };
    constexpr double places[4][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};  // sixteenths of a pixel
    for (const Lean& wanted : {Lean{1, -.125, -.375}, {3, .125, -.25}, {7, -.042, -.125}, {15, 0, 0}}) {
        double x = 0, y = 0;
        for (int i = 0; i < 4; ++i)
            if (wanted.mask >> i & 1u) x += places[i][0] / 16, y += places[i][1] / 16;
        EXPECT_NEAR(x / std::popcount(wanted.mask), wanted.x, 1e-3);
        EXPECT_NEAR(y / std::popcount(wanted.mask), wanted.y, 1e-3);
        EXPECT_EQ(sample_mask(masked_a2c_2, 4, (std::popcount(wanted.mask) + .5) / 5, {}), wanted.mask);
    }
}

}  // namespace
}  // namespace strata::gbuffer
