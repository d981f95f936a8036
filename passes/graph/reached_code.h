// The part of a shader that its specialization constants let run, as code and counted. Drivers inline every call before they look
// at constants: lavapipe 22.3 takes 200 ms to translate a shader that includes the whole scene, and 10 ms without what it never
// calls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace strata {

struct Shader;
struct Step;

/// The bits of a 32-bit specialization constant, by its id in the shader.
struct ConstantBits {
    std::uint32_t id = 0;
    std::uint32_t bits = 0;
};
/// The constants of the shader that the step fixes, in the shader's order.
std::vector<ConstantBits> fixed_constants(const Shader&, const Step&);

/// SPIR-V without the functions that are only called where a branch on constants never leads; running_blocks.h says how far
/// constants are followed. A constant that is not given has the shader's default. Every other instruction stays, the constants
/// and the branches too: what runs is the same, step by step. An output gl_SampleMask that is written by functions left out alone
/// goes, too: it would be undefined.
std::vector<std::uint32_t> reached_code(std::span<const std::uint32_t> code, std::span<const ConstantBits> constants);

/// What one invocation computes if it takes every branch that the constants leave open and turns every loop once.
struct OperationCount {
    /// Arithmetic, comparisons, conversions, bits and choices, of floats and integers: one per component, a fused multiply-add
    /// two, any other function of GLSL.std.450 one. Loads, stores, texture reads and copies are none.
    std::uint64_t operations = 0;
    std::uint64_t loops = 0;  ///< in the code, those in functions once per call
};
OperationCount count_operations(std::span<const std::uint32_t> code, std::span<const ConstantBits> constants);

}  // namespace strata
