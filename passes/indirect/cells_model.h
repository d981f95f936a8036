// Cells of grids of light, in double: where they lie, and what they hold (docs/algorithms/lighting.md 5.1). A cell holds the
// radiant intensity of each color channel as four coefficients of spherical harmonics: l0 Y0 + Y1 (l1 . w) towards a direction w,
// stored as (l0, l1.x, l1.y, l1.z).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/light_volume.h"

namespace strata::indirect::in_double {

/// 1 / (2 sqrt(pi)) and sqrt(3) / (2 sqrt(pi)): what coefficients are multiplied with.
extern const double harmonic0, harmonic1;
/// Coefficients of max(0, dot(normal, w)): (sqrt(pi) / 2, sqrt(pi / 3) normal).
glm::dvec4 cosine_lobe(const glm::dvec3& normal);

/// A box of cubic cells.
struct Grid {
    glm::uvec3 cells{1};
    double cell_size = 1;                               ///< meters
    glm::dvec3 origin{0};                               ///< corner of cell (0, 0, 0), world
    double fade_cells = 1;                              ///< width of the border over which the next grid takes over
    std::uint32_t iterations = 0;                       ///< as recorded
    VolumeOcclusion occlusion = VolumeOcclusion::none;  ///< as recorded
    bool follows_eye = false;
};

/// One color channel of a grid, by cell_index().
using Channel = std::vector<glm::dvec4>;
/// Red, green and blue of a grid.
using Field = std::array<Channel, 3>;

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
