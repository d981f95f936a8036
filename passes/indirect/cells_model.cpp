#include "passes/indirect/cells_model.h"

#include <cmath>
#include <numbers>

namespace strata::indirect::in_double {

using std::numbers::pi;
const double harmonic0 = 1 / (2 * std::sqrt(pi)), harmonic1 = std::sqrt(3.0) / (2 * std::sqrt(pi));

glm::dvec4 cosine_lobe(const glm::dvec3& normal) { return {std::sqrt(pi) / 2, std::sqrt(pi / 3) * normal}; }

std::size_t cell_count(const Grid& grid) { return std::size_t{grid.cells.x} * grid.cells.y * grid.cells.z; }

std::size_t cell_index(const glm::uvec3& cells, const glm::uvec3& cell) {
    return (std::size_t{cell.z} * cells.y + cell.y) * cells.x + cell.x;
}

glm::dvec3 in_cells(const Grid& grid, const glm::dvec3& world) { return (world - grid.origin) / grid.cell_size; }

glm::ivec3 cell_at(const Grid& grid, const glm::dvec3& world) {
    // Positions far outside would not fit an int.
    const glm::dvec3 cells(grid.cells);
    return glm::ivec3(glm::clamp(glm::floor(in_cells(grid, world)), glm::dvec3(-1), cells));
}

bool is_inside(const Grid& grid, const glm::ivec3& cell) {
    const glm::ivec3 cells(grid.cells);
    return glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) && glm::all(glm::lessThan(cell, cells));
}

glm::dvec3 cell_middle(const Grid& grid, const glm::ivec3& cell) {
    return grid.origin + grid.cell_size * (glm::dvec3(cell) + 0.5);
}

}  // namespace strata::indirect::in_double
