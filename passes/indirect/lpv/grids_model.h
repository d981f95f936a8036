// Where the grids of light propagation volumes lie, in double (docs/algorithms/lighting.md 5.7): a fixed local volume is one grid
// around its center, a cascaded global volume one grid per cascade around the eye. All in world space, along the world's axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame.h"

namespace strata::indirect::in_double {

/// A box of cubic cells.
struct Grid {
    glm::uvec3 cells{1};
    double cell_size = 1;                               ///< metres
    glm::dvec3 origin{0};                               ///< corner of cell (0, 0, 0), world
    double fade_cells = 1;                              ///< width of the border over which the next grid takes over
    std::uint32_t iterations = 0;                       ///< as recorded
    VolumeOcclusion occlusion = VolumeOcclusion::none;  ///< as recorded
};

/// Local volumes in the order of the frame, then the cascades of global volumes, finest first.
/// Cells so many times as wide as recorded, in the recorded extent.
std::vector<Grid> grids(const Frame&, double cell_scale = 1);

std::size_t cell_count(const Grid&);
/// Position of a cell in arrays: (z ny + y) nx + x.
std::size_t cell_index(const glm::uvec3& cells, const glm::uvec3& cell);
/// In cells from the origin: (0.5, 0.5, 0.5) is the middle of the first cell.
glm::dvec3 in_cells(const Grid&, const glm::dvec3& world);
/// A cell that may lie outside the grid.
glm::ivec3 cell_at(const Grid&, const glm::dvec3& world);
bool is_inside(const Grid&, const glm::ivec3& cell);
/// The middle of a cell, world.
glm::dvec3 cell_middle(const Grid&, const glm::ivec3& cell);

}  // namespace strata::indirect::in_double
