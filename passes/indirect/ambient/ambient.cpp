
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
// No bounced light: the hemisphere, which combine adds itself, is all that surfaces get beside the lights.

namespace strata::indirect {

ImageSet ambient_model(const StageInput&, const Settings&);

namespace {

void declare(Graph& graph, FrameImages& frame, const Settings&) {
    frame.indirect = graph.create("indirect", {.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples});
    graph.clear(frame.indirect, {});
}

}  // namespace

Technique ambient() {
    return {.stage = Stage::indirect,
            .name = "indirect/ambient",
            .title = "Ambient light",
            .source = "the baseline: no light bounces",
            .summary =
                "Adds no bounced light: only sky and ground light what no light source reaches. Its error is all of the bounced "
                "light.",
            .abilities = {.is_time_unit = true},
            .declare = declare,
            .model = ambient_model,
            .tolerance = {.rmse = 0, .worst = 0, .because = "a cleared image is exact"}};
}

}  // namespace strata::indirect
