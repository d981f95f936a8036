// What a technique says about itself is complete and consistent. Loops over the list; needs no device.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "captures/hard_cases.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "tests/support/errors.h"
#include "tests/support/file_text.h"
#include "tests/support/print.h"

namespace strata {
namespace {

class Description : public testing::TestWithParam<Technique> {};

INSTANTIATE_TEST_SUITE_P(Techniques, Description, testing::ValuesIn(techniques().begin(), techniques().end()),
                         technique_test_name);

template <typename Rows>
void expect_distinct_and_explained(const Rows& rows) {
    std::set<std::string_view> names;
    for (const auto& row : rows) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name << " occurs twice";
        EXPECT_FALSE(row.name.empty());
        EXPECT_FALSE(row.help.empty()) << row.name << " has no help";
    }
}

TEST_P(Description, NamesItsSourceItsTitleAndHowItFails) {
    const Technique& technique = GetParam();
    EXPECT_FALSE(technique.title.empty());
    EXPECT_FALSE(technique.source.empty());
    EXPECT_GE(technique.summary.size(), 20u) << "say what it does and how it fails";
}

TEST_P(Description, IsNamedForItsStage) {
    const Technique& technique = GetParam();
    EXPECT_TRUE(technique.name.starts_with(std::string(name(technique.stage)) + "/"));
}

TEST_P(Description, WithShaderVariantsHasAViewAndATableOfThem) {
    const Technique& technique = GetParam();
    if (!technique.abilities.variants) return;
    const ShaderVariants& variants = *technique.abilities.variants;
    EXPECT_EQ(std::ranges::count(technique.views, variants.view, &DebugView::name), 1);
    const auto table = std::ranges::find(technique.tables, variants.table, &DebugTable::name);
    ASSERT_NE(table, technique.tables.end());
    for (const std::string_view column : {variants.constant, std::string_view("tiles")})
        EXPECT_EQ(std::ranges::count(table->columns, column, &TableColumn::name), 1) << column;
}

TEST_P(Description, WithFeatureModesHasTheirTableAndTheirParameters) {
    const Technique& technique = GetParam();
    if (!technique.abilities.feature_modes) return;
    const FeatureModes& modes = *technique.abilities.feature_modes;
    const auto table = std::ranges::find(technique.tables, modes.table, &DebugTable::name);
    ASSERT_NE(table, technique.tables.end());
    for (const std::string_view column : {"spectrum", "tiles", "mode", "superfluous"})
        EXPECT_EQ(std::ranges::count(table->columns, column, &TableColumn::name), 1) << column;
    EXPECT_EQ(std::ranges::count(technique.params, modes.count, &Param::name), 1);
    for (const std::string_view mode : modes.modes)
        EXPECT_EQ(std::ranges::count(technique.params, mode, &Param::name), 1) << mode;
}

TEST_P(Description, WithSlicesOfDepthHasTheirTableInMeters) {
    const Technique& technique = GetParam();
    if (technique.abilities.slices_table.empty()) return;
    const auto table = std::ranges::find(technique.tables, technique.abilities.slices_table, &DebugTable::name);
    ASSERT_NE(table, technique.tables.end());
    ASSERT_GE(table->columns.size(), 2u);
    for (const std::size_t column : {0u, 1u}) EXPECT_EQ(table->columns[column].unit, "m");
}

TEST_P(Description, HasParametersWithDefaultsInTheirRange) {
    const Technique& technique = GetParam();
    expect_distinct_and_explained(technique.params);
    for (const Param& param : technique.params) {
        const double high = param.choices.empty() ? param.high : static_cast<double>(param.choices.size() - 1);
        const double low = param.choices.empty() ? param.low : 0;
        EXPECT_LT(low, high) << param.name;
        EXPECT_TRUE(param.fallback >= low && param.fallback <= high) << param.name << " falls back to " << param.fallback;
        EXPECT_TRUE(param.scalar == Scalar::real || param.fallback == std::floor(param.fallback)) << param.name;
        EXPECT_TRUE(param.scale == Scale::linear || low > 0) << param.name << " is logarithmic";
        EXPECT_TRUE(param.choices.empty() || param.scalar == Scalar::integer) << param.name;
    }
}

TEST_P(Description, AcceptsEveryLineItsSettingsWrite) {
    Settings settings(GetParam().params), again(GetParam().params);
    for (const std::string& line : settings.lines()) {
        const std::size_t equals = line.find('=');
        const Result<void> set = again.set(line.substr(0, equals), std::string_view(line).substr(equals + 1));
        EXPECT_TRUE(set) << set.error().sentence;
    }
    EXPECT_TRUE(settings == again);
}

TEST_P(Description, HasPointsForTheReportThatCanBeSet) {
    for (const std::string_view point : GetParam().variants) {
        Settings settings(GetParam().params);
        std::istringstream lines{std::string(point)};
        for (std::string line; lines >> line;) {
            const std::size_t equals = line.find('=');
            ASSERT_NE(equals, line.npos) << point;
            const Result<void> set = settings.set(line.substr(0, equals), std::string_view(line).substr(equals + 1));
            EXPECT_TRUE(set) << point << ": " << set.error().sentence;
        }
        EXPECT_FALSE(settings == Settings(GetParam().params)) << point << " is the default already";
    }
}

TEST_P(Description, HasCountersInsideTheirStruct) {
    const Technique& technique = GetParam();
    expect_distinct_and_explained(technique.counters);
    std::set<std::size_t> offsets;
    for (const Counter& counter : technique.counters) {
        EXPECT_LE(counter.offset + sizeof(std::uint32_t), technique.counter_bytes) << counter.name;
        EXPECT_TRUE(offsets.insert(counter.offset).second) << counter.name << " counts into another's place";
    }
    EXPECT_EQ(technique.counters.empty(), technique.counter_bytes == 0);
}

TEST_P(Description, HasViewsThatCanBeShown) {
    expect_distinct_and_explained(GetParam().views);
    for (const DebugView& view : GetParam().views) {
        EXPECT_LT(view.low, view.high) << view.name;
        EXPECT_NE(view.declare, nullptr) << view.name;
    }
}

bool is_reason(std::string_view because) { return !because.empty() && !because.starts_with("to be "); }

TEST_P(Description, HasAToleranceWithAReason) {
    const Technique& technique = GetParam();
    EXPECT_NE(technique.model, nullptr) << "there is nothing to compare the GPU with";
    EXPECT_TRUE(is_reason(technique.tolerance.because)) << technique.tolerance.because;
    EXPECT_GE(technique.tolerance.worst, technique.tolerance.rmse);
    EXPECT_LT(technique.tolerance.rmse, 0.05) << "a tolerance, not a license";
    for (const ToleranceException& row : technique.tolerance.exceptions) {
        EXPECT_TRUE(is_reason(row.because)) << row.settings << " " << row.scenario << ": " << row.because;
        EXPECT_TRUE(std::ranges::count(info(technique.stage).scenarios, row.scenario) ||
                    std::ranges::count(hard_cases(), row.scenario, &HardCase::name))
            << row.scenario;
        EXPECT_TRUE(row.rmse > technique.tolerance.rmse || row.worst > technique.tolerance.worst) << "is no exception";
    }
}

/// The technique's own files whose names match, with their text.
std::vector<std::string> texts_in_folder(const Technique& technique, const std::regex& names) {
    std::vector<std::string> texts;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(STRATA_SOURCE_DIR) / "passes" / technique.name))
        if (std::regex_match(entry.path().filename().string(), names)) texts.push_back(file_text(entry.path()));
    return texts;
}

