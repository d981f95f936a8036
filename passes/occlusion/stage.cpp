// The stage occlusion: what it writes, and when a frame does not need it.
#include "passes/stages.h"

namespace strata::occlusion {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::hemisphere) || features.has(Feature::light_volumes)) return info(Stage::culling).unwanted(features);
    return "the frame has no ambient light to occlude";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "darkens ambient light in corners", .unwanted = unwanted, .outputs = {"occlusion"}, .scenarios = {}};
}

}  // namespace strata::occlusion
