// GPUs by the numbers that decide how many waves of a shader they hold at once, and how fast they go through them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "capture_format/result.h"

namespace strata {

/// What shares one memory for groups: a compute unit (GCN), a work group processor (RDNA), a multiprocessor (NVIDIA).
struct UnitModel {
    std::string_view called;
    std::uint32_t simds = 4;
    std::uint32_t wave_slots = 0;                            ///< per SIMD, whatever the width of a wave
    std::uint32_t lanes = 0;                                 ///< of the narrowest wave; registers are counted for that one
    std::uint32_t registers = 0, register_granule = 0;       ///< vector registers per lane of a SIMD
    std::uint32_t scalar_registers = 0, scalar_granule = 0;  ///< per SIMD; 0: every wave has its own
    std::uint32_t lds_bytes = 0, lds_granule = 0;
    std::uint32_t lds_reserved = 0;   ///< kept for the system from every group
    std::uint32_t lds_per_group = 0;  ///< at most
    std::uint32_t group_slots = 0;
    std::uint32_t waves_without_slot = 0;  ///< a group of so few waves takes no slot
};

struct GpuModel {
    std::string_view name;          ///< as after --gpu-model
    std::string_view family;        ///< what RADV_FORCE_FAMILY of Mesa 22.3 calls it; empty: RADV does not compile for it
    std::string_view later_family;  ///< the same of Mesa 25, where that was renamed
    std::string_view board;         ///< whose units and clock these are
    std::uint32_t units = 0;
    double clock_mhz = 0;  ///< boost
    const UnitModel* unit = nullptr;
};

std::span<const GpuModel> gpu_models();
/// Fails (usage) with the nearest name. Capitals do not matter.
Result<const GpuModel*> find_gpu_model(std::string_view name);
/// The same of GPUs that RADV compiles for alone.
Result<const GpuModel*> find_compiled_gpu_model(std::string_view name);
/// The model of a device by what it calls itself; null for devices that are not in the table.
const GpuModel* gpu_model_of(std::string_view device_name);

/// SIMDs of the whole GPU times clock: what a cost per SIMD is divided by.
inline double simd_cycles_per_second(const GpuModel& model) {
    return double(model.units) * model.unit->simds * model.clock_mhz * 1e6;
}

}  // namespace strata
