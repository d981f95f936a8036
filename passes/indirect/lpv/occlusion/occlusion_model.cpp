#include "passes/indirect/lpv/occlusion/occlusion_model.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

namespace strata::indirect::in_double {
namespace {

// docs/algorithms/lighting.md 5.6: segments a side of a face; cells that a wall is wide and high; what counts as closed.
constexpr std::uint32_t segments_a_side = 8;
constexpr double wall_cells = 1.5, closed_from = 0.999, stored_steps = 255;

bool is_wall(const Barrier& barrier, double cell_size) {
    return 2 * std::min(barrier.half_extent.x, barrier.half_extent.y) >= wall_cells * cell_size;
}

/// Whether a barrier may meet a segment of the link: their boxes overlap.
bool is_near(const Barrier& barrier, const Segment& middles, double cell_size) {
    const glm::dvec3 reach = glm::abs(barrier.u) * barrier.half_extent.x + glm::abs(barrier.v) * barrier.half_extent.y;
    const glm::dvec3 low = glm::min(middles.from, middles.to), high = glm::max(middles.from, middles.to);
    const glm::dvec3 gap = glm::max(low - (barrier.center + reach), (barrier.center - reach) - high);
    // Half a cell to the edge of the face, and as much again for the slack of rectangles and for rounding.
    return glm::all(glm::lessThan(gap, glm::dvec3(cell_size)));
}

/// What the segments across a face meet, as shares of all.
struct Coverage {
    double stopped = 0;  ///< by any barrier
    double through_holes = 0;
};

Coverage coverage(std::span<const Barrier> near, const Segment& middles, glm::length_t axis, double cell_size) {
    Coverage result;
    const double slack = slack_of(cell_size), share = 1.0 / (segments_a_side * segments_a_side);
    for (std::uint32_t i = 0; i < segments_a_side * segments_a_side; ++i) {
        glm::dvec3 aside(0);
        aside[(axis + 1) % 3] = ((i % segments_a_side + 0.5) / segments_a_side - 0.5) * cell_size;
        aside[(axis + 2) % 3] = ((i / segments_a_side + 0.5) / segments_a_side - 0.5) * cell_size;
        const Segment segment{middles.from + aside, middles.to + aside};
        if (is_blocked(near, segment, slack)) {
            result.stopped += share;
        } else if (std::ranges::any_of(near,
                                       [&](const Barrier& b) { return meets(b, segment, slack) == Meeting::passes_hole; })) {
            result.through_holes += share;
        }
    }
    return result;
}

}  // namespace

double occlusion(const Grid& grid, const glm::uvec3& cell, glm::length_t axis, std::span<const Barrier> all) {
    glm::ivec3 neighbor(cell);
    ++neighbor[axis];
    const Segment middles{cell_middle(grid, glm::ivec3(cell)), cell_middle(grid, neighbor)};
    std::vector<Barrier> near;
    std::ranges::copy_if(all, std::back_inserter(near), [&](const Barrier& b) { return is_near(b, middles, grid.cell_size); });
    if (near.empty()) return 0;
    const Coverage covered = coverage(near, middles, axis, grid.cell_size);
    double occluded = covered.stopped;
    const bool wall_stops_middle = std::ranges::any_of(near, [&](const Barrier& b) {
        return is_wall(b, grid.cell_size) && meets(b, middles, slack_of(grid.cell_size)) == Meeting::is_stopped;
    });
    if (wall_stops_middle) occluded = std::max(occluded, 1 - covered.through_holes);
    return occluded >= closed_from ? 1 : std::round(occluded * stored_steps) / stored_steps;
}

Links links(const Grid& grid, std::span<const Barrier> all) {
    Links result{.cells = grid.cells};
    if (all.empty()) return result;
    result.open.assign(cell_count(grid), glm::dvec3(0));
    tbb::parallel_for(0u, grid.cells.z, [&](std::uint32_t z) {
        for (std::uint32_t y = 0; y < grid.cells.y; ++y)
            for (std::uint32_t x = 0; x < grid.cells.x; ++x)
                for (glm::length_t axis = 0; axis < 3; ++axis)
                    result.open[cell_index(grid.cells, {x, y, z})][axis] = 1 - occlusion(grid, {x, y, z}, axis, all);
    });
    return result;
}

}  // namespace strata::indirect::in_double
