#include "passes/indirect/lpv/occlusion/small_portals.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/indirect/lpv/volumes.h"

namespace strata::indirect {
namespace {

constexpr double ways_in_cell = 8;

double width(const Portal& portal) { return 2 * double(std::min(portal.half_u, portal.half_v)); }

bool is_in(const LightGrid& grid, const glm::dvec3& place) {
    const glm::dvec3 at = (place - grid.origin) / grid.cell;
    return glm::all(glm::greaterThanEqual(at, glm::dvec3(0))) && glm::all(glm::lessThanEqual(at, glm::dvec3(grid.cells)));
}

using Outline = std::vector<glm::dvec2>;

/// What of a convex outline is above `at` along an axis, or with sign -1 below it.
Outline cut(const Outline& outline, glm::length_t axis, double at, double sign) {
    Outline left;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        const double over_a = sign * (a[axis] - at), over_b = sign * (b[axis] - at);
        if (over_a >= 0) left.push_back(a);
        if ((over_a >= 0) != (over_b >= 0)) left.push_back(glm::mix(a, b, over_a / (over_a - over_b)));
    }
    return left;
}

double area(const Outline& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return std::abs(twice) / 2;
}

/// The most of an outline that lies in one square of a lattice of so many, 1 wide.
double most_in_a_square(const Outline& outline, const glm::dvec2& squares) {
    glm::dvec2 low = outline.front(), high = low;
    for (const glm::dvec2& corner : outline) low = glm::min(low, corner), high = glm::max(high, corner);
    low = glm::max(glm::floor(low), glm::dvec2(0)), high = glm::min(high, squares);
    double most = 0;
    for (double x = low.x; x < high.x; ++x) {
        const Outline column = cut(cut(outline, 0, x, 1), 0, x + 1, -1);
        for (double y = low.y; y < high.y; ++y) most = std::max(most, area(cut(cut(column, 1, y, 1), 1, y + 1, -1)));
    }
    return most;
}

}  // namespace

double opened_share(const LightGrid& grid, const Portal& portal) {
    const glm::dvec3 middle = (portal.center - grid.origin) / grid.cell;
    const glm::dvec3 u = glm::dvec3(portal.u) * (portal.half_u / grid.cell),
                     v = glm::dvec3(portal.v) * (portal.half_v / grid.cell);
    double most = 0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const auto seen = [&](const glm::dvec3& p) { return glm::dvec2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
        const Outline outline{seen(middle - u - v), seen(middle + u - v), seen(middle + u + v), seen(middle - u + v)};
        most = std::max(most, most_in_a_square(outline, seen(glm::dvec3(grid.cells))));
    }
    return most;
}

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
            "light grid {}: {} narrower than 1/8 of its cells of {:.3g} m (portal {} is {:.3g} m wide and opens {:.2g} % of a "
            "cell's face) and may pass no light; record smaller cells",
            i, small.size() == 1 ? "a portal is" : fmt::format("{} portals are", small.size()), grid.cell, small.front(),
            width(frame.portals[small.front()]), 100 * opened_share(grid, frame.portals[small.front()])));
    }
    return notes;
}

}  // namespace strata::indirect
