#include "passes/transparency/sorted_lists/model.h"

#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"

namespace strata::transparency {

glm::dvec3 sorted_blend(std::span<const Fragment> fragments, glm::dvec3 behind) {
    const std::vector<Fragment> sorted = nearest_first(fragments);
    glm::dvec3 radiance = behind;
    for (auto fragment = sorted.rbegin(); fragment != sorted.rend(); ++fragment)
        radiance = fragment->color + fragment->emission + fragment->transmittance * radiance;
    return radiance;
}

ImageSet sorted_lists_model(const StageInput& input, const Settings&) {
    const ReferenceImage& before = input.before.at("color");
    const PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3 at) -> BlendedSample {
        // Offsets per channel of light: what dims them all alike is taken of the sum.
        glm::dvec3 right(0), down(0);
        const std::vector<Fragment> sorted = nearest_first(fragments);
        for (auto fragment = sorted.rbegin(); fragment != sorted.rend(); ++fragment) {
            right = fragment->distortion.x + fragment->transmittance * right;
            down = fragment->distortion.y + fragment->transmittance * down;
        }
        const glm::dvec2 offset(luminance(right), luminance(down));
        if (offset == glm::dvec2(0)) return {sorted_blend(fragments, behind)};
        const BlendedSample seen = seen_behind(before, at, offset);
        return {sorted_blend(fragments, seen.radiance), seen.undecided};
    };
    return {{"color", blended(before, input, blend)}};
}

}  // namespace strata::transparency
