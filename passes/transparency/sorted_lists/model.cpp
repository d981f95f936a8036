#include "passes/transparency/sorted_lists/model.h"

#include "passes/transparency/sample_blend.h"

namespace strata::transparency {

glm::dvec3 sorted_blend(std::span<const Fragment> fragments, glm::dvec3 behind) {
    const std::vector<Fragment> sorted = nearest_first(fragments);
    glm::dvec3 radiance = behind;
    for (auto fragment = sorted.rbegin(); fragment != sorted.rend(); ++fragment)
        radiance = fragment->color + fragment->emission + fragment->transmittance * radiance;
    return radiance;
}

ImageSet sorted_lists_model(const StageInput& input, const Settings&) {
    return {{"color", blended(input.before.at("color"), input.frame, input.before, sorted_blend)}};
}

}  // namespace strata::transparency
