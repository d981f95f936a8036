// Animations and morph targets: values between keys computed by hand, and what a sequence of frames keeps and changes.
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/import/gltf_animation.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using gltf::Interpolation;
using gltf::Path;
using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

/// The frame of a scene; throws the sentence of an error.
Frame frame_of(GltfScene& scene, std::uint32_t index) {
    auto frame = scene.frame(index);
    if (!frame) throw std::runtime_error(frame.error().sentence);
    return *std::move(frame);
}

TEST(GltfTrack, LinearValuesLieOnTheLineAndHoldBeyondTheEnds) {
    const gltf::Track track{.width = 3, .times = {1, 3}, .values = {0, 0, 0, 4, 8, -4}};
    EXPECT_THAT(gltf::value_at(track, 0), ElementsAre(0, 0, 0));
    EXPECT_THAT(gltf::value_at(track, 1.5), ElementsAre(1, 2, -1));
    EXPECT_THAT(gltf::value_at(track, 7), ElementsAre(4, 8, -4));
}

TEST(GltfTrack, StepsJumpAtTheKey) {
    const gltf::Track track{.interpolation = Interpolation::step, .width = 1, .times = {0, 1}, .values = {5, 6}};
    EXPECT_THAT(gltf::value_at(track, 0.999), ElementsAre(5));
    EXPECT_THAT(gltf::value_at(track, 1), ElementsAre(6));
}

TEST(GltfTrack, CubicSplinesFollowTheirTangents) {
    // keys at 0 and 2: value 0 leaving with slope 3, value 4 arriving with slope -1. At u = 1/2 the Hermite basis is
    // 1/2, 1/8, 1/2, -1/8, and tangents count times the span of 2.
    const gltf::Track track{.interpolation = Interpolation::cubic, .width = 1, .times = {0, 2}, .values = {9, 0, 3, -1, 4, 9}};
    EXPECT_THAT(gltf::value_at(track, 1), ElementsAre(0.125 * 2 * 3 + 0.5 * 4 - 0.125 * 2 * -1));
    EXPECT_THAT(gltf::value_at(track, 0), ElementsAre(0));
    EXPECT_THAT(gltf::value_at(track, 2), ElementsAre(4));
}

TEST(GltfTrack, RotationsTurnEvenlyAndTheShortWay) {
    const double s = std::sin(std::numbers::pi / 8), c = std::cos(std::numbers::pi / 8);  // half of a turn by 45 degrees
    const double q = std::sqrt(0.5);                                                      // half of a turn by 90
    gltf::Track track{.path = Path::rotation, .width = 4, .times = {0, 2}, .values = {0, 0, 0, 1, 0, 0, q, q}};
    const auto half_way = ElementsAre(0, 0, DoubleNear(s, 1e-12), DoubleNear(c, 1e-12));
    EXPECT_THAT(gltf::value_at(track, 1), half_way);
    track.values = {0, 0, 0, 1, 0, 0, -q, -q};  // the same rotation
    EXPECT_THAT(gltf::value_at(track, 1), half_way);
}

/// A triangle on node 1, below node 0; animation "slide" moves node 0 by 4 m along x in 2 s, "jump" to y = 3.
std::string sliding() {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({0, 2}, "SCALAR", 1);
    gltf.floats({0, 0, 0, 4, 0, 0}, "VEC3", 3);
    gltf.floats({0, 3, 0, 0, 3, 0}, "VEC3", 3);
    return gltf.text(R"("nodes":[{"children":[1]},{"mesh":0},{"mesh":0,"translation":[0,9,0]}],"scenes":[{"nodes":[0,2]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "animations":[{"name":"slide","samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]},
                      {"name":"jump","samplers":[{"input":1,"output":3}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])");
}

TEST(GltfAnimation, FramesKnowWhereThingsWereOneFrameEarlier) {
    GltfScene scene = opened(sliding(), {.fps = 4});
    const Frame first = frame_of(scene, 0), third = frame_of(scene, 3);
    EXPECT_EQ(first.draws[0].to_world, first.draws[0].previous_to_world);
    EXPECT_EQ(third.time, 0.75);
    EXPECT_EQ(third.index, 3u);
    EXPECT_EQ(glm::dvec3(third.draws[0].to_world[3]), glm::dvec3(1.5, 0, 0));
    EXPECT_EQ(glm::dvec3(third.draws[0].previous_to_world[3]), glm::dvec3(1, 0, 0));
    EXPECT_EQ(third.draws[0].mobility, Mobility::moving);
    EXPECT_EQ(third.draws[1].mobility, Mobility::fixed);
    EXPECT_EQ(third.view.origin, first.view.origin) << "the framing camera stays";
    EXPECT_EQ(third.meshes[0].positions, first.meshes[0].positions);
    EXPECT_EQ(third.meshes.size(), 1u);
}

