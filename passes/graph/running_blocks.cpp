#include "passes/graph/running_blocks.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "passes/graph/known_constants.h"

namespace strata {
namespace {

/// Where a block's last instruction may lead.
template <typename Find>
std::vector<std::uint32_t> successors(const Instruction& last, const Find& find) {
    const std::span<const std::uint32_t> words = last.words;
    if (last.op == spv::OpBranch) return {words[1]};
    if (last.op == spv::OpBranchConditional) {
        if (const auto taken = find(words[1])) return {*taken ? words[2] : words[3]};
        return {words[2], words[3]};
    }
    std::vector<std::uint32_t> labels;
    if (last.op != spv::OpSwitch) return labels;
    const auto selected = find(words[1]);
    std::uint32_t chosen = words[2];
    for (std::size_t i = 3; i + 1 < words.size(); i += 2) {
        labels.push_back(words[i + 1]);
        if (selected == words[i]) chosen = words[i + 1];
    }
    labels.push_back(words[2]);
    return selected ? std::vector{chosen} : labels;
}

using Pointers = std::set<std::uint32_t>;

/// What of a function does not depend on values.
struct Body {
    struct Block {
        std::uint32_t label = 0;
        std::size_t first = 0, last = 0;  ///< places in the code
    };
    std::span<const Instruction> code;  ///< OpFunction to OpFunctionEnd
    std::vector<Block> blocks = {};
    std::map<std::uint32_t, std::size_t> places = {};  ///< of blocks, by label
    std::vector<std::uint32_t> parameters = {};
    std::set<std::uint32_t> parameter_pointers = {};  ///< those of the parameters that are pointers
    Pointers pointers = {};                           ///< that hold one value, whichever blocks run

    std::span<const Instruction> in(std::size_t block) const {
        return code.subspan(blocks[block].first, blocks[block].last - blocks[block].first + 1);
    }
};

Body body_of(std::span<const Instruction> code, const std::set<std::uint32_t>& pointer_types) {
    Body body{code};
    for (std::size_t i = 0; i < code.size(); ++i) {
        if (code[i].op == spv::OpFunctionParameter) {
            body.parameters.push_back(code[i].words[2]);
            if (pointer_types.contains(code[i].words[1])) body.parameter_pointers.insert(code[i].words[2]);
        }
        if (code[i].op == spv::OpLabel) {
            body.places[code[i].words[1]] = body.blocks.size();
            body.blocks.push_back({code[i].words[1], i, i});
        }
        if (!body.blocks.empty() && code[i].op != spv::OpFunctionEnd) body.blocks.back().last = i;
    }
    return body;
}

/// A call that runs, with what is known of its arguments: their values or, of pointers, what these hold.
struct Call {
    std::uint32_t callee = 0;
    std::vector<Value> arguments;
};

class Analysis {
public:
    Analysis(std::span<const Instruction> all, std::span<const ConstantBits> given);
    RunningModule module();

private:
    struct Outcome {
        std::vector<std::size_t> running;  ///< blocks
        std::vector<Call> calls;
        Value result;
    };
    /// One way through a function.
    struct Walk {
        const Body* body;
        Pointers pointers;
        std::size_t block = 0;
        Values values = {}, held = {};
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges = {};  ///< from a block to a block
        std::set<Value> results = {};
        unsigned depth = 0;
        Outcome outcome = {};
    };

    void visit(std::uint32_t function, std::set<std::uint32_t>& seen);
    /// Parameters and variables that hold one value all the time: of their only store in the blocks.
    Pointers pointers_in(const Body&, std::span<const std::size_t> blocks) const;
    Value find(const Walk&, std::uint32_t id) const;
    Outcome run(const Body&, const std::vector<Value>& arguments, unsigned depth) const;
    Outcome run(Walk) const;
    void run_block(Walk&) const;
    Value value_of(Walk&, const Instruction&) const;
    Value chosen(const Walk&, const Instruction& phi) const;
    Value returned(Walk&, const Instruction& call) const;
    static Outcome all_of(const Body&);

