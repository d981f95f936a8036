// Ratios of times that techniques state (Technique::ratios), measured: both variants in turn within one run, and what either
// counts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/report/report.h"
#include "replay/session/session.h"
#include "replay/tables/sheet.h"

namespace strata {

struct TimeRatio;  // passes/claims.h

/// A ratio, and what it is measured on.
struct Claim {
    const Technique* technique = nullptr;
    const TimeRatio* ratio = nullptr;
    Request base;       ///< frame, other stages' choices
    std::string scene;  ///< for people: the scenario's or the capture's name
    /// The frame of the variant that is measured against; none: that of `base`.
    std::optional<std::size_t> against_frame = {};
};

/// One of the two variants.
struct TimedVariant {
    std::string technique, settings;
    Spread ms;                            ///< of the steps that count
    std::vector<CounterRecord> counters;  ///< in the last repeat: those that the ratio names and the technique has
    std::string frame = {};               ///< what is changed in its frame, for people: "64 lights"
    std::uint64_t stage_bytes = 0;        ///< images and buffers first used by the technique
};

struct MeasuredRatio {
    Claim claim;
    std::uint32_t width = 0, height = 0, samples = 1;
    TimedVariant of, against;
    Spread ratio;              ///< repeat by repeat
    std::string not_measured;  ///< why; then there are no times
};

struct Bench {
    DeviceInfo device;
    std::size_t repeats = 0;
    std::vector<MeasuredRatio> rows;  ///< as the claims
    std::string stopped = {};         ///< what is missing because a stop was asked for: the rows are of the first claims
    std::string date = {};            ///< utc_date(); the caller's
};

/// Claims of the same two variants are measured in the same run. Fails where none can be measured.
/// Stopped (Session::stop_when), it gives the rows that are complete, or fails where there is none.
Result<Bench> measure_ratios(Session&, std::span<const Claim>, std::size_t repeats, const Progress& = {});

/// The stages ("gbuffer:") or the parts of step names that a ratio counts; none: every step of the technique.
std::vector<std::string> counted_steps(const TimeRatio&);

Sheet sheet_of(const Bench&);
/// The table, then what either variant is, took and counted.
Page page_of(const Bench&);
std::string as_text(const Bench&);
std::string as_json(const Bench&);
std::string as_csv(const Bench&);

}  // namespace strata
