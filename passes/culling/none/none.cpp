// No culling: every opaque draw is drawn. The baseline that can hide nothing wrongly.
#include "passes/culling/visible_image.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::culling {

ImageSet none_model(const StageInput&, const Settings&);

namespace {

void declare(Graph& graph, FrameImages& frame, const Settings&) {
    frame.opaque = frame.all_opaque;
    frame.visible =
        graph.create("visible", {.extent = {visible_width, visible_rows(frame.all_opaque.count)}, .format = Format::r32ui});
    graph.clear(frame.visible, {{1, 1, 1, 1}});
}

}  // namespace

Technique none() {
    return {.stage = Stage::culling,
            .name = "culling/none",
            .title = "No culling",
            .source = "the baseline: every draw is submitted",
            .summary = "Submits every draw of the frame: never wrong, and draws what is out of sight.",
            .declare = declare,
            .model = none_model,
            .tolerance = {.rmse = 0, .worst = 0, .because = "a cleared integer image is exact"}};
}

}  // namespace strata::culling
