// The saving of one curve of error against cost over another: closed forms, symmetries, and how often its interval is right.
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/compare/curve_comparison.h"

namespace strata {
namespace {

using Rows = std::vector<SampledRow>;

/// Rows of one known cost each, at exp of these logarithms.
Rows rows_at(const std::vector<std::pair<double, double>>& log_errors_and_costs) {
    Rows rows;
    for (const auto& [error, cost] : log_errors_and_costs) rows.push_back({std::exp(error), {std::exp(cost)}});
    return rows;
}

/// log cost = offset - 2 log error.
Rows power_law(double offset, const std::vector<double>& log_errors) {
    Rows rows;
    for (const double error : log_errors) rows.push_back({std::exp(error), {std::exp(offset - 2 * error)}});
    return rows;
}

TEST(CurveComparison, OfParallelLinesIsTheirDistance) {
    const CurveComparison made = compare_curves(power_law(1, {-5, -4, -2, -1}), power_law(.7, {-6, -3.5, -1.5}));
    ASSERT_TRUE(made.cost && made.error);
    EXPECT_NEAR(made.cost->ratio, std::exp(-.3), 1e-10);
    EXPECT_NEAR(made.error->ratio, std::exp(-.15), 1e-10);
    EXPECT_NEAR(made.cost->over.low, std::exp(-5), 1e-12);
    EXPECT_NEAR(made.cost->over.high, std::exp(-1.5), 1e-12);
    EXPECT_FALSE(made.cost->interval) << "no row has repeats";
}

TEST(CurveComparison, OfCurvesIsTheMeanOverTheErrorsOfBoth) {
    // exp of the mean difference of two scipy.interpolate.Akima1DInterpolator from .5 to 4, SciPy 1.10.1. Logarithms of errors
    // are 9 less: those below 1e-4 would be cut.
    const Rows a = rows_at({{-9, 4}, {-8, 2}, {-6.5, .5}, {-6, .25}, {-4, -.25}}),
               b = rows_at({{-8.5, 3}, {-7.5, 1.5}, {-5, -.75}});
    const CurveComparison made = compare_curves(a, b);
    ASSERT_TRUE(made.cost);
    EXPECT_NEAR(made.cost->ratio, .8955497886443224, 1e-12);
}

TEST(CurveComparison, IsTheInverseWithTheSidesSwappedAndTheSameInAnyUnit) {
    const Rows a = rows_at({{-8, 4}, {-7, 2}, {-5.5, .5}, {-5, .25}, {-3, -.25}}), b = rows_at({{-7.5, 3}, {-6, .9}, {-4, -.6}});
    const CurveComparison made = compare_curves(a, b), swapped = compare_curves(b, a);
    EXPECT_NEAR(made.cost->ratio * swapped.cost->ratio, 1, 1e-12);
    EXPECT_NEAR(made.error->ratio * swapped.error->ratio, 1, 1e-12);
    Rows scaled_a = a, scaled_b = b;
    for (Rows* rows : {&scaled_a, &scaled_b})
        for (SampledRow& row : *rows) row.costs[0] *= 1000;
    const CurveComparison scaled = compare_curves(scaled_a, scaled_b);
    EXPECT_NEAR(scaled.cost->ratio, made.cost->ratio, 1e-12);
    EXPECT_NEAR(scaled.error->ratio, made.error->ratio, 1e-12);
}

TEST(CurveComparison, NeedsARangeInCommon) {
    const Rows good = power_law(0, {-8, -7}), bad = power_law(0, {-5, -3}), touching = power_law(0, {-7, -6});
    EXPECT_FALSE(compare_curves(good, bad).cost);
    EXPECT_FALSE(compare_curves(good, bad).error);
    EXPECT_FALSE(compare_curves(good, touching).cost);
    const CurveComparison shifted = compare_curves(power_law(0, {-5, -3}), power_law(40, {-5, -3}));
    EXPECT_NEAR(shifted.cost->ratio / std::exp(40), 1, 1e-12);
    EXPECT_FALSE(shifted.error) << "no cost is reached by both";
    EXPECT_FALSE(compare_curves(power_law(0, {-5}), bad).cost) << "one row is no curve";
    EXPECT_FALSE(compare_curves(Rows{{0, {1}}, {1e-9, {2}}}, bad).cost) << "exact rows are one";
    EXPECT_FALSE(compare_curves(Rows{{.1, {0}}, {.2, {0}}}, bad).cost) << "a clock that is too coarse";
}

TEST(CurveComparison, StandsTheLargestAndSmallestNumbers) {
    const Rows huge{{.001, {1e300}}, {.1, {1e299}}, {1e300, {1e-300}}}, small{{1e-300, {5e-324, 1}}, {.5, {5e-324}}};
    const CurveComparison made = compare_curves(huge, small);
    ASSERT_TRUE(made.cost);
    EXPECT_FALSE(std::isnan(made.cost->ratio));
}

TEST(Quantile, LiesBetweenValuesByTheirDistance) {
    const std::vector<double> values{1, 2, 4};
    EXPECT_EQ(quantile(values, 0), 1);
    EXPECT_EQ(quantile(values, .5), 2);
    EXPECT_EQ(quantile(values, .75), 3);
    EXPECT_EQ(quantile(values, 1), 4);
}

/// Normal numbers that are equal on every platform (Box and Muller 1958).
class Normal {
public:
    explicit Normal(std::uint64_t seed) : random_(seed) {}
    double operator()() {
        const double radius = std::sqrt(-2 * std::log(unit())), angle = 2 * std::numbers::pi * unit();
        return radius * std::cos(angle);
    }

private:
    double unit() { return (double(random_() >> 11) + .5) * 0x1p-53; }
    std::mt19937_64 random_;
};

/// Four rows timed seven times with a deviation of 3 %.
Rows timed_rows(double factor, Normal& normal, std::uint32_t stream) {
    Rows rows;
    for (const auto& [error, ms] : {std::pair(.001, 8.), std::pair(.005, 3.), std::pair(.02, 1.5), std::pair(.1, 1.)}) {
        SampledRow& row = rows.emplace_back(SampledRow{.error = error, .costs = {}, .stream = stream});
        for (int repeat = 0; repeat < 7; ++repeat) row.costs.push_back(factor * ms * (1 + .03 * normal()));
        stream += 2;
    }
    return rows;
}

TEST(Bootstrap, IntervalsHoldTheTrueRatioInAbout95Of100Comparisons) {
    Normal normal(1);
    int held = 0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        const Rows a = timed_rows(1, normal, 0), b = timed_rows(.9, normal, 1);
        const CurveComparison made = compare_curves(a, b, {.draws = 1000});
        held += made.cost->interval->low <= .9 && .9 <= made.cost->interval->high;
    }
    // The interval is wide rather than narrow: over 1,000 comparisons it holds the ratio in 98 % at 3 repeats, in 98 to 99 % at 5
    // to 15, in 75 % at 2. Three deviations of 200 trials are .03 to .046.
    EXPECT_GE(held, trials * .88);
    EXPECT_LE(held, trials * .99);
}

TEST(Bootstrap, DrawsTheSameNumbersEverywhere) {
    const SampledRow row{.error = .1, .costs = {1, 2, 3, 4, 5, 6, 7}, .stream = 3};
    std::vector<double> drawn;
    for (std::uint32_t draw = 0; draw < 8; ++draw) drawn.push_back(drawn_cost(row, draw, {}));
    // Medians of seven draws each, by the same hash written in Python.
    EXPECT_THAT(drawn, testing::ElementsAre(6, 4, 5, 6, 5, 3, 4, 4));
}

TEST(Bootstrap, SaysHowManyDrawsHaveNoRangeInCommon) {
    // B's second row costs as much as its first in about half of the draws: then B is a single point.
    const Rows a{{.001, {8, 8}, 0}, {.1, {1, 1}, 2}}, b{{.01, {4, 4, 4}, 1}, {.05, {3, 5, 3, 5}, 3}};
    const CurveComparison made = compare_curves(a, b);
    EXPECT_FALSE(made.cost) << "medians of B are 4 and 4";
    const CurveComparison lower = compare_curves(a, Rows{{.01, {4, 4, 4}, 1}, {.05, {3, 5, 3}, 3}});
    ASSERT_TRUE(lower.cost && lower.cost->interval);
    EXPECT_EQ(lower.draws, 2000u);
    // Two or three of three draws are the 5: 7 / 27.
    EXPECT_NEAR(lower.cost->draws_without_it, 2000 * 7 / 27., 60);  // three deviations of 2,000 draws
}

}  // namespace
}  // namespace strata