TEST(GltfAnimation, TheFramingCameraSeesAllOfIt) {
    GltfScene scene = opened(sliding(), {.fps = 4});
    for (std::uint32_t index = 0; index < 8; ++index) {
        const Frame frame = frame_of(scene, index);
        const glm::dvec3 corner(frame.draws[0].to_world * glm::dvec4(1, 0, 0, 1));
        const glm::dvec4 clip(frame.view.projection * glm::vec4(frame.view.to_view * (corner - frame.view.origin), 1));
        EXPECT_LT(std::abs(clip.x), clip.w) << index;
        EXPECT_LT(std::abs(clip.y), clip.w) << index;
    }
}

TEST(GltfAnimation, BeginsAgainAfterItsLastKey) {
    GltfScene scene = opened(sliding(), {.fps = 4});
    EXPECT_EQ(frame_of(scene, 8).draws[0].to_world, frame_of(scene, 0).draws[0].to_world);
    EXPECT_EQ(frame_of(scene, 11).draws[0].to_world, frame_of(scene, 3).draws[0].to_world);
    EXPECT_EQ(glm::dvec3(frame_of(scene, 8).draws[0].previous_to_world[3]), glm::dvec3(3.5, 0, 0));
}

TEST(GltfAnimation, IsChosenByNameOrIndexAndTheFirstOtherwise) {
    for (const char* wanted : {"jump", "1"}) {
        GltfScene scene = opened(sliding(), {.animation = wanted});
        EXPECT_EQ(glm::dvec3(frame_of(scene, 0).draws[0].to_world[3]), glm::dvec3(0, 3, 0)) << wanted;
        EXPECT_THAT(scene.warnings(), testing::Not(Contains(HasSubstr("animations"))));
    }
    EXPECT_THAT(opened(sliding()).warnings(), Contains(HasSubstr("2 animations")));
    const auto unknown = import_text(sliding(), {.animation = "fly"});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().fault, Fault::usage);
    EXPECT_THAT(unknown, FailsWith("import.gltf.animation_missing", Field("animation", "fly"), Field("animations", 2),
                                   Field("names", ": 0 'slide' 1 'jump'")));
}

/// A triangle whose second vertex moves by 2 along z with target 0, by 1 along y with target 1.
std::string morphing(const std::string& weights, const std::string& more = "",
                     const std::string& attributes = R"("POSITION":0)") {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({0, 0, 0, 0, 0, 2, 0, 0, 0}, "VEC3", 3);
    gltf.floats({0, 0, 0, 0, 1, 0, 0, 0, 0}, "VEC3", 3);
    gltf.floats({0, 1}, "SCALAR", 1);
    gltf.floats({0, 0, 1, 0.5f}, "SCALAR", 1);
    gltf.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    gltf.floats({0, 0, 0, -1, 0, 0, 0, 0, 0}, "VEC3", 3);
    return gltf.text(fmt::format(R"("nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{{}}},
        "targets":[{{"POSITION":1,"NORMAL":6}},{{"POSITION":2}}]}}]{}}}]{})",
                                 attributes, weights, more));
}

TEST(GltfMorph, MovesVerticesByTheirWeights) {
    const Frame frame = imported(morphing(R"(,"weights":[0.5,1])")).frame;
    EXPECT_THAT(frame.meshes[0].positions, ElementsAre(glm::vec3(0), glm::vec3(1, 1, 1), glm::vec3(0, 1, 0)));
    const glm::vec3 plane = glm::normalize(glm::cross(glm::vec3(1, 1, 1), glm::vec3(0, 1, 0)));
    EXPECT_NEAR(glm::length(frame.meshes[0].normals[0] - plane), 0, 1e-6) << "flat normals are those of the moved triangle";
}

