#include "passes/indirect/lpv/volumes.h"

#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/scene/scene_facts.h"

namespace strata::indirect {

bool is_axial(const LightGrid& grid, std::uint32_t occlusion) {
    if (occlusion == occlusion_recorded) return grid.occlusion == VolumeOcclusion::axial;
    return occlusion == occlusion_axial;
}

ComputePass fix_blockers(ComputePass pass, const FrameImages& frame) {
    return pass.fixes("blocker_count", static_cast<std::uint32_t>(frame.recorded->blockers.size()))
        .fixes("portal_count", static_cast<std::uint32_t>(frame.recorded->portals.size()));
}

std::vector<DeviceGrid> make_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> made;
    for (const LightGrid& grid : light_grids(*frame.recorded)) {
        const glm::dvec3 origin = grid.origin - frame.recorded->view.origin;
        DeviceGrid g{.grid = grid,
                     .place = {.origin = glm::vec3(origin), .cell = float(grid.cell), .cells = grid.cells},
                     .has_links = is_axial(grid, params.occlusion) && !frame.recorded->blockers.empty(),
                     .fixed_one = fixed_one(*frame.facts, grid),
                     .number = made.size()};
        g.sums = graph.create(g.name("injected light of grid"), std::uint64_t{g.cells()} * sizeof(LightCell));
        graph.clear(g.sums, 0);
        made.push_back(g);
    }
    return made;
}

std::vector<DeviceGrid> lit_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    inject_lights(graph, frame, params, grids);
    for (DeviceGrid& grid : grids) propagate(graph, frame, params, grid);
    return grids;
}

}  // namespace strata::indirect
