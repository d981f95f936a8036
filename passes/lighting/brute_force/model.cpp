// Brute force in double: sample 0 of plain pixels stands for all their samples.
#include <algorithm>

#include "passes/lighting/every_light.h"
#include "passes/technique.h"

namespace strata::lighting {
namespace {

constexpr double largest_half = 65504;

}  // namespace

ImageSet brute_force_model(const StageInput& input, const Settings&) {
    const EveryLight every_light(input);
    const auto edges = input.before.find("edges");
    ReferenceImage light(every_light.width(), every_light.height(), every_light.samples());
    for (std::uint32_t sample = 0; sample < light.layers; ++sample)
        for (std::uint32_t y = 0; y < light.height; ++y)
            for (std::uint32_t x = 0; x < light.width; ++x) {
                const bool plain = edges != input.before.end() && edges->second.at(x, y).x == 0;
                const glm::dvec3 sum = every_light.at(x, y, plain ? 0 : sample);
                light.at(x, y, sample) = glm::dvec4(glm::clamp(sum, -largest_half, largest_half), 1);
            }
    return {{"light", light}};
}

}  // namespace strata::lighting
