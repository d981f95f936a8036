// A report as its JSON says it (strata report -o FILE.json): what two reports are compared by. No device.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/memory_budget.h"
#include "replay/report/ranking.h"

namespace strata {

/// A ranked row. Members are named after those of Measurement.
struct StoredRow {
    std::string technique, settings;
    double error = 0;  ///< the row is ranked by it
    std::vector<double> repeats_ms, baseline_repeats_ms;
    double bytes_per_pixel = 0;
    std::map<std::string, std::uint64_t> counters;
};

struct StoredReport {
    std::string file;  ///< as it was given
    std::string program, device, driver, capture_id, capture_name, truth;
    std::uint64_t frame = 0, width = 0, height = 0, samples = 0;
    std::string stage, error_at, time_unit;
    RankingError ranked_by;
    std::vector<StoredRow> rows;  ///< ranked ones; at least one
    // Rows that are not ranked:
    std::size_t not_supported = 0, with_other_truth = 0, without_finite_error = 0;
};

/// Fails (bad input) for a file that is no report of one capture, that is stopped before times were measured, or that lacks a
/// key; the sentence names the key.
Result<StoredReport> read_report(const std::filesystem::path&, MemoryBudget&);
/// The same of a file's text.
Result<StoredReport> parse_report(std::string_view text, const std::filesystem::path&);

}  // namespace strata
