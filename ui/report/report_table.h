// A report as a table that can be sorted: what is worth its cost, what is shown now, what is not supported and why.
#pragma once

#include "ui/report/report_job.h"
#include "ui/widgets/widgets.h"

namespace strata::ui {

class ReportTable {
public:
    struct Marks {
        const ReportAxes& axes;
        std::optional<std::size_t> now;      ///< the row that is shown now
        std::optional<std::size_t> in_plot;  ///< the row whose point is under the mouse
    };
    /// The row that was clicked.
    std::optional<std::size_t> draw(Widgets&, const Study&, const Marks&);
    /// The row that is under the mouse.
    std::optional<std::size_t> under() const { return under_; }

private:
    using Columns = std::vector<const ReportColumn*>;
    struct RowLook {
        bool on_front = false, is_now = false;
        const Columns& columns;
    };

    void draw_heads(Widgets&, const Columns&, const ReportAxes&);
    bool draw_row(Widgets&, const Study&, std::size_t row, const RowLook&);

    std::string sorted_by_;  ///< a column's label; empty: the error that is an axis
    SortOrder order_ = SortOrder::ascending;
    std::optional<std::size_t> under_;
};

}  // namespace strata::ui
