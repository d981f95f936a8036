#include "passes/gbuffer/surfaces.h"

namespace strata::gbuffer {

void add_surfaces(Graph& graph, FrameImages& frame) {
    const Shape shape{.extent = frame.extent, .format = Format::rgba32f, .layers = frame.samples};
    frame.surface_normal = graph.create("surface_normal", shape);
    frame.surface_color = graph.create("surface_color", shape);
    frame.surface_material = graph.create("surface_material", shape);
    graph.compute("gbuffer/surfaces.comp")
        .samples("gbuffer0", frame.gbuffer0)
        .samples("gbuffer1", frame.gbuffer1)
        .samples("gbuffer2", frame.gbuffer2)
        .stores("surface_normal", frame.surface_normal)
        .stores("surface_color", frame.surface_color)
        .stores("surface_material", frame.surface_material)
        .fixes("gbuffer_layout", frame.gbuffer_layout)
        .over({frame.extent.width, frame.extent.height, frame.samples});
}

}  // namespace strata::gbuffer
