#include "ui/report/modeled_costs.h"

#include <unistd.h>

#include <algorithm>
#include <map>

#include "capture_format/frame/no_index.h"
#include "passes/shaders/scene/no_index.shared.h"
#include "replay/isa/compile_elsewhere.h"
#include "replay/isa/isa_report.h"

namespace strata::ui {
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

/// Milliseconds, or why there are none.
struct Modeled {
    std::optional<double> ms;
    std::string missing;
};

Result<Modeled> model_row(Session& session, const ModeledRequest& wanted, const Measurement& row) {
    const Request request = request_of(row, wanted.base);
    const auto planned = session.plan(request);
    if (!planned) return planned.error();
    const PipelineRequests requests = pipelines_of(planned->plan, row.technique);
    if (requests.pipelines.empty()) return Modeled{0, ""};  // a technique that does nothing costs nothing
    const auto compiled =
        compile_elsewhere(requests.pipelines, {.model = wanted.model, .program = wanted.program, .environment = environ});
    if (!compiled) return compiled.error();
    const auto counts = count_steps(session, request);
    if (!counts) return counts.error();
    const Counting counting{planned->plan, *counts, !session.device().software};
    const IsaOfGpu gpu = isa_of_gpu(wanted.model, *compiled, requests, isa_steps_of(counting, requests));
    for (const IsaStep& isa_step : gpu.steps) {
        if (isa_step.modeled_ms) continue;
        const char* why =
            isa_step.invocations ? "the compiler says nothing of its throughput" : "nothing counts how often it runs";
        return Modeled{{}, fmt::format("{}: {}", isa_step.label, why)};
    }
    return Modeled{gpu.modeled_ms.value_or(0), ""};
}

}  // namespace

std::vector<std::string_view> modeled_gpus() {
    std::vector<std::string_view> names;
    for (const GpuModel& model : gpu_models())
        if (!model.family.empty()) names.push_back(model.name);
    return names;
}

Result<ModeledCosts> model_costs(Session& session, const ModeledRequest& wanted, const strata::Progress& tell) {
    const std::string_view gpu = wanted.model->name;
    ModeledCosts costs{.column = {.kind = ReportColumn::Kind::cost,
                                  .head = fmt::format("kcycles {}", gpu),
                                  .label = fmt::format("modeled kilocycles of {}", gpu),
                                  .values = {}},
                       .missing = {}};
    const Described is{.key = "kilocycles", .title = costs.column.head, .help = ""};
    for (const Measurement& row : wanted.report.rows) {
        const std::size_t done = costs.column.values.size();
        tell(fmt::format("{} on {}", name_of(row), gpu), double(done) / double(wanted.report.rows.size()));
        Modeled modeled{{}, "it cannot do this frame"};
        if (row.accuracy.not_supported.empty()) {
            auto made = model_row(session, wanted, row);
            if (!made) return made.error();
            modeled = *std::move(made);
        }
        // Milliseconds times megahertz.
        costs.column.values.push_back(modeled.ms ? std::optional(*modeled.ms * wanted.model->clock_mhz) : std::nullopt);
        costs.column.texts.push_back(window_cell(is, cell_or_nothing(costs.column.values.back())).text);
        costs.missing.push_back(std::move(modeled.missing));
    }
    return costs;
}

}  // namespace strata::ui
