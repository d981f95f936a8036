// How many waves of a shader a SIMD holds at once, and what keeps it from holding more. Whole groups only: a compiler's own
// number may be rounded up (RADV's is: replay/isa/README.md), and a difference to it is said.
#pragma once

#include <array>
#include <string_view>

#include "replay/isa/gpu_models.h"

namespace strata {

/// What a compiled shader takes. group_threads 0: no groups (vertices, fragments), every wave for itself.
struct ShaderResources {
    std::uint32_t registers = 0, scalar_registers = 0;
    std::uint32_t lds_bytes = 0;  ///< per group
    std::uint32_t group_threads = 0;
    std::uint32_t wave_lanes = 0;
};

enum class OccupancyLimit { wave_slots, registers, scalar_registers, lds, group_slots };
constexpr std::size_t occupancy_limits = 5;
std::string_view name(OccupancyLimit);

struct Occupancy {
    std::uint32_t groups = 0, waves_per_group = 1;  ///< of a unit
    double waves_per_simd = 0;                      ///< in whole groups: not always a whole number
    OccupancyLimit limit = OccupancyLimit::wave_slots;
    double lost_to_whole_groups = 0;  ///< waves per SIMD that the limit would leave room for, but not for another group
    std::array<double, occupancy_limits> alone{};  ///< waves per SIMD if each limit were the only one; infinite: it is none
};

/// waves = min(wave slots, registers / granules taken, scalar registers / granules taken); groups = min(waves x SIMDs / waves per
/// group, LDS / granules taken, group slots), each rounded down. Where several limit equally the first of the enumeration is
/// named.
Occupancy occupancy(const GpuModel&, const ShaderResources&);

/// What RADV of Mesa 22.3 states as "Subgroups per SIMD" for the same: LDS is shared out to waves, the quotient is rounded up,
/// no group is kept whole, and RDNA counts in waves of 32.
std::uint32_t stated_by_radv(const GpuModel&, const ShaderResources&);

}  // namespace strata
