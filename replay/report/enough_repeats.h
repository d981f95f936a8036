// Which rows of a report are worth another timed run: those whose place beside a row or a limit that matters is not certain yet.
// No device.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "replay/report/answer.h"

namespace strata {

/// For each row whether its time is within both spreads of that of a row that it shares the front with or may push off it, or
/// within its own spread of a limit at which it may be the most accurate row: those of budgets() in time, and Question::within. A
/// row with an error that is no larger and a time that is shorter by more than both spreads settles the place of another: that
/// one is never uncertain because of rows. A row without an error is not ranked.
std::vector<bool> uncertain_rows(std::span<const Standing>, const Question&);

/// For each row whether another one has no larger error in less than half the time: a single run tells times apart that differ
/// so much.
std::vector<bool> rows_far_behind(std::span<const Standing>);

}  // namespace strata
