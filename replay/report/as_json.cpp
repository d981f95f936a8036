// A report as JSON and as CSV, for CI and spreadsheets.
#include <cmath>

#include <nlohmann/json.hpp>

#include "replay/report/report.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Spread& spread) {
    return {
        {"median", spread.median}, {"mad", spread.mad}, {"low", spread.low}, {"high", spread.high}, {"repeats", spread.repeats}};
}

ordered_json json_of(const Measurement& row) {
    ordered_json json{{"technique", row.technique}, {"settings", row.settings}};
    if (!row.accuracy.not_supported.empty()) {
        json["not_supported"] = row.accuracy.not_supported;
        return json;
    }
    for (const Figure& figure : errors_of(row))
        json["method_error"].push_back({{"metric", figure.name}, {"unit", figure.unit}, {"value", figure.value}});
    const WorstTexel& worst = row.accuracy.worst;
    json["implementation_error"] = {{"rmse", row.accuracy.model_rmse},
                                    {"worst", row.accuracy.model_worst},
                                    {"worst_texel",
                                     {{"image", worst.image},
                                      {"x", worst.x},
                                      {"y", worst.y},
                                      {"layer", worst.layer},
                                      {"got", {worst.got.x, worst.got.y, worst.got.z}},
                                      {"wanted", {worst.wanted.x, worst.wanted.y, worst.wanted.z}}}},
                                    {"compared", row.accuracy.compared},
                                    {"undecided", row.accuracy.undecided}};
    json["stage_ms"] = json_of(row.stage_ms);
    json["frame_ms"] = json_of(row.frame_ms);
    json["stage_bytes"] = row.stage_bytes;
    json["counters"] = ordered_json::object();
    for (const CounterRecord& counter : row.counters) json["counters"][counter.name] = counter.value;
    json["on_pareto_front"] = row.on_front;
    return json;
}

}  // namespace

std::string as_json(const Report& report) {
    ordered_json json{{"schema", "strata.report"},
                      {"schema_version", 1},
                      {"stage", name(report.stage)},
                      {"capture", report.capture_id},
                      {"frame", report.frame},
                      {"extent", {report.width, report.height}},
                      {"samples", report.samples},
                      {"device",
                       {{"name", report.device.name},
                        {"driver", report.device.driver},
                        {"driver_version", report.device.driver_version},
                        {"cpu", report.device.cpu},
                        {"software", report.device.software}}},
                      {"repeats", report.repeats},
                      {"truth", report.truth},
                      {"rows", ordered_json::array()}};
    if (!report.skipped.empty()) json["skipped"] = report.skipped;
    for (const Measurement& row : report.rows) json["rows"].push_back(json_of(row));
    return json.dump(2) + "\n";
}

std::string as_csv(const Report& report) {
    std::string csv = "technique,settings";
    if (!report.rows.empty())
        for (const Figure& figure : errors_of(report.rows.front())) csv += "," + figure.name;
    csv += ",implementation_rmse,stage_ms,stage_ms_mad,frame_ms,frame_ms_mad,stage_bytes,on_pareto_front,not_supported\n";
    for (const Measurement& row : report.rows) {
        csv += row.technique + "," + row.settings;
        if (!row.accuracy.not_supported.empty()) {
            csv += std::string(errors_of(report.rows.front()).size() + 7, ',') + "\"" + row.accuracy.not_supported + "\"\n";
            continue;
        }
        for (const Figure& figure : errors_of(row)) csv += fmt::format(",{:.9g}", figure.value);
        csv += fmt::format(",{:.9g},{:.6f},{:.6f},{:.6f},{:.6f},{},{},\n", row.accuracy.model_rmse, row.stage_ms.median,
                           row.stage_ms.mad, row.frame_ms.median, row.frame_ms.mad, row.stage_bytes, row.on_front ? 1 : 0);
    }
    return csv;
}

}  // namespace strata
