#include "passes/reference/light_sets.h"

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/reference/shade.h"

namespace strata {
namespace {

bool is_black(const glm::vec3& color) { return color.x == 0 && color.y == 0 && color.z == 0; }

}  // namespace

std::vector<Light> shining_lights(const Frame& frame) {
    std::vector<Light> shining;
    if (!is_black(frame.sun.irradiance)) shining.push_back(sun_light(frame));
    for (const Light& light : frame.lights) {
        const bool reaches = !has_range(light.type) || light.range > 0;
        if (reaches && !is_black(light.intensity)) shining.push_back(light);
    }
    return shining;
}

std::vector<std::uint32_t> mapped_lights(const Frame& frame) {
    const std::vector<Light> shining = shining_lights(frame);
    const bool has_sun = !is_black(frame.sun.irradiance);
    std::vector<std::uint32_t> mapped;
    for (std::uint32_t i = 0; i < shining.size(); ++i) {
        const bool is_sun = has_sun && i == 0;
        if (shining[i].shadow.casts && (is_sun || facts_of(shining[i].type).maps != LightMaps::none)) mapped.push_back(i);
    }
    return mapped;
}

}  // namespace strata
