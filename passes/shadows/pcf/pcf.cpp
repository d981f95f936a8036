// Percentage-closer filtered shadow maps: casters are drawn into the maps before the G-buffer, and every sample of the G-buffer
// is looked up in them after it.
#include "passes/frame_images.h"
#include "passes/shadows/filter.h"
#include "passes/shadows/shadows.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::shadows {

ImageSet pcf_model(const StageInput&, const Settings&);

namespace {

void filter_maps(Graph& graph, FrameImages& frame, const Settings&) {
    filter_shadow_maps(graph, frame, "shadows/pcf/filter.comp");
}

}  // namespace

Technique pcf() {
    return {.stage = Stage::shadows,
            .name = "shadows/pcf",
            .title = "Percentage-closer filtering",
            .source =
                "Reeves, Salesin, Cook: Rendering Antialiased Shadows with Depth Maps, SIGGRAPH 1987; "
                "kernels of Lobanchikov and Gruen: Clear Sky, GDC 2009",
            .summary =
                "Averages depth comparisons over N x N texels; penumbrae have one width everywhere, and thin gaps between "
                "caster and receiver leak by the bias.",
            .params = shadow_map_params(),
            .counters = shadow_map_counters(),
            .counter_bytes = sizeof(ShadowCounters),
            .views = shadow_map_views(),
            .tables = shadow_map_tables(),
            .abilities = {.is_time_unit = true},
            .declare = make_shadow_maps,
            .at_other_stages = {{.at = Stage::occlusion, .declare = filter_maps}},
            .model = pcf_model,
            .tolerance = {.rmse = 3e-4,
                          .worst = 0.014,
                          .because = "fractions of a texel are cut to 1/256 after float arithmetic, which moves both by one step "
                                     "at most, and 16-bit floats round by 2^-11; comparisons that float may turn are undecided"}};
}

}  // namespace strata::shadows
