#include "replay/report/hard_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/technique.h"
#include "replay/gpu/kept_pipelines.h"
#include "replay/session/session_on_device.h"

namespace strata {
namespace {

/// A case's frames in the session.
struct Placed {
    const HardCase* hard_case = nullptr;
    std::size_t first = 0, count = 0;
};

struct CaseFrames {
    std::vector<Frame> all;
    std::vector<Placed> cases;
};

CaseFrames frames_of_all_cases() {
    CaseFrames frames;
    for (const HardCase& hard_case : hard_cases()) {
        std::vector<Frame> built = hard_case.build();
        frames.cases.push_back({&hard_case, frames.all.size(), built.size()});
        std::ranges::move(built, std::back_inserter(frames.all));
    }
    return frames;
}

/// What a frame gave and what it should have.
struct Seen {
    ReferenceImage got, truth;
    double model_worst = 0;
};

/// Largest over texels and channels of |value(i, channel)| relative to max(1, |truth|); infinite where it is no number.
template <typename Value>
double worst(const ReferenceImage& truth, const Value& value) {
    double found = 0;
    for (std::size_t i = 0; i < truth.texels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double relative = std::abs(value(i, c)) / std::max(1., std::abs(truth.texels[i][c]));
            if (!std::isfinite(relative)) return std::numeric_limits<double>::infinity();
            found = std::max(found, relative);
        }
    return found;
}

double error_of(const Seen& seen) {
    return worst(seen.truth, [&](std::size_t i, int c) { return seen.got.texels[i][c] - seen.truth.texels[i][c]; });
}

/// Shares of red, which only the front card has: the smallest over all frames and texels, and the largest. Infinite where it is
/// no number.
Shares shares_of(std::span<const Seen> frames) {
    Shares shares{.smallest = std::numeric_limits<double>::infinity(), .largest = -std::numeric_limits<double>::infinity()};
    for (const Seen& seen : frames)
        for (const glm::dvec4& texel : seen.got.texels) {
            if (!std::isfinite(texel.x))
                return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
            shares = {std::min(shares.smallest, texel.x), std::max(shares.largest, texel.x)};
        }
    return shares;
}

double measured(HardMeasure measure, std::span<const Seen> frames) {
    const Seen& first = frames.front();
    double error = 0, change = 0, unsteadiness = 0;
    for (const Seen& seen : frames) {
        const auto difference = [&](std::size_t i, int c) { return seen.got.texels[i][c] - first.got.texels[i][c]; };
        const auto departure = [&](std::size_t i, int c) {
            return difference(i, c) - (seen.truth.texels[i][c] - first.truth.texels[i][c]);
        };
        error = std::max(error, error_of(seen));
        change = std::max(change, worst(first.truth, difference));
        unsteadiness = std::max(unsteadiness, worst(first.truth, departure));
    }
    switch (measure) {
        case HardMeasure::error:
            return error;
        case HardMeasure::change:
            return change;
        case HardMeasure::unsteadiness:
            return unsteadiness;
        case HardMeasure::tie:
            return std::min(error, change);
        case HardMeasure::share:
            return 1 - shares_of(frames).smallest;
    }
    return error;
}

HardOutcome judged(const Variant& variant, const HardCase& hard_case, double error, double model_worst) {
    using Verdict = HardOutcome::Verdict;
    HardOutcome outcome{.error = error, .model_worst = model_worst};
    const bool holds = error <= hard_case.tolerance;
    if (!variant.settings.empty()) {
        outcome.verdict = holds ? Verdict::holds : Verdict::fails;
        return outcome;
    }
    const std::vector<KnownFailure>& failures = variant.technique->claims.failures;
    const auto known = std::ranges::find(failures, id(hard_case), &KnownFailure::hard_case);
    if (known == failures.end()) {
        outcome.verdict = holds ? Verdict::holds : Verdict::undocumented;
        return outcome;
    }
    outcome.documented = known->error;
    outcome.reason = known->because;
    outcome.verdict = holds                              ? Verdict::undeserved
                      : as_recorded(error, known->error) ? Verdict::documented
                                                         : Verdict::undocumented;
    return outcome;
}

/// What a row gave on a case's frames so far.
struct Tried {
    std::vector<Seen> seen;
    double model_worst = 0;
    std::string not_supported;
};

Result<void> add_frame(Session& session, const Request& request, const ImageSet& truth, Tried& tried) {
    const auto accuracy = session.judge(request, Stage::transparency, Against::model);
    if (!accuracy) return accuracy.error();
    tried.not_supported = accuracy->not_supported;
    if (!tried.not_supported.empty()) return {};
    auto run = session.run(request);
    if (!run) return run.error();
    tried.model_worst = std::max(tried.model_worst, accuracy->model_worst);
    tried.seen.push_back({in_double(run->images.at("color")), truth.at("color")});
    return {};
}

/// Every row's. Rows in the inner loop: what comes before them, the truth and the fragments are made once for each frame.
Result<std::vector<Tried>> tried(Session& session, std::span<const Variant> rows, const Placed& placed) {
    std::vector<Tried> all(rows.size());
    for (std::size_t frame = placed.first; frame < placed.first + placed.count; ++frame) {
        const auto truth = session.truth({.variant = {.frame = frame}}, Stage::transparency);
        if (!truth) return truth.error();
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (!all[i].not_supported.empty()) continue;
            Request request = rows[i].request;
            request.variant.frame = frame;
            request.outputs = {"color"};
            if (const auto added = add_frame(session, request, *truth, all[i]); !added) return added.error();
        }
    }
    return all;
}

HardOutcome outcome_of(const Tried& tried, const Variant& variant, const HardCase& hard_case) {
    if (!tried.not_supported.empty()) return {.verdict = HardOutcome::Verdict::not_applicable, .reason = tried.not_supported};
    HardOutcome outcome = judged(variant, hard_case, measured(hard_case.measure, tried.seen), tried.model_worst);
    if (hard_case.measure == HardMeasure::share) outcome.shares = shares_of(tried.seen);
    return outcome;
}

}  // namespace

