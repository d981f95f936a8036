// The stage lens: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/lens/judge.h"
#include "passes/lens/truth.h"
#include "passes/stages.h"

namespace strata::lens {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    for (const Feature feature : {Feature::bloom, Feature::auto_exposure, Feature::depth_of_field, Feature::lens_distortion})
        if (features.has(feature)) return std::nullopt;
    return "the frame has no lens effects";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "adapts exposure, adds bloom, depth of field and distortion",
            .unwanted = unwanted,
            .outputs = {"color", "exposure"},
            .truth = lens_truth,
            .truth_is = "in double; 256 places of a thin lens over what the picture shows, a sum of Gaussians as glow",
            .judge = lens_judge,
            .scenarios = {"lamp_at_night"}};
}

}  // namespace strata::lens
