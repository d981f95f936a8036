// Reports as comma-separated values, for spreadsheets and plots: one line for each row of each capture, then the pooled ones.
#include <algorithm>

#include "replay/report/pooled.h"

namespace strata {
namespace {

constexpr std::string_view head =
    "ranking_error,touched_share,sort_ms,implementation_rmse,stage_ms,stage_ms_mad,frame_ms,frame_ms_mad,time,time_mad,"
    "stage_bytes,bytes_per_pixel,invocations,flicker,coverage_flicker,on_pareto_front,on_memory_front,counters,not_supported,"
    "truth";

std::string csv_field(std::string_view text) {
    std::string safe(1, '"');
    for (const char c : text) safe.append(c == '"' ? 2 : 1, c);
    return safe + '"';
}

std::string number(std::optional<double> value) { return value ? fmt::format("{:.9g}", *value) : std::string(); }

/// Of the first row that has any: the judge of a stage always gives the same.
std::vector<std::string> figure_names(std::span<const Report> reports) {
    std::vector<std::string> names;
    for (const Report& report : reports)
        for (const Measurement& row : report.rows)
            if (names.empty())
                for (const Figure& figure : errors_of(row)) names.push_back(figure.name);
    return names;
}

std::string counters_field(const Measurement& row) {
    std::string text;
    for (const CounterRecord& counter : row.counters)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", counter.name, counter.value);
    return text;
}

std::string line_of(const Measurement& row, std::size_t figures, bool is_timed) {
    std::string line = row.technique + "," + csv_field(row.settings);
    if (!row.accuracy.not_supported.empty())
        return line + std::string(figures + 19, ',') + csv_field(row.accuracy.not_supported) + ",\n";
    for (const Figure& figure : errors_of(row)) line += fmt::format(",{}", number(figure.value));
    const auto touched = row.accuracy.touched.empty() ? std::nullopt : std::optional(row.accuracy.touched_share);
    const auto sorted = row.sort_ms ? std::optional(row.sort_ms->median) : std::nullopt;
    line += fmt::format(",{},{},{}", number(ranking_figure(row).value), number(touched), number(sorted));
    line += "," + number(row.accuracy.model_rmse);
    const std::string truth = row.truth.empty() ? std::string() : csv_field(row.truth);
    if (!is_timed) return line + std::string(16, ',') + truth + "\n";
    line +=
        fmt::format(",{:.6f},{:.6f},{:.6f},{:.6f}", row.stage_ms.median, row.stage_ms.mad, row.frame_ms.median, row.frame_ms.mad);
    const auto time = [&](double Spread::*part) { return row.time ? number(*row.time.*part) : std::string(); };
    line += fmt::format(",{},{}", time(&Spread::median), time(&Spread::mad));
    return line + fmt::format(",{},{},{},{},{},{:d},{:d},{},,{}\n", row.stage_bytes, number(row.bytes_per_pixel),
                              row.invocations ? fmt::format("{}", *row.invocations) : std::string(), number(row.flicker),
                              number(row.coverage_flicker), row.on_front, row.on_memory_front, csv_field(counters_field(row)),
                              truth);
}

std::string table(std::span<const Report> reports) {
    const std::vector<std::string> figures = figure_names(reports);
    std::string csv = "capture,technique,settings";
    for (const std::string& figure : figures) csv += "," + figure;
    csv += "," + std::string(head) + "\n";
    for (const Report& report : reports)
        for (const Measurement& row : report.rows)
            csv += csv_field(report.capture_name) + "," + line_of(row, figures.size(), report.is_timed);
    return csv;
}

}  // namespace

std::string as_csv(const Report& report) { return table({&report, 1}); }

std::string as_csv(std::span<const Report> reports, const Pool& pool) {
    std::string csv = table(reports);
    const std::vector<std::string> figures = figure_names(reports);
    for (const PooledRow& row : pool.rows) {
        csv += "\"pooled\"," + row.technique + "," + csv_field(row.settings);
        csv += std::string(figures.size(), ',');
        csv += fmt::format(
            ",{},,,,,,,,{},,,{},,{},,{:d},{:d},,{},\n", number(row.error), number(row.time), number(row.bytes_per_pixel),
            number(row.flicker), row.on_front, row.on_memory_front,
            row.captures == pool.captures ? std::string() : fmt::format("\"{} of {} captures\"", row.captures, pool.captures));
    }
    return csv;
}

}  // namespace strata
