// What programs, steps, variants and GPUs say of themselves, for every format.
#include "replay/isa/isa_columns.h"

#include <cmath>

namespace strata {
namespace {

std::string limit_of(const Occupancy& occupancy) {
    return fmt::format("{}{}", name(occupancy.limit), occupancy.lost_to_whole_groups > 0 ? ", whole groups" : "");
}

/// RADV counts waves of 64 as two on RDNA; we do not.
std::optional<double> stated_in_waves(const IsaProgram& program, const GpuModel* model) {
    if (!program.stated || !model || program.wave_lanes == 0) return program.stated;
    return *program.stated * model->unit->lanes / program.wave_lanes;
}

using Programs = std::vector<Column<IsaProgram>>;

/// A number of the compiler's, which it may not state.
Column<IsaProgram> stated(Described is, std::optional<double> IsaProgram::*number) {
    is.kind = CellKind::count;
    return {std::move(is), [number](const IsaProgram& program) { return cell_or_unknown(program.*number); }};
}

Programs program_names() {
    const auto text = [](std::string key, std::string help, unsigned shown, std::string IsaProgram::*member) {
        return Column<IsaProgram>{{.key = key, .title = key, .help = std::move(help), .kind = CellKind::text, .shown = shown},
                                  [member](const IsaProgram& program) { return program.*member; }};
    };
    return {
        {{.key = "pipeline", .title = "pipeline", .help = "number of the pipeline", .kind = CellKind::count, .shown = in_files},
         [](const IsaProgram& program) { return std::uint64_t{program.pipeline}; }},
        text("label", "name of the pipeline", in_files, &IsaProgram::label),
        text("stage", "stage of the pipeline: compute, vertex, fragment", in_text | in_files, &IsaProgram::stage),
        {{.key = "wave_lanes", .title = "lanes", .help = "lanes of a wave", .kind = CellKind::count},
         [](const IsaProgram& program) { return std::uint64_t{program.wave_lanes}; }},
        {{.key = "group_threads",
          .title = "group",
          .help = "threads of a work group",
          .kind = CellKind::count,
          .shown = in_files},
         [](const IsaProgram& program) { return std::uint64_t{program.group_threads}; }}};
}

Programs resources(const GpuModel* model) {
    const auto waves = [](const IsaProgram& program) {
        return program.occupancy ? CellValue(program.occupancy->waves_per_simd) : CellValue(Unknown{});
    };
    const auto limited = [](const IsaProgram& program) {
        return program.occupancy ? CellValue(limit_of(*program.occupancy)) : CellValue(Unknown{});
    };
    return {
        stated({.key = "vector_registers", .title = "VGPR", .help = "vector registers of a lane"}, &IsaProgram::registers),
        stated({.key = "scalar_registers", .title = "SGPR", .help = "scalar registers of a wave"}, &IsaProgram::scalar_registers),
        stated({.key = "lds_bytes", .title = "LDS", .help = "bytes that a work group shares"}, &IsaProgram::lds_bytes),
        {{.key = "waves_per_simd",
          .title = "waves per SIMD",
          .help = "waves that a SIMD holds at once, in whole groups",
          .kind = CellKind::count,
          .better = Better::more,
          .shown = in_text | in_csv},
         waves},
        {{.key = "stated_waves",
          .title = "com- piler's",
          .help = "the same as the compiler states it",
          .kind = CellKind::count,
          .shown = in_text},
         [model](const IsaProgram& program) { return cell_or_unknown(stated_in_waves(program, model)); }},
        {{.key = "limited_by",
          .title = "limited by",
          .help = "what keeps a SIMD from holding more",
          .kind = CellKind::text,
          .shown = in_text | in_csv},
         limited},
        stated({.key = "spilled_registers", .title = "spilled", .help = "registers kept in memory"}, &IsaProgram::spilled),
        stated({.key = "scratch_bytes", .title = "scratch", .help = "bytes of memory of a lane", .shown = in_files},
               &IsaProgram::scratch_bytes),
        stated({.key = "code_bytes", .title = "code", .help = "size of the code", .shown = in_files}, &IsaProgram::code_bytes),
        stated({.key = "instructions", .title = "instruc- tions", .help = "instructions of the code"}, &IsaProgram::instructions),
        stated({.key = "latency_cycles", .title = "latency", .help = "cycles of one wave alone"}, &IsaProgram::latency),
        stated({.key = "inverse_throughput_cycles", .title = "cycles per 64", .help = "cycles that 64 invocations take"},
               &IsaProgram::inverse_throughput),
        stated(
            {.key = "stated_by_compiler", .title = "stated", .help = "waves per SIMD as the compiler counts", .shown = in_files},
            &IsaProgram::stated),
        stated({.key = "stated_by_rule", .title = "by rule", .help = "the same by the compiler's own rule", .shown = in_files},
               &IsaProgram::stated_by_rule)};
}

/// The row's own columns, of which those that number the variants are its label, then what the compiler says.
std::vector<Column<VariantWaves>> variant_columns(const TileWaves& waves) {
    std::vector<Column<VariantWaves>> columns;
    for (std::size_t i = 0; i < waves.columns.size(); ++i) {
        const TableColumn& column = waves.columns[i];
        const std::string key(column.name);
        const bool is_label = column.name == waves.constant;
        columns.push_back({{.key = key,
                            .title = key,
                            .help = "",
                            .kind = CellKind::count,
                            .shown = in_files | (is_label ? 0u : unsigned{in_text}),
                            .unit = std::string(column.unit),
                            .digits = column.unit == "bits" ? "#06x" : ""},  // bits as such
                           [i](const VariantWaves& variant) -> CellValue {
                               const double value = variant.row[i];
                               if (value >= 0 && value == std::floor(value)) return static_cast<std::uint64_t>(value);
                               return value;
                           }});
    }
    const double tiles = double(waves.tiles);
    columns.push_back({{.key = "share_of_tiles",
                        .title = "% of tiles",
                        .help = "share of the shaded tiles",
                        .kind = CellKind::share,
                        .shown = in_text | in_files,
                        .digits = ".1f"},
                       [tiles](const VariantWaves& variant) { return double(variant.tiles) / tiles; }});
    columns.push_back(
        {{.key = "vector_registers", .title = "VGPR", .help = "vector registers of a lane", .kind = CellKind::count},
         [](const VariantWaves& variant) { return cell_or_unknown(variant.registers); }});
    columns.push_back({{.key = "waves_per_simd",
                        .title = "waves per SIMD",
                        .help = "waves that a SIMD holds at once",
                        .kind = CellKind::count,
                        .shown = in_text | in_csv},
                       [](const VariantWaves& variant) { return variant.occupancy.waves_per_simd; }});
    columns.push_back({{.key = "limited_by",
                        .title = "limited by",
                        .help = "what keeps a SIMD from holding more",
                        .kind = CellKind::text,
                        .shown = in_text | in_csv},
                       [](const VariantWaves& variant) { return limit_of(variant.occupancy); }});
    return columns;
}

}  // namespace

Sheet programs_of(const IsaOfGpu& gpu) {
    Programs columns = program_names();
    std::ranges::move(resources(gpu.model), std::back_inserter(columns));
    return sheet_of<IsaProgram>(columns, gpu.programs, [](const IsaProgram& program) { return RowName{"", program.label}; });
}

Sheet isa_steps_of(const IsaOfGpu& gpu) {
    const auto text = [](std::string key, std::string help, auto value) {
        return Column<IsaStep>{{.key = key, .title = key, .help = std::move(help), .kind = CellKind::text, .shown = in_files},
                               value};
    };
    const std::vector<Column<IsaStep>> columns{
        text("scope", "stage and technique", [](const IsaStep& isa_step) { return text_of(isa_step.scope); }),
        text("name", "name of the step", [](const IsaStep& isa_step) { return isa_step.name; }),
        {{.key = "pipeline", .title = "pipeline", .help = "number of the pipeline", .kind = CellKind::count, .shown = in_files},
         [](const IsaStep& isa_step) { return std::uint64_t{isa_step.pipeline}; }},
        text("label", "name of the pipeline", [](const IsaStep& isa_step) { return isa_step.label; }),
        {{.key = "invocations", .title = "invo- cations", .help = "how often the shader ran", .kind = CellKind::count},
         [](const IsaStep& isa_step) { return cell_or_unknown(isa_step.invocations); }},
        {{.key = "counted_by",
          .title = "counted by",
          .help = "source of the count: dispatch, pixels, rasterizer (in double), counter, device; or unknown",
          .kind = CellKind::text},
         [](const IsaStep& isa_step) { return isa_step.counted_by; }},
        {{.key = "modeled_us", .title = "modeled us", .help = "modeled microseconds", .shown = in_text, .digits = ".3f"},
         [](const IsaStep& isa_step) {
             return isa_step.modeled_ms ? CellValue(1e3 * *isa_step.modeled_ms) : CellValue(Unknown{});
         }},
        {{.key = "modeled_ms", .title = "modeled ms", .help = "modeled milliseconds", .shown = in_files},
         [](const IsaStep& isa_step) { return cell_or_unknown(isa_step.modeled_ms); }}};
    return sheet_of<IsaStep>(columns, gpu.steps, [](const IsaStep& isa_step) { return RowName{"", isa_step.label}; });
}

Sheet variants_of(const TileWaves& waves) {
    return sheet_of<VariantWaves>(variant_columns(waves), waves.variants, [&](const VariantWaves& variant) {
        return RowName{"", fmt::format("{} {}", waves.constant, variant.number)};
    });
}

Sheet sheet_of(std::span<const GpuModel> models) {
    const auto described = [](std::string key, std::string title, std::string help, unsigned shown, auto value) {
        return Column<GpuModel>{
            {.key = std::move(key), .title = std::move(title), .help = std::move(help), .kind = CellKind::count, .shown = shown},
            value};
    };
    const auto count = described;
    const auto text = [&](std::string key, std::string title, std::string help, unsigned shown, auto value) {
        Column<GpuModel> column = described(std::move(key), std::move(title), std::move(help), shown, value);
        column.is.kind = CellKind::text;
        return column;
    };
    const auto of_unit = [](std::uint32_t UnitModel::*member) {
        return [member](const GpuModel& model) { return std::uint64_t{model.unit->*member}; };
    };
    const std::vector<Column<GpuModel>> columns{
        text("name", "name", "name after --gpu-model", in_files, [](const GpuModel& model) { return std::string(model.name); }),
        count("units", "units", "compute units or the like", everywhere,
              [](const GpuModel& model) { return std::uint64_t{model.units}; }),
        text("unit", "unit", "what the vendor calls a unit", in_files,
             [](const GpuModel& model) { return std::string(model.unit->called); }),
        count("simds_per_unit", "SIMDs", "SIMDs of a unit", everywhere, of_unit(&UnitModel::simds)),
        count("clock_mhz", "MHz", "boost clock in megahertz", everywhere, [](const GpuModel& model) { return model.clock_mhz; }),
        count("wave_slots", "wave slots", "waves that a SIMD holds at most", everywhere, of_unit(&UnitModel::wave_slots)),
        count("registers", "regis- ters", "vector registers of a lane of a SIMD", everywhere, of_unit(&UnitModel::registers)),
        count("register_granule", "granule", "registers that are allocated at once", everywhere,
              of_unit(&UnitModel::register_granule)),
        count("lds_kibibytes", "LDS KiB", "memory that work groups share", in_text,
              [](const GpuModel& model) { return std::uint64_t{model.unit->lds_bytes / 1024}; }),
        count("lds_bytes", "LDS", "bytes of a unit that work groups share", in_files, of_unit(&UnitModel::lds_bytes)),
        text("radv_family", "RADV family", "what Mesa's RADV calls it; null: it does not compile for it", everywhere,
             [](const GpuModel& model) {
                 return model.family.empty() ? CellValue(Unknown{}) : CellValue(std::string(model.family));
             }),
        text("board", "board", "board whose units and clock these are", everywhere,
             [](const GpuModel& model) { return std::string(model.board); })};
    return sheet_of<GpuModel>(columns, models, [](const GpuModel& model) { return RowName{"", std::string(model.name)}; });
}

}  // namespace strata
