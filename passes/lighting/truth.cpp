#include "passes/lighting/truth.h"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include "passes/lighting/every_light.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

// Whether a sample's surface and visibility are those of the pixel's first: what is plain is integrated once.
bool is_first_again(const StageInput& input, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    const std::uint32_t samples = input.before.at("surface_normal").layers;
    for (const char* name : {"surface_normal", "surface_color", "surface_material", "visibility"}) {
        const auto image = input.before.find(name);
        if (image == input.before.end()) continue;
        for (std::uint32_t first = 0; first < image->second.layers; first += samples)
            if (image->second.at(x, y, first) != image->second.at(x, y, first + sample)) return false;
    }
    return true;
}

}  // namespace

ImageSet lighting_truth(const StageInput& input) {
    const lighting::EveryLight every_light(input, lighting::LightForm::exact);
    ReferenceImage light(every_light.width(), every_light.height(), every_light.samples());
    tbb::parallel_for(0u, light.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < light.width; ++x)
            for (std::uint32_t sample = 0; sample < light.layers; ++sample) {
                if (tbb::is_current_task_group_canceling()) return;
                const bool again = sample > 0 && is_first_again(input, x, y, sample);
                light.at(x, y, sample) = again ? light.at(x, y) : glm::dvec4(every_light.at(x, y, sample), 1);
            }
    });
    return {{"light", light}};
}

}  // namespace strata
