// Which rows are worth their cost: Pareto fronts, and the most accurate row within a budget. No device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace strata {

/// What a row is ranked by. Without an error it is not ranked: the technique cannot do the frame.
struct Standing {
    std::optional<double> error;
    double time = 0;             ///< in whatever unit all rows have
    double bytes_per_pixel = 0;  ///< whole ones: the few bytes of a counter are no cost
};
using Cost = double Standing::*;

/// For each row whether nothing is both more accurate and cheaper; equal rows share the front.
std::vector<bool> pareto_front(std::span<const Standing>, Cost);

/// A most that may be spent: "time" 2, "bytes per pixel" 32.
struct Budget {
    Cost cost;
    double most = 0;
};
/// Of time in units of Technique::is_time_unit, and of memory.
std::span<const Budget> budgets();
/// "time <= 2", "bytes per pixel <= 32".
std::string name(const Budget&);

/// The most accurate row within a budget, or nothing.
std::optional<std::size_t> best_within(std::span<const Standing>, const Budget&);

}  // namespace strata
