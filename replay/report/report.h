// Every technique of a stage, and every combination of swept settings, on one frame: error against the truth beside time,
// memory and counters, and which are on the Pareto front.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "replay/session.h"

namespace strata {

/// "--sweep key=a,b,c": every technique of the stage that has the key is measured at each value.
struct Sweep {
    std::string key;
    std::vector<std::string> values;
};

struct ReportRequest {
    Request base;  ///< frame, other stages' choices
    Stage stage = Stage::transparency;
    std::vector<Sweep> sweeps;
    std::size_t repeats = 7;
};

/// One row.
struct Measurement {
    std::string technique, settings;  ///< settings: "falloff=20 weight=w9", only what differs from the defaults
    Accuracy accuracy;
    Spread stage_ms, frame_ms;
    std::uint64_t stage_bytes = 0;
    std::vector<CounterRecord> counters;  ///< of the technique
    bool on_front = false;                ///< nothing is both more accurate and faster
};

struct Report {
    Stage stage = Stage::transparency;
    std::string capture_id, truth;  ///< truth: "exact, in double" or which technique stood in and how exact it is
    std::size_t frame = 0, repeats = 0;
    std::uint32_t width = 0, height = 0, samples = 1;
    DeviceInfo device;
    std::vector<Measurement> rows;  ///< most accurate first, then what is not supported
    std::string skipped;            ///< why the frame does not need the stage; then there are no rows
};

/// Called with what is being done and the share that is done, 0..1.
using Progress = std::function<void(std::string_view what, double done)>;

Result<Report> make_report(Session&, const ReportRequest&, const Progress& = {});

/// Marks the rows that no other row beats in both error and time.
void mark_front(std::vector<Measurement>&);

/// The figures of the stage's judge, and FLIP's mean behind them where there is one.
std::vector<Figure> errors_of(const Measurement&);

std::string as_text(const Report&);
std::string as_json(const Report&);
std::string as_csv(const Report&);

}  // namespace strata
