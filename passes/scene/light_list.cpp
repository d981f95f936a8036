#include "passes/scene/light_list.h"

#include <algorithm>
#include <iterator>

namespace strata {
namespace {

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

}  // namespace strata
