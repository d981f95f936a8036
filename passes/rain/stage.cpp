// The stage rain: what it writes, and when a frame does not need it.
#include "passes/stages.h"

namespace strata::rain {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::rain)) return std::nullopt;
    return "the frame has no rain";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "wets surfaces and draws falling drops",
            .unwanted = unwanted,
            .outputs = {"gbuffer0", "gbuffer1"},
            .scenarios = {}};
}

}  // namespace strata::rain
