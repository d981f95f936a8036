// What a device can do and what the steps of a frame reach, as JSON.
#include <nlohmann/json.hpp>

#include "replay/bench/device_bench.h"
#include "replay/json_text.h"
#include "replay/report/json_parts.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const DeviceBench& bench, const StepShare& step) {
    ordered_json json{{"scope", text_of(step.scope)},
                      {"name", step.name},
                      {"ms", json_of(step.ms)},
                      {"declared_bytes", step.bytes},
                      {"share_of_bytes", bench.share_of_bytes(step)},
                      {"operations_per_invocation", step.per_invocation.operations},
                      {"loops", step.per_invocation.loops},
                      {"counted_by", step.counted_by}};
    if (!step.invocations) return json;
    json["invocations"] = *step.invocations;
    json["operations"] = *step.operations();
    json["share_of_operations"] = *bench.share_of_operations(step);
    return json;
}

}  // namespace

std::string as_json(const DeviceBench& bench) {
    ordered_json json{{"schema", "strata.bench_device"},
                      {"schema_version", 1},
                      {"device", json_of(bench.device)},
                      {"repeats", bench.repeats},
                      {"limits",
                       {{"bytes_per_second", json_of(bench.limits.bytes)},
                        {"operations_per_second", json_of(bench.limits.operations)},
                        {"copied_bytes", bench.limits.copied_bytes},
                        {"operations_done", bench.limits.operations_done}}},
                      {"scene", bench.scene},
                      {"frame", bench.frame},
                      {"extent", {bench.width, bench.height}},
                      {"samples", bench.samples},
                      {"frame_ms", bench.frame_ms},
                      {"steps", ordered_json::array()}};
    for (const StepShare& step : bench.steps) json["steps"].push_back(json_of(bench, step));
    if (!bench.stopped.empty()) json["stopped"] = bench.stopped;
    return json_text(json);
}

}  // namespace strata
