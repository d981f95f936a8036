// Where the bytes of a glTF may come from: its own chunks, data URIs, and files below its folder. Nothing else is opened.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/import/gltf_files.h"
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

    /// What importing a triangle whose buffer is at the URI says; "" when it works.
    std::string fault_of(const std::string& uri, std::size_t length = 36) const {
        write("scene/scene.gltf", fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{},"uri":"{}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}}],
            {}}})",
                                              length, uri, showing(triangle)));
        const auto scene = import_gltf(root_ / "scene/scene.gltf", {});
        return scene ? "" : scene.error().sentence;
    }

    const std::filesystem::path root_ = std::filesystem::path(testing::TempDir()) /
                                        (std::string("gltf_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(GltfFiles, BelowTheFolderAreReadWithTheirNamesUnescaped) {
    write("scene/parts/a b.bin", triangle_bytes);
    EXPECT_EQ(fault_of("parts/a%20b.bin"), "");
    EXPECT_EQ(fault_of("./parts/a b.bin"), "");
    EXPECT_THAT(fault_of("parts/a%2"), HasSubstr("is no URI"));
    EXPECT_THAT(fault_of("parts/none.bin"), HasSubstr("the file 'parts/none.bin' is missing"));
    EXPECT_THAT(fault_of("parts"), HasSubstr("cannot open"));
    EXPECT_THAT(fault_of("parts/a%20b.bin", 37), HasSubstr("claims 37 bytes, 36 are there"));
}

TEST_F(GltfFiles, OutsideTheFolderAreNeverOpened) {
    write("secret.bin", triangle_bytes);
    const std::string absolute = (root_ / "secret.bin").string();
    for (const std::string& uri :
         {std::string("../secret.bin"), std::string("parts/../../secret.bin"), std::string("%2e%2e/secret.bin"), absolute,
          "file://" + absolute, std::string("http://localhost/a.bin"), std::string("..\\\\secret.bin"), std::string("a%00b")}) {
        EXPECT_THAT(fault_of(uri), HasSubstr("not below the folder of the glTF")) << uri;
    }
}

TEST_F(GltfFiles, LinksMayNotLeaveTheFolder) {
    write("secret.bin", triangle_bytes);
    write("scene/inside.bin", triangle_bytes);
    std::filesystem::create_symlink(root_ / "secret.bin", root_ / "scene/out.bin");
    std::filesystem::create_directory_symlink(root_, root_ / "scene/up");
    std::filesystem::create_symlink("inside.bin", root_ / "scene/in.bin");
    EXPECT_THAT(fault_of("out.bin"), HasSubstr("a link that leaves the folder"));
    EXPECT_THAT(fault_of("up/secret.bin"), HasSubstr("a link that leaves the folder"));
    EXPECT_EQ(fault_of("in.bin"), "");
}

TEST_F(GltfFiles, ADeviceOrAPipeIsNoFile) { EXPECT_FALSE(import_gltf("/dev/zero", {})); }

TEST(GltfBytes, InMemoryNoOtherFileIsRead) {
    const std::string text = Gltf().with_triangle().text(showing(triangle));
    EXPECT_TRUE(import_text(text));
    EXPECT_THAT(imported(with_image(R"("uri":"/etc/hostname")", "")).warnings,
                Contains(HasSubstr("is another file, and only this one is read")));
}

TEST(GltfBytes, DataUrisAreBase64OrEscaped) {
    const gltf::Folder none;
    const auto read = [&](const std::string& uri) {
        MemoryBudget budget(1000);
        const auto bytes = none.read(uri, budget);
        return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()) : "! " + bytes.error().sentence;
    };
    EXPECT_EQ(read("data:application/octet-stream;base64,AAEC/w=="), std::string("\0\1\2\xff", 4));
    EXPECT_EQ(read("data:;base64,AAEC/w"), std::string("\0\1\2\xff", 4)) << "padding may be missing";
    EXPECT_EQ(read("data:text/plain,a%20b"), "a b");
    EXPECT_THAT(read("data:;base64,A*=="), HasSubstr("is no base64"));
    EXPECT_THAT(read("data:;base64,AAAAA"), HasSubstr("cut short"));
    EXPECT_THAT(read("data:;base64"), HasSubstr("has no data"));
    EXPECT_THAT(read("data:;base64," + std::string(2000, 'A')), HasSubstr("the memory budget is 1000 bytes"));
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
    EXPECT_THAT(refusal(glb(json, triangle_bytes, 100000)), HasSubstr("cut short: it says it has 100000 bytes"));
    EXPECT_THAT(refusal(glb(json, triangle_bytes).substr(0, 15)), HasSubstr("cut short within its header"));
    std::string huge = glb(json, triangle_bytes);
    huge.replace(12, 4, "\xff\xff\xff\xff");  // the sum of two lengths must not wrap around
    EXPECT_THAT(refusal(huge), HasSubstr("no JSON of 4294967295 bytes"));
    EXPECT_THAT(refusal(glb(json, triangle_bytes.substr(0, 20))), HasSubstr("buffer 0 claims 36 bytes, 20 are there"));
}

}  // namespace
}  // namespace strata
