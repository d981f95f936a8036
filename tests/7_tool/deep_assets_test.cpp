// Deep images made by others, through the whole tool. They lie beside the project or not at all.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/registry.h"
#include "replay/image_io.h"
#include "tests/7_tool/process.h"
#include "tests/support/deep_exr.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;

class DeepAsset : public testing::TestWithParam<const char*> {
protected:
    std::filesystem::path image() const {
        return std::filesystem::path(STRATA_SOURCE_DIR) / "../shared/assets/deep" / GetParam();
    }
    void SetUp() override {
        if (!std::filesystem::exists(image())) GTEST_SKIP() << image() << " is not there";
        const Finished imported = strata("import --deep '" + image().string() + "' -o image.strata");
        ASSERT_EQ(imported.code, 0) << imported.err;
    }
};

TEST_P(DeepAsset, LooksAsOpenExrCompositesIt) {
    ASSERT_EQ(strata("export image.strata --image color -o color.exr").code, 0);
    const HostImage color = must(read_exr(folder() / "color.exr")).at("color");
    const auto [texels, from, width] = openexr_composite(image());
    std::size_t visible = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto x = static_cast<std::uint32_t>(from.x + int(i % width)),
                   y = static_cast<std::uint32_t>(from.y + int(i / width));
        const glm::dvec4 got = texel(color, x, y);
        for (int c = 0; c < 3; ++c) {
            // Two layers of radiance below 1 at most, in floats on both sides.
            ASSERT_NEAR(got[c], double(texels[i][c]), 1e-6) << x << ", " << y;
            if (got[c] > .01) ++visible;
        }
    }
    EXPECT_GT(visible, 1000u);
}

TEST_P(DeepAsset, IsReplayedByEveryTechniqueAndReportedWithinTolerance) {
    for (const Technique* technique : techniques_of(Stage::transparency))
        EXPECT_EQ(strata("replay image.strata --validation --use " + std::string(technique->name)).code, 0) << technique->name;
    const Finished report = strata("report image.strata --repeats 1 --sweep pool=2 --json");
    ASSERT_EQ(report.code, 0) << report.err;
    for (const json& row : json::parse(report.out)["rows"]) {
        const auto technique = find_technique(row["technique"].get<std::string>());
        ASSERT_TRUE(technique);
        EXPECT_LE(row["implementation_error"]["rmse"], (*technique)->tolerance.rmse) << row;
        EXPECT_LE(row["implementation_error"]["worst"], (*technique)->tolerance.worst) << row;
    }
}

INSTANTIATE_TEST_SUITE_P(Images, DeepAsset, testing::Values("openexr_11.deep.exr", "weta_LowResLeftView_Trunks.exr"),
                         [](const auto& file) { return std::string(file.param).substr(0, 4); });

}  // namespace
}  // namespace strata
