#include "replay/bench/device_bench.h"

#include <algorithm>

#include "passes/graph/reached_code.h"

namespace strata {
namespace {

constexpr std::size_t shown_steps = 10;

const Shader* measured_shader(const PlannedStep& planned) {
    const auto is_measured = [](const Shader* shader) {
        return shader->stage == ShaderStage::compute || shader->stage == ShaderStage::fragment;
    };
    const auto found = std::ranges::find_if(planned.shaders, is_measured);
    return found == planned.shaders.end() ? nullptr : *found;
}

std::uint64_t part_bytes(const Shape& shape, const Part& part) {
    Shape meant = shape;
    if (part.layer) meant.layers = 1;
    if (part.mip) {
        const auto halved = [&](std::uint32_t size) { return std::max(1u, size >> *part.mip); };
        meant.extent = {halved(shape.extent.width), halved(shape.extent.height), halved(shape.extent.depth)};
        meant.mips = 1;
    }
    return bytes(meant);
}

/// From element to element of a block's array of any length, 0 where it has none.
std::uint64_t element_bytes(const Shader& shader, std::string_view block) {
    for (const BlockMember& member : shader.members)
        if (member.block == block && member.bytes == 0) return member.stride;
    return 0;
}

}  // namespace

OperationCount operations_per_invocation(const PlannedStep& planned) {
    const Shader* shader = measured_shader(planned);
    return shader ? count_operations(shader->code, fixed_constants(*shader, planned.step)) : OperationCount{};
}

std::uint64_t declared_bytes(const Plan& plan, const PlannedStep& planned, std::optional<std::uint64_t> invocations) {
    const Shader* shader = measured_shader(planned);
    const bool has_loops = operations_per_invocation(planned).loops > 0;
    std::uint64_t total = 0;
    for (const Use& use : uses(planned)) {
        std::uint64_t size =
            use.image ? part_bytes(plan.images[use.image.id].shape, use.part) : plan.buffers[use.buffer.id].bytes;
        if (use.buffer && use.access == Access::stored && shader && invocations && !has_loops)
            if (const std::uint64_t element = element_bytes(*shader, use.as)) size = std::min(size, *invocations * element);
        total += size * ((reads(use.access) ? 1 : 0) + (writes(use.access) ? 1 : 0));
    }
    return total;
}

std::optional<double> StepShare::operations() const {
    if (!invocations) return {};
    return static_cast<double>(*invocations) * static_cast<double>(per_invocation.operations);
}

double DeviceBench::share_of_bytes(const StepShare& step) const {
    return 1e3 * static_cast<double>(step.bytes) / step.ms.median / limits.bytes.median;
}

std::optional<double> DeviceBench::share_of_operations(const StepShare& step) const {
    const auto operations = step.operations();
    if (!operations) return {};
    return 1e3 * *operations / step.ms.median / limits.operations.median;
}

Result<DeviceBench> bench_device(Session& session, Device& for_limits, const DeviceBenchWish& wish) {
    const auto& [request, repeats, progress, stop] = wish;
    DeviceBench bench{.device = session.device(), .frame = request.variant.frame, .repeats = repeats};
    session.stop_when(stop);
    if (progress) progress("measuring the device", 0);
    const auto limits = measure_limits(for_limits, repeats, {.stop = stop});
    if (!limits) return limits.error();
    bench.limits = *limits;
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    const auto counts = count_steps(session, request);
    if (!counts) return counts.error();
    const auto timed = session.time(std::span(&request, 1), repeats, progress);
    if (!timed) return timed.error();
    const Plan& plan = planned->plan;
    const Run& run = timed->front();
    bench.width = run.width;
    bench.height = run.height;
    bench.samples = run.samples;
    bench.frame_ms = run.frame_ms->median;
    if (const std::size_t done = run.frame_ms_by_repeat.size(); done < repeats)
        bench.stopped = fmt::format("stopped after {} of {} timed runs", done, repeats);
    const Counting counting{plan, *counts, !bench.device.software};
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const PlannedStep& step = plan.steps[i];
        const StepInvocations ran = invocations_of(counting, i);
        if (run.steps[i].ms->median <= 0) continue;
        bench.steps.push_back({.scope = run.steps[i].scope,
                               .name = run.steps[i].name,
                               .ms = *run.steps[i].ms,
                               .bytes = declared_bytes(plan, step, ran.count),
                               .invocations = ran.count,
                               .counted_by = ran.counted_by,
                               .per_invocation = operations_per_invocation(step)});
    }
    std::ranges::stable_sort(bench.steps, std::ranges::greater(), [](const StepShare& step) { return step.ms.median; });
    bench.steps.resize(std::min(bench.steps.size(), shown_steps));
    if (progress) progress("done", 1);
    return bench;
}

}  // namespace strata
