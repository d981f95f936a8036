#include "passes/transparency/layers_beyond.h"

#include "passes/frame_images.h"
#include "passes/transparency/fragment_draw.h"

namespace strata {

Image layers_beyond(Graph& graph, const FrameImages& images, std::uint32_t kept, const std::string& name) {
    Image layers =
        graph.create(name + " counts", Shape{.extent = images.extent, .format = Format::r32ui, .layers = images.samples});
    Image picture = graph.create(name, Shape{.extent = images.extent, .format = Format::rgba32f});
    graph.clear(layers, {});
    draw_fragments(graph, "transparency/count_layers", images.transparent, images).updates("layers", layers);
    graph.compute("transparency/layers_beyond.comp")
        .loads("layers", layers)
        .stores("picture", picture)
        .push(kept)
        .over(images.extent);
    return picture;
}

}  // namespace strata
