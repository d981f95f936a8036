// Where the bytes of a glTF may come from: its own chunks, data URIs, and files below its folder. Nothing else is opened.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/import/gltf_files.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string triangle_bytes = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});

/// A folder with scene/, for one test.
class GltfFiles : public testing::Test {
protected:
    GltfFiles() { std::filesystem::create_directories(root_ / "scene/parts"); }
    ~GltfFiles() override { std::filesystem::remove_all(root_); }

    void write(const std::string& path, const std::string& bytes) const {
        std::ofstream(root_ / path, std::ios::binary) << bytes;
    }

    /// Imports a triangle whose buffer is at the URI.
    Result<ImportedScene> imported_from(const std::string& uri, std::size_t length = 36) const {
        write("scene/scene.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"{}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}}],
            {}}})",
                                              length, uri, showing(triangle)));
        return import_gltf(root_ / "scene/scene.gltf", {});
    }

    const std::filesystem::path root_ = std::filesystem::path(testing::TempDir()) /
                                        (std::string("gltf_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(GltfFiles, BelowTheFolderAreReadWithTheirNamesUnescaped) {
    write("scene/parts/a b.bin", triangle_bytes);
    EXPECT_TRUE(imported_from("parts/a%20b.bin"));
    EXPECT_TRUE(imported_from("./parts/a b.bin"));
    EXPECT_THAT(imported_from("parts/a%2"), FailsWith("import.gltf.uri", Field("uri", "parts/a%2")));
    EXPECT_THAT(imported_from("parts/none.bin"), FailsWith("import.gltf.file_missing", Field("uri", "parts/none.bin")));
    EXPECT_THAT(imported_from("parts"), FailsWith("file.not_a_file"));
    EXPECT_THAT(imported_from("parts/a%20b.bin", 37),
                FailsWith("import.gltf.buffer_cut", Field("claimed_bytes", 37), Field("bytes", 36)));
}

TEST_F(GltfFiles, OutsideTheFolderAreNeverOpened) {
    write("secret.bin", triangle_bytes);
    const std::string absolute = (root_ / "secret.bin").string();
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("parts/../../secret.bin"), std::string("%2e%2e/secret.bin"), absolute,
          "file://" + absolute, std::string("http://localhost/a.bin"), std::string("..\\\\secret.bin"), std::string("a%00b")}) {
        EXPECT_THAT(imported_from(uri), FailsWith("import.gltf.uri_outside")) << uri;
    }
}

TEST_F(GltfFiles, LinksMayNotLeaveTheFolder) {
    write("secret.bin", triangle_bytes);
    write("scene/inside.bin", triangle_bytes);
    std::filesystem::create_symlink(root_ / "secret.bin", root_ / "scene/out.bin");
    std::filesystem::create_directory_symlink(root_, root_ / "scene/up");
    std::filesystem::create_symlink("inside.bin", root_ / "scene/in.bin");
    EXPECT_THAT(imported_from("out.bin"), FailsWith("import.gltf.uri_link"));
    EXPECT_THAT(imported_from("up/secret.bin"), FailsWith("import.gltf.uri_link"));
    EXPECT_TRUE(imported_from("in.bin"));
}

TEST_F(GltfFiles, ADeviceOrAPipeIsNoFile) { EXPECT_FALSE(import_gltf("/dev/zero", {})); }

TEST(GltfBytes, InMemoryNoOtherFileIsRead) {
    const std::string text = Gltf().with_triangle().text(showing(triangle));
    EXPECT_TRUE(import_text(text));
    EXPECT_THAT(imported(with_image(R"("uri":"/etc/hostname")", "")).warnings, Contains(HasSubstr("/etc/hostname")));
}

TEST(GltfBytes, DataUrisAreBase64OrEscaped) {
    const gltf::Folder none;
    const auto read = [&](const std::string& uri) {
        MemoryBudget budget(1000);
        return none.read(uri, budget).and_then([](const auto& bytes) {
            return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        });
    };
    EXPECT_EQ(*read("data:application/octet-stream;base64,AAEC/w=="), std::string("\0\1\2\xff", 4));
    EXPECT_EQ(*read("data:;base64,AAEC/w"), std::string("\0\1\2\xff", 4)) << "padding may be missing";
    EXPECT_EQ(*read("data:text/plain,a%20b"), "a b");
    EXPECT_THAT(read("data:;base64,A*=="), FailsWith("import.gltf.base64"));
    EXPECT_THAT(read("data:;base64,AAAAA"), FailsWith("import.gltf.uri_cut"));
    EXPECT_THAT(read("data:;base64"), FailsWith("import.gltf.uri_no_data"));
    EXPECT_THAT(read("data:;base64," + std::string(2000, 'A')), FailsWith("memory.budget", Field("budget", "1000 bytes")));
}

/// A .glb of these chunks; `claimed` is the length in its header.
std::string glb(const std::string& json, const std::string& binary, std::size_t claimed = 0) {
    const auto word = [](std::size_t value) { return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)}); };
    const std::string chunks = word(json.size()) + "JSON" + json + word(binary.size()) + std::string("BIN\0", 4) + binary;
    return "glTF" + word(2) + word(claimed == 0 ? 12 + chunks.size() : claimed) + chunks;
}

TEST(GltfBytes, ChunksOfAGlbAreHeldAgainstItsLength) {
    const std::string json = fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":36}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}}],{}}})",
                                         showing(triangle));
    EXPECT_EQ(imported(glb(json, triangle_bytes)).frame.meshes[0].positions[1], glm::vec3(1, 0, 0));
    EXPECT_THAT(refusal(glb(json, triangle_bytes, 100000)), FailsWith("import.gltf.glb_cut", Field("claimed_bytes", 100000)));
    EXPECT_THAT(refusal(glb(json, triangle_bytes).substr(0, 15)), FailsWith("import.gltf.glb_header_cut"));
    std::string huge = glb(json, triangle_bytes);
    huge.replace(12, 4, "\xff\xff\xff\xff");  // the sum of two lengths must not wrap around
    EXPECT_THAT(refusal(huge), FailsWith("import.gltf.glb_json", Field("bytes", 4294967295)));
    EXPECT_THAT(refusal(glb(json, triangle_bytes.substr(0, 20))),
                FailsWith("import.gltf.buffer_cut", Field("buffer", 0), Field("claimed_bytes", 36), Field("bytes", 20)));
}

}  // namespace
}  // namespace strata
