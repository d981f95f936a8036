// Parameters of the exact transmittance function.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct ExactFunctionParams {
    float pool;  ///< million fragments kept at a time
    std::uint32_t accumulation;
};

}  // namespace strata::transparency
