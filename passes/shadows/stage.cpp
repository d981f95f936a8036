// The stage shadows: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/shadows/judge.h"
#include "passes/shadows/truth.h"
#include "passes/stages.h"

namespace strata::shadows {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::shadows)) return info(Stage::culling).unwanted(features);
    return "no light of the frame casts shadows";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "draws the shadow maps of all lights",
            .unwanted = unwanted,
            .outputs = {"visibility", "shadow_maps", "shadow_bounds"},
            .truth = shadows_truth,
            .judge = shadows_judge,
            .scenarios = {"sun_and_boxes", "spot_and_box", "soft_shadows", "tilted_ground", "thirty_boxes", "leaves"},
            .leaves = {"shadow_maps", "shadow_bounds"}};
}

}  // namespace strata::shadows
