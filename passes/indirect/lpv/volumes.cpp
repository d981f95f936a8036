#include "passes/indirect/lpv/volumes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/injection/bounce.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/kept/kept.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/scene/readers.h"
#include "passes/scene/scene_facts.h"

namespace strata::indirect {
namespace {

/// As recorded, or as chosen for all grids.
std::uint32_t occlusion_of(const LightGrid& grid, std::uint32_t chosen) {
    if (chosen != occlusion_recorded) return chosen;
    switch (grid.occlusion) {
        case VolumeOcclusion::axial:
            return occlusion_axial;
        case VolumeOcclusion::fuzzy_geometry:
            return occlusion_fuzzy;
        default:
            return occlusion_none;
    }
}

/// The box around a grid in which surfaces may lie that read it: cells are read before surfaces.
BoundingBox box_of_readers(const LpvParams& params, const LightGrid& grid) {
    const double beyond = (double(params.reading) + 1) * grid.cell;
    return {grid.origin - beyond, grid.origin + grid.cell * glm::dvec3(grid.cells) + beyond};
}

std::vector<DeviceGrid> used_grids(Graph& graph, const FrameImages& frame, const LpvParams& params,
                                   std::span<const DeviceGrid> all) {
    std::vector<DeviceGrid> used;
    const auto product_of = [&](std::uint32_t i) {
        return Product{.name = all[i].name("light grid"),
                       .is_used = frame.facts->readers().has_any_in(box_of_readers(params, all[i].grid)),
                       .unused_because = "nothing in view is in it"};
    };
    for (const std::uint32_t i : used_products(graph, frame, all.size(), product_of)) used.push_back(all[i]);
    return used;
}

/// Adds the light of the second bounce.
void bounce_again(Graph& graph, const FrameImages& frame, const LpvParams& params, DeviceGrid& grid) {
    DeviceGrid again = reflected(graph, frame, params, grid);
    propagate(graph, frame, params, again);
    graph.compute("indirect/lpv/propagation/add.comp")
        .loads("More", again.total)
        .updates("Total", grid.total)
        .fixes("cell_storage", grid.storage)
        .fixes("channels", grid.channels)
        .push(grid.place)
        .over(grid.threads());
}

void light(Graph& graph, const FrameImages& frame, const LpvParams& params, std::vector<DeviceGrid>& grids) {
    inject_lights(graph, frame, params, grids);
    for (DeviceGrid& grid : grids) {
        find_macro_cells(graph, frame, params, grid);
        propagate(graph, frame, params, grid);
        if (params.bounces > 1) bounce_again(graph, frame, params, grid);
    }
}

}  // namespace

double cell_scale(const LpvParams& params) { return std::exp2(double(params.cell_scale) - double(cells_recorded)); }

bool is_axial(const LightGrid& grid, std::uint32_t occlusion) {
    const std::uint32_t kind = occlusion_of(grid, occlusion);
    return kind == occlusion_axial || kind == occlusion_both;
}

ComputeStep gated(ComputeStep builder, const DeviceGrid& grid, std::uint32_t gate, Extent threads) {
    return grid.gates ? builder.indirect(grid.gates, gate * sizeof(uvec3)) : builder.over(threads);
}

std::vector<DeviceGrid> make_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    const std::vector<LightGrid> all = light_grids(*frame.recorded, cell_scale(params));
    std::vector<LightGrid> linked;
    if (!frame.recorded->blockers.empty())
        std::ranges::copy_if(all, std::back_inserter(linked),
                             [&](const LightGrid& grid) { return is_axial(grid, params.occlusion); });
    const LightEye eye = light_eye(*frame.recorded, all, linked);
    std::vector<DeviceGrid> made;
    for (const LightGrid& grid : all) {
        const auto seen_from = [&](const View& view) {
            return GridPlace{.origin = glm::vec3(grid.origin - view.origin), .cell = float(grid.cell), .cells = grid.cells};
        };
        const std::uint32_t occlusion = occlusion_of(grid, params.occlusion);
        DeviceGrid g{.grid = grid,
                     .place = seen_from(frame.recorded->view),
                     .lit_place = seen_from(eye.view),
                     .eye = eye,
                     .has_links = is_axial(grid, params.occlusion) && !frame.recorded->blockers.empty(),
                     .is_fuzzy = occlusion == occlusion_fuzzy || occlusion == occlusion_both,
                     .fixed_one = fixed_one(*frame.facts, grid),
                     .number = static_cast<std::uint32_t>(made.size()),
                     .storage = params.cell_storage,
                     .channels = params.self_light == self_facing ? facing_channels : color_channels};
        g.sums = graph.create(g.name("injected light of grid"), g.sums_bytes());
        made.push_back(g);
    }
    return made;
}

std::vector<DeviceGrid> lit_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    light(graph, frame, params, grids);
    return grids;
}

std::vector<DeviceGrid> shown_grids(Graph& graph, const FrameImages& frame, const LpvParams& params) {
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    // What surfaces in pieces do to light is not kept.
    const bool asks_surfels = params.bounces > 1 || std::ranges::any_of(grids, &DeviceGrid::is_fuzzy);
    const bool is_kept = params.relight == relight_changed && !asks_surfels;
    // Light that comes in slices goes on while nothing reads it.
    if (!is_kept || params.slice == 0) grids = used_grids(graph, frame, params, grids);
    KeptGrids kept;
    if (is_kept) kept = recall(graph, frame, params, grids);
    light(graph, frame, params, grids);
    if (is_kept) keep(graph, grids, kept);
    return grids;
}

}  // namespace strata::indirect
