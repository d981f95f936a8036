#include "passes/transparency/distortion/bent_background.h"

#include "capture_format/frame_features.h"
#include "passes/frame_images.h"
#include "passes/transparency/fragment_draw.h"

namespace strata::transparency {

Image undistorted(Graph& graph, const FrameImages& images) {
    if (!images.features->has(Feature::distortion)) return {};
    Image copied = graph.create("undistorted background", graph.shape(images.color));
    graph.copy(images.color, copied);
    return copied;
}

void distort_background(Graph& graph, FrameImages& images) {
    const Image behind = undistorted(graph, images);
    if (!behind) return;
    Image offsets =
        graph.create("distortion", Shape{.extent = images.extent, .format = Format::rgba32f, .samples = images.samples});
    graph.clear(offsets, {});
    draw_fragments(graph, "transparency/distortion/offsets", images.back_to_front, images).composites_gray(offsets);
    const Image layers = by_sample(graph, offsets);
    graph.compute("transparency/distortion/background.comp")
        .updates("color", images.color)
        .samples("behind", behind)
        .samples("offsets", layers)
        .over({images.extent.width, images.extent.height, images.samples});
}

}  // namespace strata::transparency
