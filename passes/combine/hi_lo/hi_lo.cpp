// Combine and develop: linear color per sample at `combine`, display light at `film`, after everything was drawn over it.
#include "passes/edges/plain_pixels.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/technique.h"

namespace strata::combine {

ImageSet hi_lo_model(const StageInput&, const Settings&);

namespace {

void add_color(Graph& graph, FrameImages& frame, const Settings&) {
    frame.color = graph.create("color", {.extent = frame.extent, .format = Format::rgba32f, .layers = frame.samples});
    // Where nothing opaque is drawn there is a background alone, and nothing to read.
    const bool has_surfaces = frame.emission && frame.all_opaque.count > 0;
    const FrameImages read = has_surfaces ? frame : FrameImages{};
    sample_edges(sample_gbuffer(graph.compute("combine/hi_lo/combine.comp"), read), read)
        .samples("emission", read.emission)
        .samples("light", read.light)
        .samples("occlusion", read.occlusion)
        .samples("indirect", read.indirect)
        .stores("color", frame.color)
        .fixes("has_surfaces", has_surfaces ? 1u : 0u)
        .fixes("has_light", read.light ? 1u : 0u)
        .fixes("has_occlusion", read.occlusion ? 1u : 0u)
        .fixes("has_indirect", read.indirect ? 1u : 0u)
        .over({frame.extent.width, frame.extent.height, frame.samples});
}

void add_display(Graph& graph, FrameImages& frame, const Settings&) {
    frame.display = graph.create("display", {.extent = frame.extent, .format = Format::rgba16f});
    graph.compute("combine/hi_lo/film.comp").samples("color", frame.color).stores("display", frame.display).over(frame.extent);
}

}  // namespace

Technique hi_lo() {
    return {.stage = Stage::combine,
            .name = "combine/hi_lo",
            .title = "Hemisphere light, fog, tone curve per sample",
            .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009",
            .summary =
                "Adds emission, light and hemisphere light, applies fog, tone maps every sample and averages; per channel, so "
                "that bright saturated colors turn white.",
            .abilities = {.is_time_unit = true},
            .declare = add_color,
            .at_other_stages = {{.at = Stage::film, .declare = add_display}},
            .model = hi_lo_model,
            .tolerance = {
                .rmse = 1e-3,
                .worst = 2e-3,
                .because = "display light is stored as half floats of undefined rounding, 2^-10 of itself; color is float"}};
}

}  // namespace strata::combine
