#include "passes/graph/watch/buffer_layout.h"

#include <algorithm>

namespace strata {

struct BufferLayouts::Walk {
    std::uint32_t type = 0, matrix_stride = 0;
    ByteOffset offset = {};

    void add(std::uint32_t index, std::optional<std::uint32_t> known, std::uint32_t stride) {
        if (known) offset.fixed += std::uint64_t{*known} * stride;
        else offset.scaled.emplace_back(index, stride);
    }
};

void BufferLayouts::add(const Instruction& i) {
    const std::span<const std::uint32_t> words = i.words;
    if (i.op >= spv::OpTypeVoid && i.op <= spv::OpTypePointer) types_.emplace(words[1], i);
    if (i.op == spv::OpConstant && words.size() == 4) constants_[words[2]] = words[3];
    if (i.op == spv::OpDecorate && words[2] == spv::DecorationArrayStride) array_strides_[words[1]] = words[3];
    if (i.op != spv::OpMemberDecorate) return;
    Member& member = members_[{words[1], words[2]}];
    if (words[3] == spv::DecorationOffset) member.offset = words[4];
    if (words[3] == spv::DecorationMatrixStride) member.matrix_stride = words[4];
    if (words[3] == spv::DecorationRowMajor) member.is_row_major = true;
}

const Instruction* BufferLayouts::type(std::uint32_t id) const {
    const auto found = types_.find(id);
    return found == types_.end() ? nullptr : &found->second;
}

std::optional<std::uint32_t> BufferLayouts::constant(std::uint32_t id) const {
    const auto found = constants_.find(id);
    return found == constants_.end() ? std::nullopt : std::optional(found->second);
}

const BufferLayouts::Member& BufferLayouts::member(std::uint32_t type, std::uint32_t index) const {
    static const Member none;
    const auto found = members_.find({type, index});
    return found == members_.end() ? none : found->second;
}

bool BufferLayouts::step(Walk& walk, std::uint32_t index) const {
    const Instruction* in = type(walk.type);
    if (!in) return false;
    const auto known = constant(index);
    switch (in->op) {
        case spv::OpTypeStruct: {
            if (!known || *known + 2 >= in->words.size()) return false;
            const Member& part = member(walk.type, *known);
            walk.offset.fixed += part.offset;
            walk.matrix_stride = part.matrix_stride;
            walk.type = in->words[2 + *known];
            return !part.is_row_major;
        }
        case spv::OpTypeArray:
        case spv::OpTypeRuntimeArray: {
            const auto stride = array_strides_.find(walk.type);
            if (stride == array_strides_.end()) return false;
            walk.add(index, known, stride->second);
            walk.type = in->words[2];
            return true;
        }
        case spv::OpTypeMatrix:
            walk.add(index, known, walk.matrix_stride);
            walk.type = in->words[2];
            return walk.matrix_stride > 0;
        case spv::OpTypeVector:
            walk.type = in->words[2];
            walk.add(index, known, std::uint32_t(bytes(walk.type, 0).value_or(0)));
            return true;
        default:
            return false;
    }
}

std::optional<std::uint64_t> BufferLayouts::bytes(std::uint32_t id, std::uint32_t matrix_stride) const {
    const Instruction* is = type(id);
    if (!is) return {};
    const std::span<const std::uint32_t> words = is->words;
    if (is->op == spv::OpTypeInt || is->op == spv::OpTypeFloat) return words[2] / 8;
    if (is->op == spv::OpTypeVector) {
        const auto component = bytes(words[2], 0);
        return component ? std::optional(*component * words[3]) : component;
    }
    if (is->op == spv::OpTypeMatrix) {
        const auto column = bytes(words[2], 0);
        return column ? std::optional((words[3] - 1) * std::uint64_t{matrix_stride} + *column) : column;
    }
    if (is->op == spv::OpTypeArray) {
        const auto stride = array_strides_.find(id);
        const auto length = constant(words[3]);
        if (stride == array_strides_.end() || !length) return {};
        return std::uint64_t{*length} * stride->second;
    }
    if (is->op != spv::OpTypeStruct) return {};
    std::uint64_t end = 0;
    for (std::uint32_t i = 0; i + 2 < words.size(); ++i) {
        const Member& part = member(id, i);
        const auto size = bytes(words[2 + i], part.matrix_stride);
        if (!size || part.is_row_major) return {};
        end = std::max(end, part.offset + *size);
    }
    return end;
}

std::optional<BlockPart> BufferLayouts::part(std::uint32_t block_type, std::span<const std::uint32_t> indices) const {
    Walk walk{.type = block_type};
    for (const std::uint32_t index : indices)
        if (!step(walk, index)) return {};
    const auto size = bytes(walk.type, walk.matrix_stride);
    return size ? std::optional(BlockPart{std::move(walk.offset), *size}) : std::nullopt;
}

}  // namespace strata
