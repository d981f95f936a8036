#include "ui/report/report_columns.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "capture_format/frame/frame.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/plural.h"
#include "replay/report/report_columns.h"
#include "replay/report/variants.h"
#include "replay/tables/table.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr double worth_a_logarithm = 10;

bool is_measured(const Measurement& row) { return row.accuracy.not_supported.empty(); }

/// A column of the report's own sheet as the window shows it.
ReportColumn window_column(const Sheet& sheet, std::size_t index) {
    const Described& is = sheet.columns[index];
    const std::string label = is.label.empty() ? is.title : is.label;
    ReportColumn column{.kind = is.role == Role::cost ? ReportColumn::Kind::cost : ReportColumn::Kind::error,
                        .head = window_title(is),
                        .label = label,
                        .tooltip = window_tooltip(is),
                        .is_detail = is.is_detail};
    for (const Sheet::Row& row : sheet.rows) {
        const CellValue& value = row.values[index];
        const WindowCell cell = window_cell(is, value);
        column.values.push_back(cell.sort);
        column.texts.push_back(cell.text);
        if (!has_spread(is)) continue;
        const auto* spread = std::get_if<Spread>(&value);
        column.spreads.push_back(spread ? spread->mad : 0);
    }
    return column;
}

/// What stands with a point under the mouse.
std::string note_of(const Report& report, const ReportAxes& axes, std::size_t row, bool on_front) {
    const std::string& settings = report.rows[row].settings;
    std::string note = settings.empty() ? "default settings" : settings;
    if (!axes.cost.spreads.empty())
        note += fmt::format("\n\xc2\xb1 {} over {}", short_number(axes.cost.spreads[row]), plural(report.repeats, "repeat"));
    if (report.rows[row].has_other_truth) note += fmt::format("\n{}", other_truth_note);
    if (on_front) note += "\nnothing is both more accurate and cheaper";
    return note + "\nclick applies it";
}

/// Adds a row's point to a series.
struct PlotMaker {
    const Report& report;
    const ReportAxes& axes;
    std::vector<bool> on_front;
    ReportPlot plot;

    bool has_place(std::size_t row) const {
        const auto error = axes.error.size(row), cost = axes.cost.size(row);
        return error && cost && (*error > 0 || axes.error_scale == AxisScale::linear) &&
               (*cost > 0 || axes.cost_scale == AxisScale::linear);
    }
    void begin(std::string label, SeriesKind kind, const ImVec4& color) {
        plot.series.push_back({.label = std::move(label), .kind = kind, .points = {}, .color = color});
        plot.rows.emplace_back();
    }
    void add(std::size_t row) {
        PlotSeries& series = plot.series.back();
        series.points.emplace_back(*axes.cost.size(row), *axes.error.size(row));
        series.notes.push_back(note_of(report, axes, row, on_front[row]));
        if (series.kind == SeriesKind::scatter && !axes.cost.spreads.empty()) series.spreads.push_back(axes.cost.spreads[row]);
        plot.rows.back().push_back(row);
    }
};

void add_techniques(PlotMaker& maker) {
    for (const Technique* technique : techniques_of(maker.report.stage)) {
        std::vector<std::size_t> own;
        for (std::size_t i = 0; i < maker.report.rows.size(); ++i)
            if (maker.report.rows[i].technique == technique->name && maker.has_place(i)) own.push_back(i);
        if (own.empty()) continue;
        maker.begin(below_stage(technique->name), SeriesKind::scatter, color_of_technique(technique->name));
        for (const std::size_t row : own) maker.add(row);
    }
}

void add_front(PlotMaker& maker) {
    ImVec4 color = palette().text;
    color.w = .6f;
    maker.begin("Pareto front", SeriesKind::step, color);
    for (const std::size_t row : sorted_rows(maker.axes.cost, SortOrder::ascending))
        if (maker.on_front[row] && maker.has_place(row)) maker.add(row);
}

}  // namespace

std::optional<double> ReportColumn::size(std::size_t row) const {
    return values[row] ? std::optional(std::abs(*values[row])) : std::nullopt;
}

bool ReportColumn::has_signs() const {
    return std::ranges::any_of(values, [](const std::optional<double>& value) { return value && *value < 0; });
}

std::string ReportColumn::axis_label() const {
    return has_signs() ? fmt::format("|{}|{}", head, label.substr(std::min(head.size(), label.size()))) : label;
}

std::vector<ReportColumn> columns_of(const Report& report) {
    std::vector<ReportColumn> columns;
    const Measurement* first = first_measured(report);
    if (!first) return columns;
    const Sheet sheet = sheet_of(report);
    for (std::size_t i = 0; i < sheet.columns.size(); ++i)
        if ((sheet.columns[i].shown & in_window) != 0) columns.push_back(window_column(sheet, i));
    // Errors, then costs; of these first the error that ranks rows and milliseconds, which are the axes to begin with.
    const RankingError error = ranking_error(report);
    const std::string ranking = title_of(error);
    for (ReportColumn& column : columns)
        if (column.head == ranking) column.rounding = error.rounding();
    std::ranges::stable_sort(columns, {}, [&](const ReportColumn& column) {
        return std::pair(column.kind, column.head != (column.kind == ReportColumn::Kind::cost ? "ms" : ranking));
    });
    std::erase_if(columns, [](const ReportColumn& column) {
        return std::ranges::none_of(column.values, [](const std::optional<double>& value) { return value.has_value(); });
    });
    return columns;
}

