// Bad scenes and bad deep images through the tool: exit 3, or 4 where it wants more memory than there is, with a sentence that
// names the file, and nothing is written.
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/process.h"
#include "tests/support/deep_exr.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::HasSubstr;

struct BadScene {
    const char *name, *id;  ///< of the error, and what its fields begin with
    std::string text;
};

std::vector<BadScene> bad_scenes() {
    const std::string mesh = fmt::format(R"("meshes":[{{"primitives":[{}]}}],)", triangle);
    const auto with = [&](const std::string& more) { return Gltf().with_triangle().text(mesh + more); };
    const auto without_buffer = [&](const std::string& accessor) {
        return fmt::format(R"({{"asset":{{"version":"2.0"}},"accessors":[{}],{}"nodes":[{{"mesh":0}}]}})", accessor, mesh);
    };
    return {
        {"cut short", "import.gltf.json_cut:", R"({ "asset": )"},
        {"nodes in a circle",
         "import.gltf.node_cycle:", with(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}])")},
        {"a node that is its own child",
         "import.gltf.node_cycle:", with(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}])")},
        {"a mesh that is not there", "import.gltf.index_range: list=mesh index=9", with(R"("nodes":[{"mesh":9}])")},
        {"4294967295 vertices of no buffer",
         "import.gltf.accessor_without_view:", without_buffer(R"({"componentType":5126,"type":"VEC3","count":4294967295})")},
        {"-1 vertices", "import.gltf.member_type: place=glTF.accessors[0] member=count",
         without_buffer(R"({"componentType":5126,"type":"VEC3","count":-1})")},
        {"indices that are not there", "import.gltf.index_range: list=accessor index=7",
         Gltf().with_triangle().text(
             R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":7}]}],"nodes":[{"mesh":0}])")},
        {"a file outside of its folder", "import.gltf.uri_outside:",
         R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"../../../etc/passwd"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],)" +
             mesh + R"("nodes":[{"mesh":0}]})"},
        {"JSON of great depth", "import.gltf.json_depth:", std::string(100000, '[')},
    };
}

/// Refused, or imported into a capture that is sound.
void expect_refused_or_sound(const std::string& command) {
    const Finished imported = strata(command);
    EXPECT_THAT(imported.code, testing::AnyOf(0, 3, 4)) << imported.err;
    const bool is_made = std::filesystem::exists(folder() / "made.strata");
    EXPECT_EQ(is_made, imported.code == 0);
    if (is_made) {
        EXPECT_EQ(strata("validate made.strata").code, 0);
    } else {
        EXPECT_THAT(imported.err, HasSubstr("bad."));
    }
    std::filesystem::remove(folder() / "made.strata");
}

TEST(BadScene, IsRefusedAndNothingIsWritten) {
    for (const BadScene& scene : bad_scenes()) {
        SCOPED_TRACE(scene.name);
        std::ofstream(folder() / "bad.gltf") << scene.text;
        const Finished refused = strata("-v import bad.gltf -o made.strata");
        EXPECT_EQ(refused.code, 3) << refused.err;
        EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("bad.gltf"), HasSubstr(fmt::format("\nstrata: {}", scene.id))));
        EXPECT_FALSE(std::filesystem::exists(folder() / "made.strata"));
    }
}

std::string small_deep_image(DeepPacking packing) {
    return deep_file(
        {.width = 2,
         .height = 2,
         .pixels = {{{.1f, .2f, .3f, .5f, 1}, {.3f, .2f, .1f, .5f, 2}}, {}, {{1, 1, 1, 1, 3}}, {{.2f, .2f, .2f, .4f, 4}}},
         .packing = packing});
}

TEST(BadDeepImage, CutAnywhereIsRefused) {
    const std::string whole = small_deep_image(DeepPacking::zips);
    for (std::size_t size = 8; size < whole.size(); size += whole.size() / 12) {
        SCOPED_TRACE(size);
        std::ofstream(folder() / "bad.exr", std::ios::binary) << whole.substr(0, size);
        const Finished refused = strata("import --deep bad.exr -o made.strata");
        EXPECT_EQ(refused.code, 3) << refused.err;
        EXPECT_THAT(refused.err, HasSubstr("bad.exr"));
        EXPECT_FALSE(std::filesystem::exists(folder() / "made.strata"));
    }
}

// The format has no checksums: a changed sample is a sample.
TEST(BadDeepImage, OverwrittenIsRefusedOrImportedSoundly) {
    std::mt19937 random(5);
    for (int i = 0; i < 30; ++i) {
        std::string bytes = small_deep_image(i % 2 ? DeepPacking::zips : DeepPacking::none);
        bytes[random() % bytes.size()] = static_cast<char>(random());
        std::ofstream(folder() / "bad.exr", std::ios::binary) << bytes;
        expect_refused_or_sound("import --deep bad.exr -o made.strata");
    }
}

TEST(BadDeepImage, ThatIsFlatIsRefused) {
    std::ofstream(folder() / "bad.exr", std::ios::binary) << flat_file(2, 2);
    const Finished refused = strata("import --deep bad.exr -o made.strata");
    EXPECT_EQ(refused.code, 3);
    EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("bad.exr"), HasSubstr("deep")));
}

}  // namespace
}  // namespace strata
