#include "replay/session/step_counts.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/graph/shader.h"
#include "passes/reference/fragments.h"
#include "passes/technique.h"
#include "replay/session/describe_run.h"
#include "replay/session/device_session.h"

namespace strata {
namespace {

/// Null where the step's groups are known before the frame runs.
const ComputeWork* indirect_work(const PlannedStep& planned) {
    const auto* compute = std::get_if<ComputeWork>(&planned.step.work);
    return compute && compute->arguments ? compute : nullptr;
}

/// Whether the frame makes all arguments, and they are still in their buffers at its end.
bool keeps_arguments(const Plan& plan) {
    return std::ranges::all_of(plan.steps, [&](const PlannedStep& planned) {
        const ComputeWork* work = indirect_work(planned);
        if (!work) return true;
        const BufferRecord& buffer = plan.buffers[work->arguments.id];
        return !buffer.import && buffer.version == work->arguments.version;
    });
}

/// Those that tell by fragments_counter what one of their draws did.
std::set<const Technique*> counting_techniques(const Declaration& d) {
    const std::set<std::string> not_whole = not_counted(d, {});
    std::set<const Technique*> found;
    for (const CounterSource& source : d.counters) {
        const bool counts = std::ranges::count(source.technique->counters, fragments_counter, &Counter::name) > 0;
        if (counts && draws_once(d.plan, source.scope) && !not_whole.contains(std::string(source.technique->name)))
            found.insert(source.technique);
    }
    return found;
}

std::uint64_t invocations(const PlannedStep& planned, std::span<const std::byte> arguments) {
    std::array<std::uint32_t, 3> groups{};
    std::memcpy(groups.data(), &arguments[indirect_work(planned)->arguments_offset], sizeof groups);
    const Extent threads = group_size(planned);
    return std::uint64_t{groups[0]} * groups[1] * groups[2] * threads.width * threads.height * threads.depth;
}

/// True where the fragment shader runs behind the depth test: layout(early_fragment_tests).
bool tests_early(const ShaderLibrary& shaders, const Step& step) {
    constexpr std::uint32_t execution_mode = 16, early_fragment_tests = 9;  // of SPIR-V
    const Shader* fragment = step.shaders.empty() ? nullptr : shaders.find(step.shaders.back());
    if (!fragment || fragment->stage != ShaderStage::fragment) return false;
    for (std::size_t i = 5; i < fragment->code.size();) {  // behind the header
        const std::uint32_t words = fragment->code[i] >> 16, operation = fragment->code[i] & 0xffffu;
        if (operation == execution_mode && words >= 3 && fragment->code[i + 2] == early_fragment_tests) return true;
        i += std::max(words, 1u);
    }
    return false;
}

bool is_of_extent(const Plan& plan, const Step& step, const Extent& extent) {
    const auto& draw = std::get<DrawWork>(step.work);
    if (draw.viewport) return *draw.viewport == extent;
    return !step.attachments.empty() && plan.images[step.attachments.front().image.id].shape.extent == extent;
}

/// True for a list of all that is transparent, in whatever order.
bool is_whole(const DrawList& list, const FrameImages& images) {
    return std::ranges::any_of(
        std::array{images.transparent, images.numbered, images.separate, images.back_to_front}, [&](const DrawList& whole) {
            return list.commands.id == whole.commands.id && list.first == whole.first && list.count == whole.count;
        });
}

/// Fragments of all that is transparent in a row of pixels.
struct RowPoints {
    std::uint64_t covered = 0, before_opaque = 0;
};

/// Single-sided surfaces have backs where the device does not cull them: shaders run there and discard.
std::vector<RowPoints> transparent_points(Frame frame, Cull cull, const ReferenceImage& depth) {
    if (cull == Cull::none)
        for (Material& material : frame.materials) material.double_sided = true;
    std::vector<RowPoints> rows(frame.view.height);
    rasterize(frame, transparent_draws(frame), {}, [&](const RasterPoint& point) {
        RowPoints& row = rows[point.y];
        ++row.covered;
        row.before_opaque += static_cast<float>(point.depth) >= static_cast<float>(depth.at(point.x, point.y).x);
    });
    return rows;
}

/// A step that draws all that is transparent.
struct DrawnStep {
    std::size_t step = 0;
    Rows rows;
    Cull cull = Cull::none;
    std::uint64_t RowPoints::*counts = nullptr;
};

std::uint64_t points_of(const DrawnStep& drawn, std::span<const RowPoints> rows) {
    std::uint64_t sum = 0;
    const std::size_t end = std::min<std::size_t>(rows.size(), std::size_t{drawn.rows.first} + drawn.rows.count);
    for (std::size_t y = drawn.rows.first; y < end; ++y) sum += rows[y].*drawn.counts;
    return sum;
}

Result<StepCounts> count_everything(DeviceSession& session, const Request& request) {
    auto timed = session.time_alone(request, {.invocations = Invocations::counted});
    if (!timed) return timed.error();
    StepCounts counts{.invocations = {}, .rasterized = {}, .counters = std::move(timed->run.counters)};
    for (const StepCost& cost : timed->step_costs) counts.invocations.push_back(cost.invocations);
    return counts;
}

}  // namespace

bool draws_once(const Plan& plan, std::uint32_t scope) {
    return std::ranges::count_if(plan.steps, [&](const PlannedStep& planned) {
               return planned.step.scope == scope && std::holds_alternative<DrawWork>(planned.step.work);
           }) == 1;
}

Result<std::vector<std::optional<std::uint64_t>>> DeviceSession::rasterize_steps(const Request& request, const Declaration& d) {
    const Plan& plan = d.plan;
    std::vector<std::optional<std::uint64_t>> counts(plan.steps.size());
    std::vector<DrawnStep> drawn;
    if (d.images.transparent.count == 0) return counts;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const Step& step = plan.steps[i].step;
        const auto* draw = std::get_if<DrawWork>(&step.work);
        if (!draw || draw->count || draw->at_equal_depth || !is_whole(draw->list, d.images) ||
            !is_of_extent(plan, step, d.images.extent))
            continue;
        const auto depth = std::ranges::find_if(
            step.attachments, [&](const Attachment& each) { return plan.images[each.image.id].shape.format == Format::d32f; });
        const bool is_tested = depth != step.attachments.end();
        if (is_tested && (depth->image.id != d.images.depth.id || !tests_early(shaders(), step))) continue;
        drawn.push_back({i, draw->rows.value_or(Rows{0, d.images.extent.height}), draw->cull,
                         is_tested ? &RowPoints::before_opaque : &RowPoints::covered});
    }
    if (drawn.empty() || d.images.samples != 1) return counts;
    Request for_depth = request;
    for_depth.outputs = {"depth_layers"};
    for_depth.once = true;
    const auto run = this->run(for_depth);
    if (!run) return run.error();
    const View& view = loaded_->frame.view;
    const auto depth = run->images.find("depth_layers");
    const ReferenceImage opaque = depth == run->images.end() ? ReferenceImage(view.width, view.height) : in_double(depth->second);
    std::map<Cull, std::vector<RowPoints>> rows;
    for (const DrawnStep& each : drawn) {
        if (!rows.contains(each.cull)) rows.emplace(each.cull, transparent_points(loaded_->frame, each.cull, opaque));
        counts[each.step] = points_of(each, rows.at(each.cull));
    }
    return counts;
}

