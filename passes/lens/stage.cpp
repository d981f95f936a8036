// The stage lens: what it writes, and when a frame does not need it.
#include "passes/stages.h"

namespace strata::lens {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    for (const Feature feature : {Feature::bloom, Feature::auto_exposure, Feature::depth_of_field, Feature::lens_distortion})
        if (features.has(feature)) return std::nullopt;
    return "the lens neither blooms, adapts, focuses nor distorts";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "adds bloom, depth of field and distortion", .unwanted = unwanted, .outputs = {"color"}, .scenarios = {}};
}

}  // namespace strata::lens
