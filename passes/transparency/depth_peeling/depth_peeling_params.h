// Parameters of depth peeling.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct DepthPeelingParams {
    std::uint32_t passes;
};

}  // namespace strata::transparency
