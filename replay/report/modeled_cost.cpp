#include "replay/report/modeled_cost.h"

#include <unistd.h>

#include <map>

#include "capture_format/frame/no_index.h"
#include "passes/shaders/scene/no_index.shared.h"
#include "replay/isa/compile_elsewhere.h"
#include "replay/isa/isa_report.h"

namespace strata {
namespace {

/// The pipelines of the technique's steps alone, wherever in the frame these stand.
PipelineRequests pipelines_of(const Plan& plan, std::string_view technique) {
    PipelineRequests all = strata::pipelines_of(plan), own;
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const std::uint32_t pipeline = all.of_step[i];
        const bool is_own = pipeline != no_index && is_pass_of(plan.scopes[plan.steps[i].step.scope], technique);
        if (!is_own) {
            own.of_step.push_back(no_index);
            continue;
        }
        const auto [number, is_new] = numbers.try_emplace(pipeline, static_cast<std::uint32_t>(own.pipelines.size()));
        if (is_new) own.pipelines.push_back(std::move(all.pipelines[pipeline]));
        own.of_step.push_back(number->second);
    }
    return own;
}

}  // namespace

std::vector<std::string_view> modeled_gpus() {
    std::vector<std::string_view> names;
    for (const GpuModel& model : gpu_models())
        if (!model.family.empty()) names.push_back(model.name);
    return names;
}

Result<ModeledCost> model_cost(Session& session, const Request& base, const Measurement& row, const GpuModel& model,
                               const std::filesystem::path& program) {
    const auto of_cycles = [&](double ms) {
        return ModeledCost{.kilocycles = ms * model.clock_mhz, .ms = ms};  // milliseconds times megahertz
    };
    if (!row.accuracy.not_supported.empty()) return ModeledCost{.missing = "it cannot do this frame"};
    const Request request = request_of(row, base);
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    const PipelineRequests requests = pipelines_of(planned->plan, row.technique);
    if (requests.pipelines.empty()) return of_cycles(0);  // a technique that does nothing costs nothing
    const auto compiled = compile_elsewhere(requests.pipelines, {.model = &model, .program = program, .environment = environ});
    if (!compiled) return compiled.error();
    const auto counts = count_steps(session, request);
    if (!counts) return counts.error();
    const Counting counting{planned->plan, *counts, !session.device().software};
    const IsaOfGpu gpu = isa_of_gpu(&model, *compiled, requests, isa_steps_of(counting, requests));
    for (const IsaStep& isa_step : gpu.steps) {
        if (isa_step.modeled_ms) continue;
        const char* why =
            isa_step.invocations ? "the compiler says nothing of its throughput" : "nothing counts how often it runs";
        return ModeledCost{.missing = fmt::format("{}: {}", isa_step.label, why)};
    }
    return of_cycles(gpu.modeled_ms.value_or(0));
}

}  // namespace strata
