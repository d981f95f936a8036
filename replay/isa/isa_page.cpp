// The report for people and for scripts, and the table of GPUs.
#include <cmath>

#include <nlohmann/json.hpp>

#include "replay/isa/isa_columns.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/tables/document.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

std::string describe(const GpuModel& model) {
    return fmt::format("{}, {} x {} SIMDs, {} MHz", model.board, plural(model.units, model.unit->called), model.unit->simds,
                       model.clock_mhz);
}

void add_gpu(Page& page, const IsaOfGpu& gpu) {
    page.emplace_back(
        fmt::format("\n{}{}\n  {}, {}\n", gpu.name, gpu.model ? ": " + describe(*gpu.model) : "", gpu.device, gpu.driver));
    page.emplace_back(programs_of(gpu));
    std::string notes;
    for (const std::string& note : gpu.notes) notes += fmt::format("  note: {}\n", note);
    page.emplace_back(notes);
    if (gpu.tiles) {
        page.emplace_back(fmt::format("\n  {}: {:.2f} waves per SIMD, the mean over {}\n", gpu.tiles->technique, gpu.tiles->mean,
                                      plural(gpu.tiles->tiles, "shaded tile")));
        page.emplace_back(variants_of(*gpu.tiles));
    }
    if (!gpu.modeled_ms) return;
    page.emplace_back(
        "\n  modeled, not measured: invocations / 64 x cycles per 64 / (SIMDs x clock); no memory, no caches, no vertices\n");
    page.emplace_back(isa_steps_of(gpu));
    page.emplace_back(fmt::format("   {:.3f} us modeled for the steps that have a time\n", 1e3 * *gpu.modeled_ms));
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
            cell_json(std::isinf(alone) ? CellValue(Unknown{}) : CellValue(alone));
    }
    return json;
}

ordered_json json_of(const TileWaves& waves) {
    ordered_json json{{"technique", waves.technique},
                      {"tiles", waves.tiles},
                      {"mean_waves_per_simd", waves.mean},
                      {"variants", rows_json(variants_of(waves))}};
    for (std::size_t i = 0; i < waves.variants.size(); ++i)
        json["variants"][i]["occupancy"] = json_of(waves.variants[i].occupancy);
    return json;
}

ordered_json json_of(const IsaOfGpu& gpu) {
    ordered_json json{{"name", gpu.name}, {"device", gpu.device}, {"driver", gpu.driver}};
    json["model"] = gpu.model ? rows_json(sheet_of({gpu.model, 1}))[0] : ordered_json();
    json["programs"] = rows_json(programs_of(gpu));
    for (std::size_t i = 0; i < gpu.programs.size(); ++i) {
        const auto& occupancy = gpu.programs[i].occupancy;
        json["programs"][i]["occupancy"] = occupancy ? json_of(*occupancy) : ordered_json();
    }
    json["steps"] = rows_json(isa_steps_of(gpu));
    json["modeled_ms"] = cell_json(cell_or_unknown(gpu.modeled_ms));
    json["modeled_by"] = "invocations / 64 x inverse throughput / (SIMDs x clock)";
    json["notes"] = gpu.notes;
    if (gpu.tiles) json["tiles"] = json_of(*gpu.tiles);
    return json;
}

}  // namespace

Page page_of(const IsaReport& report) {
    Page page{fmt::format("frame {} of {}, {} x {}, {}\n", report.frame, report.capture, report.width, report.height,
                          plural(report.samples, "sample"))};
    for (const IsaOfGpu& gpu : report.gpus) add_gpu(page, gpu);
    return page;
}

std::string as_text(const IsaReport& report) { return as_text(page_of(report)); }

std::string as_csv(const IsaReport& report) {
    std::vector<Sheet> sheets;
    const auto add = [&](const IsaOfGpu& gpu, std::string table, Sheet sheet) {
        sheet.of_every_row = {{"gpu", gpu.name}, {"table", std::move(table)}};
        sheets.push_back(std::move(sheet));
    };
    for (const IsaOfGpu& gpu : report.gpus) {
        add(gpu, "programs", programs_of(gpu));
        add(gpu, "steps", isa_steps_of(gpu));
        if (gpu.tiles) add(gpu, "tiles", variants_of(*gpu.tiles));
    }
    return as_csv(sheets);
}

std::string as_json(const IsaReport& report) {
    ordered_json json = document({.schema = "strata.isa",
                                  .date = report.date,
                                  .capture_id = report.capture_id,
                                  .capture_name = report.capture,
                                  .width = report.width,
                                  .height = report.height,
                                  .samples = report.samples});
    json.update({{"capture", report.capture}, {"frame", report.frame}, {"width", report.width}, {"height", report.height}});
    json["gpus"] = ordered_json::array();
    for (const IsaOfGpu& gpu : report.gpus) json["gpus"].push_back(json_of(gpu));
    return json_text(json);
}

std::string as_text(const GpuModels& known) { return as_text(sheet_of(known.models)); }
std::string as_csv(const GpuModels& known) { return as_csv(std::vector{sheet_of(known.models)}); }
std::string as_json(const GpuModels& known) {
    ordered_json json = document({.schema = "strata.gpu_models", .date = known.date});
    json["gpus"] = rows_json(sheet_of(known.models));
    return json_text(json);
}
Page page_of(const GpuModels& known) { return {sheet_of(known.models)}; }

}  // namespace strata
