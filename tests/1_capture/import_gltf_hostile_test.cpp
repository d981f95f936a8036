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

TEST(HostileGltf, ReferencesAndModesThatGltfDoesNotHaveAreNamed) {
    const auto with = [](const std::string& members) { return refusal(Gltf().with_triangle().text(members)); };
    EXPECT_THAT(with(showing(R"({"material":4,"attributes":{"POSITION":0}})", R"(,"materials":[{}])")),
                HasSubstr("mesh 0 'm', primitive 0 uses material 4, which does not exist (there are 1)"));
    EXPECT_THAT(with(showing(R"({"mode":9,"attributes":{"POSITION":0}})")),
                HasSubstr("mesh 0 'm', primitive 0 has mode 9; glTF's modes are 0 to 6"));
    EXPECT_THAT(with(R"("nodes":[{"name":"n","camera":2}])"), HasSubstr("node 0 'n' uses camera 2"));
    EXPECT_THAT(with(R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])"), HasSubstr("uses light 0"));
    EXPECT_THAT(with(showing(triangle, R"(,"textures":[{"source":5}])")), HasSubstr("texture 0 uses image 5"));
    EXPECT_THAT(with(showing(triangle, R"(,"textures":[{"sampler":1}],"samplers":[{}])")), HasSubstr("texture 0 uses sampler 1"));
    EXPECT_THAT(with(showing(triangle, R"(,"samplers":[{"wrapT":3}])")), HasSubstr("sampler 0 has wrapT 3"));
    EXPECT_THAT(with(showing(triangle, R"(,"samplers":[{"magFilter":9984}])")), HasSubstr("sampler 0 has magFilter 9984"));
    EXPECT_THAT(with(showing(triangle, R"(,"materials":[{"name":"glass","emissiveTexture":{"index":3}}])")),
                HasSubstr("material 0 'glass' uses texture 3"));
}

TEST(HostileGltf, AFileThatNeedsANewerReaderIsRefused) {
    const auto with = [](const std::string& asset) {
        return refusal(fmt::format(R"({{"asset":{{{}}},"nodes":[{{}}]}})", asset));
    };
    EXPECT_THAT(with(R"("version":"2.1","minVersion":"2.1")"), HasSubstr("asset.minVersion is 2.1; this program reads glTF 2.0"));
    EXPECT_THAT(with(R"("version":"2.0","minVersion":"two")"), HasSubstr("asset.minVersion is 'two', which is not a version"));
    EXPECT_THAT(with(R"("version":"2.x")"), HasSubstr("asset version is '2.x'"));
    EXPECT_EQ(with(R"("version":"2.1","minVersion":"2.0")"), "it was imported");
}

TEST(HostileGltf, ImageThatIsNoPictureOrLeavesItsBufferIsAWarning) {
    const ImportedScene scene = imported(with_image(R"("bufferView":0,"mimeType":"image/png")", ""));
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("neither PNG nor JPEG")));
    EXPECT_THAT(imported(with_image(R"("bufferView":9)", "")).warnings, Contains(HasSubstr("buffer view 9 does not exist")));
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
    EXPECT_THAT(refusal("\x89PNG\r\n"), HasSubstr("the file: byte 0 is 0x89 and not JSON"));
    EXPECT_THAT(refusal(""), HasSubstr("no readable glTF"));
    EXPECT_THAT(refusal(std::string("glTF\x02\0\0\0", 8)), HasSubstr("no readable glTF"));
    EXPECT_FALSE(import_gltf("/nowhere/at_all.gltf", {}));
}

TEST(HostileGltf, NestingWithoutEndIsRefused) {
    const auto nested = [](std::size_t depth) {
        std::string text = Gltf().with_triangle().text(showing(triangle, R"(,"extras":)"));
        return text.insert(text.size() - 1, std::string(depth, '[') + std::string(depth, ']'));
    };
    EXPECT_EQ(refusal(nested(60)), "it was imported");
    EXPECT_THAT(refusal(nested(70)), HasSubstr("nests deeper than 64 levels"));
    EXPECT_THAT(refusal(nested(1000000)), HasSubstr("nests deeper than 64 levels"));
}

TEST(HostileGltf, MoreObjectsThanTheBudgetHoldsAreRefused) {
    std::string nodes = "{}";
    for (int i = 0; i < 5000; ++i) nodes += ",{}";
    const auto scene = import_text(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}", {.memory_budget = 1 << 20});
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene.error().sentence, HasSubstr("lists of the JSON would take"));
}

