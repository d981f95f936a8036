// The hull of a report's rows and the curve through it, against brute force, hand and SciPy.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/compare/curve.h"

namespace strata {
namespace {

using testing::ElementsAre;

std::vector<std::size_t> corners(const std::vector<CostPoint>& points) {
    std::vector<std::size_t> found;
    for (const HullPoint& corner : hull_of(points)) found.push_back(corner.point);
    return found;
}

/// Points that are the only cheapest one for some price of error: log cost + price * log error is least, the price above 0.
std::vector<std::size_t> corners_by_price(const std::vector<CostPoint>& points) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        double low = 0, high = HUGE_VAL;
        for (std::size_t j = 0; j < points.size(); ++j) {
            const double more_error = std::log(points[j].error / points[i].error);
            const double more_cost = std::log(points[j].cost / points[i].cost);
            if (more_error > 0) low = std::max(low, -more_cost / more_error);
            if (more_error < 0) high = std::min(high, -more_cost / more_error);
        }
        if (low < high) found.push_back(i);
    }
    std::ranges::sort(found, {}, [&](std::size_t i) { return points[i].error; });
    return found;
}

std::vector<CostPoint> random_points(std::mt19937_64& random) {
    const auto up_to = [&](double most) { return most * double(random() >> 11) * 0x1p-53; };
    std::vector<CostPoint> points(1 + random() % 30);
    for (CostPoint& point : points) {
        point.error = std::exp(-up_to(9));  // exp(-9) is above 1e-4
        point.cost = std::exp(up_to(5));
    }
    return points;
}

TEST(Hull, IsWhatACheapestChoiceFindsForSomePriceOfError) {
    std::mt19937_64 random(1);
    for (int set = 0; set < 1000; ++set) {
        const std::vector<CostPoint> points = random_points(random);
        EXPECT_EQ(corners(points), corners_by_price(points)) << "set " << set;
    }
}

TEST(Hull, EndsWhereMoreErrorSavesNothing) {
    EXPECT_THAT(corners({{.01, 8}, {.1, 1}, {.2, 1}, {.4, 2}}), ElementsAre(0, 1));
    EXPECT_THAT(corners({{.01, 8}, {.1, 4}, {.1, 2}, {1, 1}}), ElementsAre(0, 2, 3)) << "the cheapest of equal error";
    EXPECT_THAT(corners({{.01, 4}, {.1, 2}, {1, 1}}), ElementsAre(0, 2)) << "a point on the line is no corner";
}

TEST(Hull, HasOnlyTheCheapestOfExactRows) {
    EXPECT_THAT(corners({{0, 8}, {1e-12, 4}, {9e-5, 6}, {.01, 2}}), ElementsAre(1, 3));
    EXPECT_NEAR(hull_of(std::vector<CostPoint>{{0, 4}, {.01, 2}}).front().log_error, std::log(1e-4), 1e-15);
}

TEST(Hull, LeavesOutWhatNoClockMeasured) {
    EXPECT_THAT(corners({{.01, 0}, {.1, 2}}), ElementsAre(1));
    EXPECT_THAT(corners({{.01, 0}}), ElementsAre());
}

const std::vector<DecreasingCurve::Knot> five_knots{{0, 4}, {1, 2}, {2.5, .5}, {3, .25}, {5, -.25}};

TEST(DecreasingCurve, IsAkimas) {
    // Values of SciPy 1.10.1, scipy.interpolate.Akima1DInterpolator; no slope of these knots is limited.
    const DecreasingCurve curve(five_knots);
    EXPECT_NEAR(curve.at(.5), 2.8541666666666665, 1e-14);
    EXPECT_NEAR(curve.at(1.7), 1.1639407407407407, 1e-14);
    EXPECT_NEAR(curve.at(2.8), .3332000000000001, 1e-14);
    EXPECT_NEAR(curve.at(4), -.05208333333333333, 1e-14);
    EXPECT_NEAR(curve.integral(.25, 4.5), 3.9350694444444443, 1e-13);
    for (const auto& [x, y] : five_knots) EXPECT_NEAR(curve.at(x), y, 1e-15);
}

TEST(DecreasingCurve, DoesNotOvershootBesideASharpBend) {
    // SciPy's Akima1DInterpolator falls to -.31 between the third knot, .15, and the fourth, .05, where its slope is -3.37. With
    // that slope limited to three times -.1, values are those of scipy.interpolate.CubicHermiteSpline.
    const DecreasingCurve curve(std::vector<DecreasingCurve::Knot>{{0, 20.05}, {1, 10.05}, {2, .15}, {3, .05}, {4, 0}});
    EXPECT_NEAR(curve.at(.5), 15.04362373737374, 1e-13);
    EXPECT_NEAR(curve.at(1.25), 7.111079545454546, 1e-13);
    EXPECT_NEAR(curve.at(2.5), .06878172588832489, 1e-14);
    EXPECT_NEAR(curve.at(3.75), .008972477791878175, 1e-14);
    EXPECT_NEAR(curve.integral(.5, 3.75), 10.666458042829818, 1e-12);
}

TEST(DecreasingCurve, OfTwoKnotsIsALine) {
    const DecreasingCurve curve(std::vector<DecreasingCurve::Knot>{{1, 4}, {3, 0}});
    EXPECT_NEAR(curve.at(1.5), 3, 1e-15);
    EXPECT_NEAR(curve.integral(1.5, 2), 1.25, 1e-15);
}

TEST(DecreasingCurve, NeverRisesOnAnyHull) {
    std::mt19937_64 random(2);
    for (int set = 0; set < 1000; ++set) {
        const std::vector<HullPoint> hull = hull_of(random_points(random));
        if (hull.size() < 2) continue;
        for (const bool by_error : {true, false}) {
            const DecreasingCurve curve = by_error ? cost_over_error(hull) : error_over_cost(hull);
            const Interval over = by_error ? errors_of(hull) : costs_of(hull);
            double before = HUGE_VAL;
            for (int i = 0; i <= 500; ++i) {
                const double now = curve.at(over.low + (over.high - over.low) * i / 500);
                ASSERT_LE(now, before + 1e-12) << "set " << set;  // rounding where the slope is 0
                before = now;
            }
        }
    }
}

}  // namespace
}  // namespace strata
