#include "passes/indirect/lpv/views/cell_views.h"

#include <vector>

#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/indirect/lpv/views/views.shared.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/settings.h"

namespace strata::indirect {
namespace {

/// A picture, and the view depth of what it shows at each pixel.
struct DeepPicture {
    Image color, nearest;
};

/// `white`: what light of radiance 1 is in the picture's unit.
DeepPicture backdrop(Graph& graph, const FrameImages& frame, double white) {
    DeepPicture picture{.color = graph.create("volumes' picture", {.extent = frame.extent, .format = Format::rgba32f}),
                        .nearest = graph.create("volumes' nearest", {.extent = frame.extent, .format = Format::r32f})};
    if (frame.gbuffer0) {
        sample_gbuffer(graph.compute("indirect/lpv/views/backdrop.comp"), frame)
            .stores("picture", picture.color)
            .stores("nearest", picture.nearest)
            .fixes("white", float(white))
            .over(frame.extent);
    } else {
        graph.clear(picture.color, {});
        graph.clear(picture.nearest, {{1e30}});
    }
    return picture;
}

/// What the spheres are shaded by: spheres_received or spheres_sent, and the rule of irradiance.
struct Shading {
    std::uint32_t shown = spheres_received, irradiance = irradiance_cell;
};

/// `light` of each grid: as DeviceGrid::total has it.
Image spheres(Graph& graph, const FrameImages& frame, const std::vector<DeviceGrid>& grids, const std::vector<Buffer>& light,
              const Shading& shading) {
    // Of radiance 1 a face of a cell sends as many W/sr as it has square meters.
    const double cell = grids.empty() ? 1 : grids.front().grid.cell;
    DeepPicture picture = backdrop(graph, frame, shading.shown == spheres_sent ? cell * cell : 1);
    if (grids.empty()) return picture.color;
    Buffer places = graph.create("places of grids", grids.size() * sizeof(GridPlace));
    graph.clear(places, 0);
    for (std::size_t i = 0; i < grids.size(); ++i)
        graph.compute("indirect/lpv/views/spheres.comp")
            .loads("Total", light[i])
            .fixes("cell_storage", grids[i].storage)
            .fixes("channels", grids[i].channels)
            .updates("Places", places)
            .updates("picture", picture.color)
            .updates("nearest", picture.nearest)
            .fixes("shown", shading.shown)
            .fixes("irradiance", shading.irradiance)
            .push(SpheresPush{.grid = grids[i].place, .number = static_cast<std::uint32_t>(i)})
            .over(frame.extent);
    return picture.color;
}

}  // namespace

Image cells_view(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    const std::vector<DeviceGrid> grids = lit_grids(graph, frame, params);
    std::vector<Buffer> light;
    for (const DeviceGrid& grid : grids) light.push_back(grid.total);
    return spheres(graph, frame, grids, light, {.shown = spheres_received, .irradiance = params.irradiance});
}

Image injected_view(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    inject_lights(graph, frame, params, grids);
    std::vector<Buffer> light;
    for (DeviceGrid& grid : grids)
        propagate(graph, frame, params, grid, [&](std::uint32_t step, const Buffer&) {
            if (step > 0) return;
            light.push_back(graph.create(grid.name("light of step 0 of grid"), graph.record(grid.total).bytes));
            graph.copy(grid.total, light.back());
        });
    return spheres(graph, frame, grids, light, {.shown = spheres_sent});
}

Image axial_occlusion_view(Graph& graph, FrameImages& frame, const Settings& settings) {
    Image picture = graph.create("axial occlusion", {.extent = frame.extent, .format = Format::rgba32f});
    graph.clear(picture, {});
    if (!frame.gbuffer0) return picture;
    const std::vector<DeviceGrid> grids = lit_grids(graph, frame, settings.as<LpvParams>());
    for (auto grid = grids.rbegin(); grid != grids.rend(); ++grid)
        sample_gbuffer(fix_links(graph.compute("indirect/lpv/views/axial_occlusion.comp"), *grid, 0), frame)
            .updates("picture", picture)
            .push(grid->place)
            .over(frame.extent);
    return picture;
}

}  // namespace strata::indirect
