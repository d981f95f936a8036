// How the numbers of a glTF are stored: every component type, normalized or not, sparse or not there at all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::ElementsAre;

/// The positions of a triangle stored as these bytes.
std::vector<glm::vec3> positions(const std::string& bytes, int component, const std::string& more = "") {
    Gltf gltf;
    gltf.accessor(bytes, component, "VEC3", 3, more);
    return imported(gltf.text(showing(triangle))).frame.meshes[0].positions;
}

TEST(GltfAccessor, PositionsAreReadFromEveryComponentType) {
    const auto same = ElementsAre(glm::vec3(0), glm::vec3(100, 2, 0), glm::vec3(0, 3, 5));
    EXPECT_THAT(positions(bytes_of<std::int8_t>({0, 0, 0, 100, 2, 0, 0, 3, 5}), 5120), same);
    EXPECT_THAT(positions(bytes_of<std::uint8_t>({0, 0, 0, 100, 2, 0, 0, 3, 5}), 5121), same);
    EXPECT_THAT(positions(bytes_of<std::int16_t>({0, 0, 0, 100, 2, 0, 0, 3, 5}), 5122), same);
    EXPECT_THAT(positions(bytes_of<std::uint16_t>({0, 0, 0, 100, 2, 0, 0, 3, 5}), 5123), same);
    EXPECT_THAT(positions(bytes_of<std::uint32_t>({0, 0, 0, 100, 2, 0, 0, 3, 5}), 5125), same);
    EXPECT_THAT(positions(bytes_of<float>({0, 0, 0, 100, 2, 0, 0, 3, 5}), 5126), same);
}

TEST(GltfAccessor, NormalizedIntegersReachOneAndMinusOne) {
    const std::string normalized = R"(,"normalized":true)";
    const auto corner = [&](const std::string& bytes, int component) { return positions(bytes, component, normalized)[1]; };
    EXPECT_EQ(corner(bytes_of<std::int8_t>({0, 0, 0, 127, -127, -128, 0, 1, 0}), 5120), glm::vec3(1, -1, -1));
    EXPECT_EQ(corner(bytes_of<std::uint8_t>({0, 0, 0, 255, 51, 0, 0, 1, 0}), 5121), glm::vec3(1, 51 / 255.0f, 0));
    EXPECT_EQ(corner(bytes_of<std::int16_t>({0, 0, 0, 32767, -32767, -32768, 0, 1, 0}), 5122), glm::vec3(1, -1, -1));
    EXPECT_EQ(corner(bytes_of<std::uint16_t>({0, 0, 0, 65535, 13107, 0, 0, 1, 0}), 5123), glm::vec3(1, 0.2f, 0));
}

TEST(GltfAccessor, QuantizedNormalsAndUvsMayBePaddedToFourBytes) {
    Gltf gltf = Gltf().with_triangle();
    gltf.accessor(bytes_of<std::int8_t>({0, 0, 127, 9, 0, 0, 127, 9, 0, 0, 127, 9}), 5120, "VEC3", 3, R"(,"normalized":true)");
    gltf.accessor(bytes_of<std::uint16_t>({0, 0, 32768, 0, 0, 65535}), 5123, "VEC2", 3, R"(,"normalized":true)");
    std::string text = gltf.text(showing(R"({"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}})") +
                                 R"(,"extensionsRequired":["KHR_mesh_quantization"])");
    text.insert(text.find(R"("byteLength":12})"), R"("byteStride":4,)");
    const Mesh mesh = imported(text).frame.meshes[0];
    EXPECT_THAT(mesh.normals, testing::Each(glm::vec3(0, 0, 1)));
    EXPECT_FLOAT_EQ(mesh.uv0[1].x, 32768 / 65535.0f);
    EXPECT_EQ(mesh.uv0[2].y, 1);
}

TEST(GltfAccessor, ColorsOfSixteenBitsKeepTheirAlphaWhereItCovers) {
    Gltf gltf = Gltf().with_triangle();
    gltf.accessor(bytes_of<std::uint16_t>({65535, 0, 13107, 32768, 0, 0, 0, 0, 0, 0, 0, 0}), 5123, "VEC4", 3,
                  R"(,"normalized":true)");
    const std::string primitive = R"({"material":0,"attributes":{"POSITION":0,"COLOR_0":1}})";
    const auto color = [&](const char* mode) {
        return imported(gltf.text(showing(primitive, fmt::format(R"(,"materials":[{{"alphaMode":"{}"}}])", mode))))
            .frame.meshes[0]
            .colors[0];
    };
    EXPECT_EQ(color("BLEND"), glm::vec4(1, 0, 0.2f, 32768 / 65535.0f));
    EXPECT_EQ(color("OPAQUE").w, 1);
}

