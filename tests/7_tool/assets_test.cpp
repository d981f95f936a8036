// Scenes made by others, through the whole tool: import, check, replay, report. They lie beside the project or not at all.
#include <algorithm>
#include <cctype>

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/registry.h"
#include "tests/7_tool/process.h"
#include "tests/support/agreement.h"
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

class Asset : public testing::TestWithParam<std::filesystem::path> {};

// Where no assets are, the suite is empty.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Asset);

/// The tool's own report, of the stage that transparent assets are about.
void expect_report_within_tolerance(const json& report) {
    for (const json& row : report["rows"]) {
        if (row.contains("not_supported")) continue;
        const auto technique = find_technique(row["technique"].get<std::string>());
        ASSERT_TRUE(technique) << row.dump(2);
        const Tolerance tolerance = tolerance_at((*technique)->tolerance, row["settings"].get<std::string>(), {});
        EXPECT_LE(row["implementation_error"]["rmse"], tolerance.rmse) << row.dump(2);
        EXPECT_LE(row["implementation_error"]["worst"], tolerance.worst) << row.dump(2);
    }
}

/// The opaque stages; one session instead of a process each, because reading the textures costs more than the frames.
void expect_opaque_stages_within_tolerance(const std::filesystem::path& capture) {
    const auto session = must(Session::open(capture, {}));
    const auto skipped = must(session->plan({})).skipped;
    for (const Stage stage : {Stage::shadows, Stage::gbuffer, Stage::lighting}) {
        if (std::ranges::find(skipped, stage, &SkippedStage::stage) != skipped.end()) continue;
        for (const Technique* technique : techniques_of(stage)) {
            const Request request{.choices = chosen({std::string(technique->name)})};
            const Accuracy accuracy = must(session->judge(request, stage, Against::model));
            if (accuracy.not_supported.empty()) expect_within_tolerance(accuracy, *technique, request);
        }
    }
}

TEST_P(Asset, IsImportedReplayedAndReportedWithinEveryTolerance) {
    const Finished imported = strata("import '" + GetParam().string() + "' -o scene.strata --size 96x54");
    ASSERT_EQ(imported.code, 0) << imported.err;
    const Finished validated = strata("validate scene.strata");
    EXPECT_EQ(validated.code, 0) << validated.err;
    const Finished replayed = strata("replay scene.strata --validation --json");
    EXPECT_EQ(replayed.code, 0) << replayed.err;
    const Finished report = strata("report scene.strata --repeats 1 --sweep pool=2 --json");
    ASSERT_EQ(report.code, 0) << report.err;
    expect_report_within_tolerance(json::parse(report.out));
    expect_opaque_stages_within_tolerance(folder() / "scene.strata");
}

INSTANTIATE_TEST_SUITE_P(Scenes, Asset, testing::ValuesIn(scenes()), asset_test_name);

}  // namespace
}  // namespace strata
