// What the glTF import does not understand it names, and broken files end in a sentence, never in a crash.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/import/gltf.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(HostileGltf, RequiredExtensionsMustBeSupportedOthersAreIgnored) {
    const Gltf gltf = Gltf().with_triangle();
    EXPECT_THAT(refusal(gltf.text(showing(triangle, R"(,"extensionsRequired":["EXT_sparkle"])"))),
                FailsWith("import.gltf.extension", Field("extension", "EXT_sparkle")));
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
    EXPECT_THAT(broken(R"(,"count":4)", ""), FailsWith("import.gltf.accessor_range", Field("view", 0)));
    EXPECT_THAT(broken(R"(,"count":4611686018427387904)", ""), FailsWith("import.gltf.accessor_range", Field("view", 0)));
    EXPECT_THAT(broken(R"(,"count":3,"byteOffset":4)", ""), FailsWith("import.gltf.accessor_range", Field("view", 0)));
    EXPECT_THAT(broken(R"(,"count":3,"byteOffset":18446744073709551612)", ""),
                FailsWith("import.gltf.accessor_range", Field("view", 0)));
    EXPECT_THAT(broken(R"(,"count":3)", R"(,"byteOffset":8)"), FailsWith("import.gltf.buffer_view_range"));
    EXPECT_THAT(broken(R"(,"count":3)", R"(,"byteOffset":18446744073709551608)"), FailsWith("import.gltf.buffer_view_range"));
    EXPECT_THAT(broken(R"(,"count":3)", R"(,"byteStride":252)"), FailsWith("import.gltf.accessor_range", Field("view", 0)));
}

TEST(HostileGltf, DanglingReferencesAreRefused) {
    const Gltf gltf = Gltf().with_triangle();
    const std::string meshes = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";
    EXPECT_THAT(refusal(gltf.text(R"("nodes":[{"mesh":3}],)" + meshes)),
                FailsWith("import.gltf.index_range", Field("list", "mesh"), Field("index", 3)));
    EXPECT_THAT(refusal(gltf.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"children":[0]}],)" + meshes)),
                FailsWith("import.gltf.node_cycle", Field("node", 0)));
    EXPECT_THAT(refusal(gltf.text(R"("scenes":[{"nodes":[7]}],"nodes":[{}],)" + meshes)),
                FailsWith("import.gltf.index_range", Field("list", "node"), Field("index", 7)));
    EXPECT_THAT(refusal(gltf.text(showing(R"({"attributes":{"POSITION":9}})"))),
                FailsWith("import.gltf.index_range", Field("list", "accessor"), Field("index", 9)));
    EXPECT_THAT(
        refusal(gltf.text(showing(R"({"attributes":{"NORMAL":0}})"))),
        FailsWith("import.gltf.index_range", Field("list", "accessor"), Field("index", -1), Field("attribute", "POSITION")));
    Gltf far = Gltf().with_triangle();
    far.accessor(bytes_of<std::uint16_t>({0, 1, 3}), 5123, "SCALAR", 3);
    EXPECT_THAT(refusal(far.text(showing(R"({"indices":1,"attributes":{"POSITION":0}})"))),
                FailsWith("import.gltf.vertex_range", Field("vertex", 3), Field("vertices", 3)));
}

