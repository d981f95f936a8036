// A report's own arithmetic.
#include <gtest/gtest.h>

#include "replay/report/report.h"

namespace strata {
namespace {

Measurement row(std::string name, double error, double ms) {
    Measurement measured{.technique = std::move(name)};
    measured.accuracy.method = {{"rmse", "", error}};
    measured.stage_ms.median = ms;
    return measured;
}

TEST(ParetoFront, HoldsWhatNothingBeatsInBothErrorAndTime) {
    std::vector<Measurement> rows = {row("exact", 0, 10), row("good", .01, 2), row("dominated", .02, 3), row("fast", .5, 1)};
    mark_front(rows);
    EXPECT_TRUE(rows[0].on_front);
    EXPECT_TRUE(rows[1].on_front);
    EXPECT_FALSE(rows[2].on_front);
    EXPECT_TRUE(rows[3].on_front);
}

TEST(ParetoFront, EqualRowsShareIt) {
    std::vector<Measurement> rows = {row("one", .1, 1), row("other", .1, 1)};
    mark_front(rows);
    EXPECT_TRUE(rows[0].on_front);
    EXPECT_TRUE(rows[1].on_front);
}

TEST(ParetoFront, WhatIsNotSupportedIsNeverOnIt) {
    std::vector<Measurement> rows = {row("one", .1, 1), {.technique = "cannot"}};
    rows[1].accuracy.not_supported = "chromatic";
    mark_front(rows);
    EXPECT_FALSE(rows[1].on_front);
}

TEST(Spread, IsTheMedianAndItsDeviation) {
    const double values[] = {5, 1, 2, 3, 4};
    const Spread spread = spread_of(values);
    EXPECT_EQ(spread.median, 3);
    EXPECT_EQ(spread.mad, 1);
    EXPECT_EQ(spread.low, 1);
    EXPECT_EQ(spread.high, 5);
    EXPECT_EQ(spread.repeats, 5u);
}

}  // namespace
}  // namespace strata
