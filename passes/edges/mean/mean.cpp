// Edges are pixels whose samples' mean is not the first sample: cheap to write, and wrong both ways.
#include "passes/choice_names.h"
#include "passes/edges/edges.shared.h"
#include "passes/edges/mark.h"
#include "passes/edges/mean/mean.shared.h"
#include "passes/edges/mean/mean_params.h"
#include "passes/edges/views/edge_views.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::edges {

ImageSet mean_model(const StageInput&, const Settings&);

namespace {

constexpr auto choices = choice_names({{compares_first, "gbuffer0"}, {compares_all, "all"}});

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!has_samples(frame)) return;
    sample_words(mark_edges(graph, frame, "edges/mean/mark.comp"), frame).fixes("compares", settings.as<MeanParams>().compares);
}

}  // namespace

Technique mean() {
    return {.stage = Stage::edges,
            .name = "edges/mean",
            .title = "Mean against the first sample",
            .source = "OpenXRay, shaders of the marking pass (behavior only); docs/algorithms/deferred.md 3.2",
            .summary =
                "Marks pixels where the mean of the samples differs from the first sample: misses differences that cancel, and "
                "those in "
                "targets it does not read.",
            .params = {param<&MeanParams::compares>(
                {.name = "compares",
                 .high = compares_all,
                 .fallback = compares_first,
                 .help = "G-buffer targets that are averaged and compared: the first alone, as in X-Ray, or all",
                 .choices = choices})},
            .variants = {"compares=all"},
            .counters = edge_counters(),
            .counter_bytes = sizeof(EdgeCounters),
            .views = edge_views(),
            .tables = edge_tables(),
            .declare = declare,
            .model = mean_model,
            .tolerance = {.rmse = 0, .worst = 0, .because = "sums of four equal floats of 11 bits are exact"}};
}

}  // namespace strata::edges
