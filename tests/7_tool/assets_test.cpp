// Scenes made by others, through the whole tool: import, check, replay, report. They lie beside the project or not at all.
#include <algorithm>
#include <cctype>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/registry.h"
#include "tests/7_tool/process.h"

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

std::string test_name(const testing::TestParamInfo<std::filesystem::path>& info) {
    std::string name = info.param.parent_path().filename().string();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

class Asset : public testing::TestWithParam<std::filesystem::path> {};

// Where no assets are, the suite is empty.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Asset);

void expect_rows_within_tolerance(const json& report) {
    for (const json& row : report["rows"]) {
        const auto technique = find_technique(row["technique"].get<std::string>());
        ASSERT_TRUE(technique) << row["technique"];
        if (row.contains("not_supported")) continue;
        const json& error = row["implementation_error"];
        EXPECT_LE(error["rmse"].get<double>(), (*technique)->tolerance.rmse) << row.dump(2);
        EXPECT_LE(error["worst"].get<double>(), (*technique)->tolerance.worst) << row.dump(2);
    }
}

TEST_P(Asset, IsImportedReplayedAndReportedWithinEveryTolerance) {
    const Finished imported = strata("import '" + GetParam().string() + "' -o scene.strata --size 96x54");
    ASSERT_EQ(imported.code, 0) << imported.err;
    const Finished validated = strata("validate scene.strata");
    EXPECT_EQ(validated.code, 0) << validated.err;
    const Finished replayed = strata("replay scene.strata --validation --json");
    EXPECT_EQ(replayed.code, 0) << replayed.err;
    for (const Stage stage : {Stage::shadows, Stage::gbuffer, Stage::lighting, Stage::transparency}) {
        SCOPED_TRACE(name(stage));
        const Finished report = strata("report scene.strata --repeats 1 --json --stage " + std::string(name(stage)));
        ASSERT_EQ(report.code, 0) << report.err;
        expect_rows_within_tolerance(json::parse(report.out));
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Asset, testing::ValuesIn(scenes()), test_name);

}  // namespace
}  // namespace strata
