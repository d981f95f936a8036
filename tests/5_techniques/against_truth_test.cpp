// Every technique against its stage's truth, recorded in baseline.csv, with what rounding hides of the errors of a stage. An
// error here is a property of the technique: it may be large, but it may not grow unnoticed, and a better technique deserves a
// better record. The same run is held against the model, too: an error there is a bug.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include "captures/scenarios.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "tests/support/accept.h"
#include "tests/support/agreement.h"
#include "tests/support/truths.h"

namespace strata {
namespace {

// Figures move with the device's last float bits and not else. Exact techniques stand at 1e-8 to 2e-7 of rounding, which is below
// the absolute slack wherever it falls; of errors that mean something 2 % is far less than any change of a technique makes.
constexpr double relative_slack = 0.02, absolute_slack = 2e-5;

struct Key {
    std::string judged, scenario;  ///< a technique, or a stage, of which it is what its undecided samples hide
    std::uint32_t samples = 1;
    auto operator<=>(const Key&) const = default;
};

/// The judge's first two figures; 0 where it has one only.
struct Metrics {
    double first = 0, second = 0;
};
using Baseline = std::map<Key, Metrics>;

constexpr std::string_view head = "judged,scenario,samples,first figure,second figure";
const std::string path = STRATA_SOURCE_DIR "/tests/5_techniques/baseline.csv";

Baseline read_baseline() {
    Baseline rows;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        Key key;
        Metrics metrics;
        char comma = 0;
        std::getline(fields, key.judged, ',');
        std::getline(fields, key.scenario, ',');
        fields >> key.samples >> comma >> metrics.first >> comma >> metrics.second;
        EXPECT_TRUE(fields && rows.emplace(key, metrics).second) << path << ": " << line;
    }
    return rows;
}

void write_baseline(const Baseline& rows) {
    std::ofstream file(path);
    file << head << '\n';
    for (const auto& [key, metrics] : rows)
        file << fmt::format("{},{},{},{:.6g},{:.6g}\n", key.judged, key.scenario, key.samples, metrics.first, metrics.second);
    ASSERT_TRUE(file.flush()) << path;
}

/// 1, or 4 where the stage has nothing to do at 1; nothing where it has nothing to do at all.
std::optional<std::uint32_t> samples_for(Stage stage, std::string_view scenario) {
    for (const std::uint32_t samples : {1u, 4u})
        if (!unneeded(on_scenario(scenario, samples), stage)) return samples;
    return {};
}

/// The techniques that a scenario is made for.
std::vector<const Technique*> techniques_on(std::string_view scenario) {
    std::vector<const Technique*> found;
    for (const Technique& technique : techniques())
        if (std::ranges::count(info(technique.stage).scenarios, scenario)) found.push_back(&technique);
    return found;
}

/// Expects on the way that the result is what the model says.
Accuracy judged(const Technique& technique, const Key& key) {
    Request request = on_scenario(key.scenario, key.samples);
    const ImageSet& truth = truth_of(technique.stage, request);
    request.choices = chosen({key.judged});
    Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model_and_truth, &truth));
    if (accuracy.not_supported.empty()) expect_proven_within_tolerance(accuracy, technique, request, key.scenario);
    return accuracy;
}

/// Figures of a row that is named after a stage: the error that undecided samples hide at most, and the percentage left out. None
/// where no sample is undecided.
std::vector<Metric> undecided_figures(const Accuracy& accuracy) {
    if (accuracy.undecided_share == 0) return {};
    const Metric none{"hidden at most", "", 0};
    return {accuracy.undecided_bound.value_or(none), {"left out", "%", 100 * accuracy.unjudged_share}};
}

/// "rmse is .02, worse than the recorded .01", or nothing.
std::string departure(const Metric& now, double recorded) {
    if (std::abs(now.value - recorded) <= absolute_slack + relative_slack * recorded) return "";
    return fmt::format("{} is {:.6g} {}, {} the recorded {:.6g}", now.name, now.value, now.unit,
                       now.value < recorded ? "better than" : "worse than", recorded);
}

std::string departure(const std::vector<Metric>& now, const Metrics& recorded) {
    const std::string first = departure(now[0], recorded.first);
    const std::string second = now.size() > 1 ? departure(now[1], recorded.second) : "";
    return first + (first.empty() || second.empty() ? "" : "; ") + second;
}

