// Times of a report's rows, as they are measured: each beside the technique whose time is the unit, repeat by repeat.
#pragma once

#include <span>
#include <vector>

#include "replay/report/report.h"
#include "replay/report/variants.h"

namespace strata {

class RowTimes {
public:
    /// The rows' requests, in their order. The session and they outlive it.
    RowTimes(Session& session, Stage stage, std::span<const Variant> rows)
        : session_(&session), stage_(stage), all_(rows.size()) {
        for (std::size_t i = 0; i < rows.size(); ++i) all_[i].variant = &rows[i];
    }

    /// The row whose time is 1. It is timed with every other.
    void set_unit(std::size_t row) { unit_ = row; }
    std::optional<std::size_t> unit() const { return unit_; }
    /// Runs these rows in turn, `repeats` times each. Stopped, it keeps the turns that were complete, or fails where there is
    /// none.
    Result<void> time(std::vector<std::size_t> rows, std::size_t repeats, const Progress&);
    std::size_t repeats(std::size_t row) const { return all_[row].stage_ms.size(); }
    /// Times, bytes and counters of a row that was timed.
    void add_to(Measurement&, std::size_t row, const Report&) const;
    /// Whether a row can be told in the unit: none on a clock that is too coarse for the frame.
    bool has_unit() const { return has_unit_; }

private:
    struct Row {
        const Variant* variant = nullptr;
        std::uint64_t bytes = 0;                   ///< of the stage
        std::optional<std::uint64_t> invocations;  ///< and how often its shaders ran
        std::vector<CounterRecord> counters;
        std::vector<double> stage_ms, frame_ms, sort_ms, unchanged_ms;
        std::vector<std::pair<std::string, std::vector<double>>> steps_ms;  ///< by name
        std::vector<double> unit_ms;                                        ///< the unit's stage_ms in the same turns
    };
    Session* session_;
    Stage stage_;
    std::vector<Row> all_;
    std::optional<std::size_t> unit_;
    bool has_unit_ = false;
};

}  // namespace strata
