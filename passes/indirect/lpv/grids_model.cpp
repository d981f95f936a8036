#include "passes/indirect/lpv/grids_model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light_volume.h"

namespace strata::indirect::in_double {
namespace {

// Widths of the fading borders in cells: docs/algorithms/lighting.md 5.7, "Blend between cascades" and "Local volume".
constexpr double local_fade = 1, cascade_fade = 2;

double finest_cell(const LightVolume& volume) {
    const glm::dvec3 sizes = 2.0 * glm::dvec3(volume.half_extent) / glm::dvec3(volume.cells);
    return std::max({sizes.x, sizes.y, sizes.z});
}

/// As many cells as it takes to fill the volume; one that would stick out by less than a whole cell is needed, too.
glm::uvec3 filling_cells(const glm::uvec3& recorded, double cell_scale) {
    glm::uvec3 cells;
    for (glm::length_t i = 0; i < 3; ++i) cells[i] = std::uint32_t(std::ceil(recorded[i] / cell_scale));
    return cells;
}

Grid local_grid(const LightVolume& volume) {
    const double size = finest_cell(volume);
    return {.cells = volume.cells,
            .cell_size = size,
            .origin = volume.center - size * glm::dvec3(volume.cells) / 2.0,
            .fade_cells = local_fade,
            .iterations = volume.iterations,
            .occlusion = volume.occlusion};
}

/// Snapped to whole cells, so that the grid does not move against the world while the eye moves within a cell.
Grid cascade_grid(const LightVolume& volume, std::uint32_t cascade, const glm::dvec3& eye) {
    const double size = std::ldexp(finest_cell(volume), static_cast<int>(cascade));
    return {.cells = volume.cells,
            .cell_size = size,
            .origin = size * (glm::floor(eye / size) - glm::dvec3(volume.cells / 2u)),
            .fade_cells = cascade_fade,
            .iterations = volume.iterations,
            .occlusion = volume.occlusion,
            .follows_eye = true};
}

}  // namespace

std::vector<Grid> grids(const Frame& frame, double cell_scale) {
    std::vector<Grid> result;
    std::vector<LightVolume> volumes = frame.light_volumes;
    for (LightVolume& volume : volumes) volume.cells = filling_cells(volume.cells, cell_scale);
    for (const LightVolume& volume : volumes)
        if (volume.kind == VolumeKind::fixed_local) result.push_back(local_grid(volume));
    for (const LightVolume& volume : volumes) {
        if (volume.kind != VolumeKind::cascaded_global) continue;
        for (std::uint32_t k = 0; k < volume.cascades; ++k) result.push_back(cascade_grid(volume, k, frame.view.origin));
    }
    return result;
}

}  // namespace strata::indirect::in_double
