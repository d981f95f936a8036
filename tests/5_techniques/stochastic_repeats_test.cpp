// transparency/stochastic on a device: noise that is the same in every run, and in however many bands of rows it is made.
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/agreement.h"
#include "tests/support/session.h"

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
