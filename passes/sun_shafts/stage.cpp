// The stage sun_shafts: what it writes, and when a frame does not need it.
#include "passes/stages.h"

namespace strata::sun_shafts {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (!features.has(Feature::sun)) return "the frame has no sun";
    if (!features.has(Feature::sun_shafts)) return "the sun throws no shafts";
    return std::nullopt;
}

}  // namespace

StageInfo stage() {
    return {.purpose = "adds sunlight that fog and dust scatter", .unwanted = unwanted, .outputs = {}, .scenarios = {}};
}

}  // namespace strata::sun_shafts
