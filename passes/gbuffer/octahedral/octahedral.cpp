// G-buffer of 96 bits: octahedral normal, log depth and material as integer codes in half-float channels.
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/fill_coverage.h"
#include "passes/gbuffer/fill.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::gbuffer {

ImageSet octahedral_model(const StageInput&, const Settings&);

namespace {

constexpr Format targets[] = {Format::rgba16f, Format::rgba8_unorm};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    add_fill(graph, frame, {.technique = "gbuffer/octahedral", .targets = targets}, settings);
}

}  // namespace

Technique octahedral() {
    return {
        .stage = Stage::gbuffer,
        .name = "gbuffer/octahedral",
        .title = "Octahedral codes, 96 bits",
        .source = "Cigolle et al.: A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014",
        .summary =
            "Stores normals (to 0.004 degrees) and depth (to 1e-4 of itself) as integer codes in half floats, which rounding "
            "cannot change; no channel can be filtered or blended.",
        .params = fill_params(),
        .variants = {"attributes=sample", "masked=per_sample", "masked=unbiased", "masked=mip_coverage"},
        .abilities = {.is_time_unit = true},
        .claims = {.ratios = coverage_ratios()},
        .declare = declare,
        .model = octahedral_model,
        .tolerance = {.rmse = 1.5e-3,
                      .worst = 0.018,
                      .because = "a float on a rounding boundary takes the neighboring code: 1/255 on the sRGB curve is 0.0087 "
                                 "linear, 1/57 of metallic 0.018; emission is rounded to half floats (5e-4 to 1e-3)"}};
}

}  // namespace strata::gbuffer
