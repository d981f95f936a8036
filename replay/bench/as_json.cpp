// Measured ratios as JSON, for CI and scripts.
#include <nlohmann/json.hpp>

#include "replay/bench/bench.h"
#include "replay/json_text.h"
#include "replay/report/json_parts.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const TimedWay& way) {
    ordered_json json{{"technique", way.technique}, {"settings", way.settings}};
    if (!way.frame.empty()) json["frame"] = way.frame;
    json["ms"] = json_of(way.ms);
    json["stage_bytes"] = way.stage_bytes;
    json["counters"] = ordered_json::object();
    for (const CounterRecord& counter : way.counters) json["counters"][counter.name] = counter.value;
    return json;
}

ordered_json json_of(const MeasuredRatio& row) {
    const TimeRatio& stated = *row.claim.ratio;
    ordered_json json{{"technique", row.claim.technique->name},
                      {"name", stated.name},
                      {"scene", row.claim.scene},
                      {"frame", row.claim.base.variant.frame},
                      {"steps", counted_steps(stated)}};
    if (stated.published) json["published"] = {{"ratio", *stated.published}, {"source", stated.source}};
    if (!row.not_measured.empty()) {
        json["not_measured"] = row.not_measured;
        return json;
    }
    json["extent"] = {row.width, row.height};
    json["samples"] = row.samples;
    json["ratio"] = json_of(row.ratio);
    json["of"] = json_of(row.of);
    json["against"] = json_of(row.against);
    return json;
}

}  // namespace

std::string as_json(const Bench& bench) {
    ordered_json json{{"schema", "strata.bench"},
                      {"schema_version", 1},
                      {"device", json_of(bench.device)},
                      {"repeats", bench.repeats},
                      {"rows", ordered_json::array()}};
    if (!bench.stopped.empty()) json["stopped"] = bench.stopped;
    for (const MeasuredRatio& row : bench.rows) json["rows"].push_back(json_of(row));
    return json_text(json);
}

}  // namespace strata
