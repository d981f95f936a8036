// G-buffer of 96 bits: octahedral coordinates and view depth as half floats.
#include "passes/frame_images.h"
#include "passes/gbuffer/fill.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::gbuffer {

ImageSet oct_half_model(const StageInput&, const Settings&);

namespace {

constexpr Format targets[] = {Format::rgba16f, Format::rgba8_unorm};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    add_fill(graph, frame, {.technique = "gbuffer/oct_half", .targets = targets}, settings);
}

}  // namespace

Technique oct_half() {
    return {
        .stage = Stage::gbuffer,
        .name = "gbuffer/oct_half",
        .title = "Octahedral halves, 96 bits",
        .source = "Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014",
        .summary =
            "Stores octahedral normals in two half floats: off by at most 0.06 degrees in any direction; depth by 1/2048 of "
            "itself.",
        .params = fill_params(),
        .variants = {"attributes=sample"},
        .declare = declare,
        .model = oct_half_model,
        .tolerance = {.rmse = 1.5e-3,
                      .worst = 0.018,
                      .because =
                          "a float on a rounding boundary may become the neighboring half, 2^-11 of it away; colors as in 8 bits "
                          "sRGB, 0.0087 linear"}};
}

}  // namespace strata::gbuffer
