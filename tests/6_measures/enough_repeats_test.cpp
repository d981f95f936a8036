// Which rows of a report are timed again: those whose rank the spreads leave open.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/report/enough_repeats.h"

namespace strata {
namespace {

std::vector<bool> uncertain(const std::vector<Standing>& rows, const Question& question = {}) {
    return uncertain_rows(rows, question);
}

using testing::ElementsAre;

TEST(EnoughRepeats, RowsThatLieApartAreCertain) {
    EXPECT_THAT(uncertain({{.1, 1.5, .1}, {.05, 3, .1}, {.01, 5, .1}}), ElementsAre(false, false, false));
}

TEST(EnoughRepeats, TwoOfTheFrontWithinTheirSpreadsAreNot) {
    EXPECT_THAT(uncertain({{.1, 3, .1}, {.05, 3.15, .1}, {.01, 6, .1}}), ElementsAre(true, true, false));
    EXPECT_THAT(uncertain({{.1, 3, .05}, {.05, 3.15, .05}, {.01, 6, .1}}), ElementsAre(false, false, false)) << "3.05 < 3.10";
}

TEST(EnoughRepeats, ARowThatIsSurelyBeatenIsCertainHoweverNearToOthers) {
    // The second is beaten by the first, which is more accurate and faster by more than both spreads; so is the third.
    EXPECT_THAT(uncertain({{.01, 1.5, .1}, {.05, 3, .5}, {.06, 3.1, .5}}), ElementsAre(false, false, false));
}

TEST(EnoughRepeats, ALimitWithinTheSpreadLeavesOpenWhoIsMostAccurateBelowIt) {
    // Budgets are at 1, 2 and 4 times the baseline.
    EXPECT_THAT(uncertain({{.1, 1.5, .1}, {.05, 2.05, .1}}), ElementsAre(false, true));
    EXPECT_THAT(uncertain({{.1, 1.5, .1}, {.05, 2.2, .1}}), ElementsAre(false, false));
    // The third is slower and less accurate than what surely keeps to the limit.
    EXPECT_THAT(uncertain({{.1, 1.2, .01}, {.05, 1.5, .1}, {.08, 2.05, .1}}), ElementsAre(false, false, false));
}

TEST(EnoughRepeats, TheTimeThatIsAskedForIsALimit) {
    const std::vector<Standing> rows{{.1, 1.5, .1}, {.05, 3.05, .1}};
    EXPECT_THAT(uncertain(rows), ElementsAre(false, false));
    EXPECT_THAT(uncertain(rows, {.within = 3}), ElementsAre(false, true));
}

TEST(EnoughRepeats, WhatIsNotSupportedIsNotRanked) {
    EXPECT_THAT(uncertain({{{}, 1.5, .5}, {.05, 1.5, .1}}), ElementsAre(false, false));
}

TEST(RowsFarBehind, AreThoseThatAnotherBeatsTwiceOver) {
    const std::vector<Standing> rows{{.1, 1}, {.05, 2.1}, {.05, 4.1}, {.05, 4.3}, {.04, 9}, {{}, 9}};
    EXPECT_THAT(rows_far_behind(rows), ElementsAre(false, false, false, true, false, false)) << "4.2 < 4.3";
}

}  // namespace
}  // namespace strata
