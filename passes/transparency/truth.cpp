#include "passes/transparency/truth.h"

#include "passes/transparency/sample_blend.h"

namespace strata {

glm::dvec3 exact_blend(std::span<const Fragment> fragments, glm::dvec3 behind) {
    glm::dvec3 color(0), through(1);
    for (const Fragment& fragment : transparency::nearest_first(fragments)) {
        color += through * (fragment.color + fragment.emission);
        through *= fragment.transmittance;
    }
    return color + through * behind;
}

ImageSet transparency_truth(const StageInput& input) {
    return {{"color", transparency::blended(input.before.at("color"), input.frame, input.before, exact_blend)}};
}

}  // namespace strata
