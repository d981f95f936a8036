#include "replay/bench/bench.h"

#include <algorithm>
#include <array>
#include <map>

#include "passes/registry.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

/// Timed so far: the runs of two ways by what they are.
using TimedPairs = std::map<std::string, std::vector<Run>>;

/// Whether a way can be timed on the frame at all.
Result<void> check(Session& session, const Variant& way) {
    const auto planned = session.plan(way.request);
    if (!planned) return planned.error();
    for (const SkippedStage& skipped : planned->skipped)
        if (skipped.stage == way.technique->stage)
            return fail_unnamed(Fault::usage, "the frame does not need {}: {}", name(skipped.stage), skipped.reason);
    if (const std::string reason = unsupported_because(*way.technique, planned->features); !reason.empty())
        return fail_unnamed(Fault::usage, "{} cannot do {}", way.technique->name, reason);
    return {};
}

Result<std::pair<Variant, Variant>> ways_of(Session& session, const Claim& claim) {
    const bool changes = claim.ratio->of_frame.change || claim.ratio->against_frame.change;
    if (changes && !claim.against_frame)
        return fail_unnamed(
            Fault::usage,
            "this ratio changes frames of scenario {} and cannot be measured on a capture: run strata bench without one",
            claim.ratio->scenario);
    const auto of = variant_of(*claim.technique, claim.ratio->of, claim.base);
    if (!of) return of.error();
    Request base = claim.base;
    base.variant.frame = claim.against_frame.value_or(base.variant.frame);
    const auto against = variant_of(*claim.technique, claim.ratio->against, base);
    if (!against) return against.error();
    for (const Variant* way : {&*of, &*against})
        if (const auto fits = check(session, *way); !fits) return fits.error();
    return std::pair{*of, *against};
}

/// Whether a step is one of those that the ratio compares, on the way of this technique.
bool counts(const StepRecord& step, const Technique& technique, const TimeRatio& ratio) {
    if (!ratio.stages.empty()) return step.scope.kind == ScopeKind::act && std::ranges::count(ratio.stages, step.scope.at) > 0;
    const auto is_part = [&](std::string_view part) { return step.name.find(part) != step.name.npos; };
    return is_act_of(step.scope, technique.name) && (ratio.steps.empty() || std::ranges::any_of(ratio.steps, is_part));
}

/// The time of the steps that count, turn by turn; none where there is no such step.
std::vector<double> times_of(const Run& run, const Technique& technique, const TimeRatio& ratio) {
    std::vector<double> sums;
    for (const StepRecord& step : run.steps) {
        if (!counts(step, technique, ratio)) continue;
        sums.resize(step.ms_by_repeat.size());
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += step.ms_by_repeat[i];
    }
    return sums;
}

TimedWay timed_way(const Variant& variant, const Run& run, const TimeRatio& ratio) {
    TimedWay way{.technique = std::string(variant.technique->name),
                 .settings = variant.settings,
                 .ms = spread_of(times_of(run, *variant.technique, ratio)),
                 .counters = {}};
    const auto bytes = run.stage_bytes.find(std::string(name(variant.technique->stage)));
    if (bytes != run.stage_bytes.end()) way.stage_bytes = bytes->second;
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == way.technique && std::ranges::count(ratio.counters, counter.name) > 0)
            way.counters.push_back(counter);
    return way;
}

Result<MeasuredRatio> measure(Session& session, const Claim& claim, std::size_t repeats, TimedPairs& timed) {
    const auto ways = ways_of(session, claim);
    if (!ways) return ways.error();
    const auto& [of, against] = *ways;
    const std::string pair =
        fmt::format("{} in frame {} against {} in frame {}", label(of.technique->name, of.settings), of.request.variant.frame,
                    label(against.technique->name, against.settings), against.request.variant.frame);
    if (!timed.contains(pair)) {
        auto runs = session.time(std::array{of.request, against.request}, repeats);
        if (!runs) return runs.error();
        timed.emplace(pair, *std::move(runs));
    }
    const std::vector<Run>& runs = timed.at(pair);
    if (runs[0].frame_ms_by_repeat.size() < repeats) return fail_unnamed(Fault::stopped, "stopped after some of the timed runs");
    const auto times = times_of(runs[0], *of.technique, *claim.ratio);
    const auto units = times_of(runs[1], *against.technique, *claim.ratio);
    if (times.empty() || units.empty())
        return fail_unnamed(Fault::usage, "{} has none of these steps here", (times.empty() ? of : against).technique->name);
    if (std::ranges::min(units) <= 0)
        return fail_unnamed(Fault::device_lacks, "the device's clock is too coarse for so small a frame");
    MeasuredRatio measured{.claim = claim,
                           .width = runs[0].width,
                           .height = runs[0].height,
                           .samples = runs[0].samples,
                           .of = timed_way(of, runs[0], *claim.ratio),
                           .against = timed_way(against, runs[1], *claim.ratio),
                           .ratio = ratio_of(times, units)};
    measured.of.frame = claim.ratio->of_frame.name;
    measured.against.frame = claim.ratio->against_frame.name;
    return measured;
}

}  // namespace

std::vector<std::string> counted_steps(const TimeRatio& ratio) {
    if (ratio.stages.empty()) return {ratio.steps.begin(), ratio.steps.end()};
    std::vector<std::string> stages;
    for (const Stage stage : ratio.stages) stages.push_back(fmt::format("{}:", name(stage)));
    return stages;
}

Result<Bench> measure_ratios(Session& session, std::span<const Claim> claims, std::size_t repeats, const Progress& progress) {
    Bench bench{.device = session.device(), .repeats = repeats};
    TimedPairs timed;
    std::optional<Error> first_obstacle;
    for (const Claim& claim : claims) {
        if (progress) progress(claim.ratio->name, double(bench.rows.size()) / double(claims.size()));
        auto measured = measure(session, claim, repeats, timed);
        if (measured) {
            bench.rows.push_back(*std::move(measured));
            continue;
        }
        const Error& obstacle = measured.error();
        if (obstacle.fault == Fault::stopped && !bench.rows.empty()) {
            bench.stopped = fmt::format("stopped after {} of {} ratios", bench.rows.size(), claims.size());
            break;
        }
        if (obstacle.fault != Fault::usage && obstacle.fault != Fault::device_lacks) return obstacle;
        if (!first_obstacle) first_obstacle = obstacle;
        bench.rows.push_back({.claim = claim, .not_measured = obstacle.sentence});
    }
    if (progress) progress("done", 1);
    const auto is_measured = [](const MeasuredRatio& row) { return row.not_measured.empty(); };
    if (first_obstacle && std::ranges::none_of(bench.rows, is_measured)) return *first_obstacle;
    return bench;
}

}  // namespace strata
