// The hard cases of transparency: every method holds them, or fails by as much as it says, neither more nor less. Of its defaults
// the method itself says it; of its other settings hard_cases.csv does.
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "replay/report/hard_cases.h"
#include "tests/support/accept.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using Values = std::map<std::string, std::vector<std::string>>;

/// "key=value" by key.
std::map<std::string, std::string> settings_of(std::string_view point) {
    std::map<std::string, std::string> settings;
    std::istringstream words{std::string(point)};
    for (std::string word; words >> word;) settings[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
    return settings;
}

/// What a technique's points are measured for: of a number one value, of a choice the first and the last. All of them would take
/// minutes. Not resolutions: on cards that fill the picture they change nothing.
Values wanted_values(const Technique& technique) {
    Values wanted;
    for (const std::string_view point : technique.points)
        for (const auto& [key, value] : settings_of(point))
            if (std::ranges::count(wanted[key], value) == 0) wanted[key].push_back(value);
    wanted.erase("resolution");
    for (auto& [key, values] : wanted) {
        const bool is_choice = !std::ranges::find(technique.params, key, &Param::name)->choices.empty();
        values = is_choice ? std::vector{values.front(), values.back()} : std::vector{values.front()};
    }
    return wanted;
}

/// Every technique at its defaults, and each of the wanted values of its points once.
std::vector<Variant> measured_settings() {
    std::vector<Variant> kept;
    Values wanted;
    for (Variant& variant : must(variants({.stage = Stage::transparency}))) {
        bool is_wanted = variant.settings.empty();
        if (is_wanted) wanted = wanted_values(*variant.technique);
        for (const auto& [key, value] : settings_of(variant.settings)) is_wanted |= std::erase(wanted[key], value) > 0;
        if (is_wanted) kept.push_back(std::move(variant));
    }
    return kept;
}

const HardCaseReport& measured() {
    static const HardCaseReport report = must(measure_hard_cases({.validation = true}, measured_settings()));
    return report;
}

/// Of what applies: every pixel is a number, and the one that the model says.
void expect_numbers_of_the_model(const HardCaseRow& row, const HardOutcome& outcome) {
    const Tolerance& tolerance = must(find_technique(row.technique))->tolerance;
    EXPECT_TRUE(std::isfinite(outcome.error)) << row.technique << " " << row.settings << ": a pixel is no number";
    EXPECT_LE(outcome.model_worst, tolerance.worst) << row.technique << " " << row.settings << ": GPU against model";
}

class HardCases : public testing::TestWithParam<std::size_t> {};

TEST_P(HardCases, EveryMethodHoldsOrFailsAsDocumented) {
    const std::size_t index = GetParam();
    const HardCase& hard_case = hard_cases()[index];
    for (const HardCaseRow& row : measured().rows) {
        const HardOutcome& outcome = row.outcomes[index];
        if (outcome.verdict == HardOutcome::Verdict::not_applicable) continue;
        expect_numbers_of_the_model(row, outcome);
        if (!row.settings.empty()) continue;  // the record below
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

/// Technique and settings; errors in the order of hard_cases(), nothing where a case does not apply.
using Key = std::pair<std::string, std::string>;
using Errors = std::vector<std::optional<double>>;
using Record = std::map<Key, Errors>;

const std::string path = STRATA_SOURCE_DIR "/tests/5_techniques/hard_cases.csv";

std::string head() {
    std::string line = "technique,settings";
    for (const HardCase& hard_case : hard_cases()) line += fmt::format(",{}", id(hard_case));
    return line;
}

std::optional<double> parsed(const std::string& field) {
    if (field == "-") return {};
    std::size_t used = 0;
    const double error = std::stod(field, &used);
    EXPECT_EQ(used, field.size()) << path << ": " << field;
    return error;
}

/// Empty where the columns are not today's cases.
Record read_record() {
    Record record;
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line) || line != head()) return record;
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        Key key;
        std::getline(fields, key.first, ',');
        std::getline(fields, key.second, ',');
        Errors errors;
        for (std::string field; std::getline(fields, field, ',');) errors.push_back(parsed(field));
        EXPECT_EQ(errors.size(), hard_cases().size()) << path << ": " << line;
        EXPECT_TRUE(record.emplace(key, std::move(errors)).second) << path << ": " << line;
    }
    return record;
}

