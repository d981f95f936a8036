#include "passes/scene/light_grids.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light_volume.h"

namespace strata {
namespace {

/// With the extent kept: more cells or fewer.
LightVolume rescaled(LightVolume volume, double cell_scale) {
    if (cell_scale != 1) volume.cells = glm::uvec3(glm::ceil(glm::dvec3(volume.cells) / cell_scale));
    return volume;
}

double widest_cell(const LightVolume& volume) {
    const glm::dvec3 size = 2.0 * glm::dvec3(volume.half_extent) / glm::dvec3(volume.cells);
    return std::max({size.x, size.y, size.z});
}

LightGrid local_grid(const LightVolume& volume) {
    const double cell = widest_cell(volume);
    return {.origin = volume.center - .5 * cell * glm::dvec3(volume.cells),
            .cell = cell,
            .cells = volume.cells,
            .occlusion = volume.occlusion,
            .iterations = volume.iterations,
            .is_local = true};
}

/// On a lattice of its own cells that is fixed in the world.
LightGrid cascade(const Frame& frame, const LightVolume& volume, std::uint32_t number) {
    const double cell = widest_cell(volume) * std::exp2(number);
    return {.origin = cell * (glm::floor(frame.view.origin / cell) - glm::dvec3(volume.cells / 2u)),
            .cell = cell,
            .cells = volume.cells,
            .occlusion = volume.occlusion,
            .iterations = volume.iterations};
}

}  // namespace

std::vector<LightGrid> light_grids(const Frame& frame, double cell_scale) {
    std::vector<LightGrid> grids;
    for (const LightVolume& volume : frame.light_volumes)
        if (volume.kind == VolumeKind::fixed_local) grids.push_back(local_grid(rescaled(volume, cell_scale)));
    for (const LightVolume& volume : frame.light_volumes) {
        if (volume.kind != VolumeKind::cascaded_global) continue;
        for (std::uint32_t i = 0; i < volume.cascades; ++i) grids.push_back(cascade(frame, rescaled(volume, cell_scale), i));
    }
    return grids;
}

}  // namespace strata
