#include "passes/edges/routing/shade_samples.h"

#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"

namespace strata::edges {
namespace {

struct EdgeList {
    Image pixels;
    Buffer dispatch;
};

EdgeList list_edges(Graph& graph, const FrameImages& frame) {
    const Extent extent{frame.extent.width, frame.extent.height + 1};
    EdgeList list{.pixels = graph.create("list of edges", {.extent = extent, .format = Format::r32ui}),
                  .dispatch = graph.create("dispatch over edges", sizeof(EdgeDispatch))};
    graph.clear(list.dispatch, 0);
    sample_edges(graph.compute("edges/routing/list.comp"), frame)
        .stores("edge_list", list.pixels)
        .updates("Dispatch", list.dispatch)
        .over(frame.extent);
    graph.compute("edges/routing/arguments.comp")
        .updates("edge_list", list.pixels)
        .updates("Dispatch", list.dispatch)
        .fixes("further_samples", frame.samples - 1)
        .groups({1, 1, 1});
    return list;
}

ComputeStep routed(ComputeStep builder, const FrameImages& frame, const Image& list, std::uint32_t threads) {
    return sample_edges(builder, frame).samples("edge_list", list).fixes("threads_of", threads);
}

}  // namespace

void shade_samples(Graph& graph, const FrameImages& frame, std::uint32_t routing, const Shaded& shaded,
                   const std::function<ComputeStep()>& step) {
    const Extent pixels = frame.extent;
    if (routing == routing_threads || !frame.edges) {
        routed(step(), frame, {}, threads_of_samples)
            .stores(shaded.name, shaded.image)
            .over({pixels.width, pixels.height, frame.samples});
        return;
    }
    const EdgeList list = list_edges(graph, frame);
    routed(step(), frame, {}, threads_of_pixels).stores(shaded.name, shaded.image).over(pixels);
    routed(step(), frame, list.pixels, threads_of_list).updates(shaded.name, shaded.image).indirect(list.dispatch);
}

}  // namespace strata::edges
