// A report as numbers to choose from: every error and every cost is a column, any two of which are the axes of a plot. Nothing
// is drawn here.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "replay/report/report.h"
#include "ui/widgets/plot.h"

namespace strata::ui {

/// One number of every row.
struct ReportColumn {
    enum class Kind { error, cost } kind = Kind::error;
    std::string head;   ///< over a table: "ms"
    std::string label;  ///< after a number: "ms of the stage", "bias (radiance)"
    std::string tooltip = {};
    bool is_detail = false;
    double rounding = 0;                        ///< values below it are equal: Standing::rounding
    std::vector<std::optional<double>> values;  ///< by row; nothing where it was not measured. A bias may be below 0
    std::vector<double> spreads = {};           ///< median absolute deviations by row; empty: it has no spread
    std::vector<std::string> texts = {};        ///< of the cells, by row

    /// What ranks a row: a bias is as bad below 0 as above.
    std::optional<double> size(std::size_t row) const;
    bool has_signs() const;
    /// "|bias| (radiance)" where there are signs: what an axis shows is size().
    std::string axis_label() const;
};

/// Errors first, the judge's first figure before all; then costs. What no row has is not among them.
std::vector<ReportColumn> columns_of(const Report&);
/// Of a kind by its label; where there is none, the first of the kind that is no detail.
const ReportColumn& column_of(std::span<const ReportColumn>, ReportColumn::Kind, std::string_view label);

/// Logarithmic where all are above 0 and the largest is ten times the smallest.
AxisScale natural_scale(const ReportColumn&);

/// For each row whether nothing is both more accurate and cheaper; rows that lack either are not on it.
std::vector<bool> front_of(const Report&, const ReportColumn& error, const ReportColumn& cost);

/// Rows in the order of a column's sizes, then those that lack it; equal ones as they were.
enum class SortOrder { ascending, descending };
std::vector<std::size_t> sorted_rows(const ReportColumn&, SortOrder);

/// "1.23 +- 0.04" in the signs of the screen; "-" for what was not measured.
std::string cell_text(const ReportColumn&, std::size_t row);

/// What a plot shows of a report, and which row each of its variants is.
struct ReportPlot {
    std::vector<PlotSeries> series;  ///< a technique each, in the order of the list; then the front, then what is shown now
    std::vector<std::vector<std::size_t>> rows;
    std::size_t without_place = 0;  ///< rows that a logarithmic axis cannot have: 0
    std::optional<PlotPoint> point_of(std::size_t row) const;
};
struct ReportAxes {
    const ReportColumn &error, &cost;
    AxisScale error_scale, cost_scale;
};
ReportPlot plot_of(const Report&, const ReportAxes&, std::optional<std::size_t> now);

/// The color of a technique among those of its stage.
ImVec4 color_of_technique(std::string_view technique);

/// What a person must know of a row beside its numbers.
struct ReportRemark {
    std::string what, why;
    bool is_doubt = false;  ///< of the program; else the technique cannot do the frame
};
/// Rows of one technique for one reason are one remark.
std::vector<ReportRemark> remarks_of(const Report&);

/// The choices that a report of a stage starts from: those of the other stages. A row says what it measures, not what the stage
/// happens to be set to.
Request report_base(Request, Stage);
/// The row that has a choice's technique and all its settings, of those that were measured.
std::optional<std::size_t> row_of(const Report&, const Choice&);

}  // namespace strata::ui
