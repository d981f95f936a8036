// G-buffer of 80 bits beside the depth buffer, which depth is read from.
#include "passes/frame_images.h"
#include "passes/gbuffer/fill.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::gbuffer {

ImageSet depth_rebuilt_model(const StageInput&, const Settings&);

namespace {

constexpr Format targets[] = {Format::rgba8_unorm, Format::rgba8_unorm, Format::r16f};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    add_fill(graph, frame, {.technique = "gbuffer/depth_rebuilt", .targets = targets, .depth = DepthFrom::depth_buffer},
             settings);
}

}  // namespace

Technique depth_rebuilt() {
    return {
        .stage = Stage::gbuffer,
        .name = "gbuffer/depth_rebuilt",
        .title = "Rebuilt depth, 80 bits",
        .source = "Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014",
        .summary =
            "Reads depth from the depth buffer, exact at every sample; stores octahedral normals in 2 x 16 bits, off by at most "
            "0.004 degrees.",
        .params = fill_params(),
        .variants = {"attributes=sample"},
        .declare = declare,
        .model = depth_rebuilt_model,
        .tolerance = {.rmse = 1.5e-3,
                      .worst = 0.018,
                      .because = "a float on a rounding boundary takes the neighboring code: 1/255 on the sRGB curve is "
                                 "0.0087 linear, 1/57 of metallic 0.018"}};
}

}  // namespace strata::gbuffer
