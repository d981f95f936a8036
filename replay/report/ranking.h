// Which rows are worth their cost: Pareto fronts, and the most accurate row within a budget. No device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/measure/exact_below.h"

namespace strata {

/// The error that ranks rows, by its name: "display rmse touched".
struct RankingError {
    std::string name;
    bool is_of_white = false;  ///< a share of white, which people read in percent
    std::string text(double error) const;
    /// Standing::rounding: what float leaves of exact light. An object of a million that is missed is none of it.
    double rounding() const { return is_of_white ? exact_below : 0; }
};

/// What a row is ranked by. Without an error it is not ranked: the technique cannot do the frame.
struct Standing {
    std::optional<double> error;
    double time = 0;                          ///< in whatever unit all rows have
    double spread = 0;                        ///< of time: two times that differ by less than both spreads are equal
    double bytes_per_pixel = 0;               ///< whole ones: the few bytes of a counter are no cost
    double ms = 0, ms_spread = 0, bytes = 0;  ///< what limits that are no multiples are of
    double rounding = 0;                      ///< errors below it are equal
    /// The error as rows are compared by it. Only of those that are ranked.
    double compared_error() const { return *error < rounding ? 0 : *error; }
};
using Cost = double Standing::*;

/// Whether the spreads do not tell their times apart.
bool are_level(const Standing&, const Standing&);

/// For each row whether no other is more accurate and no dearer, or cheaper and no less accurate; equal rows share the front.
std::vector<bool> pareto_front(std::span<const Standing>, Cost);

/// For each row whether the spreads alone keep it off the front of time: a more accurate row's time is not told apart from its
/// own.
std::vector<bool> ties_in_time(std::span<const Standing>);

/// A most that may be spent: "time" 2, "bytes per pixel" 32.
struct Budget {
    Cost cost;
    double most = 0;
};
/// Of time in units of Technique::is_time_unit, and of memory.
std::span<const Budget> budgets();
/// "time <= 2", "bytes per pixel <= 32".
std::string name(const Budget&);

/// The most accurate row within a budget, also with its spread, or nothing; of equally accurate ones that which spends least.
std::optional<std::size_t> best_within(std::span<const Standing>, const Budget&);

}  // namespace strata
