// The stage culling: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/culling/judge.h"
#include "passes/culling/truth.h"
#include "passes/stages.h"

namespace strata::culling {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::opaque) || features.has(Feature::masked)) return std::nullopt;
    return "the frame has no opaque draws";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "culls opaque draws that cannot be seen",
            .unwanted = unwanted,
            .outputs = {"visible"},
            .truth = culling_truth,
            .judge = culling_judge,
            .scenarios = {"opaque_only", "city_of_boxes", "sun_and_boxes", "materials"}};
}

}  // namespace strata::culling
