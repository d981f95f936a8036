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
    const auto frame = session.frame(way.request.frame);
    if (!frame) return frame.error();
    const auto planned = session.plan(way.request);
    if (!planned) return planned.error();
    for (const SkippedStage& skipped : planned->skipped)
        if (skipped.stage == way.technique->stage)
            return fail(Fault::usage, "the frame does not need {}: {}", name(skipped.stage), skipped.reason);
    const Features features = frame_features(*frame);
    if (const auto feature = unsupported(*way.technique, features))
        return fail(Fault::usage, "{} cannot do {} ({})", way.technique->name, name(*feature), features.reason(*feature));
    return {};
}

Result<std::pair<Variant, Variant>> ways_of(Session& session, const Claim& claim) {
    const auto of = variant_of(*claim.technique, claim.ratio->of, claim.base);
    if (!of) return of.error();
    const auto against = variant_of(*claim.technique, claim.ratio->against, claim.base);
    if (!against) return against.error();
    for (const Variant* way : {&*of, &*against})
        if (const auto fits = check(session, *way); !fits) return fits.error();
    return std::pair{*of, *against};
}

/// A part that ends with a colon is a stage, all of whose steps count: "gbuffer:" for what culling saves there.
bool counts(const StepRecord& step, const Technique& technique, std::span<const std::string_view> parts) {
    const bool is_own = step.scope.ends_with(fmt::format(": {}", technique.name));
    const auto is_meant = [&](std::string_view part) {
        return part.ends_with(':') ? step.scope.starts_with(part) : is_own && step.name.find(part) != step.name.npos;
    };
    return parts.empty() ? is_own : std::ranges::any_of(parts, is_meant);
}

/// The time of the steps that count, turn by turn; none where there is no such step.
std::vector<double> times_of(const Run& run, const Technique& technique, std::span<const std::string_view> parts) {
    std::vector<double> sums;
    for (const StepRecord& step : run.steps) {
        if (!counts(step, technique, parts)) continue;
        sums.resize(step.ms_by_repeat.size());
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += step.ms_by_repeat[i];
    }
    return sums;
}

TimedWay timed_way(const Variant& variant, const Run& run, const TimeRatio& ratio) {
    TimedWay way{
        std::string(variant.technique->name), variant.settings, spread_of(times_of(run, *variant.technique, ratio.steps)), {}};
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == way.technique && std::ranges::count(ratio.counters, counter.name) > 0)
            way.counters.push_back(counter);
    return way;
}

Result<MeasuredRatio> measure(Session& session, const Claim& claim, std::size_t repeats, TimedPairs& timed) {
    const auto ways = ways_of(session, claim);
    if (!ways) return ways.error();
    const auto& [of, against] = *ways;
    const std::string pair = fmt::format("{} against {} in frame {}", label(of.technique->name, of.settings),
                                         label(against.technique->name, against.settings), claim.base.frame);
    if (!timed.contains(pair)) {
        auto runs = session.time(std::array{of.request, against.request}, repeats);
        if (!runs) return runs.error();
        timed.emplace(pair, *std::move(runs));
    }
    const std::vector<Run>& runs = timed.at(pair);
    const auto times = times_of(runs[0], *of.technique, claim.ratio->steps);
    const auto units = times_of(runs[1], *against.technique, claim.ratio->steps);
    if (times.empty() || units.empty())
        return fail(Fault::usage, "{} has none of these steps here", (times.empty() ? of : against).technique->name);
    if (std::ranges::min(units) <= 0) return fail(Fault::device_lacks, "the device's clock is too coarse for so small a frame");
    return MeasuredRatio{.claim = claim,
                         .width = runs[0].width,
                         .height = runs[0].height,
                         .samples = runs[0].samples,
                         .of = timed_way(of, runs[0], *claim.ratio),
                         .against = timed_way(against, runs[1], *claim.ratio),
                         .ratio = ratio_of(times, units)};
}

}  // namespace

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
