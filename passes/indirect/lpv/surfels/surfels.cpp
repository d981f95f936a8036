#include "passes/indirect/lpv/surfels/surfels.h"

#include "passes/frame_images.h"
#include "passes/scene/material_uses.h"

namespace strata::indirect {

void draw_surfels(Graph& graph, const FrameImages& frame, const DeviceGrid& grid, const std::string& shader,
                  const std::function<void(DrawStep&)>& finish) {
    const glm::uvec3 texels = (grid.grid.cells + 2 * surfel_margin) * surfels_a_side;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const glm::length_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        DrawStep draw = graph.draw(shader, frame.all_opaque);
        fix_materials(draw, frame, Surfaces::opaque)
            .within({texels[u], texels[v]})
            .takes_first(grid.eye.records)
            .push(SurfelPush{.grid = grid.lit_place, .axis = axis});
        finish(draw);
    }
}

}  // namespace strata::indirect
