// compile(): check, cull, memory, barriers. Declaration order is execution order; nothing is moved.
#include "passes/graph/plan.h"

#include <algorithm>
#include <set>

#include "passes/graph/compiling.h"
#include "passes/graph/graph.h"

namespace strata {
namespace {

void add_binding(const Binding& binding, std::vector<Use>& all) {
    if (!binding.image && !binding.buffer) return;
    all.push_back({binding.name, binding.access, binding.image, binding.buffer, binding.part});
}

void add_work(const Work& work, std::vector<Use>& all) {
    if (const auto* clear = std::get_if<ClearWork>(&work))
        all.push_back({.as = "clear", .access = Access::copied_to, .image = clear->image, .buffer = clear->buffer});
    if (const auto* copy = std::get_if<CopyWork>(&work)) {
        all.push_back({.as = "copy", .access = Access::copied_from, .image = copy->from, .buffer = copy->buffer_from});
        all.push_back({.as = "copy", .access = Access::copied_to, .image = copy->to, .buffer = copy->buffer_to});
    }
}

/// Ids of what surviving steps need, seen from the end of the frame.
struct Needed {
    std::set<std::uint32_t> images, buffers;

    bool has(const Use& use) const { return use.image ? images.contains(use.image.id) : buffers.contains(use.buffer.id); }
    void add(const Use& use) { use.image ? images.insert(use.image.id) : buffers.insert(use.buffer.id); }
    void remove(const Use& use) { use.image ? images.erase(use.image.id) : buffers.erase(use.buffer.id); }
};

/// Whether the step leaves nothing of what was in the resource before.
bool replaces_all(const Step& step, const Use& use) {
    if (use.access == Access::copied_to) return true;
    const auto* fullscreen = std::get_if<FullscreenWork>(&step.work);
    return fullscreen && !fullscreen->viewport && use.access == Access::color_written && use.part == Part{} &&
           std::ranges::none_of(step.attachments, [](const Attachment& a) {
               return a.access == Access::depth_tested || a.access == Access::depth_written;
           });
}

bool is_of_counters(const Graph& graph, const Use& use) { return use.buffer && graph.record(use.buffer).weak; }

bool feeds_something(const Graph& graph, const PlannedStep& planned, const std::vector<Use>& all, const Needed& needed) {
    const bool is_shader = !planned.shaders.empty();
    return std::ranges::any_of(
        all, [&](const Use& use) { return writes(use.access) && !(is_shader && is_of_counters(graph, use)) && needed.has(use); });
}

bool counts(const Graph& graph, const PlannedStep& planned, const std::vector<Use>& all) {
    return !planned.shaders.empty() &&
           std::ranges::any_of(all, [&](const Use& use) { return writes(use.access) && is_of_counters(graph, use); });
}

const std::string& name_of(const Graph& graph, const Use& use) {
    return use.image ? graph.record(use.image).name : graph.record(use.buffer).name;
}

std::string why_culled(const Graph& graph, const PlannedStep& planned, const std::vector<Use>& all) {
    std::string written;
    std::set<std::string_view> named;
    for (const Use& use : all) {
        const std::string& name = name_of(graph, use);
        if (!writes(use.access) || is_of_counters(graph, use) || !named.insert(name).second) continue;
        written += written.empty() ? "'" + name + "'" : ", '" + name + "'";
    }
    if (!written.empty()) return "nobody reads " + written;
    return planned.shaders.empty() ? "no step counts" : "it writes nothing but counters";
}

Result<void> check_read_contents(const Graph& graph, const PlannedStep& planned, const Use& use, const Needed& written) {
    // An update may bring its own contents (scratch that a shader writes first); every other read needs a writer.
    const bool needs_writer = reads(use.access) && use.access != Access::updated;
    const bool imported = use.image ? graph.record(use.image).import.has_value() : graph.record(use.buffer).import.has_value();
    if (!needs_writer || imported || written.has(use)) return {};
    return fail(Fault::usage, "graph.read_before_write",
                "{step} reads '{resource}' ({access}) before any step writes or clears it", planned.step.name,
                name_of(graph, use), name(use.access));
}

Plan with_records(const Graph& graph) {
    Plan plan;
    plan.images.assign(graph.images().begin(), graph.images().end());
    plan.buffers.assign(graph.buffers().begin(), graph.buffers().end());
    plan.scopes.assign(graph.scopes().begin(), graph.scopes().end());
    plan.kept_images.assign(graph.kept_images().begin(), graph.kept_images().end());
    plan.kept_buffers.assign(graph.kept_buffers().begin(), graph.kept_buffers().end());
    return plan;
}

}  // namespace

std::vector<Use> uses(const Step& step) {
    std::vector<Use> all;
    for (const Binding& binding : step.bindings) add_binding(binding, all);
    for (const Attachment& attachment : step.attachments)
        all.push_back({.as = "attachment", .access = attachment.access, .image = attachment.image, .part = attachment.part});
    add_work(step.work, all);
    return all;
}

std::vector<Image> images_written(const Step& step) {
    std::vector<Image> images;
    for (const Use& use : uses(step))
        if (use.image && writes(use.access) && std::ranges::count(images, use.image.id, &Image::id) == 0)
            images.push_back(use.image);
    return images;
}

std::vector<Use> uses(const PlannedStep& planned) {
    std::vector<Use> all = uses(planned.step);
    for (const PlannedBinding& bound : planned.bindings) {
        const bool declared =
            std::ranges::find(planned.step.bindings, bound.binding.name, &Binding::name) != planned.step.bindings.end();
        if (!declared) add_binding(bound.binding, all);  // an offer
    }
    return all;
}

bool writes_counters(const Graph& graph, const PlannedStep& planned) { return counts(graph, planned, uses(planned)); }

AccessSet accesses(const PlannedStep& planned, Image image, Part part) {
    const auto overlap = [](auto a, auto b) { return !a || !b || *a == *b; };
    AccessSet set;
    for (const Use& use : uses(planned)) {
        const bool same = use.image && use.image.id == image.id;
        if (same && overlap(use.part.mip, part.mip) && overlap(use.part.layer, part.layer)) set |= use.access;
    }
    return set;
}

namespace {

using Ids = std::set<std::uint32_t>;

/// Marks each planned step that feeds the frame's purpose; `work`: buffers of remembered work that belong to it.
std::vector<bool> steps_that_feed(const Graph& graph, const Plan& plan, const Ids& work) {
    Needed needed;
    for (const Image image : graph.kept_images()) needed.images.insert(image.id);
    for (const Buffer buffer : graph.kept_buffers())
        if (!graph.record(buffer).weak) needed.buffers.insert(buffer.id);
    for (const ImageRecord& record : graph.images())
        if (record.import) needed.images.insert(static_cast<std::uint32_t>(&record - graph.images().data()));
    for (const BufferRecord& record : graph.buffers()) {
        const auto id = static_cast<std::uint32_t>(&record - graph.buffers().data());
        if (record.import && (record.remembered != Remembered::work || work.contains(id))) needed.buffers.insert(id);
    }
    std::vector<bool> feed(plan.steps.size());
    for (std::size_t i = plan.steps.size(); i-- > 0;) {
        const PlannedStep& planned = plan.steps[i];
        const std::vector<Use> all = uses(planned);
        feed[i] = feeds_something(graph, planned, all, needed);
        if (!feed[i]) continue;
        for (const Use& use : all)
            if (replaces_all(planned.step, use)) needed.remove(use);
        for (const Use& use : all)
            if (reads(use.access)) needed.add(use);
    }
    return feed;
}

/// Buffers of remembered work that these steps use.
Ids work_of(const Graph& graph, const Plan& plan, const std::vector<bool>& feed) {
    Ids work;
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
        if (feed[i])
            for (const Use& use : uses(plan.steps[i]))
                if (use.buffer && graph.record(use.buffer).remembered == Remembered::work) work.insert(use.buffer.id);
    return work;
}

}  // namespace

void cull(const Graph& graph, Plan& plan) {
    // Work that the next frame need not do is done where this frame needs it.
    std::vector<bool> feed = steps_that_feed(graph, plan, {});
    for (Ids work, more = work_of(graph, plan, feed); more != work; more = work_of(graph, plan, feed)) {
        work = more;
        feed = steps_that_feed(graph, plan, work);
    }
    std::vector<PlannedStep> alive;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        PlannedStep& planned = plan.steps[i];
        if (feed[i]) {
            alive.push_back(std::move(planned));
            continue;
        }
        const std::vector<Use> all = uses(planned);
        plan.culled.push_back({graph.scopes()[planned.step.scope], planned.step.name, why_culled(graph, planned, all)});
        if (counts(graph, planned, all)) plan.uncounted_scopes.insert(planned.step.scope);
    }
    plan.culled.insert(plan.culled.begin(), graph.left_out().begin(), graph.left_out().end());
    plan.steps = std::move(alive);
}

Result<void> check_contents(const Graph& graph, const Plan& plan) {
    Needed written;
    for (const PlannedStep& planned : plan.steps) {
        const std::vector<Use> all = uses(planned);
        for (const Use& use : all)
            if (auto checked = check_read_contents(graph, planned, use, written); !checked) return checked;
        for (const Use& use : all)
            if (writes(use.access)) written.add(use);
    }
    for (const Image image : graph.kept_images())
        if (!graph.record(image).import && !written.images.contains(image.id))
            return fail(Fault::usage, "graph.never_written", "no step writes '{image}', which the graph keeps",
                        graph.record(image).name);
    return {};
}

Result<Plan> compile(const Graph& graph, const ShaderLibrary& library) {
    Plan plan = with_records(graph);
    for (const Step& step : graph.steps()) {
        Result<PlannedStep> planned = check_step(graph, step, library);
        if (!planned) return planned.error();
        plan.steps.push_back(std::move(*planned));
    }
    cull(graph, plan);
    if (auto checked = check_contents(graph, plan); !checked) return checked.error();
    assign_memory(graph, plan);
    place_barriers(graph, plan);
    return plan;
}

}  // namespace strata
