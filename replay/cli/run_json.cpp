#include "replay/cli/run_json.h"

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json passes_of(const Run& run) {
    ordered_json passes = ordered_json::array();
    for (const PassImages& pass : run.passes) {
        ordered_json row{
            {"index", passes.size()}, {"name", pass.label}, {"choice", pass.choice}, {"hash", ordered_json::object()}};
        for (const auto& [name, image] : pass.images) row["hash"][name] = hash_of(image);
        passes.push_back(std::move(row));
    }
    return passes;
}

ordered_json json_of(const ImageVerdict& verdict) {
    ordered_json json{
        {"pass", verdict.pass}, {"image", verdict.image}, {"hash", verdict.hash}, {"expected", verdict.expected_hash}};
    if (verdict.accepted > 1) json["accepted_results"] = verdict.accepted;
    if (!verdict.deviation) return json;
    const WorstTexel& w = verdict.deviation->worst;
    json["metric"] = "relative rmse";
    json["value"] = verdict.deviation->rmse;
    json["differing_texels"] = verdict.deviation->differing;
    json["worst_texel"] = {{"x", w.x},
                           {"y", w.y},
                           {"layer", w.layer},
                           {"got", {w.got.x, w.got.y, w.got.z, w.got.w}},
                           {"expected", {w.wanted.x, w.wanted.y, w.wanted.z, w.wanted.w}}};
    return json;
}

ordered_json json_of(const ExpectationVerdict& verdict) {
    constexpr const char* names[] = {"exact", "within tolerance", "diverges", "missing"};
    ordered_json json{{"agreement", names[static_cast<std::size_t>(verdict.agreement)]}};
    if (verdict.elsewhere) json["expected_on"] = text(*verdict.elsewhere);
    if (const ImageVerdict* first = verdict.first_divergence()) json["first_divergence"] = json_of(*first);
    for (const ImageVerdict& image : verdict.images)
        if (image.agreement == Agreement::within_tolerance) json["within_tolerance"].push_back(json_of(image));
    return json;
}

ordered_json json_of(const NumberTable& table) {
    ordered_json json{{"columns", ordered_json::array()}, {"rows", table.rows}};
    for (const TableColumn& column : table.columns) json["columns"].push_back({{"name", column.name}, {"unit", column.unit}});
    return json;
}

/// "stage/technique:view", or null.
const DebugView* find_view(const std::string& name) {
    const std::size_t colon = name.find(':');
    const auto technique = find_technique(name.substr(0, colon));
    if (colon == name.npos || !technique) return nullptr;
    const auto view = std::ranges::find((*technique)->views, name.substr(colon + 1), &DebugView::name);
    return view == (*technique)->views.end() ? nullptr : &*view;
}

/// Legend and numbers: of red, green and blue.
ordered_json json_of(const DebugView& view, const HostImage& image) {
    const ReferenceImage picture = in_double(image);
    glm::dvec3 least(std::numeric_limits<double>::infinity()), most = -least, mean(0);
    for (const glm::dvec4& texel : picture.texels) {
        const glm::dvec3 shown(texel);
        least = glm::min(least, shown), most = glm::max(most, shown);
        mean += shown / static_cast<double>(picture.texels.size());
    }
    ordered_json json{{"help", view.help}, {"unit", view.unit}, {"black", view.low}, {"white", view.high}};
    json["least"] = {least.x, least.y, least.z};
    json["mean"] = {mean.x, mean.y, mean.z};
    json["most"] = {most.x, most.y, most.z};
    return json;
}

ordered_json json_of(const LightFault& fault) {
    ordered_json json{{"pass", fault.pass},
                      {"image", fault.image},
                      {"is", fault.kind == LightFault::Kind::not_finite ? "not finite" : "cut off"},
                      {"texels", fault.texels},
                      {"first", {{"x", fault.first.x}, {"y", fault.first.y}}}};
    if (fault.kind == LightFault::Kind::cut_off) json["limit"] = fault.limit;
    return json;
}

ordered_json json_of(const RunMemory& memory) {
    ordered_json json{{"plan_bytes", memory.plan},
                      {"scene_bytes", memory.scene},
                      {"memo_bytes", memory.memo},
                      {"device_allocated_bytes", memory.allocated},
                      {"device_peak_bytes", memory.peak_allocated},
                      {"host_peak_bytes", memory.host_peak},
                      {"fullest_step",
                       {{"scope", text_of(memory.over_time.fullest_scope)},
                        {"name", memory.over_time.fullest_step},
                        {"alive_bytes", memory.over_time.peak}}}};
    for (const auto& [stage, of_stage] : memory.over_time.stages)
        json["stages"][stage] = {{"allocated_bytes", of_stage.allocated}, {"peak_bytes", of_stage.peak}};
    return json;
}

