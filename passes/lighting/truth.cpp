#include "passes/lighting/truth.h"

#include "passes/lighting/every_light.h"

namespace strata {

ImageSet lighting_truth(const StageInput& input) {
    const lighting::EveryLight every_light(input);
    ReferenceImage light(every_light.width(), every_light.height(), every_light.samples());
    for (std::uint32_t sample = 0; sample < light.layers; ++sample)
        for (std::uint32_t y = 0; y < light.height; ++y)
            for (std::uint32_t x = 0; x < light.width; ++x) light.at(x, y, sample) = glm::dvec4(every_light.at(x, y, sample), 1);
    return {{"light", light}};
}

}  // namespace strata
