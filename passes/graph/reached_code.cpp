#include "passes/graph/reached_code.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>

#define SPV_ENABLE_UTILITY_CODE
#include <GLSL.std.450.h>
#include <spirv.hpp>

#include "passes/graph/shader.h"

namespace strata {
namespace {

constexpr std::size_t header_words = 5;

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

std::vector<Instruction> instructions_of(std::span<const std::uint32_t> code) {
    std::vector<Instruction> all;
    for (std::size_t at = header_words; at < code.size();) {
        const std::size_t length = code[at] >> 16;
        if (length == 0 || at + length > code.size()) return {};
        all.push_back({static_cast<spv::Op>(code[at] & 0xffffu), code.subspan(at, length)});
        at += length;
    }
    return all;
}

/// What an operation on constants gives, where it is one that shaders choose branches by.
std::optional<std::uint32_t> result_of(spv::Op op, std::span<const std::uint32_t> in) {
    const std::uint32_t a = in[0], b = in.size() > 1 ? in[1] : 0, c = in.size() > 2 ? in[2] : 0;
    switch (op) {
        case spv::OpLogicalNot:
            return !a;
        case spv::OpNot:
            return ~a;
        case spv::OpIEqual:
        case spv::OpLogicalEqual:
            return a == b;
        case spv::OpINotEqual:
        case spv::OpLogicalNotEqual:
            return a != b;
        case spv::OpUGreaterThan:
            return a > b;
        case spv::OpUGreaterThanEqual:
            return a >= b;
        case spv::OpULessThan:
            return a < b;
        case spv::OpULessThanEqual:
            return a <= b;
        case spv::OpLogicalAnd:
        case spv::OpBitwiseAnd:
            return a & b;
        case spv::OpLogicalOr:
        case spv::OpBitwiseOr:
            return a | b;
        case spv::OpIAdd:
            return a + b;
        case spv::OpISub:
            return a - b;
        case spv::OpSelect:
            return a ? b : c;
        default:
            return {};
    }
}

/// The values of constants that are a 32-bit integer or a bool (0 or 1), by id.
class KnownConstants {
public:
    explicit KnownConstants(std::span<const ConstantBits> given) {
        for (const ConstantBits& constant : given) given_[constant.id] = constant.bits;
    }

    /// To be called for a module's instructions in their order.
    void add(const Instruction& i) {
        const std::span<const std::uint32_t> words = i.words;
        if (i.op == spv::OpDecorate && words[2] == spv::DecorationSpecId) spec_ids_[words[1]] = words[3];
        if (i.op == spv::OpTypeInt && words[2] == 32) integers_.insert(words[1]);
        if (i.op == spv::OpTypeBool) integers_.insert(words[1]);
        const auto result = i.result();
        if (!result || words.size() < 3 || !integers_.contains(words[1])) return;
        if (i.op == spv::OpConstantTrue || i.op == spv::OpConstantFalse) values_[*result] = i.op == spv::OpConstantTrue;
        if (i.op == spv::OpSpecConstantTrue || i.op == spv::OpSpecConstantFalse)
            values_[*result] = given(*result, i.op == spv::OpSpecConstantTrue) != 0;
        if (i.op == spv::OpConstant) values_[*result] = words[3];
        if (i.op == spv::OpSpecConstant) values_[*result] = given(*result, words[3]);
        if (i.op == spv::OpSpecConstantOp) add_operation(*result, static_cast<spv::Op>(words[3]), words.subspan(4));
    }

    std::optional<std::uint32_t> find(std::uint32_t id) const {
        const auto found = values_.find(id);
        return found == values_.end() ? std::nullopt : std::optional(found->second);
    }

private:
    std::uint32_t given(std::uint32_t id, std::uint32_t otherwise) const {
        const auto spec = spec_ids_.find(id);
        const auto found = spec == spec_ids_.end() ? given_.end() : given_.find(spec->second);
        return found == given_.end() ? otherwise : found->second;
    }
    void add_operation(std::uint32_t id, spv::Op op, std::span<const std::uint32_t> operands) {
        std::vector<std::uint32_t> in;
        for (const std::uint32_t operand : operands) {
            const auto value = find(operand);
            if (!value) return;
            in.push_back(*value);
        }
        if (in.empty()) return;
        if (const auto value = result_of(op, in)) values_[id] = *value;
    }

