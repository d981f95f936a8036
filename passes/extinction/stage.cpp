
#include "capture_format/frame_features.h"
#include "passes/stages.h"
// The stage extinction: what it writes, and when a frame does not need it.

namespace strata::extinction {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (auto reason = info(Stage::transparency).unwanted(features)) return reason;
    return info(Stage::culling).unwanted(features);
}

}  // namespace

StageInfo stage() {
    return {.purpose = "finds the depth behind which smoke and glass hide everything",
            .unwanted = unwanted,
            .outputs = {},
            .scenarios = {}};
}

}  // namespace strata::extinction
