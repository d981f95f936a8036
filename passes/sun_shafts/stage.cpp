// The stage sun_shafts: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/stage_input.h"
#include "passes/stages.h"
#include "passes/sun_shafts/judge.h"
#include "passes/sun_shafts/truth.h"

namespace strata::sun_shafts {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (!features.has(Feature::sun)) return "the frame has no sun";
    if (!features.has(Feature::sun_shafts)) return "the sun throws no shafts";
    if (!features.has(Feature::fog)) return "the air is clear: the frame has no fog that scatters sunlight";
    return info(Stage::culling).unwanted(features);
}

}  // namespace

StageInfo stage() {
    return {.purpose = "adds sunlight that fog and dust scatter",
            .unwanted = unwanted,
            .outputs = {"shafts"},
            .truth = sun_shafts_truth,
            .truth_is = "single scattering, integrated in double over exact shadow intervals of a point-like sun",
            .other_truths = other_sun_shafts_truths(),
            .judge = sun_shafts_judge,
            .scenarios = {"beams", "hall_with_shafts"}};
}

}  // namespace strata::sun_shafts
