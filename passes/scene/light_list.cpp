#include "passes/scene/light_list.h"

#include <algorithm>
#include <iterator>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/scene/light_features.h"
#include "passes/shaders/light_features.shared.h"

namespace strata {
namespace {

// Of one light, in the loops of passes/shaders: an emitter's outline of 16 corners, three times; a picture's two mips, each found
// from the largest on. A branch that no lane takes costs an iteration of each of its loops.
constexpr std::uint64_t outline_iterations = 3 * 17, picture_iterations = 40, idle_iterations = 6;

Light as_light(const Sun& sun) {
    Light light{.name = "sun"};
    light.type = LightType::directional;
    light.direction = sun.direction;
    light.intensity = sun.irradiance;
    light.shadow = sun.shadow;
    return light;
}

}  // namespace

bool shines(const Light& light) { return light.intensity != glm::vec3(0) && (!has_range(light.type) || light.range > 0); }

bool shines(const Sun& sun) { return sun.irradiance != glm::vec3(0); }

std::vector<Light> light_list(const Frame& frame) {
    std::vector<Light> lights;
    if (shines(frame.sun)) lights.push_back(as_light(frame.sun));
    std::ranges::copy_if(frame.lights, std::back_inserter(lights), [](const Light& light) { return shines(light); });
    return lights;
}

std::uint64_t light_iterations(std::span<const Light> lights) {
    std::uint32_t features = 0;
    for (const Light& light : lights) features |= light_features(light);
    std::uint64_t iterations = 0;
    for (const Light& light : lights) {
        const bool is_area = (light_features(light) & (feature_tube | feature_area)) != 0;
        // Each blocker has a loop over its portals.
        iterations += 1 + 2 * light.blockers.size() + light.portals.size();
        if (features & feature_clip_planes) iterations += 1 + light.clip_planes.size();
        if (features & (feature_tube | feature_area)) iterations += is_area ? outline_iterations : idle_iterations;
        if (features & feature_projected_texture) iterations += light.texture != no_index ? picture_iterations : idle_iterations;
    }
    return iterations;
}

}  // namespace strata
