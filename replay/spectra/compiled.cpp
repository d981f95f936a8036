// What a tile costs by the mode that shades it, as a compiler estimates it for a GPU that need not be there
// (docs/algorithms/lighting.md 3.5): the technique's shader is taken from the plan of a frame, compiled with the
// constant of every mode, and priced by its cycles for a tile's pixels times the penalty for the waves it leaves no room for.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "replay/isa/isa_report.h"
#include "replay/spectra/spectra.h"

namespace strata {
namespace {

constexpr double pixels_of_a_tile = 256, invocations_per_throughput = 64;

/// Between two reports of progress.
constexpr std::size_t modes_at_once = 15;

/// The constant that tells a mode's pipeline from another's; null in pipelines that shade nothing.
std::uint32_t* mode_of(const Technique& technique, PipelineRequest& request) {
    for (Fixed& fixed : request.step.step.fixed)
        if (fixed.name == technique.abilities.feature_modes->constant) return std::get_if<std::uint32_t>(&fixed.value);
    return nullptr;
}

/// The pipelines of the full mode, which every frame dispatches when it is alone.
Result<std::vector<PipelineRequest>> pipelines_of_full_mode(const CostQuestion& question, Session& session) {
    Request request = question.base;
    request.variant.frame = question.frames.front().frame;
    request.outputs = {std::string(info(question.technique.stage).outputs.front())};
    use_modes(request.choices, question.technique, std::array{every_light_feature});
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    std::vector<PipelineRequest> pipelines = pipelines_of(planned->plan).pipelines;
    std::erase_if(pipelines, [&](PipelineRequest& pipeline) { return !mode_of(question.technique, pipeline); });
    return pipelines;
}

/// The same with the constants of other modes: those too that no tile of the frame would be shaded by.
std::vector<PipelineRequest> in_modes(const Technique& technique, std::span<const PipelineRequest> full,
                                      std::span<const std::uint32_t> modes) {
    std::vector<PipelineRequest> pipelines;
    for (const std::uint32_t mode : modes)
        for (const PipelineRequest& pipeline : full) *mode_of(technique, pipelines.emplace_back(pipeline)) = mode;
    return pipelines;
}

Result<void> add_modes(const CostQuestion& question, std::vector<PipelineRequest> pipelines,
                       std::map<std::uint32_t, lighting::CompiledMode>& modes) {
    const auto made = question.compile(pipelines);
    if (!made) return made.error();
    PipelineRequests requests{.pipelines = std::move(pipelines), .of_step = {}};
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
    const auto full = pipelines_of_full_mode(question, **session);
    if (!full) return full.error();
    for (std::size_t first = 0; first < asked.size(); first += modes_at_once) {
        const std::size_t count = std::min(modes_at_once, asked.size() - first);
        auto pipelines = in_modes(question.technique, *full, std::span(asked).subspan(first, count));
        if (const auto added = add_modes(question, std::move(pipelines), modes); !added) return added.error();
        if (question.progress) question.progress("compiling modes", double(first + count) / double(asked.size()));
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
