#include "passes/graph/reached_code.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>
#include <unordered_set>

#include <GLSL.std.450.h>

#include "passes/graph/running_blocks.h"
#include "passes/graph/shader.h"

namespace strata {
namespace {

/// Numbers that values consist of.
class Components {
public:
    /// To be called for a module's instructions in their order.
    void add(const Instruction& i) {
        const std::span<const std::uint32_t> words = i.words;
        if (i.op == spv::OpTypeVector) of_type_[words[1]] = words[3];
        if (i.op == spv::OpTypeMatrix) of_type_[words[1]] = words[3] * of_type(words[2]);
        bool has_result = false, has_type = false;
        spv::HasResultAndType(i.op, &has_result, &has_type);
        if (has_result && has_type) of_value_[words[2]] = of_type(words[1]);
    }
    std::uint64_t of_type(std::uint32_t id) const { return found(of_type_, id); }
    std::uint64_t of_value(std::uint32_t id) const { return found(of_value_, id); }

private:
    static std::uint64_t found(const std::unordered_map<std::uint32_t, std::uint64_t>& in, std::uint32_t id) {
        const auto at = in.find(id);
        return at == in.end() ? 1 : at->second;
    }
    std::unordered_map<std::uint32_t, std::uint64_t> of_type_, of_value_;
};

/// Of a square matrix of so many numbers.
std::uint64_t side_of(std::uint64_t numbers) { return numbers == 4 ? 2 : numbers == 9 ? 3 : 4; }

/// Products and sums of an instruction; 0 for what computes nothing.
std::uint64_t operations_of(const Instruction& i, const Components& components) {
    const auto between = [&](spv::Op first, spv::Op last) { return i.op >= first && i.op <= last; };
    const std::span<const std::uint32_t> words = i.words;
    switch (i.op) {
        case spv::OpDot:
            return 2 * components.of_value(words[3]) - 1;
        case spv::OpMatrixTimesVector:
            return 2 * components.of_value(words[3]) - components.of_type(words[1]);
        case spv::OpVectorTimesMatrix:
            return 2 * components.of_value(words[4]) - components.of_type(words[1]);
        case spv::OpMatrixTimesMatrix:  // square ones, as all of ours: products are the third power of the side
            return 2 * components.of_type(words[1]) * side_of(components.of_type(words[1])) - components.of_type(words[1]);
        case spv::OpExtInst:
            return components.of_type(words[1]) * (words[4] == GLSLstd450Fma ? 2 : 1);
        default:
            break;
    }
    const bool computes = between(spv::OpConvertFToU, spv::OpQuantizeToF16) || between(spv::OpSNegate, spv::OpDot) ||
                          between(spv::OpAny, spv::OpFUnordGreaterThanEqual) ||
                          between(spv::OpShiftRightLogical, spv::OpBitCount);
    return computes ? components.of_type(words[1]) : 0;
}

/// Of a function with what it calls.
OperationCount count_of(const RunningModule& module, const Components& components, std::uint32_t id) {
    const RunningFunction& function = module.functions.at(id);
    OperationCount count;
    for (const std::span<const Instruction> block : function.running)
        for (const Instruction& i : block) {
            count.operations += operations_of(i, components);
            count.loops += i.op == spv::OpLoopMerge;
        }
    for (const std::uint32_t callee : function.calls) {
        const OperationCount called = count_of(module, components, callee);  // SPIR-V has no recursion
        count.operations += called.operations;
        count.loops += called.loops;
    }
    return count;
}

/// What the functions that are left out define: names and decorations of it go, too.
std::unordered_set<std::uint32_t> ids_left_out(const RunningModule& module) {
    std::unordered_set<std::uint32_t> ids;
    for (const auto& [id, function] : module.functions) {
        for (std::size_t i = 0; i < function.body.size(); ++i) {
            const bool is_void_call = function.idle_calls.contains(i) && module.void_types.contains(function.body[i].words[1]);
            if (module.called.contains(id) && !is_void_call) continue;
            if (const auto result = function.body[i].result()) ids.insert(*result);
        }
    }
    return ids;
}

/// Outputs of sample masks that no function writes any more: undefined, and lavapipe 22.3 covers no sample by them.
std::unordered_set<std::uint32_t> unwritten_masks(const RunningModule& module) {
    std::unordered_set<std::uint32_t> masks, outputs;
    for (const Instruction& i : module.head) {
        const bool is_builtin = i.op == spv::OpDecorate && i.words[2] == spv::DecorationBuiltIn;
        if (is_builtin && i.words[3] == spv::BuiltInSampleMask) masks.insert(i.words[1]);
        if (i.op == spv::OpVariable && i.words[3] == spv::StorageClassOutput) outputs.insert(i.words[2]);
    }
    std::erase_if(masks, [&](std::uint32_t id) { return !outputs.contains(id); });
    for (const std::uint32_t id : module.called)
        for (const Instruction& i : module.functions.at(id).body) {
            if (i.op == spv::OpStore) masks.erase(i.words[1]);
            if (i.op == spv::OpAccessChain) masks.erase(i.words[3]);
        }
    return masks;
}

/// An OpEntryPoint that does not name these variables: they follow its name, which ends with a zero byte.
std::vector<std::uint32_t> entry_without(std::span<const std::uint32_t> words,
                                         const std::unordered_set<std::uint32_t>& variables) {
    std::size_t end_of_name = 3;
    while (words[end_of_name] >> 24 != 0) ++end_of_name;
    std::vector<std::uint32_t> entry(words.begin(), words.end());
    entry.erase(std::remove_if(entry.begin() + std::ptrdiff_t(end_of_name) + 1, entry.end(),
                               [&](std::uint32_t id) { return variables.contains(id); }),
                entry.end());
    entry[0] = static_cast<std::uint32_t>(entry.size()) << 16 | spv::OpEntryPoint;
    return entry;
}

}  // namespace

std::vector<ConstantBits> fixed_constants(const Shader& shader, const Step& step) {
    std::vector<ConstantBits> found;
    for (const ShaderConstant& constant : shader.constants) {
        const auto fixed = std::ranges::find(step.fixed, constant.name, &Fixed::name);
        if (fixed == step.fixed.end()) continue;
        found.push_back({.id = constant.id});
        std::visit([&](auto number) { std::memcpy(&found.back().bits, &number, sizeof number); }, fixed->value);
    }
    return found;
}

OperationCount count_operations(std::span<const std::uint32_t> code, std::span<const ConstantBits> constants) {
    const std::vector<Instruction> all = instructions_of(code);
    const RunningModule module = running_blocks(all, constants);
    Components components;
    for (const Instruction& i : all) components.add(i);
    return module.entries.empty() ? OperationCount{} : count_of(module, components, module.entries.front());
}

std::vector<std::uint32_t> reached_code(std::span<const std::uint32_t> code, std::span<const ConstantBits> given) {
    const std::vector<Instruction> all = instructions_of(code);
    if (all.empty()) return {code.begin(), code.end()};
    const RunningModule module = running_blocks(all, given);
    auto left_out = ids_left_out(module);
    const auto masks = unwritten_masks(module);
    left_out.insert(masks.begin(), masks.end());
    std::vector<std::uint32_t> reached(code.begin(), code.begin() + spirv_header_words);
    const auto keep = [&](std::span<const std::uint32_t> words) { reached.insert(reached.end(), words.begin(), words.end()); };
    for (const Instruction& i : module.head) {
        const bool is_about_an_id = i.op == spv::OpName || i.op == spv::OpDecorate;
        if (is_about_an_id && left_out.contains(i.words[1])) continue;
        if (i.op == spv::OpVariable && masks.contains(i.words[2])) continue;
        if (i.op == spv::OpEntryPoint) keep(entry_without(i.words, masks));
        else keep(i.words);
    }
    for (const std::uint32_t id : module.order) {
        if (!module.called.contains(id)) continue;
        const RunningFunction& function = module.functions.at(id);
        for (std::size_t i = 0; i < function.body.size(); ++i) {
            const std::span<const std::uint32_t> words = function.body[i].words;
            if (!function.idle_calls.contains(i)) keep(words);
            else if (!module.void_types.contains(words[1])) keep(std::vector{3u << 16 | spv::OpUndef, words[1], words[2]});
        }
    }
    return reached;
}

}  // namespace strata
