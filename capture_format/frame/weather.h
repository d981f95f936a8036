// Sun, sky, fog and rain of a frame.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture_format/frame/glm_types.h"
#include "capture_format/frame/shadow_use.h"

namespace strata {

struct Sun {
    glm::vec3 direction{0, -1, 0};  ///< where it shines, unit
    glm::vec3 irradiance{0};        ///< perpendicular; zero means there is no sun
    float angular_radius = 0.00465f;
    ShadowUse shadow;
    std::uint32_t cascades = 3;
    float shadow_distance = 60;  ///< meters of view depth covered by the cascades
    bool shafts = false;
};

/// Light from all around: sky above, ground below, mixed by .5 + .5 n.y.
struct Hemisphere {
    glm::vec3 sky{0}, ground{0};  ///< radiance
};

/// The way through fog to a point: its view depth, or its distance from the eye.
enum class FogPath : std::uint32_t { view_depth, distance };

/// f = exp(-density way) of what is behind remains, and (1 - f) color is added.
struct Fog {
    float density = 0;  ///< per meter; zero means there is no fog
    glm::vec3 color{0};
    FogPath path = FogPath::view_depth;
};

struct Rain {
    float intensity = 0;  ///< 0 none, 1 heavy
    float wetness = 0;    ///< 0 dry, 1 soaked
    glm::vec3 direction{0, -1, 0};
};

}  // namespace strata
