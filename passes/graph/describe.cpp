// A plan as text that reads top to bottom, and as a Graphviz digraph: boxes are steps, ellipses are images and buffers.
#include "passes/graph/describe.h"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/core.h>

#include "capture_format/frame/no_index.h"

namespace strata {
namespace {

std::string part_text(const Part& part) {
    std::string text;
    if (part.mip) text += fmt::format(" mip {}", *part.mip);
    if (part.layer) text += fmt::format(" layer {}", *part.layer);
    return text;
}

const std::string& name_of(const Plan& plan, Image image, Buffer buffer) {
    return image ? plan.images[image.id].name : plan.buffers[buffer.id].name;
}

std::string count_text(std::size_t count, std::string_view singular, std::string_view plural) {
    return fmt::format("{} {}", count, count == 1 ? singular : plural);
}

std::string groups_text(const PlannedStep& planned) {
    const auto* compute = std::get_if<ComputeWork>(&planned.step.work);
    if (!compute) return "";
    if (compute->arguments) return ", groups on the device";
    return fmt::format(", {} x {} x {} groups", planned.groups.width, planned.groups.height, planned.groups.depth);
}

/// What a reader would not expect of a raster step.
std::string raster_text(const PlannedStep& planned) {
    std::string text;
    for (const std::string& shader : planned.step.shaders)
        if (shader.ends_with(".geom")) text += ", through " + shader;
    if (planned.layers > 1) text += fmt::format(", {} layers at once", planned.layers);
    const auto* draw = std::get_if<DrawWork>(&planned.step.work);
    if (draw && draw->alpha_to_coverage) text += ", alpha to coverage";
    if (draw && draw->at_equal_depth) text += ", at equal depth";
    if (draw && draw->columns)
        text += fmt::format(", columns {} to {}", draw->columns->first, draw->columns->first + draw->columns->count - 1);
    if (draw && draw->rows) text += fmt::format(", rows {} to {}", draw->rows->first, draw->rows->first + draw->rows->count - 1);
    return text;
}

std::string summary(const Plan& plan) {
    return fmt::format("{}, {} left out; images {} in {}, buffers {}\n", count_text(plan.steps.size(), "step", "steps"),
                       plan.culled.size(), size_text(plan.image_bytes), count_text(plan.slots.size(), "slot", "slots"),
                       size_text(plan.buffer_bytes));
}

std::string memory_text(const Plan& plan) {
    if (plan.slots.empty()) return "";
    std::string text = "\nmemory\n";
    for (std::size_t i = 0; i < plan.slots.size(); ++i) {
        const MemorySlot& slot = plan.slots[i];
        text += fmt::format("    slot {}: {} ({}):", i, describe(slot.shape), size_text(slot.bytes));
        for (std::size_t k = 0; k < slot.images.size(); ++k)
            text += fmt::format("{} {}", k == 0 ? "" : ", then", plan.images[slot.images[k]].name);
        text += "\n";
    }
    return text;
}

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '"' || c == '\\') safe += '\\';
        safe += c;
    }
    return safe;
}

std::string node_of(const Use& use) {
    return use.image ? fmt::format("image{}", use.image.id) : fmt::format("buffer{}", use.buffer.id);
}

std::string edge_text(const std::string& step, const Use& use) {
    const std::string node = node_of(use);
    if (!writes(use.access)) return fmt::format("    {} -> {} [label=\"{}\"];\n", node, step, name(use.access));
    const std::string_view both = reads(use.access) ? ", dir=both" : "";
    return fmt::format("    {} -> {} [label=\"{}\"{}];\n", step, node, name(use.access), both);
}

}  // namespace

std::string size_text(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    if (bytes < 1024 * 1024) return fmt::format("{:.1f} KiB", static_cast<double>(bytes) / 1024);
    return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1024 * 1024));
}

std::string describe(const Shape& shape) {
    std::string text = fmt::format("{} x {}", shape.extent.width, shape.extent.height);
    if (shape.extent.depth > 1) text += fmt::format(" x {}", shape.extent.depth);
    text += fmt::format(" {}", row(shape.format).name);
    if (shape.layers > 1) text += fmt::format(", {} layers", shape.layers);
    if (shape.mips > 1) text += fmt::format(", {} mips", shape.mips);
    if (shape.samples > 1) text += fmt::format(", {} samples", shape.samples);
    return text;
}

std::string describe(const Plan& plan, const Barrier& barrier) {
    const std::string what = name_of(plan, barrier.image, barrier.buffer) + part_text(barrier.part);
    std::string text = fmt::format("{}: {} -> {}", what, names(barrier.all_before), names(barrier.all_after));
    if (!barrier.image || plan.slot_of_image[barrier.image.id] == no_index) return text;
    const MemorySlot& slot = plan.slots[plan.slot_of_image[barrier.image.id]];
    const auto owner = std::ranges::find(slot.images, barrier.image.id);
    if (barrier.discard && owner != slot.images.begin())
        text += fmt::format(", takes over the memory of {}", plan.images[*(owner - 1)].name);
    else if (barrier.discard) text += ", new";
    return text;
}

std::string describe(const Plan& plan) {
    std::string text = summary(plan);
    std::uint32_t scope = no_index;
    for (const PlannedStep& planned : plan.steps) {
        if (planned.step.scope != scope) {
            scope = planned.step.scope;
            text += fmt::format("\n{}\n", text_of(plan.scopes[scope]));
        }
        text += fmt::format("    {}{}{}\n", planned.step.name, groups_text(planned), raster_text(planned));
        for (const Barrier& barrier : planned.barriers) text += fmt::format("        {}\n", describe(plan, barrier));
    }
    if (!plan.final_barriers.empty()) text += "\nat the end\n";
    for (const Barrier& barrier : plan.final_barriers) text += fmt::format("        {}\n", describe(plan, barrier));
    text += memory_text(plan);
    if (!plan.culled.empty()) text += "\nleft out\n";
    for (const CulledStep& culled : plan.culled)
        text += fmt::format("    {} ({}): {}\n", culled.name, text_of(culled.scope), culled.reason);
    return text;
}

std::string describe_dot(const Plan& plan) {
    std::string nodes, edges;
    std::set<std::string> declared;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const std::string step = fmt::format("step{}", i);
        nodes += fmt::format("    {} [shape=box, style=filled, fillcolor=\"#dfe8f5\", label=\"{}\"];\n", step,
                             escaped(plan.steps[i].step.name));
        if (i > 0) edges += fmt::format("    step{} -> {} [style=invis];\n", i - 1, step);
        for (const Use& use : uses(plan.steps[i])) {
            const std::string node = node_of(use);
            if (declared.insert(node).second)
                nodes += fmt::format("    {} [shape={}, label=\"{}\"];\n", node, use.image ? "ellipse" : "note",
                                     escaped(name_of(plan, use.image, use.buffer)));
            edges += edge_text(step, use);
        }
    }
    return "digraph plan {\n    rankdir=TB;\n    node [fontname=\"Helvetica\", fontsize=10];\n    edge [fontname=\"Helvetica\", "
           "fontsize=8];\n" +
           nodes + edges + "}\n";
}

}  // namespace strata
