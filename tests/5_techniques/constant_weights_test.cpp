// A weight that is the same over a whole scene is a plain average in disguise: the counter `weights differ` says so of a replay
// (docs/algorithms/transparency.md 3.1).
#include <algorithm>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view weighted = "transparency/weighted";

std::uint64_t weights_differ(std::string_view scenario, std::string set) {
    Request request = on_scenario(scenario);
    request.choices = chosen({std::string(weighted)}, {std::move(set)});
    const Run run = must(session_of_scenarios().run(request));
    const auto found = std::ranges::find(run.counters, "weights differ", &CounterRecord::name);
    if (found == run.counters.end()) throw std::runtime_error("no such counter");
    return found->value;
}

TEST(ConstantWeights, AreSeenInTheReplayOfAScene) {
    for (const std::string_view weight : must(find_technique(weighted))->params.front().choices) {
        const bool is_constant = weight == "constant" || weight == "w2015_plain";
        EXPECT_EQ(weights_differ("smoke_grenade", fmt::format("weight={}", weight)), is_constant ? 0u : 1u) << weight;
    }
}

TEST(ConstantWeights, AreThoseOfFormsWithoutWeights) {
    for (const char* form : {"form=average", "form=sum"}) EXPECT_EQ(weights_differ("smoke_grenade", form), 0u) << form;
}

TEST(ConstantWeights, AreThoseOfASceneWithOneDepth) { EXPECT_EQ(weights_differ("one_pane", "weight=w7"), 0u); }

}  // namespace
}  // namespace strata
