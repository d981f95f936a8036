// Parameters of z-binned lighting.
#pragma once

#include <cstdint>

namespace strata::lighting {

struct ZBinnedParams {
    std::uint32_t bins;
    std::uint32_t spacing;
    std::uint32_t tile;  ///< 0: 8 x 8 pixels, 1: 16 x 16, 2: 32 x 32
    std::uint32_t bounds;
    std::uint32_t merge;
    std::uint32_t routing;  ///< routing_* of passes/edges/routing/routing.shared.h
};

}  // namespace strata::lighting
