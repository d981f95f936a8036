// The stage combine: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/combine/judge.h"
#include "passes/combine/truth.h"
#include "passes/stages.h"

namespace strata::combine {
namespace {

std::optional<std::string> always_wanted(const Features&) { return std::nullopt; }

}  // namespace

StageInfo stage() {
    return {.purpose = "sums light and emission, applies fog, and tone maps the sum to a picture",
            .unwanted = always_wanted,
            .outputs = {"color", "display"},
            .truth = combine_truth,
            .judge = combine_judge,
            .scenarios = {"one_sphere", "materials", "lighting_models", "opaque_only", "sun_and_boxes", "foggy_panes", "beams"}};
}

}  // namespace strata::combine
