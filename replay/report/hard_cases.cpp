#include "replay/report/hard_cases.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passes/registry.h"

namespace strata {
namespace {

// How far a failure may be from its record: errors of these sizes move with the device's last bits by far less.
constexpr double relative_slack = .1, absolute_slack = 2e-3;

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
    }
    return error;
}

HardOutcome judged(const Technique& technique, const HardCase& hard_case, double error, double model_worst) {
    using Verdict = HardOutcome::Verdict;
    HardOutcome outcome{.error = error, .model_worst = model_worst};
    const bool holds = error <= hard_case.accept;
    const std::string_view id = hard_case.name.substr(0, hard_case.name.find(' '));
    const auto known = std::ranges::find(technique.known_failures, id, &KnownFailure::hard_case);
    if (known == technique.known_failures.end()) {
        outcome.verdict = holds ? Verdict::holds : Verdict::undocumented;
        return outcome;
    }
    outcome.documented = known->error;
    outcome.reason = known->because;
    const bool as_documented = std::abs(error - known->error) <= relative_slack * known->error + absolute_slack;
    outcome.verdict = holds ? Verdict::undeserved : as_documented ? Verdict::documented : Verdict::undocumented;
    return outcome;
}

/// Truths are the same for every technique.
class Measuring {
public:
    Measuring(Session& session, const CaseFrames& frames) : session_(session), frames_(frames) {}

    Result<HardCaseRow> row(const Technique& technique) {
        HardCaseRow row{.technique = std::string(technique.name)};
        for (const Placed& placed : frames_.cases) {
            auto outcome = outcome_of(technique, placed);
            if (!outcome) return outcome.error();
            row.outcomes.push_back(*std::move(outcome));
        }
        return row;
    }

private:
    Result<HardOutcome> outcome_of(const Technique& technique, const Placed& placed) {
        std::vector<Seen> seen;
        double model_worst = 0;
        for (std::size_t i = placed.first; i < placed.first + placed.count; ++i) {
            const auto truth = truth_of(i);
            if (!truth) return truth.error();
            const Request request{.frame = i, .uses = {std::string(technique.name)}, .outputs = {"color"}};
            const auto accuracy = session_.judge(request, Stage::transparency, Against::model_and_truth, *truth);
            if (!accuracy) return accuracy.error();
            if (!accuracy->not_supported.empty())
                return HardOutcome{.verdict = HardOutcome::Verdict::not_applicable, .reason = accuracy->not_supported};
            auto run = session_.run(request);
            if (!run) return run.error();
            model_worst = std::max(model_worst, accuracy->model_worst);
            seen.push_back({in_double(run->images.at("color")), (*truth)->at("color")});
        }
        return judged(technique, *placed.hard_case, measured(placed.hard_case->measure, seen), model_worst);
    }

    Result<const ImageSet*> truth_of(std::size_t frame) {
        if (const auto known = truths_.find(frame); known != truths_.end()) return &known->second;
        auto truth = session_.truth({.frame = frame}, Stage::transparency);
        if (!truth) return truth.error();
        return &truths_.emplace(frame, *std::move(truth)).first->second;
    }

    Session& session_;
    const CaseFrames& frames_;
    std::map<std::size_t, ImageSet> truths_;
};

}  // namespace

std::string_view name(HardOutcome::Verdict verdict) {
    static constexpr std::string_view names[] = {"holds", "documented failure", "undocumented failure", "better than documented",
                                                 "not applicable"};
    return names[static_cast<std::size_t>(verdict)];
}

Result<HardCaseReport> measure_hard_cases(const DeviceChoice& device,
                                          const std::function<void(std::string_view, double)>& progress) {
    const CaseFrames frames = frames_of_all_cases();
    auto session = Session::open(frames.all, device);
    if (!session) return session.error();
    HardCaseReport report{.device = (*session)->device()};
    Measuring measuring(**session, frames);
    const std::vector<const Technique*> techniques = techniques_of(Stage::transparency);
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        if (progress) progress(techniques[i]->name, double(i) / double(techniques.size()));
        auto row = measuring.row(*techniques[i]);
        if (!row) return row.error();
        report.rows.push_back(*std::move(row));
    }
    if (progress) progress("done", 1);
    return report;
}

}  // namespace strata
