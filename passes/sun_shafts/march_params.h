// Parameters of marched sun shafts. Their choices are the constants of march.shared.h.
#pragma once

#include <cstdint>

namespace strata::sun_shafts {

struct MarchParams {
    std::uint32_t steps;
    std::uint32_t taps;
    std::uint32_t stepping;
    std::uint32_t jitter;
    std::uint32_t resolution;
    std::uint32_t blur;
    std::uint32_t extinction;
    std::uint32_t normalization;
    std::uint32_t phase;
    std::uint32_t cascade;
    float intensity;
    std::uint32_t asymmetry;  ///< which of phase_asymmetries (truths.h)
    // Of sun_shafts/ray_march_min_max alone.
    std::uint32_t segment;
    std::uint32_t bounds;
};

}  // namespace strata::sun_shafts
