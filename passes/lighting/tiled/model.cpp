// Tiles in double: they leave nothing out that adds anything, so the model is every light at every sample. Sample 0 of plain
// pixels stands for all their samples.
#include <algorithm>

#include "passes/lighting/every_light.h"
#include "passes/technique.h"

namespace strata::lighting {
namespace {

constexpr double largest_half = 65504;

}  // namespace

ImageSet tiled_model(const StageInput& input, const Settings&) {
    const EveryLight every_light(input);
    const auto edges = input.before.find("edges");
    ReferenceImage light(every_light.width(), every_light.height(), every_light.samples());
    for (std::uint32_t y = 0; y < light.height; ++y)
        for (std::uint32_t x = 0; x < light.width; ++x) {
            const bool plain = edges != input.before.end() && edges->second.at(x, y).x == 0;
            for (std::uint32_t sample = 0; sample < light.layers; ++sample) {
                if (plain && sample > 0) {
                    light.at(x, y, sample) = light.at(x, y, 0);
                    continue;
                }
                const glm::dvec3 sum = every_light.at(x, y, sample);
                light.at(x, y, sample) = glm::dvec4(glm::clamp(sum, -largest_half, largest_half), 1);
            }
        }
    return {{"light", light}};
}

}  // namespace strata::lighting
