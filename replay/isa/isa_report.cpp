#include "replay/isa/isa_report.h"

#include <algorithm>

#include "capture_format/frame/no_index.h"
#include "passes/shaders/scene/no_index.shared.h"

namespace strata {
namespace {

// RADV states inverse throughput for 64 invocations whatever the width of a wave.
constexpr double invocations_per_throughput = 64;

std::uint32_t threads_of(const PipelineRequest& request) {
    if (!std::holds_alternative<ComputeWork>(request.step.step.work)) return 0;
    const Extent group = group_size(request.step);
    return group.width * group.height * group.depth;
}

std::optional<double> sum(std::optional<double> a, std::optional<double> b) {
    if (!a || !b) return a ? a : b;
    return *a + *b;
}

/// Drivers' names for the same: RADV's first, then NVIDIA's, then ANV's.
IsaProgram program_of(const PipelineRequests& requests, std::size_t pipeline, const Executable& made) {
    const PipelineRequest& request = requests.pipelines[pipeline];
    return {.pipeline = pipeline,
            .label = request.label,
            .stage = made.stage,
            .wave_lanes = made.wave_lanes,
            .group_threads = threads_of(request),
            .registers = made.statistic({"VGPRs", "Register Count"}),
            .scalar_registers = made.statistic({"SGPRs"}),
            .lds_bytes = made.statistic({"LDS size", "LDS Size", "Shared Memory Size"}),
            .spilled = sum(made.statistic({"Spilled VGPRs", "Spill Count"}), made.statistic({"Spilled SGPRs"})),
            .scratch_bytes = made.statistic({"Scratch size", "Local Memory Size", "Scratch Memory Size"}),
            .code_bytes = made.statistic({"Code size", "Binary Size"}),
            .instructions = made.statistic({"Instructions", "Instruction Count"}),
            .latency = made.statistic({"Latency", "Cycle Count"}),
            .inverse_throughput = made.statistic({"Inverse Throughput"}),
            .stated = made.statistic({"Subgroups per SIMD"})};
}

void add_occupancy(IsaProgram& program, const GpuModel& model, IsaOfGpu& gpu) {
    if (!program.registers || program.wave_lanes == 0) return;
    const auto whole = [](std::optional<double> value) { return static_cast<std::uint32_t>(value.value_or(0)); };
    const ShaderResources taken{.registers = whole(program.registers),
                                .scalar_registers = whole(program.scalar_registers),
                                .lds_bytes = whole(program.lds_bytes),
                                .group_threads = program.group_threads,
                                .wave_lanes = program.wave_lanes};
    program.occupancy = occupancy(model, taken);
    if (!program.stated) return;
    program.stated_by_rule = stated_by_radv(model, taken);
    // Fragments hold their interpolated inputs in LDS, of which no statistic tells: only compute is checked.
    if (program.group_threads > 0 && *program.stated != *program.stated_by_rule)
        gpu.notes.push_back(
            fmt::format("{}: the compiler states {} waves per SIMD where its rule gives {}: our table of GPUs or its "
                        "rule is out of date",
                        program.label, *program.stated, *program.stated_by_rule));
}

/// What the technique counted as fragments, where it draws once and so counts those of that draw.
std::optional<std::uint64_t> counted_fragments(const Counting& counting, const PlannedStep& planned) {
    if (!draws_once(counting.plan, planned.step.scope)) return {};
    const Scope& scope = counting.plan.scopes[planned.step.scope];
    for (const CounterRecord& counter : counting.counts.counters)
        if (is_pass_of(scope, counter.technique) && counter.name == fragments_counter) return counter.value;
    return {};
}

std::uint64_t pixels_of(const Plan& plan, const PlannedStep& planned) {
    Extent extent = std::get<FullscreenWork>(planned.step.work).viewport.value_or(Extent{});
    if (!planned.step.attachments.empty() && extent == Extent{}) {
        const Attachment& first = planned.step.attachments.front();
        const std::uint32_t mip = first.part.mip.value_or(0);
        extent = plan.images[first.image.id].shape.extent;
        extent = {std::max(1u, extent.width >> mip), std::max(1u, extent.height >> mip), 1};
    }
    return std::uint64_t{extent.width} * extent.height * planned.layers;
}

}  // namespace

StepInvocations invocations_of(const Counting& counting, std::size_t index) {
    const PlannedStep& planned = counting.plan.steps[index];
    const bool was_run = index < counting.counts.invocations.size();
    const auto by_device = was_run ? counting.counts.invocations[index] : std::optional<std::uint64_t>();
    if (const auto* compute = std::get_if<ComputeWork>(&planned.step.work)) {
        const Extent group = group_size(planned), groups = planned.groups;
        const std::uint64_t threads = std::uint64_t{group.width} * group.height * group.depth;
        if (!compute->arguments) return {threads * groups.width * groups.height * groups.depth, "dispatch"};
        if (by_device) return {by_device, "device"};
    } else if (std::holds_alternative<FullscreenWork>(planned.step.work)) {
        return {pixels_of(counting.plan, planned), "pixels"};
    } else if (std::holds_alternative<DrawWork>(planned.step.work)) {
        if (by_device && counting.device_counts_fragments) return {by_device, "device"};
        if (index < counting.counts.rasterized.size() && counting.counts.rasterized[index])
            return {counting.counts.rasterized[index], "rasterizer"};
        if (const auto fragments = counted_fragments(counting, planned)) return {fragments, "counter"};
    }
    return {};
}

double modeled_ms(const GpuModel& model, std::uint64_t invocations, double inverse_throughput) {
    const double cycles = static_cast<double>(invocations) / invocations_per_throughput * inverse_throughput;
    return 1e3 * cycles / simd_cycles_per_second(model);
}

std::vector<IsaStep> isa_steps_of(const Counting& counting, const PipelineRequests& requests) {
    std::vector<IsaStep> isa_steps;
    for (std::size_t i = 0; i < counting.plan.steps.size(); ++i) {
        if (requests.of_step[i] == no_index) continue;
        const Step& step = counting.plan.steps[i].step;
        isa_steps.push_back(
            {counting.plan.scopes[step.scope], step.name, requests.pipelines[requests.of_step[i]].label, requests.of_step[i]});
        const StepInvocations ran = invocations_of(counting, i);
        isa_steps.back().invocations = ran.count;
        isa_steps.back().counted_by = ran.counted_by;
    }
    return isa_steps;
}

IsaOfGpu isa_of_gpu(const GpuModel* model, const Compilation& made, const PipelineRequests& requests,
                    std::vector<IsaStep> isa_steps) {
    IsaOfGpu gpu{.name = model ? std::string(model->name) : made.device,
                 .model = model,
                 .device = made.device,
                 .driver = made.driver,
                 .steps = std::move(isa_steps)};
    for (std::size_t i = 0; i < made.pipelines.size(); ++i) {
        if (!made.pipelines[i].failure.empty())
            gpu.notes.push_back(fmt::format("{} does not compile: {}", requests.pipelines[i].label, made.pipelines[i].failure));
        for (const Executable& executable : made.pipelines[i].executables) {
            IsaProgram& program = gpu.programs.emplace_back(program_of(requests, i, executable));
            if (model) add_occupancy(program, *model, gpu);
        }
    }
    for (IsaStep& isa_step : gpu.steps) {
        // Vertices are left out: nobody counts them, and they are few against fragments.
        const auto program = std::ranges::find_if(gpu.programs, [&](const IsaProgram& candidate) {
            return candidate.pipeline == isa_step.pipeline && (candidate.stage == "compute" || candidate.stage == "fragment");
        });
        if (!model || !isa_step.invocations || program == gpu.programs.end() || !program->inverse_throughput) continue;
        isa_step.modeled_ms = modeled_ms(*model, *isa_step.invocations, *program->inverse_throughput);
        gpu.modeled_ms = gpu.modeled_ms.value_or(0) + *isa_step.modeled_ms;
    }
    return gpu;
}

}  // namespace strata
