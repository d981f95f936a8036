#include "replay/bench/timed_variants.h"

#include <algorithm>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"

namespace strata {

Result<void> check_can_run(Session& session, const Variant& variant) {
    const auto planned = session.plan(variant.request);
    if (!planned) return planned.error();
    for (const SkippedStage& skipped : planned->skipped)
        if (skipped.stage == variant.technique->stage)
            return fail(Fault::usage, "stage.not_needed", "the frame does not need {stage}: {reason}", name(skipped.stage),
                        skipped.reason);
    if (const std::string reason = unsupported_because(*variant.technique, planned->features); !reason.empty())
        return fail(Fault::usage, "technique.cannot_do", "{technique} cannot do {feature}", variant.technique->name, reason);
    return {};
}

std::vector<double> times_of_steps(const Run& run, std::string_view technique, std::span<const std::string_view> parts) {
    std::vector<double> sums;
    for (const StepRecord& step : run.steps) {
        const auto is_part = [&](std::string_view part) { return step.name.find(part) != std::string::npos; };
        if (!is_pass_of(step.scope, technique) || !(parts.empty() || std::ranges::any_of(parts, is_part))) continue;
        sums.resize(step.ms_by_repeat.size());
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += step.ms_by_repeat[i];
    }
    return sums;
}

}  // namespace strata
