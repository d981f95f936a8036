// The stage indirect: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/indirect/bounces.h"
#include "passes/indirect/judge.h"
#include "passes/indirect/truth.h"
#include "passes/stages.h"

namespace strata::indirect {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::light_volumes)) return info(Stage::culling).unwanted(features);
    return "the frame has no light volumes";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "adds light that other surfaces reflect",
            .aliases = {"gi"},
            .unwanted = unwanted,
            .outputs = {"indirect", "volume_light"},
            .truth = indirect_truth,
            .truth_is = "one bounce gathered in double, 1600 directions per sample",
            .other_truths = {{.name = two_bounces,
                              .make = two_bounce_truth,
                              .is = "one and two bounces gathered in double, 1600 paths per sample"}},
            .judge = indirect_judge,
            .scenarios = {"cornell_box", "two_rooms", "courtyard"},
            .leaves = {"volume_light"}};
}

}  // namespace strata::indirect
