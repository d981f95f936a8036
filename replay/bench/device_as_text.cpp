// What a device can do and what the steps of a frame reach, for a terminal.
#include <fmt/format.h>

#include "replay/bench/device_bench.h"
#include "replay/plural.h"
#include "replay/report/table.h"

namespace strata {
namespace {

std::string giga(const Spread& spread) { return fmt::format("{:.2f} +-{:.2f}", spread.median * 1e-9, spread.mad * 1e-9); }
std::string percent(double share) { return short_number(100 * share); }

Table table_of(const DeviceBench& bench) {
    Table table{.heads = {"ms", "MB declared", "GB/s", "% of copying", "loops", "million operations", "% of multiply-adds"},
                .rows = {}};
    for (const StepShare& step : bench.steps) {
        const auto operations = step.operations();
        const double bytes = static_cast<double>(step.bytes);
        table.rows.push_back(
            {"",
             step.name,
             {fmt::format("{} +-{}", short_number(step.ms.median), short_number(step.ms.mad)), short_number(bytes * 1e-6),
              short_number(bytes * 1e-6 / step.ms.median), percent(bench.share_of_bytes(step)),
              step.per_invocation.loops > 0 ? fmt::format("{}", step.per_invocation.loops) : "",
              operations ? short_number(*operations * 1e-6) : "not counted",
              operations ? percent(*bench.share_of_operations(step)) : ""}});
    }
    return table;
}

}  // namespace

std::string as_text(const DeviceBench& bench) {
    const DeviceLimits& limits = bench.limits;
    std::string text =
        fmt::format("device {} ({}), {}\n", bench.device.name, bench.device.driver, plural(bench.repeats, "timed run"));
    text += fmt::format("copying      {} GB/s: a buffer of {} MB, every byte read and written\n", giga(limits.bytes),
                        short_number(static_cast<double>(limits.copied_bytes) * .5e-6));
    text += fmt::format("multiply-adds {} billion operations/s: a loop of eight chains per thread, a multiply-add is two\n",
                        giga(limits.operations));
    if (bench.device.software) text += "a CPU renders here: these are limits of its cores through this driver, and of no GPU\n";
    text += fmt::format("\n{}, {} x {}, {} per pixel: {} ms; the hottest steps\n\n{}\n", bench.scene, bench.width, bench.height,
                        plural(bench.samples, "sample"), short_number(bench.frame_ms), as_text(table_of(bench)));
    text += wrapped("",
                    "MB declared: every image and buffer that the step binds, whole and once, twice where it is both read and "
                    "written. Of a buffer it only writes, at most one element per invocation where the code has no loops. Pools "
                    "and textures count whole however little of them is touched, and what is read twice counts once.");
    text += wrapped("",
                    "Operations: invocations of the fragment or compute shader times the operations in its code, of which every "
                    "branch is taken and every loop turned once: above 100 % branches are not taken, with loops the number is "
                    "too small. Vertex shaders, loads, "
                    "stores and texture reads are not counted. Nothing is counted where invocations are not.");
    if (!bench.stopped.empty()) text += fmt::format("\n{}\n", bench.stopped);
    return text;
}

}  // namespace strata
