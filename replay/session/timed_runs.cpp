// Timing several requests beside each other: what they have in common is executed, and timed, once per repeat.
#include <algorithm>
#include <functional>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/object_order.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/gpu/host_timer.h"
#include "replay/session/describe_run.h"
#include "replay/session/device_session.h"

namespace strata {
namespace {

/// The steps of a pass by name, in order.
using PassCosts = std::vector<std::pair<std::string, StepCost>>;
/// Tells equal scopes from others: a pass by its key (PassKeys), any other scope by the request.
struct ExecutedScope {
    Scope scope;
    std::optional<std::uint64_t> key = {};
    std::size_t request = 0;
    friend auto operator<=>(const ExecutedScope&, const ExecutedScope&) = default;
};
/// What one repeat has executed.
using ExecutedPasses = std::map<ExecutedScope, PassCosts>;

/// The scopes of a request: equal passes of two requests are the same one.
class RequestScopes {
public:
    RequestScopes(const Declaration& d, std::size_t request) : request_(request) {
        for (std::size_t i = 0; i < d.pass_keys.size(); ++i)
            keys_.emplace(d.graph.scopes()[d.frame.passes[i].scope], d.pass_keys[i]);
    }
    ExecutedScope operator()(const Scope& scope) const {
        const auto key = keys_.find(scope);
        return key == keys_.end() ? ExecutedScope{scope, {}, request_} : ExecutedScope{scope, key->second};
    }

private:
    std::map<Scope, std::uint64_t> keys_;
    std::size_t request_;
};

void add_executed(const Declaration& d, const Execution& execution, const RequestScopes& of, ExecutedPasses& passes) {
    ExecutedPasses now;
    for (std::size_t i = 0; i < d.plan.steps.size(); ++i) {
        const Step& step = d.plan.steps[i].step;
        now[of(d.plan.scopes[step.scope])].emplace_back(step.name, execution.step_costs[i]);
    }
    for (auto& [scope, costs] : now) passes.insert_or_assign(scope, std::move(costs));
}

/// The costs of a whole frame's steps from what the repeat executed; nothing when one of them is missing.
std::optional<std::vector<StepCost>> costs_of(const std::vector<StepRecord>& steps, const RequestScopes& of,
                                              const ExecutedPasses& passes) {
    std::map<ExecutedScope, std::size_t> next;
    std::vector<StepCost> costs;
    for (const StepRecord& step : steps) {
        const ExecutedScope scope = of(step.scope);
        const auto pass = passes.find(scope);
        if (pass == passes.end()) return {};
        std::size_t& at = next[scope];
        while (at < pass->second.size() && pass->second[at].first != step.name) ++at;
        if (at == pass->second.size()) return {};
        costs.push_back(pass->second[at++].second);
    }
    return costs;
}

/// What an execution with the memo gave, for a run that describes the whole frame.
void add_results(Run& whole, Run executed) {
    executed.memory.over_time = std::move(whole.memory.over_time);
    whole.memory = std::move(executed.memory);
    whole.counters = std::move(executed.counters);
    whole.not_counted = std::move(executed.not_counted);
    whole.not_supported = std::move(executed.not_supported);
    whole.notes = std::move(executed.notes);
    whole.host_ms = executed.host_ms;
    whole.images = std::move(executed.images);
    whole.tables = std::move(executed.tables);
}

}  // namespace

Result<DeviceSession::TimedRun> DeviceSession::time_alone(const Request& request, const RunOptions& measured) {
    const auto declared = prepare(request, nullptr, Keep::outputs);
    if (!declared) return declared.error();
    const Work work = request.unchanged ? Work::found : Work::done;
    if (request.unchanged)
        if (const auto before = execute(*declared, {}, work); !before) return before.error();
    auto execution = execute(*declared, measured, work);
    if (!execution) return execution.error();
    TimedRun timed{finished(*declared, *execution), std::move(execution->step_costs), execution->empty_step_ms};
    return timed;
}

Result<Spread> DeviceSession::time_whole(const Request& request, std::size_t repeats) {
    const auto declared = prepare(request, nullptr, Keep::outputs);
    if (!declared) return declared.error();
    std::vector<double> ms;
    while (ms.size() < repeats) {
        const auto execution =
            execute(*declared, {.timestamps = Timestamps::around_all}, request.unchanged ? Work::found : Work::done);
        if (!execution) return execution.error();
        ms.push_back(*execution->all_steps_ms);
    }
    return spread_of(ms);
}

Result<void> DeviceSession::count_invocations(std::span<const Request> requests, std::vector<Run>& runs) {
    std::vector<Request> counted;
    std::vector<Run> counted_runs;
    for (std::size_t i = 0; i < requests.size(); ++i) {
        if (!requests[i].counted) continue;
        counted.push_back(requests[i]);
        counted_runs.push_back({.steps = runs[i].steps, .skipped = runs[i].skipped});
    }
    if (counted.empty()) return {};
    const auto turn = time_one_repeat(counted, counted_runs, {.invocations = Invocations::counted}, {});
    if (!turn) return turn.error();
    for (std::size_t i = 0, place = 0; i < requests.size(); ++i)
        if (requests[i].counted) add_invocations(runs[i], (*turn)[place++].steps);
    return {};
}

Result<Run> DeviceSession::plan_run(const Request& request) {
    return prepare(request, nullptr, Keep::outputs).and_then([&](auto& declared) { return describe_run(declared); });
}

Result<void> DeviceSession::time_sorts(const Request& request, const Run& run, std::map<std::string, double>& sorts) {
    const auto choices = choose(loaded_->frame, request.choices);
    if (!choices) return choices.error();
    for (const auto& [stage, choice] : *choices) {
        if (!choice.technique->abilities.sorts_objects || std::ranges::count(run.skipped, stage, &SkippedStage::stage) > 0)
            continue;
        const Frame& frame = loaded_->frame;
        HostTimer timer;
        back_to_front_draws(frame);
        for (const Emitter& emitter : frame.emitters) back_to_front_particles(frame, emitter);
        sorts[std::string(name(stage))] = timer();
    }
    return {};
}

Result<DeviceSession::RepeatTimes> DeviceSession::time_one_repeat(std::span<const Request> requests, std::vector<Run>& runs,
                                                                  const RunOptions& measured, const Progress& progress) {
    const bool is_first = runs.empty();
    memo_.clear();
    ExecutedPasses passes;
    RepeatTimes times(requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
        if (progress) progress("", double(i) / double(requests.size()));
        if (is_first) {
            auto planned = plan_run(requests[i]);
            if (!planned) return planned.error();
            runs.push_back(*std::move(planned));
        }
        std::optional<std::vector<StepCost>> costs;
        if (requests.size() > 1 && !requests[i].unchanged) {
            const auto declared = prepare_with_memo(requests[i], measured);
            if (!declared) return declared.error();
            const auto execution = execute(*declared, measured);
            if (!execution) return execution.error();
            remember(*declared, *execution);
            const RequestScopes of(*declared, i);
            add_executed(*declared, *execution, of, passes);
            costs = costs_of(runs[i].steps, of, passes);
            times[i].empty_step_ms = execution->empty_step_ms;
            if (is_first) add_results(runs[i], finished(*declared, *execution));
            else runs[i].counters = run_counters(*declared, *execution);
        }
        if (!costs) {
            auto alone = time_alone(requests[i], measured);
            if (!alone) return alone.error();
            costs = std::move(alone->step_costs);
            times[i].empty_step_ms = alone->empty_step_ms;
            if (is_first) runs[i] = std::move(alone->run);
            else runs[i].counters = std::move(alone->run.counters);
        }
        times[i].steps = *std::move(costs);
        if (const auto sorted = time_sorts(requests[i], runs[i], times[i].sorts); !sorted) return sorted.error();
    }
    return times;
}

Result<std::vector<Run>> DeviceSession::time(std::span<const Request> requests, std::size_t repeats, const Progress& progress) {
    std::vector<Run> runs;
    if (requests.empty()) return runs;
    drop_large_fragments(memo_.budget());
    std::vector<std::vector<std::vector<StepCost>>> steps(requests.size());
    std::vector<SortTimes> sorts(requests.size());
    std::vector<std::vector<double>> empty_steps(requests.size());
    const auto add = [&](RepeatTimes turn) {
        for (std::size_t i = 0; i < turn.size(); ++i) {
            steps[i].push_back(std::move(turn[i].steps));
            for (const auto& [stage, ms] : turn[i].sorts) sorts[i][stage].push_back(ms);
            if (turn[i].empty_step_ms) empty_steps[i].push_back(*turn[i].empty_step_ms);
        }
    };
    const std::size_t pipelines_before = executor_->pipelines_created();
    for (std::size_t place = 0; steps.front().size() < repeats; ++place) {
        const std::string what = place == 0 ? "warming up" : fmt::format("timing, {} of {}", steps.front().size() + 1, repeats);
        auto turn = time_one_repeat(requests, runs, {.timestamps = Timestamps::on}, [&](std::string_view, double done) {
            if (progress) progress(what, (double(place) + done) / double(repeats + 1));
        });
        if (!turn && turn.error().fault == Fault::stopped && !steps.front().empty()) break;
        if (!turn) return turn.error();
        const bool is_warm = place > 0 || (requests.size() > 1 && executor_->pipelines_created() == pipelines_before);
        if (is_warm) add(*std::move(turn));
    }
    for (std::size_t i = 0; i < runs.size(); ++i) {
        add_costs(runs[i], steps[i], sorts[i]);
        if (!empty_steps[i].empty()) runs[i].empty_step_ms = spread_of(empty_steps[i]);
    }
    if (stop_.stop_requested()) return runs;
    if (const auto counted = count_invocations(requests, runs); !counted && counted.error().fault != Fault::stopped)
        return counted.error();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (!requests[i].whole) continue;
        const auto whole = time_whole(requests[i], steps[i].size());
        if (whole) runs[i].whole_frame_ms = *whole;
        else if (whole.error().fault != Fault::stopped) return whole.error();
    }
    return runs;
}

}  // namespace strata