ordered_json json_of(const RunTimes& times) {
    return {{"load", times.load},
            {"declare", times.declare},
            {"upload", times.upload},
            {"allocate", times.device.allocate},
            {"pipelines", times.device.pipelines},
            {"record", times.device.record},
            {"render", times.device.render},
            {"read_back", times.device.read_back}};
}

}  // namespace

Sheet steps_of(const Run& run, std::size_t frame) {
    struct NumberedStep {
        std::size_t index;
        const StepRecord& step;
    };
    const std::vector<Column<NumberedStep>> columns{
        {{.key = "frame", .title = "frame", .help = "index of the frame", .kind = CellKind::count, .shown = in_csv},
         [frame](const NumberedStep&) { return std::uint64_t{frame}; }},
        {{.key = "index", .title = "index", .help = "number of the step", .kind = CellKind::count, .shown = in_files},
         [](const NumberedStep& row) { return std::uint64_t{row.index}; }},
        {{.key = "scope", .title = "scope", .help = "stage and technique", .kind = CellKind::text, .shown = in_text | in_files},
         [](const NumberedStep& row) { return text_of(row.step.scope); }},
        {{.key = "name", .title = "step", .help = "name of the step", .kind = CellKind::text, .shown = in_files},
         [](const NumberedStep& row) { return row.step.name; }},
        {{.key = "gpu_ms",
          .title = "ms",
          .help = "time of the step, with --time",
          .kind = CellKind::spread,
          .better = Better::less},
         [](const NumberedStep& row) { return cell_or_nothing(row.step.ms); }}};
    std::vector<NumberedStep> steps;
    for (std::size_t i = 0; i < run.steps.size(); ++i) steps.push_back({i, run.steps[i]});
    return sheet_of<NumberedStep>(columns, steps, [](const NumberedStep& row) { return RowName{"", row.step.name}; });
}

ordered_json json_of(const DocumentHead& head, const Metadata& provenance, const Run& run, const ExpectationVerdict* verdict) {
    ordered_json json = document(head);
    for (const auto& [key, value] : provenance) json["provenance"][key] = value;
    json["provenance"]["strata.settings"] = run.choices;
    json["steps"] = rows_json(steps_of(run, 0));
    if (!run.passes.empty()) json["passes"] = passes_of(run);
    if (verdict) json["expectation"] = json_of(*verdict);
    if (run.frame_ms) json["frame_ms"] = json_of(*run.frame_ms);
    if (run.whole_frame_ms) json["whole_frame_ms"] = json_of(*run.whole_frame_ms);
    if (run.empty_step_ms) json["empty_step_ms"] = json_of(*run.empty_step_ms);
    for (const auto& [stage, ms] : run.stage_ms) json["stage_ms"][stage] = json_of(ms);
    if (run.unchanged_frame_ms) json["unchanged_frame_ms"] = json_of(*run.unchanged_frame_ms);
    for (const auto& [stage, ms] : run.unchanged_stage_ms) json["unchanged_stage_ms"][stage] = json_of(ms);
    for (const auto& [stage, ran] : run.stage_invocations) json["stage_invocations"][stage] = ran;
    for (const SkippedStage& skipped : run.skipped)
        json["left_out"].push_back({{"stage", name(skipped.stage)}, {"reason", skipped.reason}});
    for (const CounterRecord& counter : run.counters) json["counters"][counter.technique][counter.name] = counter.value;
    for (const std::string& technique : run.not_counted) json["not_counted"].push_back(technique);
    for (const UnsupportedChoice& choice : run.not_supported) json["not_supported"][choice.technique] = choice.reason;
    for (const auto& [name, image] : run.images)
        if (const DebugView* view = find_view(name)) json["views"][name] = json_of(*view, image);
    for (const auto& [name, table] : run.tables) json["tables"][name] = json_of(table);
    for (const LightFault& fault : run.light_faults) json["light_faults"].push_back(json_of(fault));
    for (const std::string& note : run.notes) json["notes"].push_back(note);
    json["image_bytes"] = run.image_bytes;
    json["buffer_bytes"] = run.buffer_bytes;
    json["memory"] = json_of(run.memory);
    json["host_ms"] = json_of(run.host_ms);
    return json;
}

}  // namespace strata
