// What a light or the sun asks of its shadow.
#pragma once

#include <cstdint>

namespace strata {

/// Shadow of a light: a map of size x size texels, filtered by the shadow technique.
struct ShadowUse {
    bool casts = false;
    std::uint32_t map_size = 1024;
    float bias = 0.02f;  ///< meters along the light's rays
    bool soft = false;   ///< wants penumbrae as wide as its source_radius, the sun's angular_radius, makes them
};

}  // namespace strata
