// Reports as JSON, for CI and scripts.

#include <nlohmann/json.hpp>

#include "passes/stages.h"
#include "replay/json_text.h"
#include "replay/report/report_columns.h"
#include "replay/report/warnings.h"
#include "replay/tables/document.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

/// What of a row is no single value.
void add_parts(ordered_json& json, const Measurement& row, bool is_timed) {
    const auto add_errors = [&](const char* key, const std::vector<Metric>& errors) {
        for (const Metric& metric : errors)
            json[key].push_back({{"metric", metric.name}, {"unit", metric.unit}, {"value", cell_json(metric.value)}});
    };
    add_errors("technique_error", errors_of(row));
    add_errors("touched_error", row.accuracy.touched);
    add_errors("stage_error", row.accuracy.stage_errors);
    const WorstTexel& worst = row.accuracy.worst;
    const auto texel = [](const glm::dvec4& v) {
        return ordered_json{cell_json(v.x), cell_json(v.y), cell_json(v.z), cell_json(v.w)};
    };
    json["implementation_error"]["worst_texel"] = {
        {"image", worst.image},         {"x", worst.x}, {"y", worst.y}, {"layer", worst.layer}, {"got", texel(worst.got)},
        {"wanted", texel(worst.wanted)}};
    if (row.modeled && !row.modeled->missing.empty()) json["modeled_missing"] = row.modeled->missing;
    if (!is_timed) return;
    json["repeats_ms"] = row.repeats_ms;
    json["steps"] = ordered_json::array();
    for (const StepTime& step : row.steps) json["steps"].push_back({{"name", step.name}, {"ms", step.ms.median}});
    if (row.time) json["baseline_repeats_ms"] = row.baseline_repeats_ms;
    json["counters"] = ordered_json::object();
    for (const CounterRecord& counter : row.counters) json["counters"][counter.name] = counter.value;
}

ordered_json rows_of(const Report& report) {
    ordered_json rows = rows_json(sheet_of(report));
    for (std::size_t i = 0; i < report.rows.size(); ++i)
        if (report.rows[i].accuracy.not_supported.empty()) add_parts(rows[i], report.rows[i], report.is_timed);
    return rows;
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

template <typename Rows>
ordered_json json_of_answer(const Answer& answer, const Question& asked, const Rows& of) {
    const auto row = [&](std::optional<std::size_t> i) {
        return i ? ordered_json{{"technique", of[*i].technique}, {"settings", of[*i].settings}} : ordered_json();
    };
    ordered_json json{{"error", nullptr}, {"within", nullptr}};
    if (asked.error) json["error"] = *asked.error;
    if (asked.within) json["within"] = *asked.within;
    if (asked.within_ms) json["within_ms"] = *asked.within_ms;
    if (asked.memory) json["memory"] = *asked.memory;
    json["cost"] = asked.cost == &Standing::bytes_per_pixel ? "memory" : asked.gpu.empty() ? "time" : "cycles:" + asked.gpu;
    json["recommended"] = row(answer.recommended);
    json["most_accurate"] = row(answer.most_accurate);
    json["cheaper"] = row(answer.cheaper);
    json["nearest"] = row(answer.nearest);
    for (const auto& [name, rows] : {std::pair("as_cheap", &answer.as_cheap), std::pair("unsteady", &answer.unsteady)}) {
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
    ordered_json json = document({.schema = report_schema,
                                  .version = report_schema_version,
                                  .date = report.date,
                                  .device = &report.device,
                                  .capture_id = report.capture_id,
                                  .capture_name = report.capture_name,
                                  .width = report.width,
                                  .height = report.height,
                                  .samples = report.samples});
    json.update({{"stage", name(report.stage)},
                 {"capture", report.capture_id},
                 {"capture_name", report.capture_name},
                 {"frame", report.frame},
                 {"extent", {report.width, report.height}},
                 {"repeats", report.repeats},
                 {"truth", report.truths.empty() ? std::string() : report.truths.front().is},
                 {"error_at", report.error_at == ErrorAt::picture ? "picture" : "stage"},
                 {"ranked_by", ranking_error(report).name},
                 {"time_unit", report.time_unit}});
    for (const ReportTruth& truth : report.truths) json["truths"].push_back(json_of(truth));
    if (report.flicker)
        json["flicker"] = {
            {"frames", report.flicker->frames}, {"dolly_meters", *report.flicker->dolly}, {"pan_degrees", report.flicker->pan}};
    if (!report.no_picture.empty()) json["no_picture"] = report.no_picture;
    if (!report.skipped.empty()) json["skipped"] = report.skipped;
    if (!report.stopped.empty()) json["stopped"] = report.stopped;
    json["warnings"] = ordered_json::array();
    for (const Warning& warning : warnings_of(report)) json["warnings"].push_back({{"id", warning.id}, {"text", warning.text}});
    json["rows"] = rows_of(report);
    if (!report.is_timed) return json;
    json["best_within"] = json_of_best(report.rows, standings(report.rows), report.time_unit);
    if (report.question.is_asked()) json["answer"] = json_of_answer(answer_of(report), report.question, report.rows);
    return json;
}

}  // namespace

std::string as_json(const Report& report) { return json_text(json_of(report)); }

std::string as_json(std::span<const Report> reports, const Pool& pool) {
    ordered_json json = document({.schema = pooled_reports_schema, .date = reports.empty() ? "" : reports.front().date});
    json["stage"] = name(pool.stage);
    for (const Report& report : reports) json["reports"].push_back(json_of(report));
    ordered_json& together =
        json["pooled"] = {{"captures", pool.captures},        {"frames", pool.frames},
                          {"left_out", pool.left_out},        {"mean", "geometric; arithmetic of bytes and of display rmse"},
                          {"error", pool.error.name},         {"time_unit", pool.time_unit},
                          {"rows", rows_json(sheet_of(pool))}};
    together["best_within"] = json_of_best(pool.rows, standings(pool), pool.time_unit);
    if (pool.question.is_asked()) together["answer"] = json_of_answer(answer_of(pool), pool.question, pool.rows);
    return json_text(json);
}

}  // namespace strata
