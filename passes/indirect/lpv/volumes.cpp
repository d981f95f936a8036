#include "passes/indirect/lpv/volumes.h"

#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/kept/kept.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/scene/scene_facts.h"

namespace strata::indirect {
namespace {

bool is_axial(const LightGrid& grid, std::uint32_t occlusion) {
    if (occlusion == occlusion_recorded) return grid.occlusion == VolumeOcclusion::axial;
    return occlusion == occlusion_axial;
}

void light(Graph& graph, const FrameImages& frame, const LpvParams& params, std::vector<DeviceGrid>& grids) {
    inject_lights(graph, frame, params, grids);
    for (DeviceGrid& grid : grids) propagate(graph, frame, params, grid);
}

}  // namespace

ComputePass gated(ComputePass pass, const DeviceGrid& grid, std::uint32_t gate, Extent threads) {
    return grid.gates ? pass.indirect(grid.gates, gate * sizeof(uvec3)) : pass.over(threads);
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
        made.push_back(g);
    }
    return made;
}

std::vector<DeviceGrid> lit_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    light(graph, frame, params, grids);
    for (DeviceGrid& grid : grids) find_macro_cells(graph, frame, params, grid);
    return grids;
}

std::vector<DeviceGrid> shown_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    if (params.relight == relight_always) return lit_grids(graph, frame, params);
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    KeptGrids kept = recall(graph, frame, params, grids);
    light(graph, frame, params, grids);
    keep(graph, grids, kept);
    for (DeviceGrid& grid : grids) find_macro_cells(graph, frame, params, grid);
    return grids;
}

}  // namespace strata::indirect
