#include "passes/gbuffer/surfaces.h"

#include "passes/frame_images.h"
#include "passes/gbuffer/layout.shared.h"
#include "passes/gbuffer/surface_at.h"

namespace strata::gbuffer {

void add_surfaces(Graph& graph, FrameImages& frame) {
    const Shape shape{.extent = frame.extent, .format = Format::rgba32f, .layers = frame.samples};
    frame.surface_normal = graph.create("surface_normal", shape);
    frame.surface_color = graph.create("surface_color", shape);
    frame.surface_material = graph.create("surface_material", shape);
    sample_gbuffer(graph.compute("gbuffer/surfaces.comp"), frame)
        .stores("surface_normal", frame.surface_normal)
        .stores("surface_color", frame.surface_color)
        .stores("surface_material", frame.surface_material)
        .over({frame.extent.width, frame.extent.height, frame.samples});
}

void read_surfaces(FrameImages& frame) {
    frame.gbuffer0 = frame.surface_normal;
    frame.gbuffer1 = frame.surface_color;
    frame.gbuffer2 = frame.surface_material;
    frame.gbuffer_layout = layout_decoded;
}

}  // namespace strata::gbuffer
