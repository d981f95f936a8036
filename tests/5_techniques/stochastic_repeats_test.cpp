// transparency/stochastic on a device: noise that is the same in every run, and in however many bands of rows it is made.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"
#include "tests/support/truths.h"
#include "tests/support/z_test.h"

namespace strata {
namespace {

constexpr const char* stochastic = "transparency/stochastic";

std::vector<std::byte> color_of(Session& session, const std::vector<std::string>& sets) {
    session.forget_memo();
    return must(session.run({.choices = chosen({stochastic}, sets), .outputs = {"color"}})).images.at("color").texels;
}

TEST(StochasticNoise, IsTheSameInEveryRunAndAnotherWithAnotherSeed) {
    const auto session = scenario_session("glass_and_smoke", 4);
    for (const char* mode : {"mode=layered", "mode=depth_based", "mode=hashed"}) {
        const auto first = color_of(*session, {mode});
        EXPECT_EQ(first, color_of(*session, {mode})) << mode;
        EXPECT_NE(first, color_of(*session, {mode, "seed=1"})) << mode;
    }
}

TEST(StochasticNoise, DoesNotDependOnTheBandsOfRowsThatShareItsMemory) {
    const auto session = scenario_session("glass_and_smoke", 4);
    const auto whole = color_of(*session, {"memory=4095"});
    EXPECT_EQ(whole, color_of(*session, {"memory=0.2"}));
    session->forget_memo();
    const auto steps = must(session->run({.choices = chosen({stochastic}, {"memory=0.2"})})).steps;
    EXPECT_GT(std::ranges::count(steps, std::string("transparency/stochastic/resolve.comp"), &StepRecord::name), 2);
}

TEST(StochasticNoise, FallsWithTheRootOfTheNumberOfSubsamples) {
    const auto error = [](const char* samples) {
        Request request = on_scenario("sixty_layers");
        request.choices = chosen({stochastic}, {samples, "correction=none", "subset=bernoulli"});
        return must(session_of_scenarios().judge(request, Stage::transparency, Against::truth)).technique_errors.front().value;
    };
    EXPECT_NEAR(error("samples=4") / error("samples=64"), 4, .6);
}

// Few layers, not colored: sums of many in halves are rounded towards zero (sixty_layers: all light together .15 % too dark), and
// without correction=alpha light through colored glass has the mean color.
constexpr const char* layers = "three_panes";

/// Colors of the samples that rounding does not decide.
std::vector<double> decided_colors(const ReferenceImage& image) {
    const ReferenceImage& truth = truth_of(Stage::transparency, on_scenario(layers)).at("color");
    std::vector<double> values;
    for (std::size_t i = 0; i < truth.texels.size(); ++i)
        if (!truth.undecided[i]) values.insert(values.end(), {image.texels[i].x, image.texels[i].y, image.texels[i].z});
    return values;
}

std::vector<double> colors(std::vector<std::string> sets, std::uint32_t seed) {
    Request request = on_scenario(layers);
    sets.push_back(fmt::format("seed={}", seed));
    request.choices = chosen({stochastic}, sets);
    request.outputs = {"color"};
    return decided_colors(in_double(must(session_of_scenarios().run(request)).images.at("color")));
}

std::vector<double> true_colors() { return decided_colors(truth_of(Stage::transparency, on_scenario(layers)).at("color")); }

// Half floats of color, and of what is summed.
constexpr double stored_rounding = 0x1p-10;
constexpr double least_probable = .01;

TEST(StochasticNoise, HasTheTruthAsItsMeanInEveryColorOfEverySample) {
    for (const char* subset : {"subset=bernoulli", "subset=stratified"})
        for (const char* mode : {"mode=layered", "mode=depth_based"}) {
            ZTest test;
            for (std::uint32_t seed = 0; seed < 32; ++seed)
                test.add(colors({mode, subset, "correction=none", "samples=64"}, seed));
            EXPECT_GT(test.probability(true_colors(), stored_rounding), least_probable) << mode << ' ' << subset;
        }
}

/// The test above would notice a bias of half a percent, with any seeds.
TEST(StochasticNoise, WithABiasOfHalfAPercentIsToldFromTheTruth) {
    int noticed = 0, false_alarms = 0;
    for (std::uint32_t turn = 0; turn < 20; ++turn) {
        ZTest fair, biased;
        for (std::uint32_t seed = 0; seed < 16; ++seed) {
            std::vector<double> run = colors({"correction=none", "subset=bernoulli", "samples=64"}, 1000 + 16 * turn + seed);
            fair.add(run);
            for (double& value : run) value *= 1.005;
            biased.add(run);
        }
        noticed += biased.probability(true_colors(), stored_rounding) < least_probable;
        false_alarms += fair.probability(true_colors(), stored_rounding) < least_probable;
    }
    EXPECT_EQ(noticed, 20);
    EXPECT_LE(false_alarms, 2);
}

/// Every setting's combination is the model's, not only each on its own.
TEST(StochasticModes, AreWhatTheModelSaysInEveryCombination) {
    const Technique& technique = *must(find_technique(stochastic));
    for (const char* mode : {"mode=layered", "mode=depth_based", "mode=hashed"})
        for (const char* subset : {"subset=bernoulli", "subset=stratified"})
            for (const char* correction : {"correction=none", "correction=alpha"}) {
                Request request = on_scenario("red_and_green_glass", 4);
                request.choices = chosen({stochastic}, {mode, subset, correction, "samples=64", "seed=7"});
                const Accuracy accuracy = must(session_of_scenarios().judge(request, technique.stage, Against::model));
                expect_within_tolerance(accuracy, technique, request, "red_and_green_glass");
            }
}

}  // namespace
}  // namespace strata
