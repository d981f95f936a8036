// EXT_mesh_gpu_instancing: one draw for each instance, placed by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

/// A triangle shown by one node with these attributes of instances; accessors from 1 on come from the caller.
std::string instanced(const Gltf& gltf, const std::string& attributes, const std::string& node = "") {
    return gltf.text(
        fmt::format(R"("nodes":[{{"name":"n","mesh":0{},"extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{{}}}}}}}}}],
        "meshes":[{{"primitives":[{}]}}],"extensionsUsed":["EXT_mesh_gpu_instancing"],"extensionsRequired":["EXT_mesh_gpu_instancing"])",
                    node, attributes, triangle));
}

/// Where corner (1, 0, 0) of every draw's triangle is.
std::vector<glm::dvec3> corners(const Frame& frame) {
    std::vector<glm::dvec3> result;
    for (const Draw& draw : frame.draws) result.emplace_back(draw.to_world * glm::dvec4(1, 0, 0, 1));
    return result;
}

TEST(GltfInstances, EveryInstanceIsADrawOfOneMesh) {
    std::string bytes;
    for (int i = 0; i < 125; ++i)
        bytes +=
            bytes_of<float>({static_cast<float>(i % 5) * 3, static_cast<float>(i / 5 % 5) * 3, static_cast<float>(i / 25) * 3});
    Gltf gltf = Gltf().with_triangle();
    gltf.accessor(bytes, 5126, "VEC3", 125);
    const Frame frame = imported(instanced(gltf, R"("TRANSLATION":1)", R"(,"translation":[100,0,0])")).frame;
    EXPECT_EQ(frame.meshes.size(), 1u);
    ASSERT_EQ(frame.draws.size(), 125u);
    EXPECT_EQ(corners(frame)[124], glm::dvec3(113, 12, 12));
    for (const glm::dvec3& corner : corners(frame)) {
        const glm::dvec4 clip(frame.view.projection * glm::vec4(frame.view.to_view * (corner - frame.view.origin), 1));
        EXPECT_LT(std::max(std::abs(clip.x), std::abs(clip.y)), clip.w) << "the framing camera sees all of them";
    }
}

TEST(GltfInstances, AreScaledThenTurnedThenMovedThenPlacedByTheirNode) {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({1, 2, 3, 0, 0, 0}, "VEC3", 3);
    gltf.accessor(bytes_of<std::int16_t>({0, 0, 23170, 23170, 0, 0, 0, 32767}), 5122, "VEC4", 2, R"(,"normalized":true)");
    gltf.floats({4, 1, 1, 1, 1, 1}, "VEC3", 3);
    const Frame frame =
        imported(instanced(gltf, R"("TRANSLATION":1,"ROTATION":2,"SCALE":3)", R"(,"scale":[2,2,2],"translation":[0,0,10])"))
            .frame;
    ASSERT_EQ(frame.draws.size(), 2u);
    const glm::dvec3 turned = corners(frame)[0];  // (4, 0, 0), a quarter turn about z, moved, twice as large, 10 along z
    EXPECT_NEAR(glm::length(turned - glm::dvec3(2, 12, 16)), 0, 1e-6);
    EXPECT_NEAR(glm::length(corners(frame)[1] - glm::dvec3(2, 0, 10)), 0, 1e-6);
}

TEST(GltfInstances, MoveWithTheirNode) {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({5, 0, 0, 0, 5, 0}, "VEC3", 3);
    gltf.floats({0, 1}, "SCALAR", 1);
    gltf.floats({0, 0, 0, 0, 0, 8}, "VEC3", 3);
    std::string text = instanced(gltf, R"("TRANSLATION":1)");
    text.insert(text.size() - 1, R"(,"animations":[{"samplers":[{"input":2,"output":3}],
        "channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])");
    GltfScene scene = opened(text, {.fps = 2});
    const auto frame = scene.frame(1);
    ASSERT_TRUE(frame) << frame.error().sentence;
    EXPECT_EQ(corners(*frame)[1], glm::dvec3(1, 5, 4));
    EXPECT_EQ(glm::dvec3(frame->draws[1].previous_to_world[3]), glm::dvec3(0, 5, 0));
    EXPECT_EQ(frame->draws[1].mobility, Mobility::moving);
}

TEST(GltfInstances, OfOtherTypesOrLengthsAreRefused) {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({1, 2, 3, 0, 0, 0}, "VEC3", 3);
    gltf.floats({1, 1, 1}, "VEC3", 3);
    gltf.accessor(bytes_of<std::uint16_t>({1, 2, 3, 0, 0, 0}), 5123, "VEC3", 2);
    gltf.accessor(bytes_of<std::uint8_t>({0, 0, 0, 255, 0, 0, 0, 255}), 5121, "VEC4", 2, R"(,"normalized":true)");
    const auto refused = [&](const std::string& attributes) { return refusal(instanced(gltf, attributes)); };
    EXPECT_THAT(refused(R"("TRANSLATION":1,"SCALE":2)"),
                FailsWith("import.gltf.attribute_count", Field("node", "n"), Field("attribute", "TRANSLATION"),
                          Field("elements", 2), Field("wanted", 1)));
    EXPECT_THAT(refused(R"("TRANSLATION":3)"),
                FailsWith("import.gltf.not_floats", Field("attribute", "TRANSLATION"), Field("component_type", 5123)));
    EXPECT_THAT(refused(R"("ROTATION":4)"),
                FailsWith("import.gltf.not_floats", Field("attribute", "ROTATION"), Field("component_type", 5121)));
    EXPECT_THAT(refused(R"("ROTATION":1)"), FailsWith("import.gltf.accessor_type", Field("attribute", "ROTATION"),
                                                      Field("accessor", 1), Field("type", "VEC3")));
    EXPECT_THAT(refused(R"("SCALE":9)"),
                FailsWith("import.gltf.index_range", Field("list", "accessor"), Field("index", 9), Field("attribute", "SCALE")));
    EXPECT_THAT(refused(""), FailsWith("import.gltf.no_instance_attributes"));
}

}  // namespace
}  // namespace strata
