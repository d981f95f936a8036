// Skins: an arm of two joints along x, the second at x = 1, bent by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

constexpr float half = 0.70710678118654752f;  // of a quarter turn

/// Vertices at x = 0, 1.5 and 2 that follow joint 0, both by half, and joint 1. Accessors: 0 positions, 1 normals, 2 joints,
/// 3 weights, 4 inverse bind matrices.
Gltf arm() {
    Gltf gltf;
    gltf.floats({0, 0, 0, 1.5f, 0, 0, 2, 0, 0}, "VEC3", 3);
    gltf.floats({0, 0, 1, 0, 0, 1, 0, 1, 0}, "VEC3", 3);
    gltf.accessor(bytes_of<std::uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}), 5121, "VEC4", 3);
    gltf.accessor(bytes_of<std::uint8_t>({255, 0, 0, 0, 127, 127, 0, 0, 255, 0, 0, 0}), 5121, "VEC4", 3, R"(,"normalized":true)");
    gltf.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,   //
                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},  //
                "MAT4", 16);
    return gltf;
}

/// The arm on a node with these members, its second joint turned by a quarter around z.
std::string bent(const Gltf& gltf, const std::string& node = "", const std::string& attributes = R"("JOINTS_0":2,"WEIGHTS_0":3)",
                 const std::string& skin = R"("joints":[1,2],"inverseBindMatrices":4)") {
    return gltf.text(fmt::format(R"("scenes":[{{"nodes":[0,1]}}],"skins":[{{{}}}],
        "nodes":[{{"mesh":0,"skin":0{}}},{{"children":[2]}},{{"translation":[1,0,0],"rotation":[0,0,{},{}]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,{}}}}}]}}])",
                                 skin, node, half, half, attributes));
}

/// Where a vertex of the first draw is in the world.
glm::dvec3 in_world(const Frame& frame, std::size_t vertex) {
    return glm::dvec3(frame.draws[0].to_world * glm::dvec4(glm::dvec3(frame.meshes[0].positions[vertex]), 1));
}

TEST(GltfSkin, BendsAnArmOfTwoJoints) {
    const Frame frame = imported(bent(arm())).frame;
    EXPECT_EQ(in_world(frame, 0), glm::dvec3(0));
    EXPECT_NEAR(glm::length(in_world(frame, 1) - glm::dvec3(1.25, 0.25, 0)), 0, 1e-6) << "half way from (1.5,0,0) to (1,.5,0)";
    EXPECT_NEAR(glm::length(in_world(frame, 2) - glm::dvec3(1, 1, 0)), 0, 1e-6);
    EXPECT_NEAR(glm::length(frame.meshes[0].normals[2] - glm::vec3(-1, 0, 0)), 0, 1e-6);
    EXPECT_EQ(frame.draws[0].mobility, Mobility::moving);
}

TEST(GltfSkin, IgnoresTheTransformOfItsOwnNode) {
    for (const char* node : {R"(,"translation":[5,6,7],"scale":[2,3,4])", R"(,"scale":[0,0,0])"}) {
        const Frame frame = imported(bent(arm(), node)).frame;
        EXPECT_NEAR(glm::length(in_world(frame, 2) - glm::dvec3(1, 1, 0)), 0, 1e-5) << node;
    }
}

TEST(GltfSkin, TakesAnyNumberOfJointSets) {
    Gltf gltf = arm();
    gltf.accessor(bytes_of<std::uint16_t>({0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5123, "VEC4", 3);
    gltf.floats({0, 0, 0, 0, 0.25f, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);
    gltf.floats({1, 0, 0, 0, 0.75f, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 4);
    const Frame frame = imported(bent(gltf, "", R"("JOINTS_0":2,"WEIGHTS_0":7,"JOINTS_1":5,"WEIGHTS_1":6)")).frame;
    EXPECT_NEAR(glm::length(in_world(frame, 1) - glm::dvec3(1.375, 0.125, 0)), 0, 1e-6) << "3/4 (1.5,0,0) + 1/4 (1,.5,0)";
    EXPECT_NEAR(glm::length(in_world(frame, 2) - glm::dvec3(1, 1, 0)), 0, 1e-6);
}

TEST(GltfSkin, WeightsAreMadeToSumToOne) {
    Gltf gltf = arm();
    gltf.floats({3, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.25f, 0, 0, 0}, "VEC4", 4);
    const Frame frame = imported(bent(gltf, "", R"("JOINTS_0":2,"WEIGHTS_0":5)")).frame;
    EXPECT_EQ(in_world(frame, 0), glm::dvec3(0));
    EXPECT_NEAR(glm::length(in_world(frame, 2) - glm::dvec3(1, 1, 0)), 0, 1e-6);
}

TEST(GltfSkin, WithoutBindMatricesTheJointsMoveFromTheOrigin) {
    const Frame frame = imported(bent(arm(), "", R"("JOINTS_0":2,"WEIGHTS_0":3)", R"("joints":[1,2])")).frame;
    EXPECT_NEAR(glm::length(in_world(frame, 2) - glm::dvec3(1, 2, 0)), 0, 1e-6) << "(2,0,0) turned to (0,2,0), moved by 1";
}

TEST(GltfSkin, BrokenOnesAreRefused) {
    EXPECT_THAT(refusal(bent(arm(), "", R"("JOINTS_0":2,"WEIGHTS_0":3)", R"("joints":[1])")),
                FailsWith("import.gltf.joint_range", Field("joint", 1), Field("joints", 1)));
    EXPECT_THAT(refusal(bent(arm(), "", R"("JOINTS_0":2)")), FailsWith("import.gltf.joints_without_weights", Field("set", "0")));
    EXPECT_THAT(
        refusal(bent(arm(), "", R"("JOINTS_0":2,"WEIGHTS_0":3)", R"("joints":[1,9])")),
        FailsWith("import.gltf.index_range", Field("list", "node"), Field("index", 9), Field("count", 3), Field("skin", 0)));
    EXPECT_THAT(refusal(bent(arm(), "", R"("JOINTS_0":2,"WEIGHTS_0":3)", R"("joints":[1,2,0],"inverseBindMatrices":4)")),
                FailsWith("import.gltf.bind_matrices", Field("joints", 3), Field("matrices", 2)));
    std::string other = bent(arm());
    other.replace(other.find(R"("skin":0)"), 8, R"("skin":4)");
    EXPECT_THAT(refusal(other), FailsWith("import.gltf.index_range", Field("list", "skin"), Field("index", 4)));
}

}  // namespace
}  // namespace strata