void write_record(const Record& record) {
    std::ofstream file(path);
    file << head() << '\n';
    for (const auto& [key, errors] : record) {
        file << fmt::format("{},{}", key.first, key.second);
        for (const auto& error : errors) file << (error ? fmt::format(",{:.6g}", *error) : ",-");
        file << '\n';
    }
    ASSERT_TRUE(file.flush()) << path;
}

Errors errors_of(const HardCaseRow& row) {
    Errors errors;
    for (const HardOutcome& outcome : row.outcomes) {
        const bool applies = outcome.verdict != HardOutcome::Verdict::not_applicable;
        errors.push_back(applies ? std::optional(outcome.error) : std::nullopt);
    }
    return errors;
}

/// "H5 is 0.12 where at most 0.02 holds, recorded: 0.17", or nothing. What holds may not fail for being within the slack.
std::string departure(const HardCase& hard_case, std::optional<double> now, std::optional<double> recorded) {
    const auto holds = [&](double error) { return error <= hard_case.accept; };
    const bool both = now && recorded;
    if (both ? as_recorded(*now, *recorded) && holds(*now) == holds(*recorded) : now.has_value() == recorded.has_value())
        return "";
    const auto text = [](std::optional<double> error) { return error ? fmt::format("{:.3g}", *error) : "not applicable"; };
    return fmt::format("\n  {} is {} where at most {} holds, recorded: {}", id(hard_case), text(now), hard_case.accept,
                       text(recorded));
}

TEST(HardCaseRecord, OfEveryPointIsAsMeasured) {
    const Record recorded = read_record();
    Record now;
    for (const HardCaseRow& row : measured().rows) {
        if (row.settings.empty()) continue;
        const Errors& errors = now[{row.technique, row.settings}] = errors_of(row);
        const auto known = recorded.find({row.technique, row.settings});
        std::string problem;
        for (std::size_t i = 0; known != recorded.end() && i < errors.size(); ++i)
            problem += departure(hard_cases()[i], errors[i], known->second.at(i));
        if (known == recorded.end()) problem = "no row records it";
        if (problem.empty()) continue;
        ADD_FAILURE() << row.technique << " " << row.settings << ": " << problem
                      << (accepting() ? "; now recorded" : "; accept it with\n  " + command_that_accepts());
    }
    for (const auto& [key, errors] : recorded)
        EXPECT_TRUE(now.contains(key)) << key.first << " " << key.second << " is recorded and is measured no more";
    if (accepting() && HasFailure()) write_record(now);
}

TEST(HardCaseRecord, AsksForWorseAndBetterAndForWhatHeldNoMore) {
    const HardCase hard_case{.name = "H0 a case", .accept = .1};
    EXPECT_EQ(departure(hard_case, .52, .5), "");
    EXPECT_EQ(departure(hard_case, {}, {}), "");
    EXPECT_EQ(departure(hard_case, .4, .5), "\n  H0 is 0.4 where at most 0.1 holds, recorded: 0.5");
    EXPECT_NE(departure(hard_case, .6, .5), "");
    EXPECT_NE(departure(hard_case, .101, .099), "");
    EXPECT_NE(departure(hard_case, {}, .5), "");
}

TEST(HardCaseRecords, NameCasesThatExist) {
    for (const Technique& technique : techniques())
        for (const KnownFailure& known : technique.known_failures) {
            const auto is_it = [&](const HardCase& hard_case) { return id(hard_case) == known.hard_case; };
            EXPECT_TRUE(std::ranges::any_of(hard_cases(), is_it)) << technique.name << " says of " << known.hard_case;
            EXPECT_FALSE(known.because.empty()) << technique.name << " " << known.hard_case;
        }
}

}  // namespace
}  // namespace strata
