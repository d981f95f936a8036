// Parameters of wet surfaces.
#pragma once

#include <cstdint>

namespace strata::rain {

struct WetnessParams {
    std::uint32_t map_size;
    float radius;  ///< texels
    std::uint32_t jitter;
    std::uint32_t casters;
    float bias;   ///< meters
    float reach;  ///< meters
    float fade;   ///< share of the reach from which on it fades
    std::uint32_t beyond;
    std::uint32_t form;
    float albedo;
    float gloss;
    float ripple_height;  ///< millimeters
    float flow_height;    ///< millimeters
    float puddles;
    std::uint32_t ripple_filter;
    std::uint32_t directions;
    float spread;  ///< degrees
};

}  // namespace strata::rain
