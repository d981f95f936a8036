// Reports as JSON, for CI and scripts.

#include <nlohmann/json.hpp>

#include "replay/json_text.h"
#include "replay/report/json_parts.h"
#include "replay/report/pooled.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Measurement& row, bool is_timed) {
    ordered_json json{{"technique", row.technique}, {"settings", row.settings}};
    if (!row.truth.empty()) json["truth"] = row.truth;
    if (row.has_other_truth) json["has_other_truth"] = true;
    if (!row.accuracy.not_supported.empty()) {
        json["not_supported"] = row.accuracy.not_supported;
        return json;
    }
    for (const Figure& figure : errors_of(row))
        json["method_error"].push_back({{"metric", figure.name}, {"unit", figure.unit}, {"value", figure.value}});
    for (const Figure& figure : row.accuracy.touched)
        json["touched_error"].push_back({{"metric", figure.name}, {"unit", figure.unit}, {"value", figure.value}});
    if (!row.accuracy.touched.empty()) json["touched_share"] = row.accuracy.touched_share;
    json["left_out_share"] = row.accuracy.left_out_share;
    const WorstTexel& worst = row.accuracy.worst;
    const auto if_compared = [&](double value) { return is_nothing_compared(row) ? ordered_json() : ordered_json(value); };
    json["implementation_error"] = {{"model_is", name(row.model_is)},
                                    {"rmse", if_compared(row.accuracy.model_rmse)},
                                    {"worst", if_compared(row.accuracy.model_worst)},
                                    {"worst_texel",
                                     {{"image", worst.image},
                                      {"x", worst.x},
                                      {"y", worst.y},
                                      {"layer", worst.layer},
                                      {"got", {worst.got.x, worst.got.y, worst.got.z, worst.got.w}},
                                      {"wanted", {worst.wanted.x, worst.wanted.y, worst.wanted.z, worst.wanted.w}}}},
                                    {"compared", row.accuracy.compared},
                                    {"undecided", row.accuracy.undecided},
                                    {"tolerance", {{"rmse", row.tolerance}, {"worst", row.tolerated_worst}}}};
    if (const std::string doubt = implementation_doubt(row); !doubt.empty()) json["implementation_error"]["doubt"] = doubt;
    if (!row.accuracy.incomparable.empty()) json["incomparable"] = row.accuracy.incomparable;
    if (!is_timed) return json;
    json["stage_ms"] = json_of(row.stage_ms);
    if (row.sort_ms) json["sort_ms"] = json_of(*row.sort_ms);
    if (row.time) json["time"] = json_of(*row.time);
    json["frame_ms"] = json_of(row.frame_ms);
    json["stage_bytes"] = row.stage_bytes;
    json["bytes_per_pixel"] = row.bytes_per_pixel;
    if (row.invocations) json["invocations"] = *row.invocations;
    if (row.flicker) json["flicker"] = *row.flicker;
    if (row.coverage_flicker) json["coverage_flicker"] = *row.coverage_flicker;
    json["counters"] = ordered_json::object();
    for (const CounterRecord& counter : row.counters) json["counters"][counter.name] = counter.value;
    json["on_pareto_front"] = row.on_front;
    json["is_tied"] = row.is_tied;
    json["on_memory_front"] = row.on_memory_front;
    return json;
}

ordered_json json_of(const PooledRow& row) {
    ordered_json json{{"technique", row.technique}, {"settings", row.settings}, {"error", row.error}};
    if (row.time) json["time"] = *row.time;
    json["bytes_per_pixel"] = row.bytes_per_pixel;
    if (row.flicker) json["flicker"] = *row.flicker;
    json["captures"] = row.captures;
    if (row.has_other_truth) json["has_other_truth"] = true;
    json["on_pareto_front"] = row.on_front;
    json["on_memory_front"] = row.on_memory_front;
    return json;
}

