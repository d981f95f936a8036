// Edges are pixels whose samples do not all hold the same words.
#include "passes/edges/edges.shared.h"
#include "passes/edges/mark.h"
#include "passes/edges/routing/ratios.h"
#include "passes/edges/views/edge_views.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/layout.shared.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::edges {

ImageSet bitwise_model(const StageInput&, const Settings&);

namespace {

void declare(Graph& graph, FrameImages& frame, const Settings&) {
    if (has_samples(frame)) sample_words(mark_edges(graph, frame, "edges/bitwise/mark.comp"), frame);
}

/// Where equal words lie at different places.
std::vector<std::string> notes(const FrameImages& frame, const Settings&) {
    if (!has_samples(frame) || (frame.gbuffer_layout & gbuffer::layout_reads_depth) == 0) return {};
    return {
        "edges/bitwise: this G-buffer takes depth from the depth buffer, which words do not hold; plain pixels are shaded at the "
        "place of their first sample, and silhouettes between surfaces of equal words are not marked"};
}

}  // namespace

Technique bitwise() {
    return {.stage = Stage::edges,
            .name = "edges/bitwise",
            .title = "G-buffer words that differ",
            .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009 (shading per sample at edges)",
            .summary = "Compares every word of the G-buffer bit by bit: exact, but also marks differences too small to see.",
            .counters = edge_counters(),
            .counter_bytes = sizeof(EdgeCounters),
            .views = edge_views(),
            .tables = edge_tables(),
            .abilities = {.stands_in_for_truth = true},
            .claims = {.ratios = shading_ratios()},
            .declare = declare,
            .model = bitwise_model,
            .tolerance = {.rmse = 0, .worst = 0, .because = "bits are equal or not"},
            .notes = notes};
}

}  // namespace strata::edges