const ReportColumn& column_of(std::span<const ReportColumn> columns, ReportColumn::Kind kind, std::string_view label) {
    assert(std::ranges::count(columns, kind, &ReportColumn::kind) > 0);  // a report with a measured row has an error and a time
    const ReportColumn* first = &columns.front();
    for (const ReportColumn& column : columns) {
        if (column.kind != kind) continue;
        if (column.label == label) return column;
        if (first->kind != kind || (first->is_detail && !column.is_detail)) first = &column;
    }
    return *first;
}

AxisScale natural_scale(const ReportColumn& column) {
    double low = HUGE_VAL, high = 0;
    for (std::size_t row = 0; row < column.values.size(); ++row) {
        const auto size = column.size(row);
        if (!size) continue;
        low = std::min(low, *size);
        high = std::max(high, *size);
    }
    return low > 0 && high >= worth_a_logarithm * low ? AxisScale::logarithmic : AxisScale::linear;
}

std::vector<bool> front_of(const Report& report, const ReportColumn& error, const ReportColumn& cost) {
    std::vector<Standing> standings;
    for (std::size_t row = 0; row < error.values.size(); ++row) {
        const auto spent = cost.size(row);
        const bool is_ranked = spent && !report.rows[row].has_other_truth;
        standings.push_back(
            {.error = is_ranked ? error.size(row) : std::nullopt, .time = spent.value_or(0), .rounding = error.rounding});
    }
    return pareto_front(standings, &Standing::time);
}

std::vector<std::size_t> sorted_rows(const ReportColumn& column, SortOrder order) {
    std::vector<std::size_t> rows(column.values.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    std::ranges::stable_sort(rows, {}, [&](std::size_t row) {
        const auto size = column.size(row);
        return std::pair(!size, size ? (order == SortOrder::ascending ? *size : -*size) : 0);
    });
    return rows;
}

std::string cell_text(const ReportColumn& column, std::size_t row) { return column.texts[row]; }

std::optional<PlotPoint> ReportPlot::point_of(std::size_t row) const {
    for (std::size_t s = 0; s < rows.size(); ++s)
        for (std::size_t p = 0; p < rows[s].size(); ++p)
            if (rows[s][p] == row) return PlotPoint{s, p};
    return {};
}

ReportPlot plot_of(const Report& report, const ReportAxes& axes, std::optional<std::size_t> now) {
    PlotMaker maker{report, axes, front_of(report, axes.error, axes.cost), {}};
    for (std::size_t row = 0; row < report.rows.size(); ++row)
        if (axes.error.size(row) && axes.cost.size(row) && !maker.has_place(row)) ++maker.plot.without_place;
    add_techniques(maker);
    add_front(maker);
    if (now && maker.has_place(*now)) {
        maker.begin("shown now", SeriesKind::scatter, palette().text);
        maker.add(*now);
    }
    return std::move(maker.plot);
}

ImVec4 color_of_technique(std::string_view technique) {
    const auto found = find_technique(technique);
    return found ? color_of_stage(index_in_stage(**found)) : palette().dim;
}

std::vector<ReportRemark> remarks_of(const Report& report) {
    std::vector<ReportRemark> remarks;
    std::map<std::pair<std::string, std::string>, std::vector<const Measurement*>> unable;
    for (const Measurement& row : report.rows) {
        if (!is_measured(row)) unable[{row.technique, row.accuracy.not_supported}].push_back(&row);
        else if (std::string doubt = implementation_doubt(row); !doubt.empty())
            remarks.push_back({short_label(row), std::move(doubt), true});
    }
    for (const auto& [key, rows] : unable)
        remarks.push_back({rows.size() == 1 ? short_label(*rows.front())
                                            : fmt::format("{} at {}", below_stage(key.first), plural(rows.size(), "setting")),
                           fmt::format("cannot do this frame: {}", key.second)});
    return remarks;
}

Request report_base(Request request, Stage stage) {
    request.choices.drop(stage);
    request.outputs = Request().outputs;
    return request;
}

std::optional<std::size_t> row_of(const Report& report, const Choice& choice) {
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
        const Measurement& row = report.rows[i];
        if (!is_measured(row) || row.technique != choice.technique->name) continue;
        const auto choices = choose(Frame(), request_of(row, {}).choices);
        if (choices && choices->at(report.stage).settings == choice.settings) return i;
    }
    return {};
}

}  // namespace strata::ui