/// Whatever the first group of the expression finds in the texts.
std::set<std::string> found_in(const std::vector<std::string>& texts, const std::regex& expression) {
    std::set<std::string> found;
    for (const std::string& text : texts)
        for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
            found.insert((*match)[1]);
    return found;
}

/// Every test of the folder's *_property_test.cpp, "Suite.Name".
std::set<std::string> property_tests_of(const Technique& technique) {
    std::set<std::string> tests;
    for (const std::string& text : texts_in_folder(technique, std::regex(".*_property_test\\.cpp")))
        for (const std::string& pair : found_in({text}, std::regex(R"(\nTEST\((\w+, \w+)\) \{)"))) {
            const std::size_t comma = pair.find(", ");
            tests.insert(pair.substr(0, comma) + "." + pair.substr(comma + 2));
        }
    return tests;
}

/// What the README's paragraph that begins with "Property tests:" names in backquotes.
std::set<std::string> named_property_tests(const Technique& technique) {
    const std::string readme = file_text(std::filesystem::path(STRATA_SOURCE_DIR) / "passes" / technique.name / "README.md");
    const std::size_t first = readme.find("\nProperty tests:");
    if (first == std::string::npos) return {};
    const std::string paragraph = readme.substr(first, readme.find("\n\n", first + 1) - first);
    return found_in({paragraph}, std::regex("`(\\w+\\.\\w+)`"));
}