/// The most accurate row of each budget; null where none keeps it.
template <typename Row>
ordered_json json_of_best(const std::vector<Row>& rows, const std::vector<Standing>& standings, std::string_view time_unit) {
    ordered_json json = ordered_json::array();
    for (const Budget& budget : budgets()) {
        const bool of_time = budget.cost == &Standing::time;
        if (of_time && time_unit.empty()) continue;
        const auto best = best_within(standings, budget);
        json.push_back({{"budget", of_time ? "time" : "bytes_per_pixel"}, {"most", budget.most}, {"technique", nullptr}});
        if (!best) continue;
        json.back()["technique"] = rows[*best].technique;
        json.back()["settings"] = rows[*best].settings;
        json.back()["error"] = *standings[*best].error;
    }
    return json;
}

ordered_json json_of_answer(const Report& report) {
    const Answer answer = find_answer(standings(report.rows), baseline_of(report), report.question);
    const auto row = [&](std::optional<std::size_t> i) {
        return i ? ordered_json{{"technique", report.rows[*i].technique}, {"settings", report.rows[*i].settings}}
                 : ordered_json();
    };
    ordered_json json{{"error", nullptr}, {"within", nullptr}, {"keeps_all", answer.keeps_all}};
    if (report.question.error) json["error"] = *report.question.error;
    if (report.question.within) json["within"] = *report.question.within;
    json["cheapest"] = row(answer.cheapest);
    json["most_accurate"] = row(answer.most_accurate);
    for (const auto& [name, rows] : {std::pair("as_fast", &answer.as_fast), std::pair("unsteady", &answer.unsteady)}) {
        json[name] = ordered_json::array();
        for (const std::size_t i : *rows) json[name].push_back(row(i));
    }
    return json;
}

ordered_json json_of(const ReportTruth& truth) {
    ordered_json json{{"name", truth.name}, {"is", truth.is}};
    if (truth.own_error) json["standard_error"] = {{"rmse", truth.own_error->rmse}, {"relative_rmse", truth.own_error->relative}};
    return json;
}

ordered_json json_of(const Report& report) {
    ordered_json json{{"schema", "strata.report"},
                      {"schema_version", 1},
                      {"stage", name(report.stage)},
                      {"capture", report.capture_id},
                      {"capture_name", report.capture_name},
                      {"frame", report.frame},
                      {"extent", {report.width, report.height}},
                      {"samples", report.samples},
                      {"device", json_of(report.device)},
                      {"repeats", report.repeats},
                      {"truth", report.truths.empty() ? std::string() : report.truths.front().is},
                      {"error_at", report.error_at == ErrorAt::picture ? "picture" : "stage"},
                      {"time_unit", report.time_unit},
                      {"rows", ordered_json::array()}};
    for (const ReportTruth& truth : report.truths) json["truths"].push_back(json_of(truth));
    if (report.flicker)
        json["flicker"] = {
            {"frames", report.flicker->frames}, {"dolly_metres", *report.flicker->dolly}, {"pan_degrees", report.flicker->pan}};
    if (!report.skipped.empty()) json["skipped"] = report.skipped;
    if (!report.stopped.empty()) json["stopped"] = report.stopped;
    for (const Measurement& row : report.rows) json["rows"].push_back(json_of(row, report.is_timed));
    if (!report.is_timed) return json;
    json["best_within"] = json_of_best(report.rows, standings(report.rows), report.time_unit);
    if (report.question.is_asked()) json["answer"] = json_of_answer(report);
    return json;
}

}  // namespace

std::string as_json(const Report& report) { return json_text(json_of(report)); }

std::string as_json(std::span<const Report> reports, const Pool& pool) {
    ordered_json json{{"schema", "strata.reports"}, {"schema_version", 1}, {"stage", name(pool.stage)}};
    for (const Report& report : reports) json["reports"].push_back(json_of(report));
    ordered_json& together = json["pooled"] = {{"captures", pool.captures},
                                               {"mean", "geometric; arithmetic of bytes"},
                                               {"error", pool.error},
                                               {"time_unit", pool.time_unit},
                                               {"rows", ordered_json::array()}};
    for (const PooledRow& row : pool.rows) together["rows"].push_back(json_of(row));
    together["best_within"] = json_of_best(pool.rows, standings(pool), pool.time_unit);
    return json_text(json);
}

}  // namespace strata
