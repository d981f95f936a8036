// Makes the rows of a report: errors, then times, one group after the other.
#pragma once

#include <span>

#include "replay/report/row_times.h"
#include "replay/report/row_truth.h"

namespace strata {

/// Repeats that every row has: all of them, or fewer where rows are timed again only while their place is uncertain.
std::size_t least_repeats_of(const ReportRequest&);

class RowMaker {
public:
    /// All of these outlive it. Rows whose time may be the unit come first.
    RowMaker(Session& session, const ReportRequest& wanted, std::span<const Variant> all, const RowTruths& row_truths,
             Report& report)
        : session_(&session),
          wanted_(&wanted),
          all_(all),
          row_truths_(&row_truths),
          report_(&report),
          times_(session, wanted.stage, all) {}

    /// Errors and times. Stopped, the report has the complete groups; if there is none, the rows whose errors are known.
    Result<void> make_all(const Progress&);
    /// Times the rows whose place is uncertain as often as rows are timed at most.
    Result<void> time_again(const Progress&);

private:
    Result<void> make_group(std::size_t end, const Progress&);
    bool is_supported(std::size_t row) const { return report_->rows[row].accuracy.not_supported.empty(); }
    void count_repeats();

    Session* session_;
    const ReportRequest* wanted_;
    std::span<const Variant> all_;
    const RowTruths* row_truths_;
    Report* report_;
    RowTimes times_;
};

}  // namespace strata
