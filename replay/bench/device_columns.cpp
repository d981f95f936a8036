// What a step says of what it reaches of a device's limits, for every format.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/bench/device_bench.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/tables/document.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

using Steps = std::vector<Column<StepShare>>;

std::string giga(const Spread& spread) { return fmt::format("{:.2f} +-{:.2f}", spread.median * 1e-9, spread.mad * 1e-9); }

Steps names_of_step() {
    return {{{.key = "scope", .title = "scope", .help = "stage and technique", .kind = CellKind::text, .shown = in_files},
             [](const StepShare& step) { return text_of(step.scope); }},
            {{.key = "name", .title = "step", .help = "name of the step", .kind = CellKind::text, .shown = in_files},
             [](const StepShare& step) { return step.name; }},
            {{.key = "ms", .title = "ms", .help = "time of the step", .kind = CellKind::spread, .better = Better::less},
             [](const StepShare& step) { return step.ms; }}};
}

Steps bytes_of_step(const DeviceBench& bench) {
    return {{{.key = "declared_bytes",
              .title = "bytes",
              .help = "bytes of the images and buffers that the step binds",
              .kind = CellKind::count,
              .shown = in_files},
             [](const StepShare& step) { return step.bytes; }},
            {{.key = "megabytes", .title = "MB declared", .help = "the same in millions", .shown = in_text},
             [](const StepShare& step) { return double(step.bytes) * 1e-6; }},
            {{.key = "gigabytes_per_second", .title = "GB/s", .help = "declared bytes by the time", .better = Better::more},
             [](const StepShare& step) { return double(step.bytes) * 1e-6 / step.ms.median; }},
            {{.key = "share_of_bytes",
              .title = "% of copying",
              .help = "the same as a share of what a copy reaches",
              .kind = CellKind::share,
              .better = Better::more},
             [&bench](const StepShare& step) { return bench.share_of_bytes(step); }}};
}

Steps operations_of_step(const DeviceBench& bench) {
    return {{{.key = "operations_per_invocation",
              .title = "operations",
              .help = "operations in the code of the shader",
              .kind = CellKind::count,
              .shown = in_files},
             [](const StepShare& step) { return std::uint64_t{step.per_invocation.operations}; }},
            {{.key = "loops", .title = "loops", .help = "loops in the code", .kind = CellKind::count, .shown = in_files},
             [](const StepShare& step) { return std::uint64_t{step.per_invocation.loops}; }},
            {{.key = "some_loops",
              .title = "loops",
              .help = "the same, where there are any",
              .kind = CellKind::count,
              .shown = in_text},
             [](const StepShare& step) {
                 return step.per_invocation.loops > 0 ? CellValue(std::uint64_t{step.per_invocation.loops}) : CellValue();
             }},
            {{.key = "counted_by",
              .title = "counted by",
              .help = "what counts the invocations",
              .kind = CellKind::text,
              .shown = in_files},
             [](const StepShare& step) { return step.counted_by; }},
            {{.key = "invocations",
              .title = "invocations",
              .help = "invocations of the fragment or compute shader, if they are counted",
              .kind = CellKind::count,
              .shown = in_files},
             [](const StepShare& step) { return cell_or_nothing(step.invocations); }},
            {{.key = "operations",
              .title = "operations",
              .help = "operations of all invocations, if they are counted",
              .shown = in_files},
             [](const StepShare& step) { return cell_or_nothing(step.operations()); }},
            {{.key = "million_operations", .title = "million operations", .help = "the same in millions", .shown = in_text},
             [](const StepShare& step) {
                 const auto operations = step.operations();
                 return operations ? CellValue(*operations * 1e-6) : CellValue(std::string("not counted"));
             }},
            {{.key = "share_of_operations",
              .title = "% of multiply-adds",
              .help = "operations per second as a share of what multiply-adds reach",
              .kind = CellKind::share,
              .better = Better::more},
             [&bench](const StepShare& step) { return cell_or_nothing(bench.share_of_operations(step)); }}};
}

}  // namespace

Sheet sheet_of(const DeviceBench& bench) {
    Steps columns = names_of_step();
    for (Steps more : {bytes_of_step(bench), operations_of_step(bench)}) std::ranges::move(more, std::back_inserter(columns));
    Sheet sheet = sheet_of<StepShare>(columns, bench.steps, [](const StepShare& step) { return RowName{"", step.name}; });
    sheet.heads_labels = "step";
    return sheet;
}

Page page_of(const DeviceBench& bench) {
    const DeviceLimits& limits = bench.limits;
    std::string text =
        fmt::format("device {} ({}), {}\n", bench.device.name, bench.device.driver, plural(bench.repeats, "timed run"));
    text += fmt::format("copying      {} GB/s: a buffer of {} MB, every byte read and written\n", giga(limits.bytes),
                        short_number(static_cast<double>(limits.copied_bytes) * .5e-6));
    text +=
        fmt::format("multiply-adds {} billion operations/s: {} threads, {} iterations of eight chains, a multiply-add is two\n",
                    giga(limits.operations), limits.threads, limits.iterations);
    if (bench.device.software) text += "a CPU renders here: these are limits of its cores through this driver, and of no GPU\n";
    text += fmt::format("\n{}, {} x {}, {} per pixel: {} ms; the hottest steps\n\n", bench.scene, bench.width, bench.height,
                        plural(bench.samples, "sample"), short_number(bench.frame_ms));
    std::string below = "\n";
    below += wrapped("",
                     "MB declared: every image and buffer that the step binds, whole and once, twice where it is both read and "
                     "written. Of a buffer it only writes, at most one element per invocation where the code has no loops. Pools "
                     "and textures count whole however little of them is touched, and what is read twice counts once.");
    below += wrapped("",
                     "Operations: invocations of the fragment or compute shader times the operations in its code, of which every "
                     "branch is taken and every loop iterated once: above 100 % branches are not taken, with loops the number is "
                     "too small. Vertex shaders, loads, "
                     "stores and texture reads are not counted. Nothing is counted where invocations are not.");
    if (!bench.stopped.empty()) below += fmt::format("\n{}\n", bench.stopped);
    return {text, sheet_of(bench), below};
}

std::string as_text(const DeviceBench& bench) { return as_text(page_of(bench)); }
std::string as_csv(const DeviceBench& bench) { return as_csv(std::vector{sheet_of(bench)}); }

std::string as_json(const DeviceBench& bench) {
    nlohmann::ordered_json json = document({.schema = "strata.bench_device",
                                            .date = bench.date,
                                            .device = &bench.device,
                                            .capture_id = bench.capture_id,
                                            .capture_name = bench.scene,
                                            .width = bench.width,
                                            .height = bench.height,
                                            .samples = bench.samples});
    json.update({{"repeats", bench.repeats},
                 {"limits",
                  {{"bytes_per_second", json_of(bench.limits.bytes)},
                   {"operations_per_second", json_of(bench.limits.operations)},
                   {"copied_bytes", bench.limits.copied_bytes},
                   {"operations_done", bench.limits.operations_done},
                   {"threads", bench.limits.threads},
                   {"iterations", bench.limits.iterations}}},
                 {"scene", bench.scene},
                 {"frame", bench.frame},
                 {"frame_ms", bench.frame_ms},
                 {"steps", rows_json(sheet_of(bench))}});
    if (!bench.stopped.empty()) json["stopped"] = bench.stopped;
    return json_text(json);
}

}  // namespace strata
