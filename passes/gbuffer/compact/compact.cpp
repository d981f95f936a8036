// G-buffer of 64 bits beside the depth buffer, which depth is read from.
#include "passes/frame_images.h"
#include "passes/gbuffer/fill.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::gbuffer {

ImageSet compact_model(const StageInput&, const Settings&);

namespace {

constexpr Format targets[] = {Format::rgba8_unorm, Format::rgba8_unorm};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    add_fill(graph, frame, {.technique = "gbuffer/compact", .targets = targets, .depth = DepthFrom::depth_buffer}, settings);
}

}  // namespace

Technique compact() {
    return {.stage = Stage::gbuffer,
            .name = "gbuffer/compact",
            .title = "Compact, 64 bits",
            .source = "Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014",
            .summary =
                "Stores normals in 2 x 10 bits (off by up to 0.24 degrees) and one of four materials: unlit, dielectric, metal, "
                "hair.",
            .params = fill_params(),
            .variants = {"attributes=sample"},
            .declare = declare,
            .model = compact_model,
            .tolerance = {.rmse = 1.5e-3,
                          .worst = 0.018,
                          .because = "a float on a rounding boundary takes the neighboring code: 1/511 of the octahedron is "
                                     "0.004 of a normal, 1/255 on the sRGB curve 0.0087 linear"}};
}

}  // namespace strata::gbuffer
