// What a tile costs by the mode that shades it, as a compiler estimates it for a GPU that need not be there
// (docs/algorithms/lighting.md 3.5): the technique's shader is taken from the plan of a frame, compiled with the
// constant of every mode, and priced by its cycles for a tile's pixels times the penalty for the waves it leaves no room for.
// Tap visibility is not the technique's: the steps of the stage indirect that read light volumes are priced with and without it.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/isa/isa_report.h"
#include "replay/spectra/spectra.h"

namespace strata {
namespace {

constexpr double pixels_of_a_tile = 256, invocations_per_throughput = 64;

/// Between two reports of progress.
constexpr std::size_t modes_at_once = 15;

/// The constant of steps that read light volumes: 1 where they ask blockers about what they read.
constexpr std::string_view tap_visibility_constant = "asks_taps";

/// A pipeline's constant of that name; null where it has none.
std::uint32_t* constant_of(PipelineRequest& request, std::string_view name) {
    for (Fixed& fixed : request.step.step.fixed)
        if (fixed.name == name) return std::get_if<std::uint32_t>(&fixed.value);
    return nullptr;
}

/// The constant that tells a mode's pipeline from another's; null in pipelines that shade nothing.
std::uint32_t* mode_of(const Technique& technique, PipelineRequest& request) {
    return constant_of(request, technique.abilities.feature_modes->constant);
}

/// The pipelines of a frame in which one mode of all features is alone, as far as the stage's first output needs them.
Result<std::vector<PipelineRequest>> pipelines_for(Stage stage, const CostQuestion& question, const FrameSpectra& frame) {
    auto session = question.open(frame.capture);
    if (!session) return session.error();
    Request request = question.base;
    request.variant.frame = frame.frame;
    request.outputs = {std::string(info(stage).outputs.front())};
    use_modes(request.choices, question.technique, std::array{every_light_feature});
    const auto planned = (*session)->plan(request);
    if (!planned) return planned.error();
    return pipelines_of(planned->plan).pipelines;
}

/// The pipelines of the full mode, which every frame dispatches when it is alone.
Result<std::vector<PipelineRequest>> pipelines_of_full_mode(const CostQuestion& question) {
    auto pipelines = pipelines_for(question.technique.stage, question, question.frames.front());
    if (!pipelines) return pipelines.error();
    std::erase_if(*pipelines, [&](PipelineRequest& pipeline) { return !mode_of(question.technique, pipeline); });
    return pipelines;
}

/// What a program takes of a tile; nothing where the compiler does not say it.
std::optional<lighting::CompiledMode> compiled_mode(const IsaProgram& program) {
    if (!program.inverse_throughput || !program.occupancy) return std::nullopt;
    return lighting::CompiledMode{.cycles = *program.inverse_throughput * pixels_of_a_tile / invocations_per_throughput,
                                  .waves = static_cast<std::uint32_t>(std::floor(program.occupancy->waves_per_simd))};
}

/// The same with the constants of other modes: those too that no tile of the frame would be shaded by.
std::vector<PipelineRequest> in_modes(const Technique& technique, std::span<const PipelineRequest> full,
                                      std::span<const std::uint32_t> modes) {
    std::vector<PipelineRequest> pipelines;
    for (const std::uint32_t mode : modes)
        for (const PipelineRequest& pipeline : full) *mode_of(technique, pipelines.emplace_back(pipeline)) = mode;
    return pipelines;
}

bool has_tap_visibility(const FrameSpectra& frame) {
    return std::ranges::any_of(frame.tiles, [](const auto& row) { return (row.first & feature_gi_tap_visibility) != 0; });
}

/// What reading light volumes takes of a tile, in the unit of modes, and leaves room for: without and with tap visibility.
struct TapCosts {
    std::array<double, 2> costs = {};
    std::array<std::uint32_t, 2> waves = {};
};

/// The steps of the first frame that reads volumes, compiled both ways; those with fewer waves have the penalty against the
/// others.
Result<TapCosts> tap_costs(const CostQuestion& question) {
    TapCosts costs;
    const auto frame = std::ranges::find_if(question.frames, has_tap_visibility);
    if (frame == question.frames.end()) return costs;
    auto found = pipelines_for(Stage::indirect, question, *frame);
    if (!found) return found.error();
    std::vector<PipelineRequest> pipelines;
    for (PipelineRequest& pipeline : *found)
        if (const std::uint32_t* asks = constant_of(pipeline, tap_visibility_constant); asks && *asks != 0)
            for (const std::uint32_t value : {0u, 1u})
                *constant_of(pipelines.emplace_back(pipeline), tap_visibility_constant) = value;
    if (pipelines.empty()) return costs;
    const auto made = question.compile(pipelines);
    if (!made) return made.error();
    PipelineRequests requests{.pipelines = std::move(pipelines), .of_step = {}};
    std::array<std::vector<lighting::CompiledMode>, 2> ways;
    for (const IsaProgram& program : isa_of_gpu(question.gpu, *made, requests, {}).programs)
        if (const auto mode = compiled_mode(program))
            ways[*constant_of(requests.pipelines[program.pipeline], tap_visibility_constant)].push_back(*mode);
    for (std::size_t way = 0; way < ways.size(); ++way)
        for (const lighting::CompiledMode& step : ways[way])
            costs.waves[way] = costs.waves[way] == 0 ? step.waves : std::min(costs.waves[way], step.waves);
    const std::uint32_t most_waves = std::ranges::max(costs.waves);
    for (std::size_t way = 0; way < ways.size(); ++way)
        for (const lighting::CompiledMode& step : ways[way])
            costs.costs[way] += step.cycles * lighting::occupancy_penalty(step.waves, most_waves);
    return costs;
}

Result<void> add_modes(const CostQuestion& question, std::vector<PipelineRequest> pipelines,
                       std::map<std::uint32_t, lighting::CompiledMode>& modes) {
    const auto made = question.compile(pipelines);
    if (!made) return made.error();
    PipelineRequests requests{.pipelines = std::move(pipelines), .of_step = {}};
    const IsaOfGpu gpu = isa_of_gpu(question.gpu, *made, requests, {});
    for (const IsaProgram& program : gpu.programs)
        if (const auto mode = compiled_mode(program))
            modes[*mode_of(question.technique, requests.pipelines[program.pipeline])] = *mode;
    return {};
}

}  // namespace

Result<ModeCosts> compiled_costs(const CostQuestion& question) {
    if (!question.compile) return fail(Fault::usage, "spectra.no_gpu", "--cost isa needs a GPU to compile for: add --gpu-model");
    std::map<std::uint32_t, lighting::CompiledMode> modes = question.compiled;
    std::vector<std::uint32_t> asked = question.modes;
    std::erase_if(asked, [&](std::uint32_t mode) { return modes.contains(mode); });
    const auto full = pipelines_of_full_mode(question);
    if (!full) return full.error();
    for (std::size_t first = 0; first < asked.size(); first += modes_at_once) {
        const std::size_t count = std::min(modes_at_once, asked.size() - first);
        auto pipelines = in_modes(question.technique, *full, std::span(asked).subspan(first, count));
        if (const auto added = add_modes(question, std::move(pipelines), modes); !added) return added.error();
        if (question.progress) question.progress("compiling modes", double(first + count) / double(asked.size()));
    }
    const auto taps = tap_costs(question);
    if (!taps) return taps.error();
    if (!modes.contains(every_light_feature))
        return fail(Fault::device_lacks, "spectra.no_statistics", "{gpu} gave no statistics of the full mode",
                    question.gpu->name);
    const auto waves = [modes](std::uint32_t features) {
        // Of a mode that was not compiled: what the smallest compiled superset leaves.
        const auto known = modes.find(features);
        if (known != modes.end()) return known->second.waves;
        std::uint32_t most = 0;
        for (const auto& [mode, compiled] : modes)
            if ((features & ~mode) == 0) most = std::max(most, compiled.waves);
        return most;
    };
    const auto cost = [lit = lighting::compiled_cost(modes), taps = *taps](std::uint32_t features) {
        return lit(features) + taps.costs[(features & feature_gi_tap_visibility) != 0 ? 1 : 0];
    };
    return ModeCosts{.cost = cost, .waves = waves, .tap_waves = taps->waves, .unit = "cycles", .compiled = std::move(modes)};
}

}  // namespace strata