// A mirror has the shader's mistakes. What holds it to anything are tests that do not know how it is done: those of the files
// named *_property_test.cpp beside it, all of which its README names, and no others.
TEST_P(Description, WithAModelThatIsAMirrorNamesThePropertyTestsBesideIt) {
    const Technique& technique = GetParam();
    const std::set<std::string> tests = property_tests_of(technique), named = named_property_tests(technique);
    EXPECT_EQ(named, tests) << "the README's paragraph 'Property tests:' and the tests in *_property_test.cpp";
    EXPECT_EQ(tests.empty(), technique.model_is == ModelKind::paper);
    // What C++ and GLSL both compile is what such a test is to find wrong.
    const std::set<std::string> shared = found_in(texts_in_folder(technique, std::regex(".*_property_test\\.cpp")),
                                                  std::regex("#include \"([^\"]+\\.shared\\.h)\""));
    EXPECT_TRUE(shared.empty()) << "a property test includes " << *shared.begin();
}

TEST_P(Description, WithAModelThatRunsTheShadersFunctionsSaysThatItIsAMirror) {
    const Technique& technique = GetParam();
    bool shares = !texts_in_folder(technique, std::regex(".*_mirror\\.cpp")).empty();
    const std::vector<std::string> models = texts_in_folder(technique, std::regex("(.*_)?model\\.(cpp|h)"));
    for (const std::string& path : found_in(models, std::regex("#include \"([^\"]+\\.shared\\.h)\""))) {
        const std::string text = file_text(std::filesystem::path(STRATA_SOURCE_DIR) / path);
        ASSERT_FALSE(text.empty()) << path;
        shares |= text.find("\ninline ") != std::string::npos;  // functions are declared so for C++
    }
    EXPECT_EQ(shares, technique.model_is == ModelKind::mirror);
}

TEST_P(Description, DeclaresSomething) { EXPECT_NE(GetParam().declare, nullptr); }

TEST(Stages, AStageWithTechniquesHasATruthAJudgeAndScenariosThatExist) {
    for (const StageInfo& stage : stages()) {
        EXPECT_FALSE(stage.purpose.empty()) << stage.name;
        EXPECT_EQ(find_stage(stage.name), stage.stage);
        for (const std::string_view output : stage.outputs) EXPECT_NE(find_frame_image(output), nullptr) << output;
        for (const std::string_view scenario : stage.scenarios) EXPECT_TRUE(find_scenario(scenario)) << scenario;
        if (techniques_of(stage.stage).empty()) continue;
        EXPECT_NE(stage.truth, nullptr) << stage.name;
        EXPECT_NE(stage.judge, nullptr) << stage.name;
        EXPECT_FALSE(stage.outputs.empty()) << stage.name;
        EXPECT_FALSE(stage.scenarios.empty()) << stage.name;
    }
}

TEST(Stages, AnEmptyFrameSaysWhyItNeedsAlmostNothing) {
    for (const StageInfo& stage : stages()) {
        const auto reason = stage.unwanted(Features{});
        const bool always = stage.stage == Stage::gbuffer || stage.stage == Stage::combine;
        EXPECT_EQ(reason.has_value(), !always) << stage.name;
    }
    EXPECT_EQ(info(Stage::transparency).unwanted(Features{}), "the frame has no transparent draws or particles");
}

TEST(Registry, AMisspelledTechniqueIsAnErrorWithTheNearestName) {
    for (const Technique& technique : techniques()) {
        std::string typed(technique.name);
        typed.push_back(typed.back());
        EXPECT_THAT(find_technique(typed),
                    FailsWith("technique.unknown", Field("technique", typed),
                              Field("suggestion", testing::HasSubstr(fmt::format(" {}?", technique.name)))));
    }
}

TEST(Registry, NamesAreUniqueAndEachKnowsItsPlaceInItsStage) {
    std::set<std::string_view> names;
    for (const Technique& technique : techniques()) {
        EXPECT_TRUE(names.insert(technique.name).second) << technique.name;
        EXPECT_EQ(techniques_of(technique.stage).at(index_in_stage(technique))->name, technique.name);
    }
}

TEST(Registry, AStageHasOneUnitOfTimeAtTheMost) {
    for (const StageInfo& stage : stages())
        EXPECT_LE(std::ranges::count_if(techniques_of(stage.stage), [](const Technique* t) { return t->abilities.is_time_unit; }),
                  1)
            << stage.name;
}

}  // namespace
}  // namespace strata
