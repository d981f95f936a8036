// Parameters of wavelet transparency.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct WaveletParams {
    std::uint32_t rank;  ///< 1..4: 2^(rank + 1) coefficients
    std::uint32_t storage;
    std::uint32_t correction;
    std::uint32_t bounds;
    float jitter;  ///< in cells
    std::uint32_t channels;
    std::uint32_t resolution;
    std::uint32_t accumulation;
};

}  // namespace strata::transparency
