// Deep images through the whole tool: one made here, and those of others, which lie beside the project or not at all.
#include <algorithm>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/7_tool/process.h"
#include "tests/support/deep_exr.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;

/// White of alpha .5 before black of alpha .5 in every pixel, in every other pixel the far one first in the file.
DeepSource two_layers() {
    DeepSource source{.width = 16, .height = 9};
    const std::vector<float> white{.5f, .5f, .5f, .5f, 2}, black{0, 0, 0, .5f, 3};
    for (std::uint32_t i = 0; i < source.width * source.height; ++i)
        source.pixels.push_back(i % 2 == 0 ? std::vector{white, black} : std::vector{black, white});
    return source;
}

/// By technique: the root mean square of the difference from the exact composite, which is .5.
std::map<std::string, double> reported_errors(const std::string& options) {
    const Finished made = strata("report image.strata --stage transparency --repeats 1 --json " + options);
    EXPECT_EQ(made.code, 0) << made.err;
    std::map<std::string, double> errors;
    const json report = json::parse(made.out);
    for (const json& row : report["rows"])
        for (const json& metric : row["technique_error"])
            if (metric["metric"] == "rmse") errors[row["technique"]] = metric["value"];
    return errors;
}

TEST(ExhaustiveDeepReport, IsHowFarEveryTechniqueIsFromTheExactComposite) {
    std::ofstream(folder() / "image.exr", std::ios::binary) << deep_file(two_layers());
    ASSERT_EQ(strata("import --deep image.exr -o image.strata").code, 0);
    const auto errors = reported_errors("--sweep form=average"), of_sums = reported_errors("--sweep form=sum");
    EXPECT_EQ(errors.size(), techniques_of(Stage::transparency).size());
    for (const char* exact : {"sorted_lists", "alpha_blend", "depth_peeling", "multi_layer", "k_buffer", "a_buffer"})
        EXPECT_LT(errors.at(std::string("transparency/") + exact), 2e-3) << exact;  // the last two keep color and alpha in codes
    EXPECT_LT(errors.at("transparency/sorted_lists"), 1e-6);
    // The mean color, .5, over a coverage of .75, is .375; the sum hides nothing of white: .5 and 0, over no background.
    EXPECT_NEAR(errors.at("transparency/weighted"), .125, 1e-3);
    EXPECT_LT(of_sums.at("transparency/weighted"), 1e-3);
    EXPECT_GT(errors.at("transparency/stochastic"), .01);
    const auto weighted_by_depth = reported_errors("--sweep pool=2");
    EXPECT_GT(weighted_by_depth.at("transparency/weighted"), .01);
    EXPECT_LT(weighted_by_depth.at("transparency/weighted"), .125);
}

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

class JudgedDeepAsset : public DeepAsset {};

/// One session instead of a process each: the image is read once.
void expect_replayed_by_every_technique() {
    const auto session = must(Session::open(folder() / "image.strata", {.validation = true}));
    for (const Technique* technique : techniques_of(Stage::transparency))
        EXPECT_TRUE(session->run({.choices = chosen({std::string(technique->name)})})) << technique->name;
}

TEST_P(JudgedDeepAsset, IsReplayedByEveryTechniqueAndReportedWithinTolerance) {
    expect_replayed_by_every_technique();
    const Finished made = strata("report image.strata --repeats 1 --sweep pool=2 --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    EXPECT_EQ(report["rows"].size(), techniques_of(Stage::transparency).size());
    for (const json& row : report["rows"]) {
        const auto technique = find_technique(row["technique"].get<std::string>());
        ASSERT_TRUE(technique);
        const Tolerance tolerance = tolerance_at((*technique)->tolerance, row["settings"].get<std::string>(), {});
        EXPECT_LE(row["implementation_error"]["rmse"], tolerance.rmse) << row;
        EXPECT_LE(row["implementation_error"]["worst"], tolerance.worst) << row;
    }
}

std::string deep_asset_name(const testing::TestParamInfo<const char*>& file) { return std::string(file.param).substr(0, 4); }

constexpr const char *small_image = "openexr_11.deep.exr", *trees = "weta_LowResLeftView_Trunks.exr";

INSTANTIATE_TEST_SUITE_P(Images, DeepAsset, testing::Values(small_image, trees), deep_asset_name);
INSTANTIATE_TEST_SUITE_P(Images, JudgedDeepAsset, testing::Values(small_image), deep_asset_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, JudgedDeepAsset, testing::Values(trees), deep_asset_name);

}  // namespace
}  // namespace strata
