// The hard cases of transparency: every technique holds them, or fails by as much as it says, neither more nor less. Of its
// defaults the technique itself says it; of its other settings hard_cases.csv does.
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include <gtest/gtest.h>

#include "passes/registry.h"
#include "passes/technique.h"
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

/// What a technique's variants are measured for: of a number one value, of a choice the first and the last. All of them would
/// take minutes. Not resolutions: on cards that fill the picture they change nothing.
Values wanted_values(const Technique& technique) {
    Values wanted;
    for (const std::string_view point : technique.variants)
        for (const auto& [key, value] : settings_of(point))
            if (std::ranges::count(wanted[key], value) == 0) wanted[key].push_back(value);
    wanted.erase("resolution");
    for (auto& [key, values] : wanted) {
        const bool is_choice = !std::ranges::find(technique.params, key, &Param::name)->choices.empty();
        values = is_choice ? std::vector{values.front(), values.back()} : std::vector{values.front()};
    }
    return wanted;
}

/// The technique at its defaults, and each of the wanted values of its variants once.
std::vector<Variant> measured_settings(const Technique& technique) {
    std::vector<Variant> kept;
    Values wanted = wanted_values(technique);
    for (Variant& variant : must(variants({.stage = Stage::transparency}))) {
        if (variant.technique != &technique) continue;
        bool is_wanted = variant.settings.empty();
        for (const auto& [key, value] : settings_of(variant.settings)) is_wanted |= std::erase(wanted[key], value) > 0;
        if (is_wanted) kept.push_back(std::move(variant));
    }
    return kept;
}

/// Of what applies: every pixel is a number, and the one that the model says. Of defaults: what is wrong with it is documented.
void expect_as_documented(const HardCaseRow& row, std::size_t index) {
    const HardCase& hard_case = hard_cases()[index];
    const HardOutcome& outcome = row.outcomes[index];
    if (outcome.verdict == HardOutcome::Verdict::not_applicable) return;
    SCOPED_TRACE(fmt::format("{} {} on {}", row.technique, row.settings, hard_case.name));
    EXPECT_TRUE(std::isfinite(outcome.error)) << "a pixel is no number";
    const Technique& technique = *must(find_technique(row.technique));
    testing::Test::RecordProperty(fmt::format("{} {} on {}", row.technique, row.settings, hard_case.name),
                                  fmt::format("worst {:.3g}", outcome.model_worst));
    EXPECT_LE(outcome.model_worst, tolerance_at(technique.tolerance, row.settings, hard_case.name).worst) << "GPU against model";
    if (!row.settings.empty()) return;  // the record below
    const bool as_said = outcome.verdict == HardOutcome::Verdict::holds || outcome.verdict == HardOutcome::Verdict::documented;
    EXPECT_TRUE(as_said) << name(outcome.verdict) << ", " << outcome.error << " against at most " << hard_case.tolerance
                         << "; documented: " << outcome.documented;
}

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
    const auto holds = [&](double error) { return error <= hard_case.tolerance; };
    const bool both = now && recorded;
    if (both ? as_recorded(*now, *recorded) && holds(*now) == holds(*recorded) : now.has_value() == recorded.has_value())
        return "";
    const auto text = [](std::optional<double> error) { return error ? fmt::format("{:.3g}", *error) : "not applicable"; };
    return fmt::format("\n  {} is {} where at most {} holds, recorded: {}", id(hard_case), text(now), hard_case.tolerance,
                       text(recorded));
}

/// The technique at its defaults.
std::vector<Variant> default_settings(const Technique& technique) {
    std::vector<Variant> rows = measured_settings(technique);
    std::erase_if(rows, [](const Variant& variant) { return !variant.settings.empty(); });
    return rows;
}

/// Rows of variants, but for those of other techniques, which stay.
void expect_as_recorded(const Technique& technique, const HardCaseReport& report) {
    Record record = read_record();
    Record recorded;
    for (const auto& [key, errors] : record)
        if (key.first == technique.name) recorded.emplace(key, errors);
    std::erase_if(record, [&](const auto& row) { return row.first.first == technique.name; });
    for (const HardCaseRow& row : report.rows) {
        if (row.settings.empty()) continue;
        const Errors& errors = record[{row.technique, row.settings}] = errors_of(row);
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
        EXPECT_TRUE(record.contains(key)) << key.first << " " << key.second << " is recorded and is measured no more";
    if (accepting() && testing::Test::HasFailure()) write_record(record);
}

HardCaseReport expect_documented(const std::vector<Variant>& rows) {
    HardCaseReport report = must(measure_hard_cases({.validation = true}, rows));
    EXPECT_FALSE(report.rows.empty());
    for (const HardCaseRow& row : report.rows)
        for (std::size_t i = 0; i < hard_cases().size(); ++i) expect_as_documented(row, i);
    return report;
}

/// A test for each technique: whichever processes these run in, nothing is measured twice.
class HardCases : public testing::TestWithParam<const Technique*> {};
class ExhaustiveHardCases : public testing::TestWithParam<const Technique*> {};

TEST_P(HardCases, AreHeldOrFailedAsDocumentedAtTheDefaults) { expect_documented(default_settings(*GetParam())); }

TEST_P(ExhaustiveHardCases, AreHeldOrFailedAsDocumentedAndRecordedAtEveryPoint) {
    expect_as_recorded(*GetParam(), expect_documented(measured_settings(*GetParam())));
}

std::string technique_name(const testing::TestParamInfo<const Technique*>& info) {
    const std::string_view technique = info.param->name;
    return std::string(technique.substr(technique.find('/') + 1));
}

INSTANTIATE_TEST_SUITE_P(Techniques, HardCases, testing::ValuesIn(techniques_of(Stage::transparency)), technique_name);
INSTANTIATE_TEST_SUITE_P(Techniques, ExhaustiveHardCases, testing::ValuesIn(techniques_of(Stage::transparency)), technique_name);

TEST(HardCaseRecord, IsOfTechniquesThatExist) {
    const Record record = read_record();
    EXPECT_FALSE(record.empty()) << path << " does not have today's cases";
    for (const auto& [key, errors] : record) EXPECT_TRUE(find_technique(key.first)) << path << ": " << key.first;
}

TEST(HardCaseRecord, AsksForWorseAndBetterAndForWhatHeldNoMore) {
    const HardCase hard_case{.name = "H0 a case", .tolerance = .1};
    EXPECT_EQ(departure(hard_case, .52, .5), "");
    EXPECT_EQ(departure(hard_case, {}, {}), "");
    EXPECT_EQ(departure(hard_case, .4, .5), "\n  H0 is 0.4 where at most 0.1 holds, recorded: 0.5");
    EXPECT_NE(departure(hard_case, .6, .5), "");
    EXPECT_NE(departure(hard_case, .101, .099), "");
    EXPECT_NE(departure(hard_case, {}, .5), "");
}

TEST(HardCaseRecords, NameCasesThatExist) {
    for (const Technique& technique : techniques())
        for (const KnownFailure& known : technique.claims.failures) {
            const auto is_it = [&](const HardCase& hard_case) { return id(hard_case) == known.hard_case; };
            EXPECT_TRUE(std::ranges::any_of(hard_cases(), is_it)) << technique.name << " says of " << known.hard_case;
            EXPECT_FALSE(known.because.empty()) << technique.name << " " << known.hard_case;
        }
}

}  // namespace
}  // namespace strata
