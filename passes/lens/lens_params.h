// Parameters of the effects of the lens. Their choices are the constants of lens.shared.h.
#pragma once

#include <cstdint>

namespace strata::lens {

struct LensParams {
    std::uint32_t exposure;
    float exposure_amount;
    float exposure_grey;
    std::uint32_t bloom;
    float bloom_reach;  ///< of the picture's height
    std::uint32_t focus;
    std::uint32_t focus_taps;
    float focus_reach;  ///< of the picture's height
    std::uint32_t distortion;
    float k1;
};

}  // namespace strata::lens
