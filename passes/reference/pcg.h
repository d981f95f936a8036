// PCG as a hash, for models: the shaders' is passes/shaders/hash.shared.h.
#pragma once

#include <cstdint>

namespace strata {

/// Jarzynski and Olano, Hash Functions for GPU Rendering, JCGT 9(3), 2020.
constexpr std::uint32_t pcg(std::uint32_t input) {
    const std::uint32_t state = input * 747796405u + 2891336453u;
    const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

}  // namespace strata
