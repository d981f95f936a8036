#include "replay/isa/gpu_models.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "capture_format/nearest_name.h"

namespace strata {
namespace {

constexpr std::uint32_t kib = 1024;

// GCN: SIMDs of 16 lanes that take 4 cycles for a wave of 64. 16 groups of more than one wave: the barrier unit's.
constexpr UnitModel gfx7 = {.called = "compute unit",
                            .wave_slots = 10,
                            .lanes = 64,
                            .registers = 256,
                            .register_granule = 4,
                            .scalar_registers = 512,
                            .scalar_granule = 8,
                            .lds_bytes = 64 * kib,
                            .lds_granule = 512,
                            .lds_per_group = 64 * kib,
                            .group_slots = 16,
                            .waves_without_slot = 1};

constexpr UnitModel with_more_scalars(UnitModel unit, std::uint32_t wave_slots) {
    unit.wave_slots = wave_slots;
    unit.scalar_registers = 800;
    unit.scalar_granule = 16;
    return unit;
}
constexpr UnitModel gfx9 = with_more_scalars(gfx7, 10);
constexpr UnitModel polaris = with_more_scalars(gfx7, 8);  // the driver's own cap: Mesa 22.3 never says more

// RDNA: two compute units that share their LDS. A wave of 64 takes the registers of a wave of 32 twice.
constexpr UnitModel gfx10 = {.called = "work group processor",
                             .wave_slots = 20,
                             .lanes = 32,
                             .registers = 1024,
                             .register_granule = 8,
                             .lds_bytes = 128 * kib,
                             .lds_granule = 512,
                             .lds_per_group = 64 * kib,
                             .group_slots = 32,
                             .waves_without_slot = 1};

constexpr UnitModel after_gfx10(std::uint32_t registers, std::uint32_t granule) {
    UnitModel unit = gfx10;
    unit.wave_slots = 16;
    unit.registers = registers;
    unit.register_granule = granule;
    unit.lds_granule = 1024;
    return unit;
}
constexpr UnitModel gfx10_3 = after_gfx10(1024, 16);
constexpr UnitModel gfx11_large = after_gfx10(1536, 24);

// NVIDIA sm_90 (CUDA programming guide, compute capability 9.0): a quarter of 65536 registers for each of 4 schedulers.
constexpr UnitModel sm_90 = {.called = "multiprocessor",
                             .wave_slots = 16,
                             .lanes = 32,
                             .registers = 512,
                             .register_granule = 8,
                             .lds_bytes = 228 * kib,
                             .lds_granule = 128,
                             .lds_reserved = 1 * kib,
                             .lds_per_group = 227 * kib,
                             .group_slots = 32};

// Units and clocks are those of the boards' data sheets. The PlayStation 4 has the instructions and registers of gfx7.
constexpr GpuModel gpu_model_table[] = {
    {"bonaire", "bonaire", "", "Radeon HD 7790", 14, 1000, &gfx7},
    {"ps4", "bonaire", "", "PlayStation 4, compiled as bonaire", 18, 800, &gfx7},
    {"hawaii", "hawaii", "", "Radeon R9 290X", 44, 1000, &gfx7},
    {"polaris10", "polaris10", "", "Radeon RX 480", 36, 1266, &polaris},
    {"vega10", "vega10", "", "Radeon RX Vega 64", 64, 1546, &gfx9},
    {"navi10", "navi10", "", "Radeon RX 5700 XT", 20, 1905, &gfx10},
    {"navi21", "navi21", "", "Radeon RX 6900 XT", 40, 2250, &gfx10_3},
    {"gfx1100", "gfx1100", "navi31", "Radeon RX 7900 XTX", 48, 2500, &gfx11_large},
    {"h200", "", "", "H200 SXM", 132, 1980, &sm_90},
};

std::string lower(std::string_view text) {
    std::string made(text);
    std::ranges::transform(made, made.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return made;
}

}  // namespace

std::span<const GpuModel> gpu_models() { return gpu_model_table; }

Result<const GpuModel*> find_gpu_model(std::string_view name) {
    const std::string wanted = lower(name);
    std::vector<std::string_view> known;
    for (const GpuModel& model : gpu_model_table) {
        if (model.name == wanted || (!model.later_family.empty() && model.later_family == wanted)) return &model;
        known.push_back(model.name);
    }
    return fail(Fault::usage, "isa.unknown_gpu_model", "there is no GPU model '{model}'{suggestion} (strata isa lists them)",
                name, did_you_mean(wanted, known));
}

Result<const GpuModel*> find_compiled_gpu_model(std::string_view name) {
    const auto found = find_gpu_model(name);
    if (found && (*found)->family.empty())
        return fail(
            Fault::usage, "isa.model_not_in_radv",
            "RADV does not compile for {model}: run on one and name no GPU model, or name one that `strata isa` lists with "
            "a family",
            (*found)->name);
    return found;
}

const GpuModel* gpu_model_of(std::string_view device_name) {
    const std::string device = lower(device_name);
    const auto names_it = [&](std::string_view part) { return !part.empty() && device.find(part) != std::string::npos; };
    const auto found = std::ranges::find_if(gpu_model_table, [&](const GpuModel& model) {
        return names_it(model.name) || names_it(model.family) || names_it(model.later_family);
    });
    return found == std::end(gpu_model_table) ? nullptr : found;
}

}  // namespace strata
