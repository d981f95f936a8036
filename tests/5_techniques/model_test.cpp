// The matrix: every technique on every scenario of its stage, at 1 and at 4 samples, against its model in double. An error here
// is an implementation error: a bug. By default a quarter of it is judged, at 4 samples: technique_test.cpp judges all of it
// at 1.
#include <algorithm>
#include <ostream>
#include <ranges>
#include <stdexcept>

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "tests/support/agreement.h"
#include "tests/support/print.h"
#include "tests/support/truths.h"

namespace strata {
namespace {

struct Case {
    std::string technique, scenario;
    std::uint32_t samples = 1;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.technique << " on " << c.scenario << " at " << c.samples; }

std::vector<Case> all_cases() {
    std::vector<Case> all;
    for (const StageInfo& stage : stages())
        for (const std::string_view scenario : stage.scenarios)
            for (const std::uint32_t samples : {1u, 4u})
                // Innermost: what comes before the stage, and a frame's fragments, are made once for all that follow each other.
                for (const Technique* technique : techniques_of(stage.stage))
                    all.push_back({std::string(technique->name), std::string(scenario), samples});
    return all;
}

/// At 4 samples each technique on every fourth scenario of its stage, each scenario with every fourth technique.
std::vector<Case> diagonal_cases() {
    std::vector<Case> chosen;
    for (const StageInfo& stage : stages())
        for (std::size_t scenario = 0; scenario < stage.scenarios.size(); ++scenario) {
            const auto techniques = techniques_of(stage.stage);
            for (std::size_t i = 0; i < techniques.size(); ++i)
                if ((i + scenario) % 4 == 0)
                    chosen.push_back({std::string(techniques[i]->name), std::string(stage.scenarios[scenario]), 4});
        }
    return chosen;
}

std::string judged_case_name(const testing::TestParamInfo<Case>& info) {
    return as_identifier(fmt::format("{}_on_{}_at_{}", info.param.technique, info.param.scenario, info.param.samples));
}

/// Judges a frame; skips where the technique is not needed or cannot do it.
void expect_agreement(const Case& c, const std::vector<std::string>& sets) {
    const Technique& technique = *must(find_technique(c.technique));
    Session& session = session_of_scenarios();
    Request request = on_scenario(c.scenario, c.samples);
    if (const auto reason = unneeded(request, technique.stage))
        GTEST_SKIP() << c.scenario << " does not need the stage: " << *reason;

    request.choices = chosen({c.technique}, sets);
    const Accuracy accuracy = must(session.judge(request, technique.stage, Against::model));
    if (!accuracy.not_supported.empty()) GTEST_SKIP() << c.technique << " cannot do " << accuracy.not_supported;
    expect_proven_within_tolerance(accuracy, technique, request, c.scenario);
}

class Matrix : public testing::TestWithParam<Case> {};

TEST_P(Matrix, TheGpuAgreesWithTheModel) { expect_agreement(GetParam(), {}); }

INSTANTIATE_TEST_SUITE_P(Diagonal, Matrix, testing::ValuesIn(diagonal_cases()), judged_case_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, Matrix, testing::ValuesIn(all_cases()), judged_case_name);

/// The first of the scenarios that needs the stage and that the technique can do: at one sample, if any does, else at four.
template <typename Scenarios>
Case first_it_can(const Technique& technique, const Scenarios& scenarios) {
    for (const std::uint32_t samples : {1u, 4u})
        for (const std::string_view scenario : scenarios) {
            const Features features = frame_features(scenario_frames(scenario, samples).front());
            if (!unsupported(technique, features) && !info(technique.stage).unwanted(features))
                return {std::string(technique.name), std::string(scenario), samples};
        }
    throw std::logic_error(fmt::format("no scenario for {}", technique.name));
}

Case on_plainest_scenario(const Technique& technique) { return first_it_can(technique, info(technique.stage).scenarios); }
Case on_richest_scenario(const Technique& technique) {
    return first_it_can(technique, std::views::reverse(info(technique.stage).scenarios));
}

class EveryChoice : public testing::TestWithParam<Case> {};

/// But for the one that the matrix above has already.
TEST_P(EveryChoice, OfEveryParameterIsWhatTheModelSays) {
    const Technique& technique = *must(find_technique(GetParam().technique));
    for (const Param& param : technique.params)
        for (std::size_t i = 0; i < param.choices.size(); ++i) {
            if (double(i) == param.fallback) continue;
            const std::string set = fmt::format("{}={}", param.name, param.choices[i]);
            SCOPED_TRACE(set);
            expect_agreement(GetParam(), {set});
        }
}

std::vector<Case> with_choices(Case (*case_of)(const Technique&)) {
    std::vector<Case> found;
    for (const Technique& technique : techniques())
        if (std::ranges::any_of(technique.params, [](const Param& param) { return !param.choices.empty(); }))
            found.push_back(case_of(technique));
    return found;
}

INSTANTIATE_TEST_SUITE_P(Plainest, EveryChoice, testing::ValuesIn(with_choices(on_plainest_scenario)), judged_case_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, EveryChoice, testing::ValuesIn(with_choices(on_richest_scenario)), judged_case_name);

class TwoPanes : public testing::TestWithParam<const Technique*> {};

/// The fewest layers that have an order. Two depths are all that four moments can tell, and a matrix of them has no third root.
TEST_P(TwoPanes, AreWhatTheModelSaysAtTheDefaults) {
    const Technique& technique = *GetParam();
    const std::vector<Card> panes{{.center = {0, 0, 2}, .half = 1.5f, .color = {.8f, .3f, .1f, .5f}},
                                  {.center = {.5, 0, 3}, .half = 2, .color = {.1f, .4f, .9f, .5f}}};
    const auto session = session_of(std::vector<Frame>{frame_of_cards(panes, 16)});
    const Request request{.choices = chosen({std::string(technique.name)})};
    const Accuracy accuracy = must(session->judge(request, technique.stage, Against::model));
    expect_within_tolerance(accuracy, technique, request);
    EXPECT_GE(accuracy.compared - accuracy.trivial, 100u);
}

INSTANTIATE_TEST_SUITE_P(Techniques, TwoPanes, testing::ValuesIn(techniques_of(Stage::transparency)),
                         [](const auto& tested) { return as_identifier(std::string(tested.param->name)); });

}  // namespace
}  // namespace strata
