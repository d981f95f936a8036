// How deep the lists are.
#include "passes/technique.h"
#include "passes/transparency/sorted_lists/sorted_lists.shared.h"

namespace strata::transparency {

Image sorted_lists_layers_view(Graph& graph, FrameImages& images, const Settings&) {
    const Band frame{0, images.extent.height, images.extent.width, images.samples, 0};
    Buffer counts =
        graph.create("sorted_lists layers", std::uint64_t{frame.rows} * frame.width * frame.samples * sizeof(std::uint32_t));
    Image picture = graph.create("sorted_lists layers view", Shape{.extent = images.extent, .format = Format::rgba32f});
    graph.clear(counts, 0);
    graph.draw("transparency/sorted_lists/count", images.transparent)
        .tests_depth(images.depth)
        .updates("Counts", counts)
        .push(frame);
    graph.compute("transparency/sorted_lists/layers.comp")
        .loads("Counts", counts)
        .stores("picture", picture)
        .push(frame)
        .over(images.extent);
    return picture;
}

}  // namespace strata::transparency