    std::span<const Instruction> head_;
    KnownConstants constants_;
    std::set<std::uint32_t> pointer_types_;
    std::vector<std::uint32_t> order_, callees_first_;
    std::map<std::uint32_t, Body> bodies_;
};

Analysis::Analysis(std::span<const Instruction> all, std::span<const ConstantBits> given) : constants_(given) {
    const auto first = std::ranges::find(all, spv::OpFunction, &Instruction::op);
    head_ = {all.begin(), first};
    for (const Instruction& i : head_) {
        constants_.add(i);
        if (i.op == spv::OpTypePointer) pointer_types_.insert(i.words[1]);
    }
    for (auto begin = first; begin != all.end();) {
        const auto end = std::find_if(begin, all.end(), [](const Instruction& i) { return i.op == spv::OpFunctionEnd; });
        if (end == all.end()) break;
        order_.push_back(begin->words[2]);
        bodies_.emplace(begin->words[2], body_of({begin, end + 1}, pointer_types_));
        begin = end + 1;
    }
    std::set<std::uint32_t> seen;
    for (const std::uint32_t id : order_) visit(id, seen);
    for (const std::uint32_t id : callees_first_) {
        Body& body = bodies_.at(id);
        body.pointers = pointers_in(body, all_of(body).running);
    }
}

void Analysis::visit(std::uint32_t function, std::set<std::uint32_t>& seen) {
    if (!seen.insert(function).second) return;
    for (const Instruction& i : bodies_.at(function).code)
        if (i.op == spv::OpFunctionCall) visit(i.words[3], seen);
    callees_first_.push_back(function);
}

/// Counts what writes each. Whatever is not a load, a store or a call that only reads may write.
Pointers Analysis::pointers_in(const Body& body, std::span<const std::size_t> blocks) const {
    constexpr unsigned many = 2;
    std::unordered_map<std::uint32_t, unsigned> writes;
    for (const std::uint32_t parameter : body.parameter_pointers) writes[parameter] = 1;  // by the caller
    for (const Instruction& i : body.code)
        if (i.op == spv::OpVariable) writes[i.words[2]] = i.words.size() > 4 ? many : 0;
    const auto write = [&](std::uint32_t id, unsigned times) {
        if (const auto found = writes.find(id); found != writes.end()) found->second += times;
    };
    const auto add = [&](const Instruction& i) {
        if (i.op == spv::OpVariable || i.op == spv::OpLoad) return;
        if (i.op == spv::OpStore) return write(i.words[1], 1);
        if (i.op != spv::OpFunctionCall) {
            for (const std::uint32_t word : i.words.subspan(1)) write(word, many);
            return;
        }
        const Body& callee = bodies_.at(i.words[3]);
        for (std::size_t k = 0; k < callee.parameters.size(); ++k)
            if (!callee.pointers.contains(callee.parameters[k])) write(i.words[4 + k], many);
    };
    for (const std::size_t block : blocks) std::ranges::for_each(body.in(block), add);
    Pointers pointers;
    for (const auto& [id, times] : writes)
        if (times < many) pointers.insert(id);
    return pointers;
}

Value Analysis::find(const Walk& walk, std::uint32_t id) const {
    const Value value = found_in(walk.values, id);
    return value ? value : constants_.find(id);
}

/// The value of a phi: that of the edges that are taken, where they agree. Of loops nothing is known.
Value Analysis::chosen(const Walk& walk, const Instruction& phi) const {
    const Body::Block& block = walk.body->blocks[walk.block];
    Value all;
    for (std::size_t i = 3; i + 1 < phi.words.size(); i += 2) {
        if (walk.body->places.at(phi.words[i + 1]) >= walk.block) return {};
        if (!walk.edges.contains({phi.words[i + 1], block.label})) continue;
        const Value one = find(walk, phi.words[i]);
        if (!one || (all && all != one)) return {};
        all = one;
    }
    return all;
}

/// Notes the call. Small functions are asked for what they return to just this caller.
Value Analysis::returned(Walk& walk, const Instruction& call) const {
    constexpr std::size_t small = 64;  // instructions
    constexpr unsigned deepest = 4;
    Call made{call.words[3], {}};
    for (const std::uint32_t argument : call.words.subspan(4)) {
        const Value held = found_in(walk.held, argument);
        made.arguments.push_back(held ? held : find(walk, argument));
    }
    const Body& callee = bodies_.at(made.callee);
    Value result;
    if (callee.code.size() <= small && walk.depth < deepest) result = run(callee, made.arguments, walk.depth + 1).result;
    walk.outcome.calls.push_back(std::move(made));
    return result;
}

Value Analysis::value_of(Walk& walk, const Instruction& i) const {
    if (i.op == spv::OpFunctionCall) return returned(walk, i);
    if (i.op == spv::OpLoad) return found_in(walk.held, i.words[3]);
    if (i.words.size() < 4 || !i.result() || !constants_.is_integer(i.words[1])) return {};
    if (i.op == spv::OpPhi) return chosen(walk, i);
    std::vector<Value> in;
    for (const std::uint32_t operand : i.words.subspan(3)) in.push_back(find(walk, operand));
    return result_of(i.op, in);
}

void Analysis::run_block(Walk& walk) const {
    for (const Instruction& i : walk.body->in(walk.block)) {
        if (i.op == spv::OpStore && walk.pointers.contains(i.words[1])) {
            if (const Value value = find(walk, i.words[2])) walk.held[i.words[1]] = *value;
        } else if (i.op == spv::OpReturnValue) {
            walk.results.insert(find(walk, i.words[1]));
        } else if (const Value value = value_of(walk, i)) {
            walk.values[*i.result()] = *value;
        }
    }
}

/// Blocks stand after what they follow but for the heads of loops. Where they do not, nothing is known.
Analysis::Outcome Analysis::all_of(const Body& body) {
    Outcome outcome;
    for (std::size_t i = 0; i < body.blocks.size(); ++i) outcome.running.push_back(i);
    for (const Instruction& i : body.code)
        if (i.op == spv::OpFunctionCall) outcome.calls.push_back({i.words[3], std::vector<Value>(i.words.size() - 4)});
    return outcome;
}

Analysis::Outcome Analysis::run(Walk walk) const {
    const Body& body = *walk.body;
    std::set<std::uint32_t> reached = {body.blocks.front().label};
    for (walk.block = 0; walk.block < body.blocks.size(); ++walk.block) {
        const Body::Block& block = body.blocks[walk.block];
        if (!reached.contains(block.label)) continue;
        walk.outcome.running.push_back(walk.block);
        run_block(walk);
        for (const std::uint32_t to : successors(body.code[block.last], [&](std::uint32_t id) { return find(walk, id); })) {
            walk.edges.insert({block.label, to});
            if (reached.insert(to).second && body.places.at(to) <= walk.block) return all_of(body);
        }
    }
    if (walk.results.size() == 1) walk.outcome.result = *walk.results.begin();
    return walk.outcome;
}

/// Again as long as blocks that do not run leave more variables with one value.
Analysis::Outcome Analysis::run(const Body& body, const std::vector<Value>& arguments, unsigned depth) const {
    Walk walk{&body, body.pointers};
    walk.depth = depth;
    while (true) {
        for (std::size_t k = 0; k < arguments.size(); ++k) {
            const std::uint32_t id = body.parameters[k];
            const bool is_pointer = body.parameter_pointers.contains(id);
            if (!arguments[k] || (is_pointer && !walk.pointers.contains(id))) continue;
            (is_pointer ? walk.held : walk.values)[id] = *arguments[k];
        }
        Outcome outcome = run(walk);
        Pointers pointers = pointers_in(body, outcome.running);
        if (pointers.size() <= walk.pointers.size()) return outcome;
        walk.pointers = std::move(pointers);
    }
}

/// What is known of the arguments of all calls of a function.
struct Arguments {
    std::vector<Value> values;  ///< none before the first call

