// Alpha blending in double: one object after another in painter's order, its triangles as they were submitted.
#include "passes/transparency/distortion/model.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::transparency {
namespace {

glm::dvec3 in_submission_order(std::span<const Fragment> fragments, glm::dvec3 radiance) {
    for (const Fragment& f : fragments) radiance = f.color + f.emission + f.transmittance * radiance;
    return radiance;
}

}  // namespace

ImageSet alpha_blend_model(const StageInput& input, const Settings&) {
    return {{"color", blended_by_object(background(input), input, in_submission_order)}};
}

}  // namespace strata::transparency
