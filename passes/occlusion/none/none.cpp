
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
// No screen-space occlusion: combine finds no image and multiplies by nothing. Whoever asks for the image gets ones.

namespace strata::occlusion {

ImageSet none_model(const StageInput&, const Settings&);

namespace {

void declare_nothing(Graph&, FrameImages&, const Settings&) {}

/// After all readers, so that none of them finds the image; the graph leaves out the step unless somebody keeps what it makes.
void make_ones(Graph& graph, FrameImages& frame, const Settings&) {
    if (frame.occlusion) return;  // a truth was put in its place
    frame.occlusion = graph.create("occlusion", {.extent = frame.extent, .format = Format::r16f, .layers = frame.samples});
    graph.clear(frame.occlusion, {{1, 1, 1, 1}});
}

}  // namespace

Technique none() {
    return {
        .stage = Stage::occlusion,
        .name = "occlusion/none",
        .title = "No screen-space occlusion",
        .source = "the baseline: ambient light reaches every surface whole",
        .summary =
            "Lets all ambient light through, so that corners are as bright as open ground; costs nothing, and its error is the "
            "whole occlusion.",
        .declare = declare_nothing,
        .at_other_stages = {{.at = Stage::film, .declare = make_ones}},
        .model = none_model,
        .tolerance = {.rmse = 0, .worst = 0, .because = "the image is 1 everywhere, which a half float holds exactly"}};
}

}  // namespace strata::occlusion
