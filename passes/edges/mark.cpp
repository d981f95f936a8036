#include "passes/edges/mark.h"

#include "passes/edges/edges.shared.h"
#include "passes/frame_images.h"

namespace strata::edges {

bool has_samples(const FrameImages& frame) { return frame.samples > 1 && frame.gbuffer0; }

ComputeStep mark_edges(Graph& graph, FrameImages& frame, std::string shader) {
    frame.edges = graph.create("edges", {.extent = frame.extent, .format = Format::r8ui});
    return graph.compute(std::move(shader)).samples("emission", frame.emission).stores("edges", frame.edges).over(frame.extent);
}

std::vector<Counter> edge_counters() {
    return {counter<&EdgeCounters::plain_pixels>(
                {.name = "plain_pixels", .help = "pixels with a surface that are shaded once for all samples"}),
            counter<&EdgeCounters::edge_pixels>({.name = "edge_pixels", .help = "pixels whose samples are shaded one by one"}),
            counter<&EdgeCounters::sky_pixels>({.name = "sky_pixels", .help = "pixels without a surface in any sample"}),
            counter<&EdgeCounters::edge_samples>(
                {.name = "edge_samples",
                 .help = "samples with a surface in edge pixels; each light shades these, and one sample per plain pixel"})};
}

}  // namespace strata::edges
