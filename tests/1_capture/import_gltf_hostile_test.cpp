// What the glTF import does not understand it names, and broken files end in a sentence, never in a crash.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/import/gltf.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(HostileGltf, RequiredExtensionsMustBeSupportedOthersAreIgnored) {
    const Gltf gltf = Gltf().with_triangle();
    EXPECT_THAT(refusal(gltf.text(showing(triangle, R"(,"extensionsRequired":["EXT_sparkle"])"))),
                HasSubstr("requires EXT_sparkle, which is not supported"));
    EXPECT_THAT(imported(gltf.text(showing(triangle, R"(,"extensionsUsed":["EXT_sparkle"])"))).warnings,
                Contains(HasSubstr("EXT_sparkle is ignored")));
}

TEST(HostileGltf, OrthographicCameraIsReplacedWithAWarning) {
    const ImportedScene scene = imported(Gltf().with_triangle().text(
        R"("nodes":[{"camera":0},{"mesh":0}],"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0.1,"zfar":9}}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"));
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("orthographic")));
    EXPECT_GT(scene.frame.view.projection[0][0], 0);
}

TEST(HostileGltf, AccessorsThatLeaveTheirBufferAreRefused) {
    const auto broken = [](const std::string& accessor, const std::string& view) {
        return refusal(fmt::format(
            R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{}"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36{}}}],"accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3"{}}}],{}}})",
            base64(std::string(36, '\0')), view, accessor, showing(triangle)));
    };
    EXPECT_THAT(broken(R"(,"count":4)", ""), HasSubstr("leave buffer view"));
    EXPECT_THAT(broken(R"(,"count":4611686018427387904)", ""), HasSubstr("leave buffer view"));
    EXPECT_THAT(broken(R"(,"count":3,"byteOffset":4)", ""), HasSubstr("leave buffer view"));
    EXPECT_THAT(broken(R"(,"count":3,"byteOffset":18446744073709551612)", ""), HasSubstr("leave buffer view"));
    EXPECT_THAT(broken(R"(,"count":3)", R"(,"byteOffset":8)"), HasSubstr("leaves its buffer"));
    EXPECT_THAT(broken(R"(,"count":3)", R"(,"byteOffset":18446744073709551608)"), HasSubstr("leaves its buffer"));
    EXPECT_THAT(broken(R"(,"count":3)", R"(,"byteStride":252)"), HasSubstr("leave buffer view"));
}

TEST(HostileGltf, DanglingReferencesAreRefused) {
    const Gltf gltf = Gltf().with_triangle();
    const std::string meshes = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
    EXPECT_THAT(refusal(gltf.text(R"("nodes":[{"mesh":3}],)" + meshes)), HasSubstr("mesh 3"));
    EXPECT_THAT(refusal(gltf.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}],)" + meshes)),
                HasSubstr("reached twice"));
    EXPECT_THAT(refusal(gltf.text(R"("scenes":[{"nodes":[7]}],"nodes":[{}],)" + meshes)), HasSubstr("node 7"));
    EXPECT_THAT(refusal(gltf.text(showing(R"({"attributes":{"POSITION":9}})"))), HasSubstr("accessor 9"));
    EXPECT_THAT(refusal(gltf.text(showing(R"({"attributes":{"NORMAL":0}})"))), HasSubstr("POSITION"));
    Gltf far = Gltf().with_triangle();
    far.accessor(bytes_of<std::uint16_t>({0, 1, 3}), 5123, "SCALAR", 3);
    EXPECT_THAT(refusal(far.text(showing(R"({"indices":1,"attributes":{"POSITION":0}})"))), HasSubstr("vertex 3 of 3"));
}

TEST(HostileGltf, ImageThatIsNoPictureOrLeavesItsBufferIsAWarning) {
    const ImportedScene scene = imported(with_image(R"("bufferView":0,"mimeType":"image/png")", ""));
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("neither PNG nor JPEG")));
    std::string text = with_image(R"("bufferView":0,"mimeType":"image/png")", "");
    const std::string view = R"({"buffer":0,"byteOffset":0,"byteLength":36})";
    text.insert(text.find(view), R"({"buffer":0,"byteOffset":16,"byteLength":1000000},)");
    for (const char* accessor : {"\"bufferView\":1,\"comp", "\"bufferView\":0,\"comp"}) {  // the others move up by one
        text[text.find(accessor) + 13]++;
    }
    EXPECT_THAT(imported(text).warnings, Contains(HasSubstr("leaves its buffer")));
}

TEST(HostileGltf, WhatIsNoGltfIsRefused) {
    EXPECT_THAT(refusal("not json"), HasSubstr("no readable glTF"));
    EXPECT_THAT(refusal(""), HasSubstr("no readable glTF"));
    EXPECT_THAT(refusal(std::string("glTF\x02\0\0\0", 8)), HasSubstr("no readable glTF"));
    EXPECT_FALSE(import_gltf("/nowhere/at_all.gltf", {}));
}

TEST(HostileGltf, TruncatedFilesNeverCrash) {
    const std::string text = with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png), "");
    for (std::size_t length = 0; length < text.size(); length += 7) EXPECT_FALSE(import_text(text.substr(0, length))) << length;
}

}  // namespace
}  // namespace strata
