// The specialization constants of a shader module, and what follows from them: 32-bit integers and bools (0 or 1), by id.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>

#define SPV_ENABLE_UTILITY_CODE
#include <spirv.hpp>

namespace strata {

struct ConstantBits;
struct Instruction;

/// Of a 32-bit integer or a bool, where it is known.
using Value = std::optional<std::uint32_t>;
using Values = std::unordered_map<std::uint32_t, std::uint32_t>;  ///< by id

inline Value found_in(const Values& values, std::uint32_t id) {
    const auto found = values.find(id);
    return found == values.end() ? std::nullopt : Value(found->second);
}

/// What an operation gives, where it is one that shaders choose branches by and the operands that are known decide it.
Value result_of(spv::Op, std::span<const Value> operands);

/// The values of a module's constants.
class KnownConstants {
public:
    explicit KnownConstants(std::span<const ConstantBits> given);

    /// To be called for a module's instructions in their order.
    void add(const Instruction&);
    Value find(std::uint32_t id) const { return found_in(values_, id); }
    /// Whether the type is one of those whose values are known.
    bool is_integer(std::uint32_t type) const { return integers_.contains(type); }

private:
    std::uint32_t given(std::uint32_t id, std::uint32_t otherwise) const;

    Values given_, spec_ids_, values_;
    std::unordered_set<std::uint32_t> integers_;  ///< types
};

}  // namespace strata