class TechniqueAgainstTruth : public testing::TestWithParam<std::string> {};

TEST_P(TechniqueAgainstTruth, IsAsWrongAsRecorded) {
    Baseline baseline = read_baseline();
    bool accepted = false;
    const auto look = [&](const Key& key, const std::vector<Metric>& now) {
        const auto row = baseline.find(key);
        std::string problem;
        if (now.empty() && row != baseline.end()) problem = "there is nothing to judge, and it is recorded all the same";
        if (!now.empty()) problem = row == baseline.end() ? "no row records it" : departure(now, row->second);
        if (problem.empty()) return;
        ADD_FAILURE() << key.judged << " on " << key.scenario << " at " << key.samples << ": " << problem
                      << (accepting() ? "; now recorded" : "; accept it with\n  " + command_that_accepts());
        accepted = accepting();
        if (now.empty()) baseline.erase(key);
        else baseline[key] = {now[0].value, now.size() > 1 ? now[1].value : 0};
    };
    std::map<Stage, std::vector<Metric>> undecided;
    for (const Technique* technique : techniques_on(GetParam())) {
        const auto samples = samples_for(technique->stage, GetParam());
        if (!samples) continue;
        const Key key{std::string(technique->name), GetParam(), *samples};
        const Accuracy accuracy = judged(*technique, key);
        look(key, accuracy.technique_errors);
        if (accuracy.technique_errors.empty() || !undecided.emplace(technique->stage, undecided_figures(accuracy)).second)
            continue;
        look({std::string(name(technique->stage)), GetParam(), *samples}, undecided.at(technique->stage));
    }
    if (accepted) write_baseline(baseline);
}

std::vector<std::string> judged_scenarios() {
    std::vector<std::string> names;
    for (const Scenario& scenario : scenarios())
        if (!techniques_on(scenario.name).empty()) names.emplace_back(scenario.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Scenarios, TechniqueAgainstTruth, testing::ValuesIn(judged_scenarios()),
                         [](const auto& name) { return name.param; });

/// The first scenario of the stage, the plainest, that needs it at four samples; nothing where none does.
std::optional<std::string_view> first_scenario(const StageInfo& stage) {
    const auto needs_it = [&](std::string_view scenario) { return !unneeded(on_scenario(scenario, 4), stage.stage); };
    const auto found = std::ranges::find_if(stage.scenarios, needs_it);
    return found == stage.scenarios.end() ? std::nullopt : std::optional(*found);
}

TEST(ExhaustiveTechniqueMetrics, AreNumbersAtFourSamplesToo) {
    for (const StageInfo& stage : stages()) {
        const auto scenario = first_scenario(stage);
        for (const Technique* technique : techniques_of(stage.stage)) {
            ASSERT_TRUE(scenario) << stage.name << " has no scenario";
            const std::vector<Metric> metrics =
                judged(*technique, {std::string(technique->name), std::string(*scenario), 4}).technique_errors;
            EXPECT_FALSE(metrics.empty()) << technique->name << " on " << *scenario;
            for (const Metric& metric : metrics)
                EXPECT_TRUE(std::isfinite(metric.value)) << technique->name << " on " << *scenario << ": " << metric.name;
        }
    }
}

TEST(TechniqueBaseline, RecordsNothingThatIsGone) {
    for (const auto& [key, metrics] : read_baseline()) {
        const auto technique = find_technique(key.judged);
        const auto stage = technique ? std::optional((*technique)->stage) : find_stage(key.judged);
        const bool judged = stage && std::ranges::count(info(*stage).scenarios, key.scenario);
        EXPECT_TRUE(judged) << key.judged << " on " << key.scenario << ": delete its row from " << path;
    }
}

TEST(TechniqueBaseline, WorseAndBetterBothAskToBeRecorded) {
    const Metric rmse{"rmse", "radiance", .1};
    EXPECT_EQ(departure(rmse, .101), "");
    EXPECT_EQ(departure(rmse, .05), "rmse is 0.1 radiance, worse than the recorded 0.05");
    EXPECT_EQ(departure(rmse, .2), "rmse is 0.1 radiance, better than the recorded 0.2");
}

}  // namespace
}  // namespace strata
