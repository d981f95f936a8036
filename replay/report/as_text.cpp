// A report as a table for a terminal.
#include <algorithm>

#include "replay/counted.h"
#include "replay/report/report.h"

namespace strata {
namespace {

std::string bytes_text(std::uint64_t bytes) { return fmt::format("{:.2f}", double(bytes) / (1 << 20)); }

std::string label(const Measurement& row) { return row.settings.empty() ? row.technique : row.technique + " " + row.settings; }

std::string counters_text(const Measurement& row) {
    std::string text;
    for (const CounterRecord& counter : row.counters)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counter.name, counter.value);
    return text;
}

}  // namespace

std::string as_text(const Report& report) {
    std::string text = fmt::format("{} of frame {}, {} x {}, {} per pixel, capture {}\n", name(report.stage), report.frame,
                                   report.width, report.height, counted(report.samples, "sample"), report.capture_id);
    text += fmt::format("device {} ({}), {} each, interleaved\n", report.device.name, report.device.driver,
                        counted(report.repeats, "timed run"));
    if (report.device.software) text += "a CPU renders here: times rank techniques on this driver only, they model no GPU\n";
    if (!report.skipped.empty()) return text + fmt::format("the frame does not need this stage: {}\n", report.skipped);
    text += fmt::format("truth: {}\n\n", report.truth);

    std::size_t width = 9;
    for (const Measurement& row : report.rows) width = std::max(width, label(row).size());
    text += fmt::format("  {:<{}}", "technique", width);
    if (!report.rows.empty())
        for (const Figure& figure : errors_of(report.rows.front()))
            text += fmt::format("  {:>14}", figure.unit.empty() ? figure.name : figure.name + " [" + figure.unit + "]");
    text +=
        fmt::format("  {:>10}  {:>8}  {:>7}  {:>9}  {:>8}  {}\n", "impl. rmse", "ms", "+- mad", "frame ms", "MiB", "counters");
    for (const Measurement& row : report.rows) {
        text += fmt::format("{} {:<{}}", row.on_front ? '*' : ' ', label(row), width);
        if (!row.accuracy.not_supported.empty()) {
            text += fmt::format("  not supported: {}\n", row.accuracy.not_supported);
            continue;
        }
        for (const Figure& figure : errors_of(row)) text += fmt::format("  {:>14.6g}", figure.value);
        text +=
            fmt::format("  {:>10.2e}  {:>8.3f}  {:>7.3f}  {:>9.3f}  {:>8}  {}\n", row.accuracy.model_rmse, row.stage_ms.median,
                        row.stage_ms.mad, row.frame_ms.median, bytes_text(row.stage_bytes), counters_text(row));
    }
    text +=
        "\n* on the Pareto front: nothing measured is both more accurate and faster. impl. rmse: GPU against the method's model "
        "in double.\n";
    return text;
}

}  // namespace strata
