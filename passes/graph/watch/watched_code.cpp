#include "passes/graph/watch/watched_code.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "passes/graph/watch/buffer_layout.h"

namespace strata {
namespace {

using Ids = std::vector<std::uint32_t>;

void append(Ids& to, spv::Op op, std::span<const std::uint32_t> operands) {
    to.push_back(static_cast<std::uint32_t>(operands.size() + 1) << 16 | op);
    to.insert(to.end(), operands.begin(), operands.end());
}
void append(Ids& to, spv::Op op, std::initializer_list<std::uint32_t> operands) {
    append(to, op, std::span(operands.begin(), operands.size()));
}

/// The operands of an image instruction that follow its mask, each with as many ids as its bit says.
std::optional<std::uint32_t> sample_operand(std::span<const std::uint32_t> mask_and_operands) {
    if (mask_and_operands.empty()) return {};
    const std::uint32_t mask = mask_and_operands.front();
    std::size_t at = 1;
    for (std::uint32_t bit = 1; bit < spv::ImageOperandsSampleMask; bit <<= 1) {
        const bool has_two = bit == spv::ImageOperandsGradMask;
        if (mask & bit) at += has_two ? 2 : 1;
    }
    return mask & spv::ImageOperandsSampleMask ? std::optional(mask_and_operands[at]) : std::nullopt;
}
bool moves_texels(std::span<const std::uint32_t> mask_and_operands) {
    const std::uint32_t moving =
        spv::ImageOperandsConstOffsetMask | spv::ImageOperandsOffsetMask | spv::ImageOperandsConstOffsetsMask;
    return !mask_and_operands.empty() && (mask_and_operands.front() & moving) != 0;
}

/// Fields of MarkPlace, in their order.
enum Field : std::uint32_t { first_word, units, width, height, samples, first_layer, is_linear, fields = 8 };
static_assert(sizeof(MarkPlace) == fields * sizeof(std::uint32_t));

enum class Kind { read, write };

class Watching {
public:
    Watching(std::span<const std::uint32_t> code, const Watched& watched)
        : code_(code),
          all_(instructions_of(code)),
          watched_(watched.bindings),
          attachments_(watched.attachments),
          slots_(watched.slots),
          bound_(code[3]) {}

    Result<Ids> operator()() {
        read_head();
        if (resources_.empty() && !marks_attachments()) return Ids(code_.begin(), code_.end());
        trace_parameters();
        declare();
        for (std::size_t i = first_function_; i < all_.size(); ++i) {
            if (all_[i].op == spv::OpFunction) function_ = all_[i].words[2];
            if (all_[i].op == spv::OpReturn && function_ == entry_ && marks_attachments()) mark_attachments();
            body_.insert(body_.end(), all_[i].words.begin(), all_[i].words.end());
            watch(all_[i]);
            if (!problem_.empty())
                return fail(Fault::usage, "shader.cannot_be_watched", "it {problem}, which cannot be watched", problem_);
        }
        return assembled();
    }

private:
    /// A watched variable: its binding, and the type that it points to.
    struct Resource {
        std::size_t binding = 0;
        std::uint32_t type = 0;
    };
    struct Pointer {
        std::uint32_t variable = 0;
        Ids indices;
    };
    struct Texel {
        std::uint32_t x = 0, y = 0, layer = 0, sample = 0;
    };

    void read_head();
    void trace_parameters();
    void declare();
    void watch(const Instruction&);
    void watch_image(const Instruction&);
    void watch_buffer(const Instruction&);
    Ids assembled() const;
    bool may_test_early() const;
    bool is_in_buffer(std::uint32_t pointer) const;

    std::set<std::uint32_t> images_at(std::uint32_t id) const;
    void mark(std::uint32_t place, std::uint32_t unit);
    void mark_texel(std::uint32_t place, const Texel&);
    void mark_footprint(std::uint32_t place, std::uint32_t coordinates, bool gathers);
    void mark_words(std::uint32_t pointer, Kind);
    bool marks_attachments() const { return is_fragment_ && !attachments_.empty(); }
    void mark_attachments();
    std::uint32_t coordinates_of_fragment();
    Texel texel_at(std::uint32_t coordinates, std::optional<std::uint32_t> sample);
    /// The place of a resource's marks, where these are made.
    std::optional<std::uint32_t> place(std::uint32_t variable, Kind) const;

