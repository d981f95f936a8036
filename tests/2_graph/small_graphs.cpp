#include "tests/2_graph/small_graphs.h"

#include <gtest/gtest.h>

#include "passes/graph/graph.h"

namespace strata {
namespace {

enum class Direction { in, out, both };

ShaderBinding image(std::string name, std::uint32_t slot, Direction direction) {
    return {.name = std::move(name),
            .binding = slot,
            .kind = BindingKind::storage_image,
            .read = direction != Direction::out,
            .written = direction != Direction::in};
}

ShaderBinding texture(std::string name, std::uint32_t slot) {
    return {.name = std::move(name), .binding = slot, .kind = BindingKind::sampled_image};
}

ShaderBinding block(std::string name, std::uint32_t slot, Direction direction) {
    ShaderBinding binding = image(std::move(name), slot, direction);
    binding.kind = BindingKind::storage_buffer;
    return binding;
}

Shader shader(std::string name, ShaderStage stage, std::vector<ShaderBinding> bindings) {
    Shader made;
    made.name = std::move(name);
    made.stage = stage;
    made.bindings = std::move(bindings);
    if (stage == ShaderStage::compute) made.group = {8, 8, 1};
    if (stage == ShaderStage::fragment) made.color_outputs = 1;
    return made;
}

ShaderLibrary made_library() {
    ShaderLibrary library;
    const auto compute = [&](std::string name, std::vector<ShaderBinding> bindings) {
        library.add(shader(std::move(name), ShaderStage::compute, std::move(bindings)));
    };
    compute("write.comp", {image("target", 0, Direction::out)});
    compute("copy.comp", {image("source", 0, Direction::in), image("target", 1, Direction::out)});
    compute("sample.comp", {texture("source", 0), image("target", 1, Direction::out)});
    compute("change.comp", {image("target", 0, Direction::both)});
    compute("count.comp", {texture("source", 0), block("Counters", 1, Direction::both)});
    compute("shade_and_count.comp",
            {texture("source", 0), image("target", 1, Direction::out), block("Counters", 2, Direction::both)});
    compute("fill_list.comp", {block("List", 0, Direction::out)});
    compute("use_list.comp", {block("List", 0, Direction::in), image("target", 1, Direction::out)});
    Shader pushed = shader("pushed.comp", ShaderStage::compute, {image("target", 0, Direction::out)});
    pushed.push_bytes = 8;
    pushed.constants = {{.name = "rank", .id = 0, .bytes = 4}, {.name = "width", .id = 1, .bytes = 4}};
    pushed.group_constants[0] = "width";
    library.add(pushed);
    library.add(shader("shaders/draw.vert", ShaderStage::vertex, {}));
    library.add(shader("shaders/fullscreen.vert", ShaderStage::vertex, {}));
    library.add(shader("depth_only.vert", ShaderStage::vertex, {}));
    library.add(shader("paint.frag", ShaderStage::fragment, {}));
    Shader sort = shader("sort.geom", ShaderStage::geometry, {block("List", 0, Direction::in)});
    sort.chooses_layer = true;
    library.add(sort);
    library.add(shader("shade.frag", ShaderStage::fragment, {texture("source", 0)}));
    return library;
}

std::string sentence(const Plan& plan, const Barrier& barrier) {
    std::string text = barrier.image ? plan.images[barrier.image.id].name : plan.buffers[barrier.buffer.id].name;
    if (barrier.part.mip) text += " mip " + std::to_string(*barrier.part.mip);
    if (barrier.part.layer) text += " layer " + std::to_string(*barrier.part.layer);
    text += ": " + names(barrier.all_before) + " -> " + names(barrier.all_after);
    return barrier.discard ? text + ", discarded" : text;
}

std::vector<std::string> sentences(const Plan& plan, const std::vector<Barrier>& barriers) {
    std::vector<std::string> all;
    for (const Barrier& barrier : barriers) all.push_back(sentence(plan, barrier));
    return all;
}

}  // namespace

const ShaderLibrary& small_shaders() {
    static const ShaderLibrary library = made_library();
    return library;
}

Shape small_shape(Format format) { return {.extent = {64, 32}, .format = format}; }
Shape small_depth() { return small_shape(Format::d32f); }

Plan compiled(const Graph& graph) {
    Result<Plan> plan = compile(graph, small_shaders());
    if (plan) return std::move(*plan);
    ADD_FAILURE() << plan.error().sentence;
    return {};
}

std::optional<Error> refusal(const Graph& graph) {
    const Result<Plan> plan = compile(graph, small_shaders());
    return plan ? std::nullopt : std::optional(plan.error());
}

std::vector<std::string> waits(const Plan& plan, std::size_t step) {
    if (step < plan.steps.size()) return sentences(plan, plan.steps[step].barriers);
    ADD_FAILURE() << "the plan has only " << plan.steps.size() << " steps";
    return {};
}

std::vector<std::string> final_waits(const Plan& plan) { return sentences(plan, plan.final_barriers); }

std::vector<std::string> step_names(const Plan& plan) {
    std::vector<std::string> all;
    for (const PlannedStep& planned : plan.steps) all.push_back(planned.step.name);
    return all;
}

}  // namespace strata
