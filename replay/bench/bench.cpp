#include "replay/bench/bench.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/bench/timed_variants.h"

namespace strata {
namespace {

/// Timed so far: the runs of two variants by what they are.
using TimedPairs = std::map<std::string, std::vector<Run>>;

Result<std::pair<Variant, Variant>> variants_of(Session& session, const Claim& claim) {
    const bool changes = claim.ratio->of_frame.change || claim.ratio->against_frame.change;
    if (changes && !claim.against_frame)
        return fail(
            Fault::usage, "bench.needs_scenario",
            "this ratio changes frames of scenario {scenario} and cannot be measured on a capture: run strata bench without one",
            claim.ratio->scenario);
    auto of = variant_of(*claim.technique, claim.ratio->of, claim.base);
    if (!of) return of.error();
    of->request.unchanged = claim.ratio->of_unchanged;
    Request base = claim.base;
    base.variant.frame = claim.against_frame.value_or(base.variant.frame);
    const auto against = variant_of(*claim.technique, claim.ratio->against, base);
    if (!against) return against.error();
    for (const Variant* variant : {&std::as_const(*of), &*against})
        if (const auto fits = check_can_run(session, *variant); !fits) return fits.error();
    return std::pair{*of, *against};
}

/// The time of the steps that count, repeat by repeat; none where there is no such step.
std::vector<double> times_of(const Run& run, const Technique& technique, const TimeRatio& ratio) {
    if (ratio.stages.empty()) return times_of_steps(run, technique.name, ratio.steps);
    std::vector<double> sums;
    for (const StepRecord& step : run.steps) {
        if (step.scope.kind != ScopeKind::pass || std::ranges::count(ratio.stages, step.scope.at) == 0) continue;
        sums.resize(step.ms_by_repeat.size());
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += step.ms_by_repeat[i];
    }
    return sums;
}

TimedVariant timed_variant(const Variant& variant, const Run& run, const TimeRatio& ratio) {
    TimedVariant timed{.technique = std::string(variant.technique->name),
                       .settings = variant.settings,
                       .ms = spread_of(times_of(run, *variant.technique, ratio)),
                       .counters = {}};
    const auto bytes = run.stage_bytes.find(std::string(name(variant.technique->stage)));
    if (bytes != run.stage_bytes.end()) timed.stage_bytes = bytes->second;
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == timed.technique && std::ranges::count(ratio.counters, counter.name) > 0)
            timed.counters.push_back(counter);
    return timed;
}

/// Why the two variants did the same work, or nothing: neither counted more than the ratio's witness asks for.
std::string same_work(const MeasuredRatio& measured) {
    const RatioWitness& witness = measured.claim.ratio->witness;
    if (witness.counter.empty()) return {};
    for (const TimedVariant* variant : {&measured.of, &measured.against})
        for (const CounterRecord& counter : variant->counters)
            if (counter.name == witness.counter && double(counter.value) > witness.more_than) return {};
    return std::string(witness.otherwise);
}

Result<MeasuredRatio> measure(Session& session, const Claim& claim, std::size_t repeats, TimedPairs& timed) {
    const auto variants = variants_of(session, claim);
    if (!variants) return variants.error();
    const auto& [of, against] = *variants;
    const std::string pair = fmt::format("{}{} in frame {} against {} in frame {}", label(of.technique->name, of.settings),
                                         of.request.unchanged ? " unchanged" : "", of.request.variant.frame,
                                         label(against.technique->name, against.settings), against.request.variant.frame);
    if (!timed.contains(pair)) {
        auto runs = session.time(std::array{of.request, against.request}, repeats);
        if (!runs) return runs.error();
        timed.emplace(pair, *std::move(runs));
    }
    const std::vector<Run>& runs = timed.at(pair);
    if (runs[0].frame_ms_by_repeat.size() < repeats)
        return fail(Fault::stopped, "session.stopped", "stopped after some of the timed runs");
    const auto times = times_of(runs[0], *of.technique, *claim.ratio);
    const auto units = times_of(runs[1], *against.technique, *claim.ratio);
    if (times.empty() || units.empty())
        return fail(Fault::usage, "bench.no_steps", "{technique} has none of these steps here",
                    (times.empty() ? of : against).technique->name);
    if (std::ranges::min(units) <= 0)
        return fail(Fault::device_lacks, "bench.clock_too_coarse", "the device's clock is too coarse for so small a frame");
    MeasuredRatio measured{.claim = claim,
                           .width = runs[0].width,
                           .height = runs[0].height,
                           .samples = runs[0].samples,
                           .of = timed_variant(of, runs[0], *claim.ratio),
                           .against = timed_variant(against, runs[1], *claim.ratio),
                           .ratio = ratio_of(times, units)};
    measured.of.frame = claim.ratio->of_frame.name;
    measured.against.frame = claim.ratio->against_frame.name;
    if (const std::string same = same_work(measured); !same.empty())
        return fail(Fault::usage, "bench.same_work", "{reason}: both variants did the same work", same);
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