    void add(const std::vector<Value>& more) {
        if (values.empty()) values = more;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (values[i] != more[i]) values[i].reset();
    }
};

RunningFunction function_of(const Body& body, const std::vector<std::size_t>& running) {
    RunningFunction function{body.code};
    std::set<std::uint32_t> labels;  // of running blocks
    for (const std::size_t block : running) {
        function.running.push_back(body.in(block));
        labels.insert(body.blocks[block].label);
    }
    for (const auto& [label, first, last] : body.blocks)
        for (std::size_t i = first; i <= last && !labels.contains(label); ++i)
            if (body.code[i].op == spv::OpFunctionCall) function.idle_calls.insert(i);
    return function;
}

RunningModule Analysis::module() {
    RunningModule module{head_};
    module.order = order_;
    for (const Instruction& i : head_) {
        if (i.op == spv::OpEntryPoint) module.entries.push_back(i.words[2]);
        if (i.op == spv::OpTypeVoid) module.void_types.insert(i.words[1]);
    }
    module.called.insert(module.entries.begin(), module.entries.end());
    std::map<std::uint32_t, Arguments> given;
    std::vector<std::uint32_t> callers_first = callees_first_;
    std::ranges::reverse(callers_first);
    for (const std::uint32_t id : callers_first) {
        const Body& body = bodies_.at(id);
        if (!module.called.contains(id)) {
            module.functions.emplace(id, RunningFunction{body.code});
            continue;
        }
        const Outcome outcome = run(body, given[id].values, 0);
        RunningFunction& function = module.functions.emplace(id, function_of(body, outcome.running)).first->second;
        for (const Call& call : outcome.calls) {
            function.calls.push_back(call.callee);
            module.called.insert(call.callee);
            given[call.callee].add(call.arguments);
        }
    }
    return module;
}

}  // namespace

std::vector<Instruction> instructions_of(std::span<const std::uint32_t> code) {
    std::vector<Instruction> all;
    for (std::size_t at = spirv_header_words; at < code.size();) {
        const std::size_t length = code[at] >> 16;
        if (length == 0 || at + length > code.size()) return {};
        all.push_back({static_cast<spv::Op>(code[at] & 0xffffu), code.subspan(at, length)});
        at += length;
    }
    return all;
}

RunningModule running_blocks(std::span<const Instruction> all, std::span<const ConstantBits> given) {
    return Analysis(all, given).module();
}

}  // namespace strata
