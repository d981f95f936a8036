// Reports to compare, as a device would have given them.
#pragma once

#include <string>
#include <vector>

#include "replay/compare/stored_report.h"
#include "replay/report/report.h"

namespace strata {

/// A ranked row of a report in which the baseline takes 2 ms in every repeat.
struct TimedRow {
    std::string technique;
    double error = 0;
    std::vector<double> repeats_ms;
    std::uint64_t overflowed = 0;  ///< a counter
};
Report report_with(const std::vector<TimedRow>&);
/// The same, written and read.
StoredReport stored(const Report&);

}  // namespace strata