std::string_view name(HardOutcome::Verdict verdict) {
    static constexpr std::string_view names[] = {"holds", "documented failure", "undocumented failure", "better than documented",
                                                 "fails", "not applicable"};
    return names[static_cast<std::size_t>(verdict)];
}

bool as_recorded(double error, double recorded) {
    // Errors of these sizes move with the device's last bits by far less.
    constexpr double relative_slack = .1, absolute_slack = 2e-3;
    return std::abs(error - recorded) <= relative_slack * recorded + absolute_slack;
}

std::string_view id(const HardCase& hard_case) { return hard_case.name.substr(0, hard_case.name.find(' ')); }

Result<HardCaseReport> measure_hard_cases(const DeviceChoice& choice, std::span<const Variant> rows,
                                          const std::function<void(std::string_view, double)>& progress, std::stop_token stop) {
    const CaseFrames frames = frames_of_all_cases();
    const auto device = Device::open(choice);
    if (!device) return device.error();
    keep_pipelines(**device, many_pipelines);  // rows come again on every frame
    const auto session = open_session_on(**device, frames.all);
    session->stop_when(std::move(stop));
    HardCaseReport report{.device = session->device(), .rows = {}};
    for (const Variant& row : rows) report.rows.push_back({std::string(row.technique->name), row.settings, {}});
    for (const Placed& placed : frames.cases) {
        if (progress) progress(placed.hard_case->name, double(placed.first) / double(frames.all.size()));
        const auto all = tried(*session, rows, placed);
        const auto done = static_cast<std::size_t>(&placed - frames.cases.data());
        if (!all && all.error().fault == Fault::stopped && done > 0) {
            report.stopped = fmt::format("stopped after {} of {} cases", done, frames.cases.size());
            return report;
        }
        if (!all) return all.error();
        for (std::size_t i = 0; i < rows.size(); ++i)
            report.rows[i].outcomes.push_back(outcome_of((*all)[i], rows[i], *placed.hard_case));
    }
    if (progress) progress("done", 1);
    return report;
}

}  // namespace strata