Result<StepCounts> DeviceSession::count(const Request& request) {
    const auto whole = prepare(request, nullptr, Keep::outputs);
    if (!whole) return whole.error();
    const Plan& plan = whole->plan;
    if (!device().software || !keeps_arguments(plan)) return count_everything(*this, request);
    auto rasterized = rasterize_steps(request, *whole);
    if (!rasterized) return rasterized.error();
    StepCounts counts{.invocations = std::vector<std::optional<std::uint64_t>>(plan.steps.size()),
                      .rasterized = *std::move(rasterized),
                      .counters = {}};
    const std::set<const Technique*> counting = counting_techniques(*whole);
    if (counting.empty() && std::ranges::none_of(plan.steps, indirect_work)) return counts;
    const auto declared = declare_counts(request, {*loaded_, scene_, device(), shaders()}, plan, counting);
    if (!declared) return declared.error();
    const auto execution = execute(*declared, {.kept_images = KeptImages::left});
    if (!execution) return execution.error();
    counts.counters = summed(read_counters(*declared, *execution));
    std::erase_if(counts.counters, [&](const CounterRecord& record) {
        return std::ranges::none_of(counting, [&](const Technique* technique) { return technique->name == record.technique; });
    });
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
        if (const ComputeWork* work = indirect_work(plan.steps[i]))
            counts.invocations[i] = invocations(plan.steps[i], execution->buffers.at(work->arguments.id));
    return counts;
}

Result<StepCounts> count_steps(Session& session, const Request& request) {
    return static_cast<DeviceSession&>(session).count(request);  // there is no other kind of session
}

}  // namespace strata
