#include "replay/isa/occupancy.h"

#include <algorithm>
#include <limits>

namespace strata {
namespace {

constexpr std::uint32_t unlimited = std::numeric_limits<std::uint32_t>::max();

std::uint32_t over(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }
std::uint32_t rounded_up(std::uint32_t value, std::uint32_t granule) { return over(value, granule) * granule; }

/// Of a file that hands out granules; what takes nothing is not limited.
std::uint32_t fit(std::uint32_t file, std::uint32_t granule, std::uint32_t taken) {
    return taken == 0 || file == 0 ? unlimited : file / rounded_up(taken, granule);
}

/// A wave of twice the lanes takes two of the narrowest wave's registers for one of its own.
std::uint32_t waves_by_registers(const UnitModel& unit, const ShaderResources& shader) {
    const std::uint32_t wider = std::max(1u, shader.wave_lanes / unit.lanes);
    return fit(unit.registers / wider, unit.register_granule / wider, shader.registers);
}

double number(std::uint32_t count) { return count == unlimited ? std::numeric_limits<double>::infinity() : count; }

std::uint32_t groups_by_lds(const UnitModel& unit, const ShaderResources& shader) {
    if (shader.lds_bytes > unit.lds_per_group) return 0;
    return shader.group_threads == 0 ? unlimited : fit(unit.lds_bytes, unit.lds_granule, shader.lds_bytes + unit.lds_reserved);
}

}  // namespace

std::string_view name(OccupancyLimit limit) {
    constexpr std::string_view names[] = {"wave slots", "registers", "scalar registers", "LDS", "group slots"};
    static_assert(std::size(names) == occupancy_limits);
    return names[static_cast<std::size_t>(limit)];
}

Occupancy occupancy(const GpuModel& model, const ShaderResources& shader) {
    const UnitModel& unit = *model.unit;
    Occupancy found;
    found.waves_per_group = std::max(1u, over(shader.group_threads, std::max(1u, shader.wave_lanes)));
    const double waves_of_group = found.waves_per_group, simds = unit.simds;
    const bool takes_slot = shader.group_threads > 0 && found.waves_per_group > unit.waves_without_slot;

    const auto of_groups = [&](std::uint32_t groups) { return number(groups) * waves_of_group / simds; };
    found.alone = {number(unit.wave_slots), number(waves_by_registers(unit, shader)),
                   number(fit(unit.scalar_registers, unit.scalar_granule, shader.scalar_registers)),
                   of_groups(groups_by_lds(unit, shader)), of_groups(takes_slot ? unit.group_slots : unlimited)};
    const auto least = std::ranges::min_element(found.alone);
    found.limit = static_cast<OccupancyLimit>(least - found.alone.begin());
    // A limit that counts groups is a whole number of them up to the rounding of the division above.
    found.groups = static_cast<std::uint32_t>(*least * simds / waves_of_group + 1e-9);
    found.waves_per_simd = found.groups * waves_of_group / simds;
    found.lost_to_whole_groups = std::max(0.0, *least - found.waves_per_simd);
    return found;
}

std::uint32_t stated_by_radv(const GpuModel& model, const ShaderResources& shader) {
    const UnitModel& unit = *model.unit;
    // Slots are counted as if a wave of half the width left room for another, which the hardware does not have.
    const std::uint32_t widest = 64 / std::max(1u, shader.wave_lanes);
    std::uint32_t waves = unit.wave_slots * widest;
    waves = std::min(waves, waves_by_registers(unit, shader));
    waves = std::min(waves, fit(unit.scalar_registers, unit.scalar_granule, shader.scalar_registers));
    if (shader.lds_bytes > 0 && shader.group_threads > 0) {
        const std::uint32_t per_wave =
            rounded_up(shader.lds_bytes, unit.lds_granule) / over(shader.group_threads, shader.wave_lanes);
        waves = std::min(waves, over(unit.lds_bytes / unit.simds, per_wave));
    }
    return waves * (shader.wave_lanes / unit.lanes);
}

}  // namespace strata
