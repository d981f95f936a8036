// Parameters of brute-force lighting.
#pragma once

#include <cstdint>

namespace strata::lighting {

struct BruteForceParams {
    std::uint32_t routing;  ///< routing_* of passes/edges/routing/routing.shared.h
    std::uint32_t materials;
    std::uint32_t specular;
};

}  // namespace strata::lighting
