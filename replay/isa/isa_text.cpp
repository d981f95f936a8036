// The report for people, and the table of GPUs.
#include <cmath>

#include "replay/isa/isa_report.h"
#include "replay/plural.h"
#include "replay/report/table.h"

namespace strata {
namespace {

std::string cell(std::optional<double> value) { return value ? fmt::format("{}", *value) : "-"; }

std::string limit_of(const Occupancy& occupancy) {
    return fmt::format("{}{}", name(occupancy.limit), occupancy.lost_to_whole_groups > 0 ? ", whole groups" : "");
}

/// RADV counts waves of 64 as two on RDNA; we do not.
std::optional<double> stated_in_waves(const IsaProgram& program, const GpuModel* model) {
    if (!program.stated || !model || program.wave_lanes == 0) return program.stated;
    return *program.stated * model->unit->lanes / program.wave_lanes;
}

Table programs_of(const IsaOfGpu& gpu) {
    Table table{.heads = {"stage", "lanes", "VGPR", "SGPR", "LDS", "waves per SIMD", "com- piler's", "limited by", "spilled",
                          "instruc- tions", "latency", "cycles per 64"},
                .rows = {}};
    for (const IsaProgram& p : gpu.programs) {
        table.rows.push_back({.marks = "",
                              .label = p.label,
                              .cells = {p.stage, fmt::format("{}", p.wave_lanes), cell(p.registers), cell(p.scalar_registers),
                                        cell(p.lds_bytes), p.occupancy ? cell(p.occupancy->waves_per_simd) : "-",
                                        cell(stated_in_waves(p, gpu.model)), p.occupancy ? limit_of(*p.occupancy) : "-",
                                        cell(p.spilled), cell(p.instructions), cell(p.latency), cell(p.inverse_throughput)}});
    }
    return table;
}

Table passes_of(const IsaOfGpu& gpu) {
    Table table{.heads = {"invo- cations", "counted by", "modelled us"}, .rows = {}};
    for (const IsaPass& pass : gpu.passes)
        table.rows.push_back({.marks = "",
                              .label = pass.label,
                              .cells = {pass.invocations ? fmt::format("{}", *pass.invocations) : "-", pass.counted_by,
                                        pass.modelled_ms ? fmt::format("{:.3f}", 1e3 * *pass.modelled_ms) : "-"}});
    return table;
}

/// A column of the technique's own: bits as such.
std::string cell(const TableColumn& column, double value) {
    return column.unit == "bits" ? fmt::format("{:#06x}", static_cast<std::uint64_t>(value)) : fmt::format("{}", value);
}

std::string tiles_text(const TileWaves& waves) {
    Table table;
    for (const TableColumn& column : waves.columns)
        if (column.name != waves.constant) table.heads.emplace_back(column.name);
    table.heads.insert(table.heads.end(), {"% of tiles", "VGPR", "waves per SIMD", "limited by"});
    for (const VariantWaves& variant : waves.variants) {
        Table::Row row{.marks = "", .label = fmt::format("{} {}", waves.constant, variant.number), .cells = {}};
        for (std::size_t i = 0; i < waves.columns.size(); ++i)
            if (waves.columns[i].name != waves.constant) row.cells.push_back(cell(waves.columns[i], variant.row[i]));
        row.cells.push_back(fmt::format("{:.1f}", 100 * double(variant.tiles) / double(waves.tiles)));
        row.cells.insert(row.cells.end(),
                         {cell(variant.registers), cell(variant.occupancy.waves_per_simd), limit_of(variant.occupancy)});
        table.rows.push_back(std::move(row));
    }
    return fmt::format("\n  {}: {:.2f} waves per SIMD, the mean over {}\n", waves.technique, waves.mean,
                       plural(waves.tiles, "shaded tile")) +
           as_text(table);
}

std::string describe(const GpuModel& model) {
    return fmt::format("{}, {} x {} SIMDs, {} MHz", model.board, plural(model.units, model.unit->called), model.unit->simds,
                       model.clock_mhz);
}

}  // namespace

std::string as_text(const IsaReport& report) {
    std::string text = fmt::format("frame {} of {}, {} x {}, {}\n", report.frame, report.capture, report.width, report.height,
                                   plural(report.samples, "sample"));
    for (const IsaOfGpu& gpu : report.gpus) {
        text += fmt::format("\n{}{}\n  {}, {}\n", gpu.name, gpu.model ? ": " + describe(*gpu.model) : "", gpu.device, gpu.driver);
        text += as_text(programs_of(gpu));
        for (const std::string& note : gpu.notes) text += fmt::format("  note: {}\n", note);
        if (gpu.tiles) text += tiles_text(*gpu.tiles);
        if (!gpu.modelled_ms) continue;
        text +=
            "\n  modelled, not measured: invocations / 64 x cycles per 64 / (SIMDs x clock); no memory, no caches, no vertices\n";
        text += as_text(passes_of(gpu));
        text += fmt::format("   {:.3f} us modelled for the passes that have a time\n", 1e3 * *gpu.modelled_ms);
    }
    return text;
}

std::string gpu_models_text() {
    Table table{.heads = {"units", "SIMDs", "MHz", "wave slots", "regis- ters", "granule", "LDS KiB", "RADV family", "board"},
                .rows = {}};
    for (const GpuModel& model : gpu_models()) {
        const UnitModel& unit = *model.unit;
        const auto number = [](auto value) { return fmt::format("{}", value); };
        table.rows.push_back({.marks = "",
                              .label = std::string(model.name),
                              .cells = {number(model.units), number(unit.simds), number(model.clock_mhz), number(unit.wave_slots),
                                        number(unit.registers), number(unit.register_granule), number(unit.lds_bytes / 1024),
                                        model.family.empty() ? "-" : std::string(model.family), std::string(model.board)}});
    }
    return as_text(table);
}

}  // namespace strata
