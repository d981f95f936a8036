// Parameters of combining into two targets.
#pragma once

#include <cstdint>

namespace strata::combine {

struct HiLoParams {
    std::uint32_t resolve;
    std::uint32_t fog;
    std::uint32_t fog_distance;
    std::uint32_t fog_sky;
    float fog_near;  ///< of linear fog, in mean free paths: meters times the recorded density
    float fog_far;
    std::uint32_t hemisphere;
};

}  // namespace strata::combine
