#include "passes/indirect/lpv/occlusion/fuzzy.h"

#include "passes/frame_images.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/indirect/lpv/surfels/surfels.h"

namespace strata::indirect {

void find_fuzzy_links(Graph& graph, const FrameImages& frame, DeviceGrid& grid) {
    const glm::u64vec3 corners = glm::u64vec3(grid.grid.cells) + std::uint64_t{1};
    Buffer cover = graph.create(grid.name("cover of grid"), corners.x * corners.y * corners.z * 6 * sizeof(std::int32_t));
    graph.clear(cover, 0);
    draw_surfels(graph, frame, grid, "indirect/lpv/occlusion/cover", [&](DrawStep& draw) { draw.updates("Cover", cover); });
    grid.later_links = graph.create(grid.name("fuzzy links of grid"), std::uint64_t{grid.cells()} * 3 * sizeof(float));
    fix_links(graph.compute("indirect/lpv/occlusion/fuzzy.comp"), grid, 0)
        .loads("Cover", cover)
        .stores("FuzzyLinks", grid.later_links)
        .push(grid.place)
        .over(grid.threads());
}

}  // namespace strata::indirect