TEST(HostileGltf, NodesMayNestHoweverDeep) {
    std::string nodes = R"({"mesh":0})";
    for (int i = 0; i < 100000; ++i) nodes += fmt::format(R"(,{{"children":[{}]}})", i);
    const std::string text =
        Gltf().with_triangle().text(fmt::format(R"("meshes":[{{"primitives":[{}]}}],"nodes":[{}])", triangle, nodes));
    EXPECT_EQ(imported(text).frame.draws.size(), 1u);
}

TEST(HostileGltf, MembersOfAWrongTypeAreNamed) {
    const auto with = [](const std::string& members) { return refusal(Gltf().with_triangle().text(members)); };
    EXPECT_THAT(with(R"("nodes":[{},{"children":[0,"x"]}])"), HasSubstr("glTF.nodes[1].children is not a list of indices"));
    EXPECT_THAT(with(R"("nodes":[{"translation":[1,2]}])"), HasSubstr("nodes[0].translation is not a list of 3 numbers"));
    EXPECT_THAT(with(R"("nodes":[{"mesh":-1}])"), HasSubstr("nodes[0].mesh is not an index"));
    EXPECT_THAT(with(R"("nodes":[7])"), HasSubstr("nodes[0] is no object"));
    EXPECT_THAT(with(R"("nodes":{})"), HasSubstr("nodes is not a list"));
    EXPECT_THAT(with(R"("nodes":[{"scale":[1e999,1,1]}])"), HasSubstr("nodes[0].scale[0]: 1e999 is too large"));
    EXPECT_THAT(refusal(R"({"asset":{"version":"1.0"}})"), HasSubstr("its asset version is '1.0'"));
}

TEST(HostileGltf, TextThatIsNoJsonIsQuotedWithItsPlace) {
    const std::string materials = R"({"asset":{"version":"2.0"},"materials":[{},{"alphaCutoff":)";
    EXPECT_THAT(refusal(materials + "NaN}]}"), HasSubstr("glTF.materials[1].alphaCutoff: 'NaN' at byte 58 is not JSON"));
    EXPECT_THAT(refusal(materials + "-Infinity}]}"),
                HasSubstr("glTF.materials[1].alphaCutoff: '-Infinity' at byte 58 is not JSON"));
    EXPECT_THAT(refusal(materials + "1e400}]}"), HasSubstr("glTF.materials[1].alphaCutoff: 1e400 is too large for a number"));
    EXPECT_THAT(refusal(materials + "[0,[1,nan"), HasSubstr("glTF.materials[1].alphaCutoff[1][1]: 'nan'"));
    EXPECT_THAT(refusal(materials + "1;}]}"), HasSubstr("glTF.materials[1].alphaCutoff: '1;' at byte 58"));
    EXPECT_THAT(refusal(materials), HasSubstr("the JSON is cut short in glTF.materials[1].alphaCutoff after 58 bytes"));
    EXPECT_THAT(refusal(R"({"asset":{"vers)"), HasSubstr("the JSON is cut short in glTF.asset after 15 bytes"));
    EXPECT_THAT(refusal("hello"), HasSubstr("the file: 'hello' at byte 0 is not JSON"));
    EXPECT_THAT(refusal(""), HasSubstr("cut short in the file after 0 bytes"));
}

TEST(HostileGltf, PicturesAreHeldAgainstTheBudgetBeforeTheyAreDecoded) {
    std::string png(33, '\0');  // a header that claims 16384 x 16384
    png.replace(0, 16, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
    png.replace(16, 10, std::string("\0\0\x40\0\0\0\x40\0\x08\x06", 10));
    const std::string text = with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", base64(png)), "");
    const auto scene = import_text(text, {.memory_budget = 1 << 20});
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().fault, Fault::device_lacks);
    EXPECT_THAT(scene.error().sentence, HasSubstr("image 0 would take 6144.0 MiB (268435456 x 24 bytes)"));
}

TEST(HostileGltf, OtherPicturesThanPngAndJpegNeverReachADecoder) {
    const std::string gif = "GIF89a\1\0\1\0\0\0\0;", bmp = "BM" + std::string(60, '\1');
    for (const std::string& picture : {gif, bmp}) {
        EXPECT_THAT(imported(with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", base64(picture)), "")).warnings,
                    Contains(HasSubstr("neither PNG nor JPEG")));
    }
}

TEST(HostileGltf, TruncatedFilesNeverCrash) {
    const std::string text = with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png), "");
    for (std::size_t length = 0; length < text.size(); length += 7) EXPECT_FALSE(import_text(text.substr(0, length))) << length;
}

}  // namespace
}  // namespace strata
