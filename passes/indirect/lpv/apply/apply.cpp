#include "passes/indirect/lpv/apply/apply.h"

#include <ranges>

#include "passes/edges/plain_pixels.h"
#include "passes/gbuffer/surface_at.h"

namespace strata::indirect {
namespace {

/// Cells over which a grid fades at its border.
double border_cells(const LightGrid& grid) { return grid.is_local ? 1 : 2; }

}  // namespace

ComputePass see_light(ComputePass pass, const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid) {
    return sample_gbuffer(fix_blockers(pass, frame), frame)
        .loads("Total", grid.total)
        .fixes("asks_taps", grid.has_links && params.taps == taps_visible ? 1u : 0u)
        .push(ApplyPush{.grid = grid.place, .border = float(border_cells(grid.grid) * grid.grid.cell)});
}

Image apply(Graph& graph, const FrameImages& frame, const LpvParams& params, std::span<const DeviceGrid> grids) {
    Image light = graph.create("indirect", {.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples});
    graph.clear(light, {});
    for (const DeviceGrid& grid : std::views::reverse(grids))
        sample_edges(see_light(graph.compute("indirect/lpv/apply/apply.comp"), frame, params, grid), frame)
            .updates("indirect", light)
            .fixes("irradiance", params.irradiance)
            .over({frame.extent.width, frame.extent.height, frame.samples});
    return light;
}

}  // namespace strata::indirect
