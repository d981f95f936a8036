// Warnings that the errors of a report say little of other views: few pixels, one bright sample, clipped light, metrics that
// disagree, errors of a few pixels. No device.
#pragma once

#include <string>
#include <vector>

#include "replay/report/report.h"

namespace strata {

/// Under so many pixels that the stage changes there is no answer, and under so many an answer is of this view alone: the orders
/// of techniques over 7, 100, 300 and 1,000 of a frame's pixels agree with the whole frame's by .55, .64, .69 and .85 (Kendall's
/// tau, 16 scenes and 12 techniques).
inline constexpr std::size_t fewest_pixels = 100, few_pixels = 1000;

struct Warning {
    std::string id;  ///< "few_pixels"
    std::string text;
};
std::vector<Warning> warnings_of(const Report&);

/// Whether the stage changes too few pixels for an answer.
bool changes_too_little(const Report&);

/// Kendall's tau-b of two figures of the same rows: 1 where they order all pairs alike, -1 where none; nothing where one of them
/// is the same in all rows.
std::optional<double> rank_agreement(const std::vector<double>&, const std::vector<double>&);

}  // namespace strata
