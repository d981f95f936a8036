#include "passes/indirect/lpv/occlusion/small_portals.h"

#include <algorithm>

#include <fmt/format.h>

#include "passes/indirect/lpv/volumes.h"

namespace strata::indirect {
namespace {

constexpr double ways_in_cell = 8;

double width(const Portal& portal) { return 2 * double(std::min(portal.half_u, portal.half_v)); }

bool is_in(const LightGrid& grid, const glm::dvec3& place) {
    const glm::dvec3 at = (place - grid.origin) / grid.cell;
    return glm::all(glm::greaterThanEqual(at, glm::dvec3(0))) && glm::all(glm::lessThanEqual(at, glm::dvec3(grid.cells)));
}

}  // namespace

std::vector<std::string> notes_on_small_portals(const Frame& frame, std::span<const LightGrid> grids, std::uint32_t occlusion) {
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        const LightGrid& grid = grids[i];
        if (!is_axial(grid, occlusion)) continue;
        const double least = grid.cell / ways_in_cell;
        std::vector<std::size_t> small;
        for (std::size_t k = 0; k < frame.portals.size(); ++k)
            if (const double w = width(frame.portals[k]); w > 0 && w < least && is_in(grid, frame.portals[k].center))
                small.push_back(k);
        if (small.empty()) continue;
        notes.push_back(fmt::format(
            "light grid {}: {} narrower than 1/8 of its cells of {:.3g} m (portal {} is {:.3g} m wide) and may pass no light; "
            "record smaller cells",
            i, small.size() == 1 ? "a portal is" : fmt::format("{} portals are", small.size()), grid.cell, small.front(),
            width(frame.portals[small.front()])));
    }
    return notes;
}

}  // namespace strata::indirect