TEST(GltfAccessor, SparseReplacementsNeedNoBaseAndMayBeIndices) {
    Gltf gltf = Gltf().with_triangle();
    const int places = gltf.accessor(bytes_of<std::uint8_t>({1, 2}), 5121, "SCALAR", 2);
    const int values = gltf.accessor(bytes_of<std::uint16_t>({2, 1}), 5123, "SCALAR", 2);
    const std::string sparse =
        fmt::format(R"("sparse":{{"count":2,"indices":{{"bufferView":{},"componentType":5121}},"values":{{"bufferView":{}}}}})",
                    places, values);
    std::string text = gltf.text(showing(R"({"indices":3,"attributes":{"POSITION":0}})"));
    text.insert(text.find("],\"nodes\""), R"(,{"componentType":5123,"type":"SCALAR","count":3,)" + sparse + "}");
    EXPECT_THAT(imported(text).frame.meshes[0].normals, testing::Each(glm::vec3(0, 0, -1))) << "0, 2, 1 turns it around";
}

TEST(GltfAccessor, WithoutBufferViewEverythingIsZero) {
    Gltf gltf = Gltf().with_triangle();
    std::string text = gltf.text(showing(R"({"attributes":{"POSITION":0,"COLOR_0":1}})"));
    text.insert(text.find("],\"nodes\""), R"(,{"componentType":5126,"type":"VEC3","count":3})");
    EXPECT_THAT(imported(text).frame.meshes[0].colors, testing::Each(glm::vec4(0, 0, 0, 1)));
}

TEST(GltfAccessor, LyingCountsAreRefusedBeforeAnythingIsAllocated) {
    const std::string text = Gltf().with_triangle().text(showing(triangle));
    const auto with_count = [&](const std::string& count, const std::string& more) {
        std::string broken = text;
        const std::string old = R"("count":3})";
        return refusal(broken.replace(broken.find(old), old.size(), R"("count":)" + count + more + "}"));
    };
    EXPECT_THAT(with_count("4000000000", ""),
                FailsWith("import.gltf.accessor_range", Field("elements", 4000000000), Field("view", 0)));
    EXPECT_THAT(with_count("-3", ""),
                FailsWith("import.gltf.member_type", Field("place", "glTF.accessors[0]"), Field("member", "count")));
    EXPECT_THAT(
        with_count("3", R"(,"sparse":{"count":4,"indices":{"bufferView":0,"componentType":5125},"values":{"bufferView":0}})"),
        FailsWith("import.gltf.sparse_count", Field("replaced", 4), Field("elements", 3)));
    EXPECT_THAT(
        with_count("3", R"(,"sparse":{"count":1,"indices":{"bufferView":0,"componentType":5126},"values":{"bufferView":0}})"),
        FailsWith("import.gltf.sparse_index_type", Field("component_type", 5126)));
    std::string implicit = text;
    implicit.replace(implicit.find(R"("bufferView":0,)"), 15, "");
    implicit.replace(implicit.find(R"("count":3)"), 9, R"("count":9000000000000)");
    EXPECT_THAT(refusal(implicit), FailsWith("import.gltf.accessor_without_view", Field("elements", 9000000000000)));
}

TEST(GltfAccessor, ManyUsesOfOneAccessorStayWithinTheBudget) {
    std::string primitives = triangle;
    for (int i = 0; i < 100; ++i) primitives += std::string(",") + triangle;
    const std::string text = Gltf().with_triangle().text(showing(primitives));
    const auto scene = import_text(text, {.memory_budget = 200000});
    ASSERT_FALSE(scene);
    EXPECT_THAT(scene, FailsWith("memory.budget", Field("budget", "0.2 MiB")));
    EXPECT_TRUE(import_text(text, {.memory_budget = 2000000}));
}

}  // namespace
}  // namespace strata
