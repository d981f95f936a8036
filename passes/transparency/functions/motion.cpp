#include "passes/transparency/functions/motion.h"

#include "passes/scene/material_uses.h"
#include "passes/transparency/fragment_draw.h"

namespace strata::transparency {
namespace {

/// By sample.
Image opaque_motion(Graph& graph, const FrameImages& images) {
    Image motion = graph.create("motion of what is opaque",
                                Shape{.extent = images.extent, .format = Format::rg32f, .samples = images.samples});
    graph.clear(motion, {});
    if (images.opaque.count > 0) {
        DrawStep draw = graph.draw("transparency/functions/opaque_motion", images.opaque);
        fix_materials(draw, images, Surfaces::opaque).tests_depth(images.depth).covers(motion);
    }
    return by_sample(graph, motion);
}

}  // namespace

Image motion_view(Graph& graph, const FrameImages& images, const FunctionSums& sums) {
    Image picture = graph.create("motion view", Shape{.extent = images.extent, .format = Format::rgba32f});
    const Image behind = opaque_motion(graph, images);
    const FunctionSums read = by_sample(graph, sums);
    over_sums(graph, "transparency/functions/motion.comp", images, read)
        .samples("offset", read.full.offset)
        .samples("low_offset", read.low.offset)
        .samples("motion_behind", behind)
        .stores("picture", picture)
        .over(images.extent);
    return picture;
}

DebugView motion_row(Image (*declare)(Graph&, FrameImages&, const Settings&)) {
    return {.name = "motion",
            .help =
                "screen motion since the previous frame without that of the camera; red: to the right; green: down; alpha: "
                "weight of the background",
            .unit = "pixels",
            .low = 0,
            .high = 16,
            .declare = declare,
            .channels = {"to the right", "down"},
            .if_zero = "nothing has moved"};
}

}  // namespace strata::transparency
