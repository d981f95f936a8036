#include "passes/scene/light_list.h"

#include <algorithm>
#include <iterator>

#include "passes/scene/light_features.h"
#include "passes/shaders/light_features.shared.h"

namespace strata {
namespace {

// Of one light, in the loops of passes/shaders: an emitter's outline of 16 corners, three times; a picture's two mips, each found
// from the largest on. A branch that no lane takes costs a turn of each of its loops.
constexpr std::uint64_t outline_turns = 3 * 17, picture_turns = 40, idle_turns = 6;

Light as_light(const Sun& sun) {
    Light light{.name = "sun"};
    light.type = LightType::directional;
    light.direction = sun.direction;
    light.intensity = sun.irradiance;
    light.shadow = sun.shadow;
    return light;
}

}  // namespace

bool shines(const Light& light) {
    return light.intensity != glm::vec3(0) && (light.type == LightType::directional || light.range > 0);
}

bool shines(const Sun& sun) { return sun.irradiance != glm::vec3(0); }

std::vector<Light> light_list(const Frame& frame) {
    std::vector<Light> lights;
    if (shines(frame.sun)) lights.push_back(as_light(frame.sun));
    std::ranges::copy_if(frame.lights, std::back_inserter(lights), [](const Light& light) { return shines(light); });
    return lights;
}

std::uint64_t light_turns(std::span<const Light> lights) {
    std::uint32_t features = 0;
    for (const Light& light : lights) features |= light_features(light);
    std::uint64_t turns = 0;
    for (const Light& light : lights) {
        const bool is_area = (light_features(light) & (feature_tube | feature_area)) != 0;
        // Each blocker has a loop over its portals.
        turns += 1 + 2 * light.blockers.size() + light.portals.size();
        if (features & feature_clip_planes) turns += 1 + light.clip_planes.size();
        if (features & (feature_tube | feature_area)) turns += is_area ? outline_turns : idle_turns;
        if (features & feature_projected_texture) turns += light.texture != no_index ? picture_turns : idle_turns;
    }
    return turns;
}

}  // namespace strata
