#include "passes/indirect/lpv/occlusion/fuzzy_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace strata::indirect::in_double {
namespace {

/// Of a corner of cells: along +x -x +y -y +z -z.
using Blocking = std::array<double, 6>;

/// Cells are centered at the corners of a grid's cells: a volume half a cell beside it.
struct GeometryVolume {
    const Grid& grid;
    glm::uvec3 corners = grid.cells + 1u;
    std::vector<Blocking> blocking = std::vector<Blocking>(std::size_t{corners.x} * corners.y * corners.z);

    explicit GeometryVolume(const Grid& around) : grid(around) {}
    Blocking& at(const glm::uvec3& corner) { return blocking[cell_index(corners, corner)]; }

    void add(const Surfel& surfel) {
        const glm::dvec3 corner = glm::floor(in_cells(grid, surfel.position) + 0.5 + double(cover_shift));
        if (glm::any(glm::lessThan(corner, glm::dvec3(0))) || glm::any(glm::greaterThan(corner, glm::dvec3(grid.cells)))) return;
        const double share = surfel.area / (grid.cell_size * grid.cell_size);
        const glm::dvec4 lobe = cosine_lobe(surfel.normal);
        for (glm::length_t i = 0; i < 6; ++i) {
            const double along = (i % 2 == 0 ? 1 : -1) * lobe[i / 2 + 1];
            at(glm::uvec3(corner))[std::size_t(i)] += share * std::max(0.0, harmonic0 * lobe.x + harmonic1 * along);
        }
    }

    /// Of the face between a cell and its next neighbor.
    double stopped(const glm::uvec3& cell, glm::length_t axis) {
        std::array<double, 2> sums{};
        for (std::uint32_t i = 0; i < 4; ++i) {
            glm::uvec3 corner = cell;
            ++corner[axis];
            corner[(axis + 1) % 3] += i % 2;
            corner[(axis + 2) % 3] += i / 2;
            for (std::size_t way = 0; way < 2; ++way) sums[way] += at(corner)[2 * std::size_t(axis) + way] / 4;
        }
        return std::min(1.0, std::max(sums[0], sums[1]));
    }
};

}  // namespace

Links with_surfels(const Grid& grid, Links links, std::span<const Surfel> surfels) {
    GeometryVolume volume(grid);
    for (const Surfel& surfel : surfels) volume.add(surfel);
    if (links.open.empty()) links.open.assign(cell_count(grid), glm::dvec3(1));
    for (std::uint32_t z = 0; z < grid.cells.z; ++z)
        for (std::uint32_t y = 0; y < grid.cells.y; ++y)
            for (std::uint32_t x = 0; x < grid.cells.x; ++x)
                for (glm::length_t axis = 0; axis < 3; ++axis)
                    links.open[cell_index(grid.cells, {x, y, z})][axis] *= 1 - volume.stopped({x, y, z}, axis);
    return links;
}

}  // namespace strata::indirect::in_double
