// A shader module taken apart, and its blocks that run with the specialization constants it is given. Constants are followed
// through calls: a function that asks `(features & bit) != 0` of a parameter is answered where every call gives it the same
// constant.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#define SPV_ENABLE_UTILITY_CODE
#include <spirv.hpp>

namespace strata {

struct ConstantBits;

inline constexpr std::size_t spirv_header_words = 5;

struct Instruction {
    spv::Op op;
    std::span<const std::uint32_t> words;  ///< the first holds opcode and length

    /// The id that it defines, or nothing.
    std::optional<std::uint32_t> result() const {
        bool has_result = false, has_type = false;
        spv::HasResultAndType(op, &has_result, &has_type);
        if (!has_result) return {};
        return words[has_type ? 2 : 1];
    }
};

/// Nothing where the code is cut off.
std::vector<Instruction> instructions_of(std::span<const std::uint32_t> code);

struct RunningFunction {
    std::span<const Instruction> body;                       ///< OpFunction to OpFunctionEnd
    std::vector<std::uint32_t> calls = {};                   ///< in blocks that run
    std::set<std::size_t> idle_calls = {};                   ///< in the others, by place in the body
    std::vector<std::span<const Instruction>> running = {};  ///< blocks that run
};

struct RunningModule {
    std::span<const Instruction> head;  ///< all before the first function
    std::map<std::uint32_t, RunningFunction> functions = {};
    std::vector<std::uint32_t> order = {};  ///< of the functions
    std::set<std::uint32_t> called = {};    ///< functions that run
    std::set<std::uint32_t> void_types = {};
    std::vector<std::uint32_t> entries = {};
};

/// Points into the instructions.
RunningModule running_blocks(std::span<const Instruction>, std::span<const ConstantBits>);

}  // namespace strata
