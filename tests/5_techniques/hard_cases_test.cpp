// The hard cases of transparency: every method holds them, or fails by as much as it says, neither more nor less.
#include <cmath>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "replay/report/hard_cases.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const HardCaseReport& measured() {
    static const HardCaseReport report = must(measure_hard_cases({.validation = true}));
    return report;
}

class HardCases : public testing::TestWithParam<std::size_t> {};

TEST_P(HardCases, EveryMethodHoldsOrFailsAsDocumented) {
    const std::size_t index = GetParam();
    const HardCase& hard_case = hard_cases()[index];
    for (const HardCaseRow& row : measured().rows) {
        const HardOutcome& outcome = row.outcomes[index];
        if (outcome.verdict == HardOutcome::Verdict::not_applicable) continue;
        const Tolerance& tolerance = must(find_technique(row.technique))->tolerance;
        EXPECT_TRUE(std::isfinite(outcome.error)) << row.technique << ": a pixel is no number";
        EXPECT_LE(outcome.model_worst, tolerance.worst) << row.technique << ": GPU against model";
        const bool as_said =
            outcome.verdict == HardOutcome::Verdict::holds || outcome.verdict == HardOutcome::Verdict::documented;
        EXPECT_TRUE(as_said) << row.technique << ": " << name(outcome.verdict) << ", " << outcome.error << " against at most "
                             << hard_case.accept << "; documented: " << outcome.documented;
    }
}

std::string test_name(const testing::TestParamInfo<std::size_t>& info) {
    std::string label(hard_cases()[info.param].name);
    for (char& c : label)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return label;
}

INSTANTIATE_TEST_SUITE_P(Cases, HardCases, testing::Range(std::size_t{0}, hard_cases().size()), test_name);

TEST(HardCaseRecords, NameCasesThatExist) {
    for (const Technique& technique : techniques())
        for (const KnownFailure& known : technique.known_failures) {
            const auto is_it = [&](const HardCase& c) { return c.name.substr(0, c.name.find(' ')) == known.hard_case; };
            EXPECT_TRUE(std::ranges::any_of(hard_cases(), is_it)) << technique.name << " says of " << known.hard_case;
            EXPECT_FALSE(known.because.empty()) << technique.name << " " << known.hard_case;
        }
}

}  // namespace
}  // namespace strata