TEST(HostileGltf, ReferencesAndModesThatGltfDoesNotHaveAreNamed) {
    const auto with = [](const std::string& members) { return refusal(Gltf().with_triangle().text(members)); };
    EXPECT_THAT(with(showing(R"({"material":4,"attributes":{"POSITION":0}})", R"(,"materials":[{}])")),
                FailsWith("import.gltf.index_range", Field("list", "material"), Field("index", 4), Field("count", 1),
                          Field("place", "mesh 0 'm', primitive 0")));
    EXPECT_THAT(with(showing(R"({"mode":9,"attributes":{"POSITION":0}})")),
                FailsWith("import.gltf.mode", Field("place", "mesh 0 'm', primitive 0"), Field("mode", 9)));
    EXPECT_THAT(with(R"("nodes":[{"name":"n","camera":2}])"),
                FailsWith("import.gltf.index_range", Field("list", "camera"), Field("index", 2), Field("place", "node 0 'n'")));
    EXPECT_THAT(with(R"("nodes":[{"extensions":{"KHR_lights_punctual":{"light":0}}}])"),
                FailsWith("import.gltf.index_range", Field("list", "light"), Field("index", 0)));
    EXPECT_THAT(with(showing(triangle, R"(,"textures":[{"source":5}])")),
                FailsWith("import.gltf.index_range", Field("list", "image"), Field("index", 5), Field("place", "texture 0")));
    EXPECT_THAT(with(showing(triangle, R"(,"textures":[{"sampler":1}],"samplers":[{}])")),
                FailsWith("import.gltf.index_range", Field("list", "sampler"), Field("index", 1), Field("place", "texture 0")));
    EXPECT_THAT(with(showing(triangle, R"(,"samplers":[{"wrapT":3}])")),
                FailsWith("import.gltf.wrap_mode", Field("place", "sampler 0"), Field("member", "wrapT"), Field("mode", 3)));
    EXPECT_THAT(
        with(showing(triangle, R"(,"samplers":[{"magFilter":9984}])")),
        FailsWith("import.gltf.filter", Field("place", "sampler 0"), Field("member", "magFilter"), Field("filter", 9984)));
    EXPECT_THAT(
        with(showing(triangle, R"(,"samplers":[{"minFilter":9988}])")),
        FailsWith("import.gltf.filter", Field("place", "sampler 0"), Field("member", "minFilter"), Field("filter", 9988)));
    EXPECT_THAT(
        with(showing(triangle, R"(,"materials":[{"name":"glass","emissiveTexture":{"index":3}}])")),
        FailsWith("import.gltf.index_range", Field("list", "texture"), Field("index", 3), Field("place", "material 0 'glass'")));
}

TEST(HostileGltf, AFileThatNeedsANewerReaderIsRefused) {
    const auto with = [](const std::string& asset) {
        return refusal(fmt::format(R"({{"asset":{{{}}},"nodes":[{{}}]}})", asset));
    };
    EXPECT_THAT(with(R"("version":"2.1","minVersion":"2.1")"), FailsWith("import.gltf.min_version", Field("version", "2.1")));
    EXPECT_THAT(with(R"("version":"2.0","minVersion":"two")"),
                FailsWith("import.gltf.min_version_syntax", Field("version", "two")));
    EXPECT_THAT(with(R"("version":"2.x")"), FailsWith("import.gltf.version", Field("version", "2.x")));
    EXPECT_FALSE(with(R"("version":"2.1","minVersion":"2.0")"));
}

TEST(HostileGltf, ImageThatIsNoPictureOrLeavesItsBufferIsAWarning) {
    const ImportedScene scene = imported(with_image(R"("bufferView":0,"mimeType":"image/png")", ""));
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("PNG")));
    EXPECT_THAT(imported(with_image(R"("bufferView":9)", "")).warnings, Contains(HasSubstr("buffer view 9")));
    std::string text = with_image(R"("bufferView":0,"mimeType":"image/png")", "");
    const std::string view = R"({"buffer":0,"byteOffset":0,"byteLength":36})";
    text.insert(text.find(view), R"({"buffer":0,"byteOffset":16,"byteLength":1000000},)");
    for (const char* accessor : {"\"bufferView\":1,\"comp", "\"bufferView\":0,\"comp"}) {  // the others move up by one
        text[text.find(accessor) + 13]++;
    }
    EXPECT_THAT(imported(text).warnings, Contains(HasSubstr("bufferViews[0]")));
}

TEST(HostileGltf, WhatIsNoGltfIsRefused) {
    EXPECT_THAT(refusal("not json"), FailsWith("import.gltf.json_syntax", Field("file", "test.gltf"), Field("word", "'not'")));
    EXPECT_THAT(refusal("\x89PNG\r\n"), FailsWith("import.gltf.json_syntax", Field("word", "0x89"), Field("byte", 0)));
    EXPECT_THAT(refusal(""), FailsWith("import.gltf.json_cut", Field("bytes", 0)));
    EXPECT_THAT(refusal(std::string("glTF\x02\0\0\0", 8)), FailsWith("import.gltf.glb_header_cut"));
    EXPECT_FALSE(import_gltf("/nowhere/at_all.gltf", {}));
}

