#include "passes/graph/known_constants.h"

#include <algorithm>
#include <vector>

#include "passes/graph/reached_code.h"
#include "passes/graph/running_blocks.h"

namespace strata {
namespace {

/// Of operands that are all known.
Value result_of_known(spv::Op op, std::span<const std::uint32_t> in) {
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
        case spv::OpShiftLeftLogical:
            return b < 32 ? std::optional(a << b) : std::nullopt;
        case spv::OpShiftRightLogical:
            return b < 32 ? std::optional(a >> b) : std::nullopt;
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

}  // namespace

Value result_of(spv::Op op, std::span<const Value> in) {
    const auto has = [&](std::uint32_t value) { return std::ranges::find(in, Value(value)) != in.end(); };
    if (op == spv::OpSelect && in[0]) return in[*in[0] ? 1 : 2];
    if ((op == spv::OpLogicalAnd || op == spv::OpBitwiseAnd) && has(0)) return 0;
    if (op == spv::OpLogicalOr && has(1)) return 1;
    std::vector<std::uint32_t> known;
    for (const Value& one : in) {
        if (!one) return {};
        known.push_back(*one);
    }
    return known.empty() ? Value() : result_of_known(op, known);
}

KnownConstants::KnownConstants(std::span<const ConstantBits> given) {
    for (const ConstantBits& constant : given) given_[constant.id] = constant.bits;
}

void KnownConstants::add(const Instruction& i) {
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
    if (i.op != spv::OpSpecConstantOp) return;
    std::vector<Value> in;
    for (const std::uint32_t operand : words.subspan(4)) in.push_back(find(operand));
    if (const Value value = result_of(static_cast<spv::Op>(words[3]), in)) values_[*result] = *value;
}

std::uint32_t KnownConstants::given(std::uint32_t id, std::uint32_t otherwise) const {
    const Value spec = found_in(spec_ids_, id);
    return spec ? found_in(given_, *spec).value_or(otherwise) : otherwise;
}

}  // namespace strata
