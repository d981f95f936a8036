#include "passes/scene/still_view.h"

#include <glm/glm.hpp>

#include "capture_format/frame/frame.h"
#include "passes/scene/light_grids.h"

namespace strata {
namespace {

glm::dvec3 still_place(const LightGrid& grid, const glm::dvec3& eye) {
    if (grid.is_local) return grid.origin + .5 * grid.cell * glm::dvec3(grid.cells);
    const double block = 256 * grid.cell;
    return block * glm::floor(eye / block + .5);
}

}  // namespace

View still_view(const Frame& frame) {
    View view = frame.view;
    const std::vector<LightGrid> grids = light_grids(frame);
    if (grids.empty()) return view;
    view.origin = still_place(grids.front(), frame.view.origin);
    view.to_view = glm::dmat3(1);
    if (glm::determinant(frame.view.to_view) < 0) view.to_view[2][2] = -1;
    return view;
}

}  // namespace strata
