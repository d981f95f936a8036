// G-buffer of 96 bits as the X-Ray engine had it later: z of the normal as it is, x with the sign of y.
#include "passes/frame_images.h"
#include "passes/gbuffer/fill.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::gbuffer {

ImageSet z_first_model(const StageInput&, const Settings&);

namespace {

constexpr Format targets[] = {Format::rgba16f, Format::rgba8_unorm};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    add_fill(graph, frame, {.technique = "gbuffer/z_first", .targets = targets}, settings);
}

}  // namespace

Technique z_first() {
    return {
        .stage = Stage::gbuffer,
        .name = "gbuffer/z_first",
        .title = "Clear Sky packing, z first, 96 bits",
        .source = "OpenXRay (xray-16), the later packing of the X-Ray engine",
        .summary =
            "Stores z and x of the normal and rebuilds y: normals of level walls, which a level camera sees most, are off by up "
            "to 1.9 degrees.",
        .params = fill_params(),
        .variants = {"attributes=sample"},
        .declare = declare,
        .model = z_first_model,
        .tolerance = {.rmse = 1.5e-3,
                      .worst = 0.11,
                      .because =
                          "a float on a rounding boundary takes the neighboring half: where y of the normal goes to 0 that "
                          "is up to 0.044 of it (sqrt(2 * 2^-10)), against a root mean square of 0.42 with the background"}};
}

}  // namespace strata::gbuffer
