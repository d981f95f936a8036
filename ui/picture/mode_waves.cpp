#include "ui/picture/mode_waves.h"

#include <unistd.h>

#include <algorithm>
#include <iterator>

#include "capture_format/frame/no_index.h"
#include "passes/shaders/scene/no_index.shared.h"
#include "passes/technique.h"
#include "replay/isa/compile_elsewhere.h"
#include "replay/isa/isa_report.h"

namespace strata::ui {
namespace {

/// The pipelines of the technique that fix the constant that tells its variants.
PipelineRequests variants_of(const Plan& plan, const Technique& technique) {
    PipelineRequests all = pipelines_of(plan), kept;
    std::vector<std::uint32_t> places(all.pipelines.size(), no_index);
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const std::uint32_t pipeline = all.of_step[i];
        kept.of_step.push_back(no_index);
        const Step& step = plan.steps[i].step;
        if (pipeline == no_index || !is_pass_of(plan.scopes[step.scope], technique.name)) continue;
        if (std::ranges::find(step.fixed, technique.abilities.variants->constant, &Fixed::name) == step.fixed.end()) continue;
        if (places[pipeline] == no_index) {
            places[pipeline] = static_cast<std::uint32_t>(kept.pipelines.size());
            kept.pipelines.push_back(std::move(all.pipelines[pipeline]));
        }
        kept.of_step.back() = places[pipeline];
    }
    return kept;
}

Result<Compilation> compile_each(const PipelineRequests& requests, const ModesOnGpu& of, Progress& progress) {
    Compilation made;
    for (const PipelineRequest& pipeline : requests.pipelines) {
        const double done = static_cast<double>(made.pipelines.size()) / static_cast<double>(requests.pipelines.size());
        if (!progress.at(done, pipeline.label)) return fail(Fault::stopped, "session.stopped", "stopped");
        auto compiled = compile_elsewhere({pipeline}, {.model = &of.gpu, .program = of.program, .environment = environ});
        if (!compiled) return compiled.error();
        made.device = compiled->device;
        made.driver = compiled->driver;
        std::ranges::move(compiled->pipelines, std::back_inserter(made.pipelines));
    }
    return made;
}

}  // namespace

std::vector<const GpuModel*> compilable_gpus() {
    std::vector<const GpuModel*> found;
    for (const GpuModel& model : gpu_models())
        if (!model.family.empty()) found.push_back(&model);
    return found;
}

Result<TileWaves> waves_of_modes(Session& session, Progress& progress, const Request& shown, const ModesOnGpu& of) {
    Request request = shown;
    request.outputs = {"display"};
    auto planned = session.plan(request);
    if (!planned) return planned.error();
    const PipelineRequests requests = variants_of(planned->plan, of.technique);
    std::vector<IsaStep> isa_steps = isa_steps_of({planned->plan, {}}, requests);
    request.outputs = outputs_of_variants(of.technique);
    const auto run = session.run(request);
    if (!run) return run.error();
    const auto made = compile_each(requests, of, progress);
    if (!made) return made.error();
    const IsaOfGpu gpu = isa_of_gpu(&of.gpu, *made, requests, std::move(isa_steps));
    return waves_of_tiles({of.technique, *run, gpu, requests});
}

}  // namespace strata::ui
