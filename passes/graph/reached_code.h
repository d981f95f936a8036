// The part of a shader that its specialization constants let run. Drivers inline every call before they look at constants:
// lavapipe 22.3 takes 200 ms to translate a shader that includes the whole scene, and 10 ms without what it never calls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace strata {

/// The bits of a 32-bit specialization constant, by its id in the shader.
struct ConstantBits {
    std::uint32_t id = 0;
    std::uint32_t bits = 0;
};

/// SPIR-V without the functions that are only called where a branch on constants never leads. A constant that is not given has
/// the shader's default. Every other instruction stays, the constants and the branches too: what runs is the same, step by step.
std::vector<std::uint32_t> reached_code(std::span<const std::uint32_t> code, std::span<const ConstantBits> constants);

}  // namespace strata
