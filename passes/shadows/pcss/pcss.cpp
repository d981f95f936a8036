// Percentage-closer soft shadows: the maps of the stage, looked up by a kernel as wide as the penumbra where a light asks for it.
#include "passes/frame_images.h"
#include "passes/shadows/filter.h"
#include "passes/shadows/shadows.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::shadows {

ImageSet pcss_model(const StageInput&, const Settings&);

namespace {

constexpr std::string_view noises[] = {"none", "pixel"};

void filter_maps(Graph& graph, FrameImages& frame, const Settings&) {
    filter_shadow_maps(graph, frame, "shadows/pcss/filter.comp");
}

std::vector<Param> params() {
    std::vector<Param> rows = shadow_map_params();
    rows.push_back(param<&ShadowFilter::search_taps>(
        {.name = "search_taps",
         .low = 1,
         .high = 64,
         .fallback = 16,
         .help = "shadow map taps that search for blockers; more: fewer thin blockers are missed, in proportion to time"}));
    rows.push_back(param<&ShadowFilter::filter_taps>(
        {.name = "filter_taps",
         .low = 1,
         .high = 64,
         .fallback = 32,
         .help = "bilinear comparisons over the penumbra; more: smoother, in proportion to time"}));
    rows.push_back(param<&ShadowFilter::noise>(
        {.name = "noise",
         .low = 0,
         .high = 1,
         .fallback = 0,
         .help = "rotation of the taps; pixel: by a different angle in each pixel, grain instead of bands",
         .choices = noises}));
    return rows;
}

}  // namespace

Technique pcss() {
    return {
        .stage = Stage::shadows,
        .name = "shadows/pcss",
        .title = "Percentage-closer soft shadows",
        .source = "Fernando: Percentage-Closer Soft Shadows, SIGGRAPH 2005; taps of Vogel 1979",
        .summary =
            "Searches a map for what blocks a light and filters as widely as its mean distance says; blockers at several "
            "distances share one penumbra, thin ones slip through the search, and light leaks behind the first blocker.",
        .params = params(),
        .variants = {"search_taps=8 filter_taps=16", "search_taps=32 filter_taps=64"},
        .counters = shadow_map_counters(),
        .counter_bytes = sizeof(ShadowCounters),
        .views = shadow_map_views(),
        .tables = shadow_map_tables(),
        .declare = make_shadow_maps,
        .at_other_stages = {{.at = Stage::occlusion, .declare = filter_maps}},
        .model = pcss_model,
        .tolerance = {.rmse = 3e-4,
                      .worst = 0.01,
                      .because = "fractions of a texel are cut to 1/256 after float arithmetic, which moves each of the taps by "
                                 "one step, and 16-bit floats round by 2^-11; comparisons and searches that float may turn are "
                                 "undecided"}};
}

}  // namespace strata::shadows
