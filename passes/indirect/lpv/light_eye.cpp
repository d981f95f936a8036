#include "passes/indirect/lpv/light_eye.h"

#include <algorithm>

#include <glm/glm.hpp>

#include "capture_format/frame/frame.h"
#include "passes/indirect/lpv/kept/middles.h"
#include "passes/scene/draw_bounds.h"
#include "passes/scene/still_view.h"

namespace strata::indirect {
namespace {

/// From here on a float rounds places by a third of what light is moved across borders of cells (receiving_cell.glsl), or by
/// 1/10,000 of a cell.
bool is_far(const LightGrid& grid, const glm::dvec3& eye) {
    const BoundingBox box{grid.origin, grid.origin + grid.cell * glm::dvec3(grid.cells)};
    return !(farthest_distance(box, eye) < std::min(512., 1024 * grid.cell));
}

bool has_unit_axes(const glm::dmat3& m) {
    const glm::dmat3 product = glm::transpose(m) * m;
    for (glm::length_t i = 0; i < 3; ++i)
        if (glm::length(product[i] - glm::dmat3(1)[i]) > 1e-5) return false;
    return true;
}

}  // namespace

LightEye light_eye(const Frame& frame, std::span<const LightGrid> grids, std::span<const LightGrid> linked) {
    const View still = still_view(frame);
    const bool is_still =
        has_unit_axes(frame.view.to_view) &&
        std::ranges::none_of(grids, [&](const LightGrid& grid) { return is_far(grid, still.origin); }) &&
        std::ranges::none_of(linked, [&](const LightGrid& grid) { return has_middle_of_either_side(frame, still.origin, grid); });
    return is_still ? LightEye{still, "Still"} : LightEye{frame.view, ""};
}

}  // namespace strata::indirect
