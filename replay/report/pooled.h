// Reports of several captures as one: how techniques fare in the mean over frames. No device.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/report/report.h"

namespace strata {

/// A technique with its settings over all captures whose frame needs the stage. Geometric means: half on one frame and twice on
/// another cancel, whatever the frames' own errors are. Shares of white are of one scale on all frames: their mean is arithmetic.
struct PooledRow {
    std::string technique, settings;
    double error = 0;
    double worst_error = 0;      ///< of a capture
    std::string worst_capture;   ///< its name
    std::optional<double> time;  ///< in the time unit; none where a capture has none
    double bytes_per_pixel = 0;  ///< arithmetic mean: it may be 0
    std::optional<double> flicker;
    std::size_t captures = 0;      ///< that it can do; only rows that can do all of them are ranked
    bool has_other_truth = false;  ///< in any of them: not ranked, see Measurement
    bool on_front = false, on_memory_front = false;
};

struct Pool {
    Stage stage = Stage::transparency;
    std::size_t captures = 0;     ///< whose frame needs the stage
    RankingError error;           ///< what PooledRow::error is the mean of
    std::string time_unit;        ///< as in Report; empty when not all have the same
    std::vector<PooledRow> rows;  ///< those that can do all captures first, then the ranked ones, then the most accurate first
};

/// Of reports on one stage.
Pool pooled(std::span<const Report>);

/// exp of the mean of the logs. Values below 1e-5 count as 1e-5, which nobody sees: one frame that a technique happens to do
/// exactly would be all of its mean, and the rounding of an exact technique is no merit.
double geometric_mean(std::span<const double>);

/// Rows that are not ranked have no error.
std::vector<Standing> standings(const Pool&);

std::string as_text(const Pool&);
/// The reports and what they are pooled to.
std::string as_json(std::span<const Report>, const Pool&);
std::string as_csv(std::span<const Report>, const Pool&);

}  // namespace strata
