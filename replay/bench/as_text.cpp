// Measured ratios for a terminal: a table of them, then what either way is, took and counted.
#include <fmt/format.h>

#include "replay/bench/bench.h"
#include "replay/plural.h"
#include "replay/report/table.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

Table table_of(const Bench& bench) {
    Table table{.heads = {"measured", "published", "ms", "against ms"}, .rows = {}};
    for (const MeasuredRatio& row : bench.rows) {
        Table::Row line{"", std::string(row.claim.ratio->name), {}};
        const auto& published = row.claim.ratio->published;
        if (row.not_measured.empty())
            line.cells = {fmt::format("{:.2f} +-{:.2f}", row.ratio.median, row.ratio.mad),
                          published ? fmt::format("{:.2f}", *published) : "", short_number(row.of.ms.median),
                          short_number(row.against.ms.median)};
        else line.cells = {"not measured: " + row.not_measured};
        table.rows.push_back(std::move(line));
    }
    return table;
}

std::string way_text(const TimedWay& way) {
    std::vector<std::string> parts{fmt::format("{} +-{} ms", short_number(way.ms.median), short_number(way.ms.mad)),
                                   fmt::format("{:.2f} MiB", double(way.stage_bytes) / 0x1p20)};
    for (const CounterRecord& counter : way.counters) parts.push_back(fmt::format("{} {}", counter.name, counter.value));
    const std::string frame = way.frame.empty() ? "" : ", " + way.frame;
    return fmt::format("{}{}: {}", label(way.technique, way.settings), frame, fmt::join(parts, ", "));
}

std::string details_of(const MeasuredRatio& row) {
    const TimeRatio& stated = *row.claim.ratio;
    std::string text = wrapped("", fmt::format("{}: {}", row.claim.technique->name, stated.name));
    if (!row.not_measured.empty()) return text + wrapped("    ", "not measured: " + row.not_measured);
    text += wrapped("    ", way_text(row.of)) + wrapped("    ", "against " + way_text(row.against));
    const std::vector<std::string> steps = counted_steps(stated);
    text += wrapped("    ", fmt::format("{} of {}, {} x {}, {} per pixel",
                                        steps.empty() ? "the whole stage" : fmt::format("{}", fmt::join(steps, ", ")),
                                        row.claim.scene, row.width, row.height, plural(row.samples, "sample")));
    if (stated.published) text += wrapped("    ", fmt::format("published: {:.2f}, {}", *stated.published, stated.source));
    return text;
}

}  // namespace

std::string as_text(const Bench& bench) {
    std::string text = fmt::format("device {} ({}), {} of each way, in turn within one run\n", bench.device.name,
                                   bench.device.driver, plural(bench.repeats, "timed run"));
    if (bench.device.software) text += "a CPU renders here: times rank ways on this driver only, they model no GPU\n";
    text += fmt::format("\n{}", as_text(table_of(bench)));
    for (const MeasuredRatio& row : bench.rows) text += fmt::format("\n{}", details_of(row));
    if (!bench.stopped.empty()) text += fmt::format("\n{}\n", bench.stopped);
    return text;
}

}  // namespace strata
