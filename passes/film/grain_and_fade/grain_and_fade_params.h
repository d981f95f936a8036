// Parameters of film grain and fade.
#pragma once

#include <cstdint>

namespace strata::film {

struct GrainParams {
    std::uint32_t grain;
    float grain_rate;  ///< Hz
};

}  // namespace strata::film
