// Brute force in double: it is what every light gives.
#include "passes/frame_images.h"
#include "passes/lighting/brute_force/brute_force.shared.h"
#include "passes/lighting/brute_force/light_buffer_model.h"
#include "passes/lighting/every_light.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::lighting {

ImageSet brute_force_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<BruteForceParams>();
    if (params.materials == materials_recorded && params.specular == specular_colored) return light_of_shaded_samples(input);
    ImageSet images =
        light_of_shaded_samples(input, {.reflects = [&](const Frame& frame, const SurfacePoint& p, const Light& light) {
                                    return accumulated(frame, p, light, params).radiance;
                                }});
    if (params.materials == materials_recorded) return images;
    // Light where the table is undecided.
    const ImageSet doubts =
        light_of_shaded_samples(input, {.reflects = [&](const Frame& frame, const SurfacePoint& p, const Light& light) {
                                    return glm::dvec3(accumulated(frame, p, light, params).undecided ? 1 : 0);
                                }});
    ReferenceImage& light = images.at("light");
    for (const glm::dvec4& doubt : doubts.at("light").texels) light.undecided.push_back(doubt.x > 0);
    return images;
}

}  // namespace strata::lighting