TEST(HostileGltf, NestingWithoutEndIsRefused) {
    const auto nested = [](std::size_t depth) {
        std::string text = Gltf().with_triangle().text(showing(triangle, R"(,"extras":)"));
        return text.insert(text.size() - 1, std::string(depth, '[') + std::string(depth, ']'));
    };
    EXPECT_FALSE(refusal(nested(60)));
    EXPECT_THAT(refusal(nested(70)), FailsWith("import.gltf.json_depth", Field("most", 64)));
    EXPECT_THAT(refusal(nested(1000000)), FailsWith("import.gltf.json_depth", Field("most", 64)));
}

TEST(HostileGltf, MoreObjectsThanTheBudgetHoldsAreRefused) {
    std::string nodes = "{}";
    for (int i = 0; i < 5000; ++i) nodes += ",{}";
    const auto scene = import_text(R"({"asset":{"version":"2.0"},"nodes":[)" + nodes + "]}", {.memory_budget = 1 << 20});
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene, FailsWith("memory.budget", Field("what", "the objects and lists of the JSON")));
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
    EXPECT_THAT(with(R"("nodes":[{},{"children":[0,"x"]}])"),
                FailsWith("import.gltf.member_type", Field("place", "glTF.nodes[1]"), Field("member", "children")));
    EXPECT_THAT(with(R"("nodes":[{"translation":[1,2]}])"),
                FailsWith("import.gltf.member_type", Field("place", "glTF.nodes[0]"), Field("member", "translation")));
    EXPECT_THAT(with(R"("nodes":[{"mesh":-1}])"),
                FailsWith("import.gltf.member_type", Field("place", "glTF.nodes[0]"), Field("member", "mesh")));
    EXPECT_THAT(with(R"("nodes":[7])"), FailsWith("import.gltf.not_an_object", Field("place", "glTF.nodes[0]")));
    EXPECT_THAT(with(R"("nodes":{})"), FailsWith("import.gltf.member_type", Field("place", "glTF"), Field("member", "nodes")));
    EXPECT_THAT(with(R"("nodes":[{"scale":[1e999,1,1]}])"),
                FailsWith("import.gltf.json_number", Field("place", "glTF.nodes[0].scale[0]"), Field("number", "1e999")));
    EXPECT_THAT(refusal(R"({"asset":{"version":"1.0"}})"), FailsWith("import.gltf.version", Field("version", "1.0")));
}

TEST(HostileGltf, TextThatIsNoJsonIsQuotedWithItsPlace) {
    const std::string materials = R"({"asset":{"version":"2.0"},"materials":[{},{"alphaCutoff":)";
    EXPECT_THAT(refusal(materials + "NaN}]}"),
                FailsWith("import.gltf.json_syntax", Field("place", "glTF.materials[1].alphaCutoff"), Field("word", "'NaN'"),
                          Field("byte", 58)));
    EXPECT_THAT(refusal(materials + "-Infinity}]}"),
                FailsWith("import.gltf.json_syntax", Field("place", "glTF.materials[1].alphaCutoff"),
                          Field("word", "'-Infinity'"), Field("byte", 58)));
    EXPECT_THAT(refusal(materials + "1e400}]}"),
                FailsWith("import.gltf.json_number", Field("place", "glTF.materials[1].alphaCutoff"), Field("number", "1e400")));
    EXPECT_THAT(
        refusal(materials + "[0,[1,nan"),
        FailsWith("import.gltf.json_syntax", Field("place", "glTF.materials[1].alphaCutoff[1][1]"), Field("word", "'nan'")));
    EXPECT_THAT(refusal(materials + "1;}]}"),
                FailsWith("import.gltf.json_syntax", Field("place", "glTF.materials[1].alphaCutoff"), Field("word", "'1;'"),
                          Field("byte", 58)));
    EXPECT_THAT(refusal(materials),
                FailsWith("import.gltf.json_cut", Field("place", "glTF.materials[1].alphaCutoff"), Field("bytes", 58)));
    EXPECT_THAT(refusal(R"({"asset":{"vers)"),
                FailsWith("import.gltf.json_cut", Field("place", "glTF.asset"), Field("bytes", 15)));
    EXPECT_THAT(refusal("hello"),
                FailsWith("import.gltf.json_syntax", Field("place", "the file"), Field("word", "'hello'"), Field("byte", 0)));
    EXPECT_THAT(refusal(""), FailsWith("import.gltf.json_cut", Field("place", "the file"), Field("bytes", 0)));
}

