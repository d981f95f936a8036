// The report for scripts: everything that is known.
#include <cmath>

#include <nlohmann/json.hpp>

#include "replay/isa/isa_report.h"
#include "replay/json_text.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

template <typename T>
ordered_json or_null(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json();
}

ordered_json json_of(const Occupancy& occupancy) {
    ordered_json json{{"waves_per_simd", occupancy.waves_per_simd},
                      {"limited_by", name(occupancy.limit)},
                      {"lost_to_whole_groups", occupancy.lost_to_whole_groups},
                      {"groups_per_unit", occupancy.groups},
                      {"waves_per_group", occupancy.waves_per_group}};
    for (std::size_t i = 0; i < occupancy_limits; ++i) {
        const double alone = occupancy.alone[i];
        json["alone"][std::string(name(static_cast<OccupancyLimit>(i)))] =
            std::isinf(alone) ? ordered_json() : ordered_json(alone);
    }
    return json;
}

ordered_json json_of(const IsaProgram& p) {
    return {{"pipeline", p.pipeline},
            {"label", p.label},
            {"stage", p.stage},
            {"wave_lanes", p.wave_lanes},
            {"group_threads", p.group_threads},
            {"vector_registers", or_null(p.registers)},
            {"scalar_registers", or_null(p.scalar_registers)},
            {"lds_bytes", or_null(p.lds_bytes)},
            {"spilled_registers", or_null(p.spilled)},
            {"scratch_bytes", or_null(p.scratch_bytes)},
            {"code_bytes", or_null(p.code_bytes)},
            {"instructions", or_null(p.instructions)},
            {"latency_cycles", or_null(p.latency)},
            {"inverse_throughput_cycles", or_null(p.inverse_throughput)},
            {"occupancy", p.occupancy ? json_of(*p.occupancy) : ordered_json()},
            {"stated_by_compiler", or_null(p.stated)},
            {"stated_by_rule", or_null(p.stated_by_rule)}};
}

ordered_json json_of(const IsaPass& pass) {
    return {{"scope", text_of(pass.scope)},
            {"name", pass.name},
            {"pipeline", pass.pipeline},
            {"label", pass.label},
            {"invocations", or_null(pass.invocations)},
            {"counted_by", pass.counted_by},
            {"modelled_ms", or_null(pass.modelled_ms)}};
}

/// A number of a table: most are whole.
ordered_json json_of(double value) {
    return value == std::floor(value) ? ordered_json(static_cast<std::int64_t>(value)) : ordered_json(value);
}

ordered_json json_of(const TileWaves& waves) {
    ordered_json json{{"technique", waves.technique},
                      {"tiles", waves.tiles},
                      {"mean_waves_per_simd", waves.mean},
                      {"variants", ordered_json::array()}};
    for (const VariantWaves& variant : waves.variants) {
        ordered_json& row = json["variants"].emplace_back();
        for (std::size_t i = 0; i < waves.columns.size(); ++i) row[std::string(waves.columns[i].name)] = json_of(variant.row[i]);
        row["vector_registers"] = or_null(variant.registers);
        row["occupancy"] = json_of(variant.occupancy);
    }
    return json;
}

ordered_json json_of(const GpuModel& model) {
    return {{"name", model.name},
            {"board", model.board},
            {"units", model.units},
            {"unit", model.unit->called},
            {"simds_per_unit", model.unit->simds},
            {"clock_mhz", model.clock_mhz}};
}

}  // namespace

std::string as_json(const IsaReport& report) {
    ordered_json json{{"schema", "strata.isa"},    {"schema_version", 1},          {"capture", report.capture},
                      {"frame", report.frame},     {"width", report.width},        {"height", report.height},
                      {"samples", report.samples}, {"gpus", ordered_json::array()}};
    for (const IsaOfGpu& gpu : report.gpus) {
        ordered_json& row =
            json["gpus"].emplace_back(ordered_json{{"name", gpu.name}, {"device", gpu.device}, {"driver", gpu.driver}});
        row["model"] = gpu.model ? json_of(*gpu.model) : ordered_json();
        row["programs"] = row["passes"] = ordered_json::array();
        for (const IsaProgram& program : gpu.programs) row["programs"].push_back(json_of(program));
        for (const IsaPass& pass : gpu.passes) row["passes"].push_back(json_of(pass));
        row["modelled_ms"] = or_null(gpu.modelled_ms);
        row["modelled_by"] = "invocations / 64 x inverse throughput / (SIMDs x clock)";
        row["notes"] = gpu.notes;
        if (gpu.tiles) row["tiles"] = json_of(*gpu.tiles);
    }
    return json_text(json);
}

std::string gpu_models_json() {
    ordered_json json{{"schema", "strata.gpu_models"}, {"schema_version", 1}, {"gpus", ordered_json::array()}};
    for (const GpuModel& model : gpu_models()) {
        ordered_json& row = json["gpus"].emplace_back(json_of(model));
        const UnitModel& unit = *model.unit;
        row["wave_slots"] = unit.wave_slots;
        row["registers"] = unit.registers;
        row["register_granule"] = unit.register_granule;
        row["lds_bytes"] = unit.lds_bytes;
        row["radv_family"] = model.family.empty() ? ordered_json() : ordered_json(model.family);
    }
    return json_text(json);
}

}  // namespace strata
