#include "passes/indirect/lpv/views/surface_views.h"

#include <string>
#include <utility>
#include <vector>

#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/settings.h"

namespace strata::indirect {
namespace {

Image black_picture(Graph& graph, const FrameImages& frame, std::string name) {
    Image picture = graph.create(std::move(name), {.extent = frame.extent, .format = Format::rgba32f});
    graph.clear(picture, {});
    return picture;
}

/// A shader over every pixel for each grid, the first grid last: it lies over what others gave.
Image of_seen_light(Graph& graph, const FrameImages& frame, const Settings& settings, const std::string& shader) {
    const auto params = settings.as<LpvParams>();
    const std::vector<DeviceGrid> grids = lit_grids(graph, frame, params);
    Image picture = black_picture(graph, frame, shader);
    for (auto grid = grids.rbegin(); grid != grids.rend(); ++grid)
        see_light(graph.compute("indirect/lpv/views/" + shader + ".comp"), frame, params, *grid)
            .stores("picture", picture)
            .over(frame.extent);
    return picture;
}

}  // namespace

Image visible_taps(Graph& graph, FrameImages& frame, const Settings& settings) {
    return of_seen_light(graph, frame, settings, "visible_taps");
}

Image near_blockers(Graph& graph, FrameImages& frame, const Settings& settings) {
    return of_seen_light(graph, frame, settings, "near_blockers");
}

Image lighting_volume(Graph& graph, FrameImages& frame, const Settings& settings) {
    const std::vector<DeviceGrid> grids = make_grids(graph, frame, settings.as<LpvParams>());
    Image picture = black_picture(graph, frame, "lighting volume");
    for (auto grid = grids.rbegin(); grid != grids.rend(); ++grid)
        sample_gbuffer(graph.compute("indirect/lpv/views/lighting_volume.comp"), frame)
            .updates("picture", picture)
            .push(apply_push(*grid))
            .over(frame.extent);
    return picture;
}

}  // namespace strata::indirect
