// What a tile costs by the mode that shades it, as a compiler estimates it for a GPU that need not be there
// (docs/algorithms/lighting.md 3.5): the technique's shader of every mode is taken from the plan of a frame that has these modes,
// compiled, and priced by its cycles for a tile's pixels times the penalty for the waves it leaves no room for.
#include <algorithm>
#include <cmath>
#include <map>

#include "replay/isa/isa_report.h"
#include "replay/spectra/spectra.h"

namespace strata {
namespace {

constexpr double pixels_of_a_tile = 256, invocations_per_throughput = 64;
std::optional<std::uint32_t> mode_of(const Technique& technique, const PipelineRequest& request) {
    const std::string_view mode_constant = technique.abilities.feature_modes->constant;
    for (const Fixed& fixed : request.step.step.fixed)
        if (const auto* bits = std::get_if<std::uint32_t>(&fixed.value); bits && fixed.name == mode_constant) return *bits;
    return {};
}

/// The pipelines of the modes, of a frame that would dispatch them all.
Result<std::vector<PipelineRequest>> pipelines_of_modes(const CostQuestion& question, Session& session,
                                                        std::span<const std::uint32_t> modes) {
    Request request = question.base;
    request.frame = question.frames.front().frame;
    request.outputs = {std::string(info(question.technique.stage).outputs.front())};
    use_modes(request.choices, question.technique, modes);
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    std::vector<PipelineRequest> pipelines = pipelines_of(planned->plan).pipelines;
    std::erase_if(pipelines, [&](const PipelineRequest& pipeline) { return !mode_of(question.technique, pipeline); });
    return pipelines;
}

Result<void> add_modes(const CostQuestion& question, std::vector<PipelineRequest> pipelines,
                       std::map<std::uint32_t, lighting::CompiledMode>& modes) {
    const auto made = question.compile(pipelines);
    if (!made) return made.error();
    const PipelineRequests requests{.pipelines = std::move(pipelines), .of_step = {}};
    const IsaOfGpu gpu = isa_of_gpu(question.gpu, *made, requests, {});
    for (const IsaProgram& program : gpu.programs) {
        if (!program.inverse_throughput || !program.occupancy) continue;
        modes[*mode_of(question.technique, requests.pipelines[program.pipeline])] = {
            .cycles = *program.inverse_throughput * pixels_of_a_tile / invocations_per_throughput,
            .waves = static_cast<std::uint32_t>(std::floor(program.occupancy->waves_per_simd))};
    }
    return {};
}

}  // namespace

Result<ModeCosts> compiled_costs(const CostQuestion& question) {
    if (!question.compile) return fail(Fault::usage, "--cost isa needs a GPU to compile for: add --gpu-model");
    auto session = question.open(question.frames.front().capture);
    if (!session) return session.error();
    std::map<std::uint32_t, lighting::CompiledMode> modes = question.compiled;
    std::vector<std::uint32_t> asked = question.modes;
    std::erase_if(asked, [&](std::uint32_t mode) { return modes.contains(mode); });
    for (std::size_t first = 0; first < asked.size(); first += most_settable_modes - 1) {
        const std::size_t end = std::min(first + most_settable_modes - 1, asked.size());
        auto pipelines = pipelines_of_modes(question, **session, std::span(asked).subspan(first, end - first));
        if (!pipelines) return pipelines.error();
        if (const auto added = add_modes(question, *std::move(pipelines), modes); !added) return added.error();
        if (question.progress) question.progress("compiling modes", double(end) / double(asked.size()));
    }
    if (!modes.contains(every_light_feature))
        return fail(Fault::device_lacks, "{} gave no statistics of the full mode", question.gpu->name);
    const auto waves = [modes](std::uint32_t features) {
        // Of a mode that was not compiled: what the smallest compiled superset leaves.
        const auto known = modes.find(features);
        if (known != modes.end()) return known->second.waves;
        std::uint32_t most = 0;
        for (const auto& [mode, compiled] : modes)
            if ((features & ~mode) == 0) most = std::max(most, compiled.waves);
        return most;
    };
    return ModeCosts{.cost = lighting::compiled_cost(modes), .waves = waves, .unit = "cycles", .compiled = std::move(modes)};
}

}  // namespace strata
