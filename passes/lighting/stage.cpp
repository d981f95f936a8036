// The stage lighting: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/lighting/judge.h"
#include "passes/lighting/truth.h"
#include "passes/stages.h"

namespace strata::lighting {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::sun) || features.has(Feature::local_lights)) return info(Stage::culling).unwanted(features);
    return "the frame has no lights";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "shades opaque surfaces with all lights",
            .unwanted = unwanted,
            .outputs = {"light"},
            .truth = lighting_truth,
            .judge = lighting_judge,
            .scenarios = {"one_sphere", "materials", "lighting_models", "lights_room", "light_types", "blocker_rooms",
                          "spot_and_box", "sun_and_boxes", "agents_hq", "hall_of_lights_65", "pair_overflow"}};
}

}  // namespace strata::lighting
