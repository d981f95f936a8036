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

std::vector<std::byte> color_of(Session& session, std::vector<std::string> sets) {
    session.forget_memo();
    return must(session.run({.choices = chosen({stochastic}, std::move(sets)), .outputs = {"color"}})).images.at("color").texels;
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
        Request request = on_scenario("smoke_grenade");
        request.choices = chosen({stochastic}, {samples, "correction=none", "subset=bernoulli"});
        return must(session_of_scenarios().judge(request, Stage::transparency, Against::truth)).technique_errors.front().value;
    };
    EXPECT_NEAR(error("samples=4") / error("samples=64"), 4, .6);
}

/// Colors of all samples in one run with a seed.
std::vector<double> colors(const std::vector<std::string>& sets, std::uint32_t seed) {
    Request request = on_scenario("glass_and_smoke");
    std::vector<std::string> all = sets;
    all.push_back(fmt::format("seed={}", seed));
    request.choices = chosen({stochastic}, all);
    request.outputs = {"color"};
    const ReferenceImage image = in_double(must(session_of_scenarios().run(request)).images.at("color"));
    std::vector<double> values;
    for (const glm::dvec4& texel : image.texels) values.insert(values.end(), {texel.x, texel.y, texel.z});
    return values;
}

/// Of the samples whose fragments are certain; the others are as in the run.
std::vector<double> true_colors(const std::vector<double>& run) {
    const ReferenceImage& truth = truth_of(Stage::transparency, on_scenario("glass_and_smoke")).at("color");
    std::vector<double> values = run;
    for (std::size_t i = 0; i < truth.texels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            if (!truth.undecided[i]) values[3 * i + c] = truth.texels[i][static_cast<glm::length_t>(c)];
    return values;
}

// Half floats of color, and of what is summed.
constexpr double stored_rounding = 0x1p-10;
constexpr double least_probable = .01;

TEST(StochasticNoise, HasTheTruthAsItsMeanInEveryColorOfEverySample) {
    for (const char* subset : {"subset=bernoulli", "subset=stratified"})
        for (const char* mode : {"mode=layered", "mode=depth_based"}) {
            ZTest test;
            std::vector<double> wanted;
            for (std::uint32_t seed = 0; seed < 32; ++seed) {
                const auto run = colors({mode, subset, "correction=none", "samples=64"}, seed);
                if (seed == 0) wanted = true_colors(run);
                test.add(run);
            }
            EXPECT_GT(test.probability(wanted, stored_rounding), least_probable) << mode << ' ' << subset;
        }
}

/// The test above would notice a bias of half a percent, with any seeds.
TEST(StochasticNoise, WithABiasOfHalfAPercentIsToldFromTheTruth) {
    int noticed = 0, false_alarms = 0;
    for (std::uint32_t turn = 0; turn < 20; ++turn) {
        ZTest fair, biased;
        std::vector<double> wanted;
        for (std::uint32_t seed = 0; seed < 16; ++seed) {
            std::vector<double> run = colors({"correction=none", "subset=bernoulli", "samples=64"}, 1000 + 16 * turn + seed);
            if (seed == 0) wanted = true_colors(run);
            fair.add(run);
            for (double& value : run) value *= 1.005;
            biased.add(run);
        }
        noticed += biased.probability(wanted, stored_rounding) < least_probable;
        false_alarms += fair.probability(wanted, stored_rounding) < least_probable;
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
