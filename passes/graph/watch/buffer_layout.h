// Places of what pointers into a block of SPIR-V point at, in bytes: by the decorations of its types.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "passes/graph/running_blocks.h"

namespace strata {

/// A distance from the start of a block: bytes, and ids of indices with the bytes from one to the next.
struct ByteOffset {
    std::uint64_t fixed = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> scaled = {};
};

/// A part of a block.
struct BlockPart {
    ByteOffset offset;
    std::uint64_t bytes = 0;
};

/// Types, constants and layouts of a module.
class BufferLayouts {
public:
    /// To be called for a module's instructions before its first function, in their order.
    void add(const Instruction&);
    /// The instruction that defines a type; null for what is none.
    const Instruction* type(std::uint32_t id) const;
    /// A 32-bit integer constant, not specialized.
    std::optional<std::uint32_t> constant(std::uint32_t id) const;
    /// The part of the block that these indices of an access chain lead to. Nothing where its size is not known, or a matrix has
    /// its rows together.
    std::optional<BlockPart> part(std::uint32_t block_type, std::span<const std::uint32_t> indices) const;

private:
    struct Member {
        std::uint32_t offset = 0, matrix_stride = 0;
        bool is_row_major = false;
    };
    struct Walk;
    const Member& member(std::uint32_t type, std::uint32_t index) const;
    /// One index further in; false where that leads nowhere.
    bool step(Walk&, std::uint32_t index) const;
    std::optional<std::uint64_t> bytes(std::uint32_t type, std::uint32_t matrix_stride) const;

    std::unordered_map<std::uint32_t, Instruction> types_;
    std::unordered_map<std::uint32_t, std::uint32_t> constants_, array_strides_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Member> members_;
};

}  // namespace strata
