// Scenes made by others, through the whole tool: import, check, replay, report. They lie beside the project or not at all. By
// default techniques are judged on two of them; a feature that one calls for and these do not belongs among them.
#include <algorithm>
#include <cctype>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/7_tool/process.h"
#include "tests/support/agreement.h"
#include "tests/support/not_finite.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;

/// Every glTF below the assets folder, in the order of their names.
std::vector<std::filesystem::path> scenes() {
    const auto root = std::filesystem::path(STRATA_SOURCE_DIR) / "../shared/assets";
    std::vector<std::filesystem::path> found;
    if (!std::filesystem::is_directory(root)) return found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        const auto kind = entry.path().extension();
        if (entry.is_regular_file() && (kind == ".glb" || kind == ".gltf")) found.push_back(entry.path().lexically_normal());
    }
    std::ranges::sort(found);
    return found;
}

std::string asset_test_name(const testing::TestParamInfo<std::filesystem::path>& info) {
    std::string name = info.param.parent_path().filename().string();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

class Asset : public testing::TestWithParam<std::filesystem::path> {
protected:
    void SetUp() override {
        const Finished imported = strata("import '" + GetParam().string() + "' -o scene.strata --size 96x54");
        ASSERT_EQ(imported.code, 0) << imported.err;
    }
};
class JudgedAsset : public Asset {};
class ExhaustiveAsset : public Asset {};

// Where no assets are, the suites are empty.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Asset);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(JudgedAsset);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExhaustiveAsset);

/// What was imported, on the device whose pipelines the scenes share.
std::unique_ptr<Session> scene_session() {
    const Capture capture = must(Capture::open(folder() / "scene.strata"));
    return session_of({must(capture.frame(0))});
}

TEST_P(Asset, IsImportedValidatedAndReplayed) {
    const Finished validated = strata("validate scene.strata");
    EXPECT_EQ(validated.code, 0) << validated.err;
    const auto run = must(scene_session()->run({.outputs = {"color", "display"}}));
    for (const auto& [name, image] : run.images) EXPECT_EQ(texel_that_is_no_number(image), std::nullopt) << name;
}

bool takes(const Technique& technique, std::string_view param) {
    return std::ranges::find(technique.params, param, &Param::name) != technique.params.end();
}

TEST_P(JudgedAsset, IsWhatTheModelOfEveryTechniqueSays) {
    const auto session = scene_session();
    const auto skipped = must(session->plan({})).skipped;
    for (const Stage stage : {Stage::shadows, Stage::gbuffer, Stage::lighting, Stage::transparency}) {
        if (std::ranges::find(skipped, stage, &SkippedStage::stage) != skipped.end()) continue;
        for (const Technique* technique : techniques_of(stage)) {
            const auto sets = takes(*technique, "pool") ? std::vector<std::string>{"pool=2"} : std::vector<std::string>();
            const Request request{.choices = chosen({std::string(technique->name)}, sets)};
            const Accuracy accuracy = must(session->judge(request, stage, Against::model));
            if (accuracy.not_supported.empty()) expect_within_tolerance(accuracy, *technique, request);
        }
    }
}

/// The tool's own report, of the stage that transparent assets are about.
TEST_P(ExhaustiveAsset, IsReportedWithinEveryTolerance) {
    const Finished report = strata("report scene.strata --repeats 1 --sweep pool=2 --json");
    ASSERT_EQ(report.code, 0) << report.err;
    const json rows = json::parse(report.out)["rows"];
    for (const json& row : rows) {
        if (row.contains("not_supported")) continue;
        const auto technique = find_technique(row["technique"].get<std::string>());
        ASSERT_TRUE(technique) << row.dump(2);
        const Tolerance tolerance = tolerance_at((*technique)->tolerance, row["settings"].get<std::string>(), {});
        EXPECT_LE(row["implementation_error"]["rmse"], tolerance.rmse) << row.dump(2);
        EXPECT_LE(row["implementation_error"]["worst"], tolerance.worst) << row.dump(2);
    }
}

/// Masked foliage and glass under a sun and a sky. Colored glass, emission and punctual lights, with textures of 90 MB, take 100
/// s.
constexpr std::string_view judged_by_default = "GlassVaseFlowers";

std::vector<std::filesystem::path> scenes_judged(bool (*wanted)(bool by_default)) {
    std::vector<std::filesystem::path> found = scenes();
    std::erase_if(found, [&](const auto& scene) { return !wanted(scene.parent_path().filename() == judged_by_default); });
    return found;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Asset, testing::ValuesIn(scenes()), asset_test_name);
INSTANTIATE_TEST_SUITE_P(Few, JudgedAsset, testing::ValuesIn(scenes_judged([](bool by_default) { return by_default; })),
                         asset_test_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, JudgedAsset, testing::ValuesIn(scenes_judged([](bool by_default) { return !by_default; })),
                         asset_test_name);
INSTANTIATE_TEST_SUITE_P(Scenes, ExhaustiveAsset, testing::ValuesIn(scenes()), asset_test_name);

}  // namespace
}  // namespace strata