    std::unordered_map<std::uint32_t, std::uint32_t> given_, spec_ids_, values_;
    std::unordered_set<std::uint32_t> integers_;  ///< types
};

/// Where a block's last instruction may lead.
std::vector<std::uint32_t> successors(const Instruction& last, const KnownConstants& constants) {
    const std::span<const std::uint32_t> words = last.words;
    if (last.op == spv::OpBranch) return {words[1]};
    if (last.op == spv::OpBranchConditional) {
        if (const auto taken = constants.find(words[1])) return {*taken ? words[2] : words[3]};
        return {words[2], words[3]};
    }
    std::vector<std::uint32_t> labels;
    if (last.op != spv::OpSwitch) return labels;
    const auto selected = constants.find(words[1]);
    std::uint32_t chosen = words[2];
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
        labels.push_back(words[i + 1]);
        if (selected == words[i]) chosen = words[i + 1];
    }
    labels.push_back(words[2]);
    return selected ? std::vector{chosen} : labels;
}

/// A function: its instructions, and those of the blocks that run.
struct Function {
    std::span<const Instruction> body;                       ///< OpFunction to OpFunctionEnd
    std::vector<std::uint32_t> calls;                        ///< in blocks that run
    std::set<std::size_t> idle_calls;                        ///< in the others, by place in the body
    std::vector<std::span<const Instruction>> running = {};  ///< blocks that run
};

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

Function function_of(std::span<const Instruction> body, const KnownConstants& constants) {
    struct Block {
        std::size_t first = 0, last = 0;
    };
    std::map<std::uint32_t, Block> blocks;
    std::vector<std::uint32_t> next;
    std::uint32_t label = 0;
    for (std::size_t i = 0; i < body.size(); ++i) {
        if (body[i].op == spv::OpLabel) blocks[label = body[i].words[1]].first = i;
        if (label != 0 && next.empty()) next.push_back(label);
        if (label != 0) blocks[label].last = body[i].op == spv::OpFunctionEnd ? i - 1 : i;
    }
    std::set<std::uint32_t> reached(next.begin(), next.end());
    Function function{body, {}, {}};
    while (!next.empty()) {
        const Block block = blocks[next.back()];
        next.pop_back();
        function.running.push_back(body.subspan(block.first, block.last - block.first + 1));
        for (const Instruction& i : function.running.back())
            if (i.op == spv::OpFunctionCall) function.calls.push_back(i.words[3]);
        for (const std::uint32_t to : successors(body[block.last], constants))
            if (reached.insert(to).second) next.push_back(to);
    }
    for (const auto& [id, block] : blocks)
        for (std::size_t i = block.first; i <= block.last && !reached.contains(id); ++i)
            if (body[i].op == spv::OpFunctionCall) function.idle_calls.insert(i);
    return function;
}

/// A module taken apart.
struct Module {
    std::span<const Instruction> head;  ///< all before the first function
    std::map<std::uint32_t, Function> functions;
    std::vector<std::uint32_t> order;  ///< of the functions
    std::set<std::uint32_t> called;    ///< functions that run
    std::set<std::uint32_t> void_types = {};
    std::vector<std::uint32_t> entries = {};
};

Module module_of(std::span<const Instruction> all, std::span<const ConstantBits> given) {
    const auto first = std::ranges::find(all, spv::OpFunction, &Instruction::op);
    Module module{all.first(static_cast<std::size_t>(first - all.begin())), {}, {}, {}, {}};
    KnownConstants constants(given);
    for (const Instruction& i : module.head) {
        constants.add(i);
        if (i.op == spv::OpEntryPoint) module.entries.push_back(i.words[2]);
        if (i.op == spv::OpTypeVoid) module.void_types.insert(i.words[1]);
    }
    for (auto begin = first; begin != all.end();) {
        const auto end = std::find_if(begin, all.end(), [](const Instruction& i) { return i.op == spv::OpFunctionEnd; });
        if (end == all.end()) break;
        module.order.push_back(begin->words[2]);
        module.functions.emplace(begin->words[2], function_of({begin, end + 1}, constants));
        begin = end + 1;
    }
    std::vector<std::uint32_t> next = module.entries;
    module.called.insert(next.begin(), next.end());
    while (!next.empty()) {
        const std::vector<std::uint32_t> calls = module.functions.at(next.back()).calls;
        next.pop_back();
        for (const std::uint32_t callee : calls)
            if (module.called.insert(callee).second) next.push_back(callee);
    }
    return module;
}

/// Of a function with what it calls.
OperationCount count_of(const Module& module, const Components& components, std::uint32_t id) {
    const Function& function = module.functions.at(id);
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
std::unordered_set<std::uint32_t> ids_left_out(const Module& module) {
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
std::unordered_set<std::uint32_t> unwritten_masks(const Module& module) {
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
    const Module module = module_of(all, constants);
    Components components;
    for (const Instruction& i : all) components.add(i);
    return module.entries.empty() ? OperationCount{} : count_of(module, components, module.entries.front());
}

std::vector<std::uint32_t> reached_code(std::span<const std::uint32_t> code, std::span<const ConstantBits> given) {
    const std::vector<Instruction> all = instructions_of(code);
    if (all.empty()) return {code.begin(), code.end()};
    const Module module = module_of(all, given);
    auto left_out = ids_left_out(module);
    const auto masks = unwritten_masks(module);
    left_out.insert(masks.begin(), masks.end());
    std::vector<std::uint32_t> reached(code.begin(), code.begin() + header_words);
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
        const Function& function = module.functions.at(id);
        for (std::size_t i = 0; i < function.body.size(); ++i) {
            const std::span<const std::uint32_t> words = function.body[i].words;
            if (!function.idle_calls.contains(i)) keep(words);
            else if (!module.void_types.contains(words[1])) keep(std::vector{3u << 16 | spv::OpUndef, words[1], words[2]});
        }
    }
    return reached;
}

}  // namespace strata
