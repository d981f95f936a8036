// The stage rain: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/rain/judge.h"
#include "passes/rain/look.h"
#include "passes/rain/truth.h"
#include "passes/stages.h"

namespace strata::rain {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::rain)) return info(Stage::culling).unwanted(features);
    return "the frame has no rain";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "wets surfaces that rain reaches",
            .unwanted = unwanted,
            .outputs = {"surface_color", "surface_normal", "surface_material", "gbuffer0", "gbuffer1", "gbuffer2"},
            .truth = rain_truth,
            .truth_is = "the formulas in double, rain traced along its direction from every sample",
            .other_truths = {{.name = xray_truth_name,
                              .make = xray_rain_truth,
                              .is = "X-Ray's formulas in double, rain traced along its direction from every sample"},
                             {.name = wind_truth_name,
                              .make = rain_in_wind_truth,
                              .is = "the formulas in double, rain traced along 64 directions from every sample"},
                             {.name = xray_wind_truth_name,
                              .make = xray_rain_in_wind_truth,
                              .is = "X-Ray's formulas in double, rain traced along 64 directions from every sample"}},
            .judge = rain_judge,
            .scenarios = {"roof_in_rain", "zone_at_dusk"},
            // Readers of given surfaces do not read the layout.
            .leaves = {"gbuffer0", "gbuffer1", "gbuffer2"}};
}

}  // namespace strata::rain