/// A PNG of nothing but a header, as an image of a glTF.
std::string with_empty_png(std::uint32_t edge) {
    std::string png(33, '\0');
    png.replace(0, 16, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
    for (std::size_t i = 0; i < 4; ++i) png[16 + i] = png[20 + i] = static_cast<char>(edge >> (24 - 8 * i));
    png.replace(24, 2, "\x08\x06");
    return with_image(fmt::format(R"("name":"sky","uri":"data:image/png;base64,{}")", base64(png)), "");
}

TEST(HostileGltf, PicturesAreHeldAgainstTheBudgetBeforeTheyAreDecoded) {
    const auto scene = import_text(with_empty_png(8192), {.memory_budget = 1 << 20});
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().fault, Fault::device_lacks);
    EXPECT_THAT(scene, FailsWith("memory.budget", Field("what", "image 0"), Field("count", 67108864), Field("each_bytes", 24)));
}

TEST(HostileGltf, APictureThatNoCaptureHoldsIsNamedBeforeItIsDecoded) {
    // With mips 4/3 of 4 * 16384^2 bytes and a few more: 1.43e9. The budget holds less, and is not asked.
    EXPECT_THAT(imported(with_empty_png(16384), {.memory_budget = 1 << 20}).warnings,
                Contains("texture 0 is left out: image 0 'sky' has 16384 x 16384 texels, with mips 1431655764 bytes; a capture "
                         "holds at most 1073741824 bytes for a texture"));
    EXPECT_THAT(import_text(with_empty_png(14000), {.memory_budget = 1 << 20}),
                FailsWith("memory.budget", Field("what", "image 0"), Field("count", 14000 * 14000)));
}

TEST(HostileGltf, AccessorsWithoutAViewHaveNoMoreElementsThanTheFileHasBytes) {
    const auto zeros = [](std::uint64_t count) {
        return fmt::format(
            R"({{"asset":{{"version":"2.0"}},"accessors":[{{"componentType":5126,"type":"VEC3","count":{}}}],{}}})", count,
            showing(triangle));
    };
    EXPECT_THAT(refusal(zeros(300'000'000)), FailsWith("import.gltf.accessor_without_view", Field("elements", 300'000'000),
                                                       Field("bytes", zeros(300'000'000).size())));
    EXPECT_EQ(imported(zeros(3)).frame.meshes[0].positions, std::vector<glm::vec3>(3, glm::vec3(0)));
}

TEST(HostileGltf, IndicesThatRestartAPrimitiveAreRefused) {
    // As many vertices as make the largest index of the type one of them.
    const auto restarted = [](int type, const std::string& indices, std::size_t vertices) {
        Gltf gltf;
        gltf.accessor(std::string(12 * vertices, '\0'), 5126, "VEC3", vertices);
        gltf.accessor(indices, type, "SCALAR", 3);
        return refusal(gltf.text(showing(R"({"indices":1,"attributes":{"POSITION":0}})")));
    };
    EXPECT_THAT(restarted(5121, bytes_of<std::uint8_t>({0, 1, 255}), 256),
                FailsWith("import.gltf.restart_index", Field("element", 2), Field("accessor", 1), Field("index", 255)));
    EXPECT_THAT(restarted(5123, bytes_of<std::uint16_t>({0, 65535, 1}), 65536),
                FailsWith("import.gltf.restart_index", Field("element", 1), Field("index", 65535)));
    EXPECT_THAT(restarted(5125, bytes_of<std::uint32_t>({0, 1, 0xffffffff}), 3),
                FailsWith("import.gltf.restart_index", Field("element", 2), Field("index", 4294967295)));
    EXPECT_FALSE(restarted(5123, bytes_of<std::uint16_t>({0, 255, 65534}), 65536)) << "other types' largest";
}

TEST(HostileGltf, OtherPicturesThanPngAndJpegNeverReachADecoder) {
    const std::string gif("GIF89a\1\0\1\0\0\0\0;", 14), bmp = "BM" + std::string(60, '\1');
    for (const std::string& picture : {gif, bmp}) {
        EXPECT_THAT(imported(with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", base64(picture)), "")).warnings,
                    Contains(HasSubstr("PNG")));
    }
}

TEST(HostileGltf, TruncatedFilesNeverCrash) {
    const std::string text = with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png), "");
    for (std::size_t length = 0; length < text.size(); length += 7) EXPECT_FALSE(import_text(text.substr(0, length))) << length;
}

}  // namespace
}  // namespace strata