TEST(GltfMorph, MovesNormalsAndMakesThemUnit) {
    const Frame frame = imported(morphing(R"(,"weights":[1,0])", "", R"("POSITION":0,"NORMAL":5)")).frame;
    EXPECT_NEAR(glm::length(frame.meshes[0].normals[1] - glm::normalize(glm::vec3(-1, 0, 1))), 0, 1e-6);
    EXPECT_EQ(frame.meshes[0].normals[0], glm::vec3(0, 0, 1));
}

TEST(GltfMorph, WeightsOfTheNodeComeBeforeThoseOfTheMesh) {
    std::string text = morphing(R"(,"weights":[1,1])");
    text.replace(text.find(R"({"mesh":0})"), 10, R"({"mesh":0,"weights":[0.25,0]})");
    EXPECT_EQ(imported(text).frame.meshes[0].positions[1], glm::vec3(1, 0, 0.5f));
}

TEST(GltfMorph, AnimatedWeightsMakeAMeshPerFrameAndEqualOnesTheSame) {
    const std::string animation = R"(,"animations":[{"samplers":[{"input":3,"output":4}],
        "channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]}])";
    GltfScene scene = opened(morphing("", animation), {.fps = 4});
    const Frame start = frame_of(scene, 0), half_way = frame_of(scene, 2), again = frame_of(scene, 6);
    EXPECT_EQ(start.meshes[0].positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(half_way.meshes[0].positions[1], glm::vec3(1, 0.25f, 1)) << "weights .5 and .25";
    EXPECT_EQ(half_way.draws[0].mobility, Mobility::moving);
    EXPECT_EQ(half_way.meshes[0].positions, again.meshes[0].positions);
    EXPECT_EQ(half_way.meshes[0].normals, again.meshes[0].normals);
}

TEST(GltfAnimation, BrokenKeysAreRefused) {
    const auto broken = [](const std::string& old, const std::string& fresh) {
        std::string text = sliding();
        return refusal(text.replace(text.find(old), old.size(), fresh));
    };
    EXPECT_THAT(broken(R"("input":1,"output":2)", R"("input":1,"output":0)"),
                FailsWith("import.gltf.key_count", Field("animation", "slide"), Field("keys", 2), Field("numbers", 9)));
    EXPECT_THAT(broken(R"("input":1,"output":2)", R"("input":9,"output":2)"),
                FailsWith("import.gltf.index_range", Field("list", "accessor"), Field("index", 9)));
    EXPECT_THAT(broken(R"("output":2)", R"("output":2,"interpolation":"BOUNCE")"),
                FailsWith("import.gltf.interpolation", Field("interpolation", "BOUNCE")));
    EXPECT_THAT(broken(R"("node":0)", R"("node":7)"),
                FailsWith("import.gltf.index_range", Field("list", "node"), Field("index", 7)));
    EXPECT_THAT(broken(R"("sampler":0)", R"("sampler":3)"),
                FailsWith("import.gltf.index_range", Field("list", "sampler"), Field("index", 3)));
    EXPECT_THAT(broken(R"("count":2)", R"("count":2000000000)"),
                FailsWith("import.gltf.accessor_range", Field("elements", 2000000000)));
}

TEST(GltfAnimation, KeyframeTimesAreFloats) {
    std::string text = sliding();
    const std::string times = R"("componentType":5126,"type":"SCALAR")";
    EXPECT_THAT(refusal(text.replace(text.find(times), times.size(), R"("componentType":5125,"type":"SCALAR")")),
                FailsWith("import.gltf.not_floats", Field("animation", "slide"), Field("numbers", "keyframe times"),
                          Field("accessor", 1), Field("component_type", 5125)));
    text = sliding();
    const std::size_t values = text.find(R"("componentType":5126,"type":"VEC3","count":2)");
    EXPECT_THAT(
        refusal(text.replace(values, 20, R"("componentType":5122)")),
        FailsWith("import.gltf.not_floats", Field("numbers", "values"), Field("accessor", 2), Field("component_type", 5122)));
}

TEST(GltfAnimation, ThereAreMoreThanZeroFramesPerSecond) {
    for (const double fps : {0.0, -1.0, std::nan(""), 1e9}) EXPECT_FALSE(import_text(sliding(), {.fps = fps})) << fps;
}

}  // namespace
}  // namespace strata
