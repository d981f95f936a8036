#include "ui/frame/frame_rows.h"

#include <algorithm>

#include "passes/stages.h"

namespace strata::ui {
namespace {

std::vector<FramePass> passes_of(const std::vector<PlanRow>& steps) {
    std::vector<FramePass> passes;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const PlanRow& step = steps[i];
        if (passes.empty() || passes.back().scope != step.scope) passes.push_back({.scope = step.scope, .first = i});
        FramePass& pass = passes.back();
        pass.end = i + 1;
        pass.barriers += step.barriers;
        pass.draws += step.draws;
        pass.made_bytes += step.made_bytes;
        pass.alive_bytes = std::max(pass.alive_bytes, step.alive_bytes);
    }
    return passes;
}

/// The measured steps of a pass's scope are in one place, too.
void take_times(FrameRows& rows, FramePass& pass, const std::vector<PlanRow>& steps, const std::vector<StepRecord>& timed) {
    const auto begin = std::ranges::find(timed, pass.scope, &StepRecord::scope);
    const auto first = static_cast<std::size_t>(begin - timed.begin());
    bool has_all = true;
    for (std::size_t i = pass.first; i < pass.end; ++i) {
        const std::size_t place = first + i - pass.first;
        const bool is_same =
            place < timed.size() && timed[place].scope == pass.scope && timed[place].name == steps[i].name && timed[place].ms;
        if (is_same) rows.timed[i] = place;
        has_all = has_all && is_same;
    }
    if (has_all) pass.ms = spread_of_sum(timed, first, first + pass.end - pass.first);
}

}  // namespace

FrameRows frame_rows(const Replay& replay, const FrameTimes* times) {
    FrameRows rows{.passes = passes_of(replay.steps), .timed = {}};
    rows.timed.resize(replay.steps.size());
    for (FramePass& pass : rows.passes) {
        pass.is_executed = std::ranges::find(replay.run.steps, pass.scope, &StepRecord::scope) != replay.run.steps.end();
        if (times) take_times(rows, pass, replay.steps, times->run.steps);
    }
    return rows;
}

namespace {

/// What makes a view is no pass of the frame: looking at one changes no count.
bool counts(const FramePass& pass) { return pass.scope.kind != ScopeKind::view; }

}  // namespace

std::size_t FrameRows::executed() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(passes, [](const FramePass& pass) { return counts(pass) && pass.is_executed; }));
}

std::optional<std::size_t> FrameRows::step_timed_as(std::size_t place) const {
    const auto step = std::ranges::find(timed, std::optional(place));
    return step == timed.end() ? std::nullopt : std::optional(static_cast<std::size_t>(step - timed.begin()));
}

std::optional<Spread> spread_of_sum(const std::vector<StepRecord>& steps, std::size_t first, std::size_t end) {
    std::vector<double> sums;
    for (std::size_t i = first; i < end; ++i) {
        sums.resize(std::max(sums.size(), steps[i].ms_by_repeat.size()));
        for (std::size_t repeat = 0; repeat < steps[i].ms_by_repeat.size(); ++repeat)
            sums[repeat] += steps[i].ms_by_repeat[repeat];
    }
    return sums.empty() ? std::nullopt : std::optional(spread_of(sums));
}

std::string time_text(const Spread& spread) {
    // Three digits of what counts: a column holds no more.
    const int digits = spread.median >= 1000 ? 0 : spread.median >= 100 ? 1 : spread.median >= .1 ? 2 : 3;
    return spread.mad > 0 ? fmt::format("{:.{}f} \xc2\xb1{:.{}f}", spread.median, digits, spread.mad, digits)
                          : fmt::format("{:.{}f}", spread.median, digits);
}

std::string face_of(const Scope& scope) {
    if (scope.kind == ScopeKind::view) return fmt::format("{}:{} at view", scope.technique, scope.view);
    if (scope.kind != ScopeKind::pass) return text_of(scope);
    return scope.at == scope.stage ? scope.technique : fmt::format("{} at {}", scope.technique, name(scope.at));
}

std::string short_name(std::string_view step) { return std::string(step.substr(step.rfind('/') + 1)); }

std::string executed_text(const FrameRows& rows) {
    const std::size_t executed = rows.executed(), all = static_cast<std::size_t>(std::ranges::count_if(rows.passes, counts));
    return fmt::format("{} of {} {} run, {} reused", executed, all, all == 1 ? "pass" : "passes", all - executed);
}

std::optional<std::size_t> step_beside(const std::vector<std::size_t>& steps, std::optional<std::size_t> selected,
                                       int direction) {
    if (steps.empty()) return {};
    if (!selected) return direction > 0 ? steps.front() : steps.back();
    if (direction > 0) {
        const auto next = std::ranges::upper_bound(steps, *selected);
        return next == steps.end() ? std::nullopt : std::optional(*next);
    }
    const auto at = std::ranges::lower_bound(steps, *selected);
    return at == steps.begin() ? std::nullopt : std::optional(*std::prev(at));
}

}  // namespace strata::ui
