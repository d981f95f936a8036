// The stage occlusion: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/occlusion/judge.h"
#include "passes/occlusion/truth.h"
#include "passes/stage_input.h"
#include "passes/stages.h"

namespace strata::occlusion {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::hemisphere) || features.has(Feature::light_volumes)) return info(Stage::culling).unwanted(features);
    return "the frame has no ambient light to occlude";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "darkens ambient light in corners",
            .aliases = {"ao"},
            .unwanted = unwanted,
            .outputs = {"occlusion"},
            .truth = occlusion_truth,
            .truth_is = occlusion_truth_is(),
            .other_truths = other_occlusion_truths(),
            .judge = occlusion_judge,
            .scenarios = {"corners", "one_sphere", "opaque_only"}};
}

}  // namespace strata::occlusion
