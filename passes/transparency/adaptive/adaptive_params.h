// Parameters of adaptive transparency.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct AdaptiveParams {
    std::uint32_t nodes;  ///< choice: 4, 8, 16
    std::uint32_t accumulation;
    float pool;  ///< million fragments kept at a time
};

}  // namespace strata::transparency
