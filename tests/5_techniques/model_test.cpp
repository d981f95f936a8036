// The matrix: every technique on every scenario of its stage, at 1 and at 4 samples, against its model in double. An error here
// is an implementation error: a bug.
#include <algorithm>
#include <ostream>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "tests/support/print.h"
#include "tests/support/truths.h"

namespace strata {
namespace {

struct Case {
    std::string technique, scenario;
    std::uint32_t samples = 1;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.technique << " on " << c.scenario << " at " << c.samples; }

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const StageInfo& stage : stages())
        for (const std::string_view scenario : stage.scenarios)
            for (const std::uint32_t samples : {1u, 4u})
                // Innermost: what comes before the stage, and a frame's fragments, are made once for all that follow each other.
                for (const Technique* technique : techniques_of(stage.stage))
                    all.push_back({std::string(technique->name), std::string(scenario), samples});
    return all;
}

std::string test_name(const testing::TestParamInfo<Case>& info) {
    return as_identifier(fmt::format("{}_on_{}_at_{}", info.param.technique, info.param.scenario, info.param.samples));
}

/// Judges a frame; skips where the technique is not needed or cannot do it.
void expect_agreement(const Case& c, const std::vector<std::string>& sets) {
    const Technique& technique = *must(find_technique(c.technique));
    Session& session = session_of_scenarios();
    Request request = on_scenario(c.scenario, c.samples);
    if (const auto reason = unneeded(request, technique.stage))
        GTEST_SKIP() << c.scenario << " does not need the stage: " << *reason;

    request.uses = {c.technique};
    request.sets = sets;
    const Accuracy accuracy = must(session.judge(request, technique.stage, Against::model));
    if (!accuracy.not_supported.empty()) GTEST_SKIP() << c.technique << " cannot do " << accuracy.not_supported;
    const WorstTexel& w = accuracy.worst;
    const View view = must(session.frame(request.frame)).view;
    const std::string where = fmt::format(
        "worst at ({}, {}) layer {} of {}: got {:.9g} {:.9g} {:.9g}, the model says {:.9g} {:.9g} {:.9g}\n"
        "reproduce: strata record {} --size {}x{} --samples {} && strata report {}.strata --stage {} {}",
        w.x, w.y, w.layer, w.image, w.got.x, w.got.y, w.got.z, w.wanted.x, w.wanted.y, w.wanted.z, c.scenario,
        view.width / request.extent_divisor, view.height / request.extent_divisor, c.samples, c.scenario, name(technique.stage),
        sets.empty() ? "" : "--set " + sets.front());
    EXPECT_LE(accuracy.model_rmse, technique.tolerance.rmse) << where;
    EXPECT_LE(accuracy.model_worst, technique.tolerance.worst) << where;

    // Two empty images agree about nothing; and a model that cannot decide much proves little.
    EXPECT_GT(accuracy.compared, 0u);
    EXPECT_LT(double(accuracy.undecided), .25 * double(accuracy.compared + accuracy.undecided));
}

class Matrix : public testing::TestWithParam<Case> {};

TEST_P(Matrix, TheGpuAgreesWithTheModel) { expect_agreement(GetParam(), {}); }

INSTANTIATE_TEST_SUITE_P(Techniques, Matrix, testing::ValuesIn(cases()), test_name);

/// The last scenario of its stage, the richest, that the technique can do.
std::string richest_scenario(const Technique& technique) {
    const auto scenarios = info(technique.stage).scenarios;
    const auto can = [&](std::string_view scenario) {
        return !unsupported(technique, frame_features(scenario_frames(scenario).front()));
    };
    const auto found = std::ranges::find_if(scenarios.rbegin(), scenarios.rend(), can);
    return std::string(found == scenarios.rend() ? scenarios.back() : *found);
}

class EveryChoice : public testing::TestWithParam<const Technique*> {};

/// But for the one that the matrix above has already.
TEST_P(EveryChoice, OfEveryParameterIsWhatTheModelSays) {
    const Technique& technique = *GetParam();
    const Case richest{std::string(technique.name), richest_scenario(technique)};
    for (const Param& param : technique.params)
        for (std::size_t i = 0; i < param.choices.size(); ++i) {
            if (double(i) == param.fallback) continue;
            const std::string set = fmt::format("{}={}", param.name, param.choices[i]);
            SCOPED_TRACE(set);
            expect_agreement(richest, {set});
        }
}

std::vector<const Technique*> with_choices() {
    std::vector<const Technique*> found;
    for (const Technique& technique : techniques())
        if (std::ranges::any_of(technique.params, [](const Param& param) { return !param.choices.empty(); }))
            found.push_back(&technique);
    return found;
}

INSTANTIATE_TEST_SUITE_P(Techniques, EveryChoice, testing::ValuesIn(with_choices()),
                         [](const auto& tested) { return as_identifier(std::string(tested.param->name)); });

}  // namespace
}  // namespace strata
