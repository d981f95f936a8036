// G-buffer of 160 bits as it was before it was optimized: position and normal whole, in half floats.
#include "passes/frame_images.h"
#include "passes/gbuffer/fill.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::gbuffer {

ImageSet wide_model(const StageInput&, const Settings&);

namespace {

constexpr Format targets[] = {Format::rgba16f, Format::rgba16f, Format::rgba8_unorm};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    add_fill(graph, frame, {.technique = "gbuffer/wide", .targets = targets}, settings);
}

std::vector<TimeRatio> ratios() {
    return {{.name = "drawing into 160 bits and not 96",
             .of = "",
             .against = "octahedral",
             .steps = {"/fill"},
             .scenario = "city_of_boxes"},
            {.name = "G-buffer of 160 bits and not 96, with its copies by sample",
             .of = "",
             .against = "octahedral",
             .scenario = "city_of_boxes",
             .stages = {Stage::gbuffer}},
            {.name = "lighting and combining that read 160 bits and not 96",
             .of = "",
             .against = "octahedral",
             .scenario = "city_of_boxes",
             .stages = {Stage::lighting, Stage::combine}}};
}

}  // namespace

Technique wide() {
    return {
        .stage = Stage::gbuffer,
        .name = "gbuffer/wide",
        .title = "Position and normal, 160 bits",
        .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, a showcase for Direct3D 10.0/1, GDC 2009",
        .summary =
            "Stores position and normal whole, as half floats: nothing to reconstruct, 1.7 times the memory of a 96-bit layout.",
        .params = fill_params(),
        .variants = {"attributes=sample"},
        .claims = {.ratios = ratios()},
        .declare = declare,
        .model = wide_model,
        .tolerance = {
            .rmse = 1.5e-3,
            .worst = 0.025,
            .because = "a float on a rounding boundary takes the neighboring code: 1/255 on the sRGB curve is 0.02 of a mean of "
                       "0.15; a position moves by at most 0.012 pixel of 0.6, because texels are undecided where the neighboring "
                       "half of one coordinate moves it by 0.004"}};
}

}  // namespace strata::gbuffer
