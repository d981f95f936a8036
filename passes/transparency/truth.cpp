#include "passes/transparency/truth.h"

#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"

namespace strata {

glm::dvec3 exact_blend(std::span<const Fragment> fragments, glm::dvec3 behind) {
    return exact_blend(fragments, transparency::nearest_first_order(fragments), behind);
}

glm::dvec3 exact_blend(std::span<const Fragment> fragments, std::span<const std::size_t> nearest_first, glm::dvec3 behind) {
    glm::dvec3 color(0), through(1);
    for (const std::size_t i : nearest_first) {
        const Fragment& fragment = fragments[i];
        color += through * (fragment.color + fragment.emission);
        through *= fragment.transmittance;
    }
    return color + through * behind;
}

glm::dvec2 exact_distortion(std::span<const Fragment> fragments) {
    glm::dvec2 offset(0);
    glm::dvec3 through(1);
    for (const std::size_t i : transparency::nearest_first_order(fragments)) {
        const Fragment& fragment = fragments[i];
        offset += transparency::luminance(through) * fragment.distortion;
        through *= fragment.transmittance;
    }
    return offset;
}

ImageSet transparency_truth(const StageInput& input) {
    const ReferenceImage& before = input.before.at("color");
    const transparency::PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind,
                                                glm::uvec3 at) -> transparency::BlendedSample {
        const glm::dvec2 offset = exact_distortion(fragments);
        if (offset == glm::dvec2(0)) return {exact_blend(fragments, behind)};
        const transparency::BlendedSample seen = transparency::seen_behind(before, at, offset);
        return {exact_blend(fragments, seen.radiance), seen.undecided};
    };
    return {{"color", transparency::blended(before, input, blend)}};
}

}  // namespace strata
