// Supersampling: every pixel counts as an edge, so every sample is shaded alone.
#include "passes/edges/all_samples/all_samples.shared.h"
#include "passes/edges/views/edge_views.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::edges {

ImageSet all_samples_model(const StageInput&, const Settings&);

namespace {

void declare(Graph& graph, FrameImages& frame, const Settings&) {
    if (frame.samples == 1) return;  // one sample has no edges; the stage may still be forced on
    frame.edges = graph.create("edges", {.extent = frame.extent, .format = Format::r8ui});
    graph.compute("edges/all_samples/mark.comp").stores("edges", frame.edges).over(frame.extent);
}

}  // namespace

Technique all_samples() {
    return {.stage = Stage::edges,
            .name = "edges/all_samples",
            .title = "Every sample",
            .source = "supersampling: the baseline of deferred multisampling",
            .summary = "Marks every pixel, so each sample is shaded alone; misses nothing and costs as many shadings as samples.",
            .counters = {counter<&AllSamplesCounters::edge_pixels>(
                {.name = "edge_pixels", .help = "pixels whose samples are shaded one by one"})},
            .counter_bytes = sizeof(AllSamplesCounters),
            .views = edge_views(),
            .tables = edge_tables(),
            .declare = declare,
            .model = all_samples_model,
            .tolerance = {.rmse = 0, .worst = 0, .because = "the integer 1 everywhere"}};
}

}  // namespace strata::edges
