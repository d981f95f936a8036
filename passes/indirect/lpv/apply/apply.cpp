#include "passes/indirect/lpv/apply/apply.h"

#include <ranges>

#include "passes/edges/plain_pixels.h"
#include "passes/gbuffer/surface_at.h"

namespace strata::indirect {
namespace {

/// Metres over which a grid fades at its border: a cell, of cascades two.
float border(const LightGrid& grid) { return float((grid.is_local ? 1 : 2) * grid.cell); }

std::uint32_t asks_taps(const LpvParams& params, const DeviceGrid& grid) {
    return grid.has_links && params.taps == taps_visible ? 1 : 0;
}

/// Of records that are texels_per_record texels each.
Extent volume_extent(std::uint32_t records) {
    return {volume_texels_per_row, (texels_per_record * records + volume_texels_per_row - 1) / volume_texels_per_row};
}

}  // namespace

ComputePass see_light(ComputePass pass, const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid) {
    return sample_gbuffer(fix_blockers(pass, frame), frame)
        .loads("Total", grid.total)
        .fixes("asks_taps", asks_taps(params, grid))
        .push(ApplyPush{.grid = grid.place, .border = border(grid.grid)});
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

void hand_on(Graph& graph, FrameImages& frame, const LpvParams& params, std::span<const DeviceGrid> grids) {
    const auto count = static_cast<std::uint32_t>(grids.size());
    if (count == 0) return;
    std::uint32_t records = count;
    for (const DeviceGrid& grid : grids) records += grid.cells();
    frame.light_grids = count;
    frame.light_grid_rule = params.irradiance;
    frame.volume_light = graph.create("volume_light", {.extent = volume_extent(records), .format = Format::rgba32f});
    graph.clear(frame.volume_light, {});
    std::uint32_t first_cell = count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DeviceGrid& grid = grids[i];
        graph.compute("indirect/lpv/apply/hand_on.comp")
            .loads("Total", grid.total)
            .updates("volume_light", frame.volume_light)
            .push(HandOnPush{.grid = grid.place,
                             .border = border(grid.grid),
                             .asks_taps = asks_taps(params, grid),
                             .irradiance = params.irradiance,
                             .number = i,
                             .count = count,
                             .first_cell = first_cell})
            .over(grid.threads());
        first_cell += grid.cells();
    }
}

}  // namespace strata::indirect