    std::uint32_t op(spv::Op, std::uint32_t type, std::initializer_list<std::uint32_t> operands);
    std::uint32_t global(spv::Op, std::initializer_list<std::uint32_t> operands);
    std::uint32_t number(std::uint32_t value);
    std::uint32_t real(float value);
    std::uint32_t field(std::uint32_t place, Field);
    std::uint32_t type_or_new(spv::Op, std::initializer_list<std::uint32_t> operands);
    std::uint32_t component_count(std::uint32_t id) const;
    std::uint32_t component_type(std::uint32_t id) const;
    bool is_arrayed(std::uint32_t variable) const;

    std::span<const std::uint32_t> code_;
    std::vector<Instruction> all_;
    std::span<const WatchedBinding> watched_;
    std::span<const std::uint32_t> attachments_;
    WatchSlots slots_;
    std::uint32_t bound_;
    std::size_t first_function_ = 0, first_type_ = 0;
    BufferLayouts layouts_;
    std::unordered_map<std::uint32_t, Resource> resources_;              ///< by variable
    std::unordered_map<std::uint32_t, std::uint32_t> types_of_;          ///< of results
    std::unordered_map<std::uint32_t, Pointer> pointers_;                ///< into watched blocks
    std::unordered_map<std::uint32_t, std::set<std::uint32_t>> images_;  ///< variables that an image or its pointer may be
    std::unordered_map<std::uint32_t, std::uint32_t> numbers_, reals_;
    Ids decorations_, globals_, body_, interface_;
    std::uint32_t word_ = 0, boolean_ = 0, float_ = 0, word_pointer_ = 0, marks_ = 0, places_ = 0;
    std::uint32_t entry_ = 0, function_ = 0, fragment_coordinates_ = 0;
    std::string problem_;
    bool has_marks_ = false, is_fragment_ = false;
};

void Watching::read_head() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> wanted;
    for (std::size_t i = 0; i < watched_.size(); ++i) wanted[{watched_[i].set, watched_[i].slot}] = i;
    std::unordered_map<std::uint32_t, std::uint32_t> sets, slots;
    for (const Instruction& i : all_) {
        if (i.op == spv::OpFunction) break;
        ++first_function_;
        layouts_.add(i);
        const bool is_type = layouts_.type(i.result().value_or(0)) != nullptr;
        if (first_type_ == 0 && is_type) first_type_ = first_function_ - 1;
        if (i.op == spv::OpEntryPoint) {
            is_fragment_ = i.words[1] == spv::ExecutionModelFragment;
            entry_ = i.words[2];
        }
        if (i.op == spv::OpDecorate && i.words[2] == spv::DecorationBuiltIn && i.words[3] == spv::BuiltInFragCoord)
            fragment_coordinates_ = i.words[1];
        if (i.op == spv::OpDecorate && i.words[2] == spv::DecorationDescriptorSet) sets[i.words[1]] = i.words[3];
        if (i.op == spv::OpDecorate && i.words[2] == spv::DecorationBinding) slots[i.words[1]] = i.words[3];
        if (i.op != spv::OpVariable || !sets.contains(i.words[2])) continue;
        const auto found = wanted.find({sets[i.words[2]], slots[i.words[2]]});
        if (found == wanted.end()) continue;
        resources_[i.words[2]] = {found->second, layouts_.type(i.words[1])->words[3]};
        images_[i.words[2]] = {i.words[2]};
        if (layouts_.type(resources_[i.words[2]].type)->op == spv::OpTypeStruct) pointers_[i.words[2]] = {i.words[2], {}};
    }
    for (const Instruction& i : all_) {
        bool has_result = false, has_type = false;
        spv::HasResultAndType(i.op, &has_result, &has_type);
        if (has_result && has_type) types_of_[i.words[2]] = i.words[1];
    }
}

/// Functions get images as pointers to them: which ones, calls say.
void Watching::trace_parameters() {
    std::unordered_map<std::uint32_t, Ids> parameters;
    std::uint32_t function = 0;
    for (const Instruction& i : all_) {
        if (i.op == spv::OpFunction) function = i.words[2];
        if (i.op == spv::OpFunctionParameter) parameters[function].push_back(i.words[2]);
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (const Instruction& call : all_) {
            if (call.op != spv::OpFunctionCall) continue;
            for (std::size_t a = 4; a < call.words.size(); ++a) {
                const auto given = images_.find(call.words[a]);
                if (given == images_.end()) continue;
                const std::set<std::uint32_t> may_be = given->second;
                auto& known = images_[parameters[call.words[3]][a - 4]];
                const std::size_t before = known.size();
                known.insert(may_be.begin(), may_be.end());
                changed |= known.size() > before;
            }
        }
    }
}

std::uint32_t Watching::type_or_new(spv::Op type, std::initializer_list<std::uint32_t> operands) {
    for (std::size_t i = first_type_; i < first_function_; ++i)
        if (all_[i].op == type && std::ranges::equal(all_[i].words.subspan(2), operands)) return all_[i].words[1];
    const std::uint32_t id = bound_++;
    Ids words{id};
    words.insert(words.end(), operands.begin(), operands.end());
    append(globals_, type, words);
    return id;
}

std::uint32_t Watching::global(spv::Op what, std::initializer_list<std::uint32_t> operands) {
    const std::uint32_t id = bound_++;
    Ids words{id};
    words.insert(words.end(), operands.begin(), operands.end());
    append(globals_, what, words);
    return id;
}

void Watching::declare() {
    word_ = type_or_new(spv::OpTypeInt, {32, 0});
    boolean_ = type_or_new(spv::OpTypeBool, {});
    float_ = type_or_new(spv::OpTypeFloat, {32});
    const std::uint32_t array = global(spv::OpTypeRuntimeArray, {word_});
    const std::uint32_t block = global(spv::OpTypeStruct, {array});
    const std::uint32_t pointer = global(spv::OpTypePointer, {spv::StorageClassStorageBuffer, block});
    word_pointer_ = global(spv::OpTypePointer, {spv::StorageClassStorageBuffer, word_});
    append(decorations_, spv::OpDecorate, {array, spv::DecorationArrayStride, 4});
    append(decorations_, spv::OpDecorate, {block, spv::DecorationBlock});
    append(decorations_, spv::OpMemberDecorate, {block, 0, spv::DecorationOffset, 0});
    const auto variable = [&](std::uint32_t slot) {
        const std::uint32_t id = bound_++;
        append(globals_, spv::OpVariable, {pointer, id, spv::StorageClassStorageBuffer});
        append(decorations_, spv::OpDecorate, {id, spv::DecorationDescriptorSet, slots_.set});
        append(decorations_, spv::OpDecorate, {id, spv::DecorationBinding, slot});
        interface_.push_back(id);
        return id;
    };
    marks_ = variable(slots_.marks);
    places_ = variable(slots_.places);
}

std::uint32_t Watching::op(spv::Op what, std::uint32_t type, std::initializer_list<std::uint32_t> operands) {
    const std::uint32_t id = bound_++;
    Ids words{type, id};
    words.insert(words.end(), operands.begin(), operands.end());
    append(body_, what, words);
    return id;
}

std::uint32_t Watching::number(std::uint32_t value) {
    std::uint32_t& id = numbers_[value];
    if (id == 0) append(globals_, spv::OpConstant, {word_, id = bound_++, value});
    return id;
}

std::uint32_t Watching::real(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    std::uint32_t& id = reals_[bits];
    if (id == 0) append(globals_, spv::OpConstant, {float_, id = bound_++, bits});
    return id;
}

std::uint32_t Watching::field(std::uint32_t place, Field which) {
    return op(spv::OpLoad, word_, {op(spv::OpAccessChain, word_pointer_, {places_, number(0), number(place * fields + which)})});
}

std::uint32_t Watching::component_type(std::uint32_t id) const {
    const Instruction* type = layouts_.type(types_of_.at(id));
    return type->op == spv::OpTypeVector ? type->words[2] : type->words[1];
}

std::uint32_t Watching::component_count(std::uint32_t id) const {
    const Instruction* type = layouts_.type(types_of_.at(id));
    return type->op == spv::OpTypeVector ? type->words[3] : 1;
}

std::optional<std::uint32_t> Watching::place(std::uint32_t variable, Kind kind) const {
    const std::size_t binding = resources_.at(variable).binding;
    std::uint32_t place = 0;
    for (std::size_t i = 0; i < binding; ++i) place += std::uint32_t{watched_[i].reads} + std::uint32_t{watched_[i].writes};
    const WatchedBinding& watched = watched_[binding];
    if (kind == Kind::read) return watched.reads ? std::optional(place) : std::nullopt;
    return watched.writes ? std::optional(place + watched.reads) : std::nullopt;
}

void Watching::mark(std::uint32_t place, std::uint32_t unit) {
    has_marks_ = true;
    const std::uint32_t end = field(place, units);
    const std::uint32_t is_inside = op(spv::OpULessThan, boolean_, {unit, end});
    const std::uint32_t bit = op(spv::OpSelect, word_, {is_inside, unit, end});
    const std::uint32_t word =
        op(spv::OpIAdd, word_, {field(place, first_word), op(spv::OpShiftRightLogical, word_, {bit, number(5)})});
    const std::uint32_t mask = op(spv::OpShiftLeftLogical, word_, {number(1), op(spv::OpBitwiseAnd, word_, {bit, number(31)})});
    const std::uint32_t pointer = op(spv::OpAccessChain, word_pointer_, {marks_, number(0), word});
    op(spv::OpAtomicOr, word_, {pointer, number(spv::ScopeDevice), number(spv::MemorySemanticsMaskNone), mask});
}

void Watching::mark_texel(std::uint32_t place, const Texel& at) {
    const std::uint32_t wide = field(place, width), high = field(place, height);
    const std::uint32_t is_inside =
        op(spv::OpLogicalAnd, boolean_,
           {op(spv::OpULessThan, boolean_, {at.x, wide}), op(spv::OpULessThan, boolean_, {at.y, high})});
    const std::uint32_t layer = op(spv::OpIAdd, word_, {at.layer, field(place, first_layer)});
    const std::uint32_t row = op(spv::OpIAdd, word_, {op(spv::OpIMul, word_, {layer, high}), at.y});
    const std::uint32_t texel = op(spv::OpIAdd, word_, {op(spv::OpIMul, word_, {row, wide}), at.x});
    const std::uint32_t unit = op(spv::OpIAdd, word_, {op(spv::OpIMul, word_, {texel, field(place, samples)}), at.sample});
    mark(place, op(spv::OpSelect, word_, {is_inside, unit, field(place, units)}));
}

Watching::Texel Watching::texel_at(std::uint32_t coordinates, std::optional<std::uint32_t> sample) {
    const std::uint32_t type = component_type(coordinates);
    const auto part = [&](std::uint32_t index) { return op(spv::OpCompositeExtract, type, {coordinates, index}); };
    return {part(0), part(1), component_count(coordinates) > 2 ? part(2) : number(0), sample.value_or(number(0))};
}

/// Of a sampler whose coordinates go from 0 to 1 and are clamped to the edge.
void Watching::mark_footprint(std::uint32_t place, std::uint32_t coordinates, bool gathers) {
    const std::uint32_t linear = gathers ? number(1) : field(place, is_linear);
    const std::uint32_t half = op(spv::OpFMul, float_, {op(spv::OpConvertUToF, float_, {linear}), real(.5f)});
    std::array<std::array<std::uint32_t, 2>, 2> ends{};
    for (std::uint32_t axis = 0; axis < 2; ++axis) {
        const std::uint32_t size = field(place, axis == 0 ? width : height);
        const std::uint32_t last = op(spv::OpISub, word_, {size, number(1)});
        const std::uint32_t last_real = op(spv::OpConvertUToF, float_, {last});
        const std::uint32_t given = op(spv::OpCompositeExtract, float_, {coordinates, axis});
        const std::uint32_t scaled = op(spv::OpFMul, float_, {given, op(spv::OpConvertUToF, float_, {size})});
        const std::uint32_t moved = op(spv::OpFSub, float_, {scaled, half});
        const std::uint32_t is_in = op(spv::OpFOrdGreaterThanEqual, boolean_, {moved, real(0)});  // not NaN, either
        const std::uint32_t low = op(spv::OpSelect, float_, {is_in, moved, real(0)});
        const std::uint32_t is_far = op(spv::OpFOrdGreaterThan, boolean_, {low, last_real});
        const std::uint32_t first = op(spv::OpConvertFToU, word_, {op(spv::OpSelect, float_, {is_far, last_real, low})});
        const std::uint32_t next = op(spv::OpIAdd, word_, {first, op(spv::OpSelect, word_, {is_in, linear, number(0)})});
        const std::uint32_t is_next_in = op(spv::OpULessThan, boolean_, {next, last});
        ends[axis] = {first, op(spv::OpSelect, word_, {is_next_in, next, last})};
    }
    std::uint32_t layer = number(0);
    if (component_count(coordinates) > 2) {
        const std::uint32_t given = op(spv::OpCompositeExtract, float_, {coordinates, 2});
        layer = op(spv::OpConvertFToU, word_, {op(spv::OpFAdd, float_, {given, real(.5f)})});
    }
    for (const std::uint32_t y : ends[1])
        for (const std::uint32_t x : ends[0]) mark_texel(place, {x, y, layer, number(0)});
}

/// gl_FragCoord.
std::uint32_t Watching::coordinates_of_fragment() {
    const std::uint32_t type = type_or_new(spv::OpTypeVector, {float_, 4});
    if (fragment_coordinates_ == 0) {
        const std::uint32_t pointer = global(spv::OpTypePointer, {spv::StorageClassInput, type});
        fragment_coordinates_ = bound_++;
        append(globals_, spv::OpVariable, {pointer, fragment_coordinates_, spv::StorageClassInput});
        append(decorations_, spv::OpDecorate, {fragment_coordinates_, spv::DecorationBuiltIn, spv::BuiltInFragCoord});
        interface_.push_back(fragment_coordinates_);
    }
    return op(spv::OpLoad, type, {fragment_coordinates_});
}

/// Where a fragment ends that was not discarded.
void Watching::mark_attachments() {
    std::uint32_t place = 0;
    for (const WatchedBinding& binding : watched_) place += std::uint32_t{binding.reads} + std::uint32_t{binding.writes};
    const std::uint32_t at = coordinates_of_fragment();
    const auto part = [&](std::uint32_t index) {
        return op(spv::OpConvertFToU, word_, {op(spv::OpCompositeExtract, float_, {at, index})});
    };
    const std::uint32_t x = part(0), y = part(1);
    for (const std::uint32_t sample_count : attachments_) {
        for (std::uint32_t sample = 0; sample < sample_count; ++sample) mark_texel(place, {x, y, number(0), number(sample)});
        ++place;
    }
}

/// All words of what the pointer points at.
void Watching::mark_words(std::uint32_t pointer, Kind kind) {
    const auto found = pointers_.find(pointer);
    if (found == pointers_.end()) return;
    const auto at = place(found->second.variable, kind);
    if (!at) return;
    const auto part = layouts_.part(resources_.at(found->second.variable).type, found->second.indices);
    if (!part) {
        problem_ = "reads a part of a buffer whose size its types do not say";
        return;
    }
    std::uint32_t offset = number(std::uint32_t(part->offset.fixed));
    for (const auto& [index, stride] : part->offset.scaled)
        offset = op(spv::OpIAdd, word_, {offset, op(spv::OpIMul, word_, {index, number(stride)})});
    const std::uint32_t first = op(spv::OpShiftRightLogical, word_, {offset, number(2)});
    for (std::uint32_t word = 0; word < (part->bytes + 3) / 4; ++word)
        mark(*at, word == 0 ? first : op(spv::OpIAdd, word_, {first, number(word)}));
}

std::set<std::uint32_t> Watching::images_at(std::uint32_t id) const {
    const auto found = images_.find(id);
    return found == images_.end() ? std::set<std::uint32_t>() : found->second;
}

void Watching::watch_image(const Instruction& i) {
    const std::span<const std::uint32_t> words = i.words;
    const bool writes = i.op == spv::OpImageWrite;
    const std::size_t image = writes ? 1 : 3, behind_coordinates = i.op == spv::OpImageGather ? 6 : writes ? 4 : 5;
    const bool is_sampled = i.op == spv::OpImageSampleExplicitLod || i.op == spv::OpImageGather;
    const auto rest = words.subspan(std::min(behind_coordinates, words.size()));
    for (const std::uint32_t variable : images_at(words[image])) {
        const auto at = place(variable, writes ? Kind::write : Kind::read);
        if (!at) continue;
        if (moves_texels(rest)) problem_ = "reads an image beside its coordinates";
        else if (is_sampled) mark_footprint(*at, words[image + 1], i.op == spv::OpImageGather);
        else mark_texel(*at, texel_at(words[image + 1], sample_operand(rest)));
    }
}

void Watching::watch_buffer(const Instruction& i) {
    const std::span<const std::uint32_t> words = i.words;
    if (i.op == spv::OpLoad) return mark_words(words[3], Kind::read);
    if (i.op == spv::OpStore) return mark_words(words[1], Kind::write);
    mark_words(words[3], Kind::read);  // an atomic operation
    if (i.op != spv::OpAtomicLoad) mark_words(words[3], Kind::write);
}

void Watching::watch(const Instruction& i) {
    const std::span<const std::uint32_t> words = i.words;
    const auto may_be = [&](std::uint32_t id) { return !images_at(id).empty(); };
    switch (i.op) {
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain:
            if (const auto from = pointers_.find(words[3]); from != pointers_.end()) {
                Pointer made = from->second;
                made.indices.insert(made.indices.end(), words.begin() + 4, words.end());
                pointers_[words[2]] = std::move(made);
            }
            return;
        case spv::OpLoad:
            if (may_be(words[3])) images_[words[2]] = images_at(words[3]);
            return watch_buffer(i);
        case spv::OpImage:
        case spv::OpSampledImage:
            if (may_be(words[3])) images_[words[2]] = images_at(words[3]);
            return;
        case spv::OpStore:
            return watch_buffer(i);
        case spv::OpImageFetch:
        case spv::OpImageRead:
        case spv::OpImageWrite:
        case spv::OpImageGather:
        case spv::OpImageSampleExplicitLod:
            return watch_image(i);
        case spv::OpImageTexelPointer:
            for (const std::uint32_t variable : images_at(words[3]))
                for (const Kind kind : {Kind::read, Kind::write})
                    if (const auto at = place(variable, kind)) mark_texel(*at, texel_at(words[4], words[5]));
            return;
        default:
            if (i.op >= spv::OpAtomicLoad && i.op <= spv::OpAtomicXor && i.op != spv::OpAtomicStore) return watch_buffer(i);
            if (i.op == spv::OpAtomicStore) return mark_words(words[1], Kind::write);
            if (i.op >= spv::OpImageSampleImplicitLod && i.op <= spv::OpImageDrefGather && may_be(words[3]))
                problem_ = "reads an image at a level that the device chooses";
            if (i.op == spv::OpCopyMemory && pointers_.contains(words[2])) problem_ = "copies memory";
    }
}

/// Whether a fragment shader may run behind the depth test, where its marks alone would have it run before.
bool Watching::may_test_early() const {
    std::set<std::uint32_t> depths_and_masks;
    for (const Instruction& i : all_) {
        const std::span<const std::uint32_t> words = i.words;
        const bool is_atomic = i.op >= spv::OpAtomicLoad && i.op <= spv::OpAtomicXor;
        const bool ends = i.op == spv::OpKill || i.op == spv::OpTerminateInvocation || i.op == spv::OpDemoteToHelperInvocation;
        if (ends || is_atomic || i.op == spv::OpImageWrite) return false;
        if (i.op == spv::OpEntryPoint && words[1] != spv::ExecutionModelFragment) return false;
        if (i.op == spv::OpExecutionMode && words[2] == spv::ExecutionModeEarlyFragmentTests) return false;  // it does
        const bool is_builtin = i.op == spv::OpDecorate && words[2] == spv::DecorationBuiltIn;
        if (is_builtin && (words[3] == spv::BuiltInFragDepth || words[3] == spv::BuiltInSampleMask))
            depths_and_masks.insert(words[1]);
        if (i.op == spv::OpVariable && words[3] == spv::StorageClassOutput && depths_and_masks.contains(words[2])) return false;
        if (i.op == spv::OpStore && is_in_buffer(words[1])) return false;
    }
    return true;
}

bool Watching::is_in_buffer(std::uint32_t pointer) const {
    const auto type = types_of_.find(pointer);
    return type != types_of_.end() && layouts_.type(type->second)->words[2] == spv::StorageClassStorageBuffer;
}

Ids Watching::assembled() const {
    Ids made(code_.begin(), code_.begin() + spirv_header_words);
    made[3] = bound_;
    for (std::size_t i = 0; i < first_function_; ++i) {
        if (i == first_type_) made.insert(made.end(), decorations_.begin(), decorations_.end());
        const std::span<const std::uint32_t> words = all_[i].words;
        if (all_[i].op != spv::OpEntryPoint) {
            made.insert(made.end(), words.begin(), words.end());
            continue;
        }
        Ids operands(words.begin() + 1, words.end());
        operands.insert(operands.end(), interface_.begin(), interface_.end());
        append(made, spv::OpEntryPoint, operands);
        if (has_marks_ && may_test_early()) append(made, spv::OpExecutionMode, {words[2], spv::ExecutionModeEarlyFragmentTests});
    }
    made.insert(made.end(), globals_.begin(), globals_.end());
    made.insert(made.end(), body_.begin(), body_.end());
    return made;
}

}  // namespace

Result<std::vector<std::uint32_t>> watched_code(std::span<const std::uint32_t> code, const Watched& watched) {
    return Watching(code, watched)();
}

}  // namespace strata
