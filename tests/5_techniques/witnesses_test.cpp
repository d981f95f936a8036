// Every scenario poses its question: the counters and features that it names as witnesses exceed the numbers that it states, at
// 96 x 54 and at its natural extent.
#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Frame small_frame(const Scenario& scenario) { return scenario.build(0, {.width = 96, .height = 54}); }

/// The first technique of its stage that has the counter; null where none does.
const Technique* counting(const Witness& witness) {
    for (const Technique& technique : techniques())
        if (name(technique.stage) == witness.stage && std::ranges::count(technique.counters, witness.counted, &Counter::name) > 0)
            return &technique;
    return nullptr;
}

/// What its witnesses count on a frame of a scenario. Witnesses of one technique share a run, and so do those of different
/// stages.
class Counted {
public:
    explicit Counted(Frame frame) : features_(frame_features(frame)), session_(session_of({std::move(frame)})) {}

    double value_of(const Witness& witness, std::span<const Witness> all) {
        if (witness.stage.empty()) return features_.has(must_be(find_feature(witness.counted))) ? 1 : 0;
        const Run& run = run_of(witness, all);
        const auto is_it = [&](const CounterRecord& record) {
            return record.technique == technique_of(witness) && record.name == witness.counted;
        };
        const auto found = std::ranges::find_if(run.counters, is_it);
        return found == run.counters.end() ? 0 : double(found->value);  // a stage that the frame does not need counts nothing
    }

private:
    static Feature must_be(std::optional<Feature> feature) {
        if (!feature) throw std::runtime_error("there is no such feature");
        return *feature;
    }

    /// A run of the witness's technique, and of others among all that stand at another stage and are as they are by default.
    const Run& run_of(const Witness& witness, std::span<const Witness> all) {
        std::map<std::string_view, std::string> by_stage{{witness.stage, technique_of(witness)}};
        if (witness.setting.empty())
            for (const Witness& other : all)
                if (!other.stage.empty() && other.setting.empty() && other.samples == witness.samples)
                    by_stage.emplace(other.stage, technique_of(other));
        std::vector<std::string> uses;
        for (const auto& [stage, technique] : by_stage) uses.push_back(technique);
        const Request request{.variant = {.samples = witness.samples}, .choices = chosen(uses, settings_of(witness))};
        const std::string name = fmt::format("{} {} {}", fmt::join(uses, " "), witness.setting, witness.samples);
        const auto known = runs_.find(name);
        return known != runs_.end() ? known->second : runs_.emplace(name, must(session_->run(request))).first->second;
    }

    static std::string technique_of(const Witness& witness) { return std::string(counting(witness)->name); }

    static std::vector<std::string> settings_of(const Witness& witness) {
        if (witness.setting.empty()) return {};
        return {fmt::format("{}:{}", technique_of(witness), witness.setting)};
    }

    Features features_;
    std::unique_ptr<Session> session_;
    std::map<std::string, Run> runs_;
};

void expect_witnesses(const Scenario& scenario, Frame frame) {
    Counted counted(std::move(frame));
    for (const Witness& witness : scenario.witnesses)
        EXPECT_GT(counted.value_of(witness, scenario.witnesses), witness.more_than)
            << scenario.name << ": " << witness.stage << " " << witness.setting << " " << witness.counted;
}

/// Names of witnesses that do not exist would count 0 without a word.
TEST(Witnesses, NameCountersAndFeaturesThatExist) {
    for (const Scenario& scenario : scenarios())
        for (const Witness& witness : scenario.witnesses) {
            const bool exists = witness.stage.empty() ? find_feature(witness.counted).has_value() : counting(witness) != nullptr;
            EXPECT_TRUE(exists) << scenario.name << " " << witness.stage << " " << witness.counted;
        }
}

TEST(Witnesses, AreDeclaredByEveryScenarioButTheEmptyOne) {
    for (const Scenario& scenario : scenarios()) EXPECT_EQ(scenario.witnesses.empty(), scenario.name == "empty") << scenario.name;
}

/// Above 5 s of CPU: it is the one test that looks whether a frame has become too easy, and it runs each scenario once.
TEST(Witnesses, AreExceededByEveryScenarioAt96x54) {
    for (const Scenario& scenario : scenarios()) expect_witnesses(scenario, small_frame(scenario));
}

TEST(ExhaustiveWitnesses, AreExceededByEveryScenarioAtItsNaturalExtent) {
    for (const Scenario& scenario : scenarios()) expect_witnesses(scenario, scenario_frames(scenario.name).front());
}

}  // namespace
}  // namespace strata
