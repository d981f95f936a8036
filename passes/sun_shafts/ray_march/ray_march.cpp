// Sun shafts by a march along every ray, with a lookup of the shadow map at each step.
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/sun_shafts/march.h"
#include "passes/technique.h"

namespace strata::sun_shafts {

ImageSet ray_march_model(const StageInput&, const Settings&);

namespace {

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (has_shafts(frame)) march_shafts(graph, frame, settings, {.name = "sun_shafts/ray_march/march.comp"});
}

}  // namespace

Technique ray_march() {
    return {
        .stage = Stage::sun_shafts,
        .name = "sun_shafts/ray_march",
        .title = "Marched sun shafts",
        .source =
            "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009; constants of X-Ray: "
            "docs/algorithms/deferred.md 6.2",
        .summary =
            "Sums over steps of the view ray what the sun's shadow maps leave lit; shadows thinner than a step become noise, and "
            "the maps' texels show as steps along the beams.",
        .params = march_params(),
        .variants = {"shaft_steps=8", "shaft_steps=16", "shaft_steps=64", "shaft_steps=128", "shaft_taps=1", "shaft_jitter=none",
                     "shaft_jitter=hash", "shaft_blur=off", "shaft_jitter=interleaved_gradient shaft_blur=off",
                     "shaft_resolution=half", "shaft_extinction=sampled", "shaft_cascade=last",
                     "shaft_stepping=xray shaft_steps=20 shaft_extinction=sampled",
                     "shaft_stepping=xray shaft_steps=20 shaft_normalization=steps",
                     "shaft_phase=henyey_greenstein shaft_asymmetry=0.8"},
        .counters = march_counters(),
        .counter_bytes = sizeof(MarchCounters),
        .views = march_views(),
        .abilities = {.is_time_unit = true},
        .claims = {.ratios = {{.name = "half resolution, against full",
                               .of = "shaft_resolution=half",
                               .against = "",
                               .scenario = "beams",
                               .counters = {"rays", "kilosteps", "kilofetches"}},
                              {.name = "with a blur, against none",
                               .of = "",
                               .against = "shaft_blur=off",
                               .scenario = "beams",
                               .counters = {"rays", "kilosteps", "kilofetches"}}}},
        .declare = declare,
        .approximates = truth_of_phase,
        .model = ray_march_model,
        .tolerance = {.rmse = 1e-3,
                      .worst = 4e-3,
                      .because = "half floats of undefined rounding in up to two images, 2^-10 each; lookups that rounding may "
                                 "turn change up to 2e-3, or are undecided"}};
}

}  // namespace strata::sun_shafts
