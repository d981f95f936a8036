// glTF scenes become frames: values by hand on small files written here, and real scenes when they are there.
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/codec/texture_mips.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/texture.h"
#include "capture_format/import/gltf.h"
#include "capture_format/import/seen.h"
#include "capture_format/reader.h"
#include "capture_format/view.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

TEST(ImportGltf, TriangleWithoutNormalsGetsTheNormalOfItsPlane) {
    const Frame frame = imported(Gltf().with_triangle().text(showing(triangle))).frame;
    ASSERT_EQ(frame.meshes.size(), 1u);
    EXPECT_EQ(frame.meshes[0].positions[1], glm::vec3(1, 0, 0));
    EXPECT_THAT(frame.meshes[0].indices, testing::ElementsAre(0, 1, 2));
    EXPECT_THAT(frame.meshes[0].normals, testing::Each(glm::vec3(0, 0, 1)));
    ASSERT_EQ(frame.draws.size(), 1u);
    EXPECT_EQ(frame.materials[frame.draws[0].material].name, "default");
}

TEST(ImportGltf, StripsAndFansKeepTheirWinding) {
    Gltf gltf;
    gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 3);
    gltf.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    const Frame strip = imported(gltf.text(showing(R"({"mode":5,"attributes":{"POSITION":0,"NORMAL":1}})"))).frame;
    EXPECT_THAT(strip.meshes[0].indices, testing::ElementsAre(0, 1, 2, 1, 3, 2));
    const Frame fan = imported(gltf.text(showing(R"({"mode":6,"attributes":{"POSITION":0,"NORMAL":1}})"))).frame;
    EXPECT_THAT(fan.meshes[0].indices, testing::ElementsAre(1, 2, 0, 2, 3, 0));
}

TEST(ImportGltf, IndicesAndColorsOfEveryWidthAreRead) {
    Gltf gltf = Gltf().with_triangle();
    gltf.accessor(bytes_of<std::uint8_t>({2, 0, 1}), 5121, "SCALAR", 3);
    gltf.accessor(bytes_of<std::uint16_t>({2, 0, 1}), 5123, "SCALAR", 3);
    gltf.accessor(bytes_of<std::uint32_t>({2, 0, 1}), 5125, "SCALAR", 3);
    gltf.accessor(bytes_of<std::uint8_t>({255, 0, 51, 255, 255, 255, 0, 0, 0}), 5121, "VEC3", 3, R"(,"normalized":true)");
    gltf.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);
    for (const int indices : {1, 2, 3}) {
        const Frame frame = imported(gltf.text(showing(fmt::format(
                                         R"({{"indices":{},"attributes":{{"POSITION":0,"COLOR_0":4,"NORMAL":5}}}})", indices))))
                                .frame;
        EXPECT_THAT(frame.meshes[0].indices, testing::ElementsAre(2, 0, 1));
        EXPECT_EQ(frame.meshes[0].colors[0], glm::vec4(1, 0, 51 / 255.0f, 1));
    }
}

TEST(ImportGltf, SignedNormalizedIntegersReachMinusOne) {
    Gltf gltf = Gltf().with_triangle();
    gltf.accessor(bytes_of<std::int8_t>({0, 0, -128, 0, 0, -127, 0, 0, -127}), 5120, "VEC3", 3, R"(,"normalized":true)");
    const Frame frame = imported(gltf.text(showing(R"({"attributes":{"POSITION":0,"NORMAL":1}})"))).frame;
    EXPECT_THAT(frame.meshes[0].normals, testing::Each(glm::vec3(0, 0, -1)));
}

TEST(ImportGltf, SparseAccessorsReplaceElements) {
    Gltf gltf = Gltf().with_triangle();
    gltf.accessor(bytes_of<std::uint16_t>({1}), 5123, "SCALAR", 1);
    gltf.floats({5, 0, 0}, "VEC3", 3);
    gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3,
                R"(,"sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}})");
    const Frame frame = imported(gltf.text(showing(R"({"attributes":{"POSITION":3}})"))).frame;
    EXPECT_EQ(frame.meshes[0].positions[1], glm::vec3(5, 0, 0));
    EXPECT_EQ(frame.meshes[0].positions[2], glm::vec3(0, 1, 0));
}

TEST(ImportGltf, NodesNestAndShareTheirMesh) {
    const Frame frame = imported(Gltf().with_triangle().text(
                                     R"("nodes":[{"translation":[1,2,3],"children":[1,2]},
        {"mesh":0,"rotation":[0,0.70710678118654752,0,0.70710678118654752],"scale":[2,2,2]},
        {"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1]}],"scenes":[{"nodes":[0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"))
                            .frame;
    ASSERT_EQ(frame.draws.size(), 2u);
    EXPECT_EQ(frame.meshes.size(), 1u);
    const glm::dvec4 turned = frame.draws[0].to_world * glm::dvec4(1, 0, 0, 1);  // a quarter turn around y takes x to -z
    EXPECT_NEAR(glm::length(turned - glm::dvec4(1, 2, 1, 1)), 0, 1e-12);
    EXPECT_EQ(glm::dvec3(frame.draws[1].to_world[3]), glm::dvec3(11, 2, 3));
}

TEST(ImportGltf, CameraLooksAlongMinusZSoTheViewMirrors) {
    const Frame frame = imported(Gltf().with_triangle().text(
                                     R"("nodes":[{"camera":0,"translation":[0,1,5]},{"mesh":0}],
        "cameras":[{"type":"perspective","perspective":{"yfov":1.5707963267948966,"znear":0.25}}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])"),
                                 {.width = 200, .height = 100, .samples = 4})
                            .frame;
    const View& view = frame.view;
    EXPECT_EQ(view.origin, glm::dvec3(0, 1, 5));
    EXPECT_EQ(view.to_view * glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1));
    EXPECT_EQ(view.to_view * glm::dvec3(1, 0, 0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(view.to_view * glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0));
    EXPECT_NEAR(view.projection[0][0], 0.5, 1e-6);  // tan 45 degrees, twice as wide as high
    EXPECT_EQ(view.near, 0.25f);
    EXPECT_EQ(view.width, 200u);
    EXPECT_EQ(view.samples, 4u);
}

TEST(ImportGltf, WithoutCameraTheWholeSceneIsInView) {
    const Frame frame = imported(Gltf().with_triangle().text(showing(triangle))).frame;
    for (const glm::vec3& position : frame.meshes[0].positions) {
        const glm::dvec3 p = frame.view.to_view * (glm::dvec3(position) - frame.view.origin);
        const glm::vec4 clip = frame.view.projection * glm::vec4(p, 1);
        EXPECT_GT(p.z, frame.view.near);
        EXPECT_LT(std::abs(clip.x / clip.w), 1);
        EXPECT_LT(std::abs(clip.y / clip.w), 1);
    }
}

TEST(ImportGltf, TheFramingCameraStandsAsNearAsItMay) {
    const Frame frame = imported(Gltf().with_triangle().text(showing(triangle)), {.azimuth = 70, .elevation = 40}).frame;
    glm::dvec2 low(2), high(-2);
    for (const glm::dvec3 corner : {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 0)}) {
        const glm::dvec4 clip(frame.view.projection * glm::vec4(frame.view.to_view * (corner - frame.view.origin), 1));
        low = glm::min(low, glm::dvec2(clip) / clip.w);
        high = glm::max(high, glm::dvec2(clip) / clip.w);
    }
    EXPECT_NEAR(low.y, -1 / 1.05, 1e-3) << "the box touches the margin above";
    EXPECT_NEAR(high.y, 1 / 1.05, 1e-3) << "and below";
    EXPECT_LT(high.x, 1 / 1.05);
    EXPECT_NEAR(glm::normalize(frame.view.origin - glm::dvec3(0.5, 0.5, 0)).y, std::sin(glm::radians(40.0)), 1e-6);
}

TEST(ImportGltf, AnEyeATargetAndAFieldOfViewReplaceTheCamera) {
    const std::string text = Gltf().with_triangle().text(
        R"("nodes":[{"camera":0},{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
           "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}])");
    const View view =
        imported(text, {.width = 200, .height = 100, .eye = glm::dvec3(3, 0, 0), .target = glm::dvec3(3, 0, 8), .fov = 90})
            .frame.view;
    EXPECT_EQ(view.origin, glm::dvec3(3, 0, 0));
    EXPECT_EQ(view.to_view * glm::dvec3(0, 0, 1), glm::dvec3(0, 0, 1)) << "it looks along +z";
    EXPECT_EQ(view.to_view * glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0));
    EXPECT_NEAR(view.projection[0][0], 0.5, 1e-6);
    const View middle = imported(text, {.eye = glm::dvec3(0.5, 0.5, 4)}).frame.view;
    EXPECT_EQ(middle.to_view * glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1)) << "the middle of the scene is (.5, .5, 0)";
    EXPECT_TRUE(import_text(text, {.eye = glm::dvec3(0, 9, 0), .target = glm::dvec3(0)})) << "straight down";
    EXPECT_THAT(import_text(text, {.target = glm::dvec3(1)}), FailsWith("import.gltf.target_without_eye"));
    EXPECT_THAT(import_text(text, {.eye = glm::dvec3(1), .target = glm::dvec3(1)}), FailsWith("import.gltf.eye_is_target"));
    EXPECT_THAT(import_text(text, {.camera = 0, .eye = glm::dvec3(1)}),
                FailsWith("import.gltf.two_cameras", Field("option", "--eye"), Field("other", "--camera")));
    EXPECT_THAT(import_text(text, {.fov = 180}), FailsWith("import.gltf.fov_range", Field("fov", 180)));
}

TEST(ImportGltf, InsideViewsStandWithinTheSceneAndSeeItAllAround) {
    Gltf gltf;  // a room of 8 x 3 x 6 meters
    gltf.floats({0, 0, 0, 8, 0, 0, 0, 3, 0, 8, 3, 0, 0, 0, 6, 8, 0, 6, 0, 3, 6, 8, 3, 6}, "VEC3", 3);
    gltf.accessor(bytes_of<std::uint8_t>({0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7, 0, 2, 4, 2, 6, 4,
                                          1, 5, 3, 3, 5, 7, 0, 4, 1, 1, 4, 5, 2, 3, 6, 3, 7, 6}),
                  5121, "SCALAR", 36);
    const std::string text = gltf.text(showing(R"({"indices":1,"attributes":{"POSITION":0}})"));
    const Frame inside = imported(text, {.inside = true}).frame;
    const glm::dvec3 eye = inside.view.origin, middle = glm::dvec3(4, 1.5, 3) - eye;
    EXPECT_TRUE(eye.x > 0 && eye.x < 8 && eye.z > 0 && eye.z < 6) << eye.x << ", " << eye.z;
    EXPECT_GT((inside.view.to_view * middle).z, 1) << "it looks across the room, not at the nearest wall";
    EXPECT_EQ(seen_share(inside), 1) << "walls all around";
    const Frame outside = imported(text).frame;
    EXPECT_GT(seen_share(outside), 0.2);
    EXPECT_LT(seen_share(outside), 0.9);
    EXPECT_EQ(seen_share(imported(text, {.eye = glm::dvec3(4, 1, 9), .target = glm::dvec3(4, 1, 20)}).frame), 0)
        << "it looks away";
}

/// A triangle and a lamp.
std::string lit_by(double candela) {
    return Gltf().with_triangle().text(
        R"("nodes":[{"mesh":0},{"translation":[0.5,0.5,2],"extensions":{"KHR_lights_punctual":{"light":0}}}],
           "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)" +
        fmt::format(R"("extensions":{{"KHR_lights_punctual":{{"lights":[{{"type":"point","name":"lamp","intensity":{}}}]}}}})",
                    candela));
}

TEST(ImportGltf, StrongLightsLowerTheExposure) {
    const auto scene = [](double candela) { return imported(lit_by(candela)); };
    EXPECT_EQ(scene(8).frame.view.exposure, 1) << "8 / 2^2 / pi = 0.64";
    const ImportedScene strong = scene(400);
    EXPECT_NEAR(strong.frame.view.exposure, 1.7 / (400 / 4 / 3.14159265), 1e-6);
    EXPECT_THAT(strong.warnings, Contains(HasSubstr("0.0534")));
    EXPECT_GT(scene(3e38).frame.view.exposure, 0) << "a float holds this light";
    EXPECT_NEAR(scene(1e-6).frame.view.exposure * 1e-6 / 4 / 3.14159265, 1.7, 1e-5) << "a dark one raises it";
    EXPECT_EQ(imported(lit_by(400), {.exposure = .25f}).frame.view.exposure, .25f);
    EXPECT_THAT(import_text(lit_by(8), {.exposure = 0}), FailsWith("import.gltf.exposure_range", Field("exposure", 0)));
}

TEST(ImportGltf, ALightWithoutARangeReachesBeyondTheSceneInEveryUnitOfLight) {
    // It is 2 m away and lights nothing else: at 32 m, 16 times as far, 1/256 of its light there is left.
    for (const double candela : {1e-6, 1e-3, 1., 8., 1e5, 1e12})
        EXPECT_NEAR(imported(lit_by(candela)).frame.lights.at(0).range, 32, 1e-3) << candela;
}

TEST(ImportGltf, ALightThatAFloatCannotHoldIsRefusedByItsName) {
    EXPECT_THAT(refusal(lit_by(1e300)), FailsWith("frame.not_finite", Field("property", "intensity"), Field("subject", "light"),
                                                  Field("number", 0), Field("name", "lamp")));
}

TEST(ImportGltf, WithoutLightsThereIsASunAndASky) {
    const ImportedScene scene = imported(Gltf().with_triangle().text(showing(triangle)));
    EXPECT_GT(scene.frame.sun.irradiance.x, 0);
    EXPECT_GT(scene.frame.hemisphere.sky.x, 0);
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("no lights")));
}

TEST(ImportGltf, PunctualLightsKeepColorIntensityAndCone) {
    const Frame frame = imported(Gltf().with_triangle().text(showing(triangle) +
                                                             R"(,"extensionsRequired":["KHR_lights_punctual"],
        "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":[1,0.5,0],"intensity":8},
        {"type":"spot","intensity":2,"range":3,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},
        {"type":"directional","intensity":3}]}},
        "nodes":[{"mesh":0},{"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
        {"extensions":{"KHR_lights_punctual":{"light":1}}},{"extensions":{"KHR_lights_punctual":{"light":2}}}])"))
                            .frame;
    ASSERT_EQ(frame.lights.size(), 2u);
    EXPECT_EQ(frame.lights[0].intensity, glm::vec3(8, 4, 0));
    EXPECT_EQ(frame.lights[0].position, glm::dvec3(1, 2, 3));
    // 1/256 of a white surface's light: of the sun, of the lamp's at sqrt(11.5) m and of the spot's at sqrt(.5) m.
    EXPECT_NEAR(frame.lights[0].range, std::sqrt(8 * 256 / (3 + 8 / 11.5 + 2 / .5)), 1e-3);
    EXPECT_EQ(frame.lights[1].type, LightType::round_spot);
    EXPECT_EQ(frame.lights[1].direction, glm::vec3(0, 0, -1));
    EXPECT_EQ(frame.lights[1].range, 3);
    for (const Light& light : frame.lights) EXPECT_EQ(light.window, RangeWindow::quartic) << "as KHR_lights_punctual recommends";
    EXPECT_FLOAT_EQ(frame.lights[1].outer_angle, 0.2f);
    EXPECT_EQ(frame.sun.irradiance, glm::vec3(3));
    EXPECT_EQ(frame.hemisphere.sky, glm::vec3(0));
}

TEST(ImportGltf, EveryLightThatHasShadowMapsCastsShadows) {
    const ImportedScene scene = imported(Gltf().with_triangle().text(showing(triangle) + R"(,
        "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"},{"type":"spot"},{"type":"directional"},
        {"type":"directional","name":"moon"}]}},
        "nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}},{"extensions":{"KHR_lights_punctual":{"light":1}}},
        {"extensions":{"KHR_lights_punctual":{"light":2}}},{"extensions":{"KHR_lights_punctual":{"light":3}}}])"));
    const std::vector<Light>& lights = scene.frame.lights;
    ASSERT_EQ(lights.size(), 3u);
    EXPECT_TRUE(lights[0].shadow.casts) << "a point light";
    EXPECT_TRUE(lights[1].shadow.casts) << "a spot";
    EXPECT_TRUE(scene.frame.sun.shadow.casts);
    EXPECT_FALSE(lights[2].shadow.casts);
    EXPECT_THAT(scene.warnings, Contains("light 3 'moon' is another directional light than the sun; it casts no shadow"));
}

TEST(ImportGltf, LightsBeyondTheSpecificationAreWarnedOf) {
    const std::vector<std::string> warnings = imported(Gltf().with_triangle().text(showing(triangle) + R"(,
        "extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","color":[2,-1,0],"intensity":-5,"range":-3,
        "spot":{"outerConeAngle":9}},{"type":"spot","spot":{"outerConeAngle":1.5707964}}]}},
        "nodes":[{"mesh":0},{"extensions":{"KHR_lights_punctual":{"light":0}}},{"extensions":{"KHR_lights_punctual":{"light":1}}}])"))
                                                  .warnings;
    for (const char* what : {"the color (2, -1, 0); glTF allows 0 to 1", "the intensity -5, which is below 0",
                             "the range -3, which is not above 0; it is ignored",
                             "an outer cone of 9 radians, more than a right angle; 1.54 is used"})
        EXPECT_THAT(warnings, Contains(fmt::format("light 0 '' has {}", what)));
    EXPECT_THAT(warnings, Not(Contains(HasSubstr("light 1"))));
}

TEST(ImportGltf, MaterialsKeepTheirFactorsAndModes) {
    const ImportedScene scene = imported(Gltf().with_triangle().text(showing(triangle, R"(,"materials":[
        {"name":"a","alphaMode":"BLEND","doubleSided":true,"emissiveFactor":[1,0.5,0],
         "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.25,"roughnessFactor":0.75},
         "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":6}}},
        {"name":"b","alphaMode":"MASK","alphaCutoff":0.3,"extensions":{"KHR_materials_unlit":{}}},
        {"name":"c","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.4]}}])")));
    const std::vector<Material>& materials = scene.frame.materials;
    EXPECT_EQ(materials[0].alpha_mode, AlphaMode::blend);
    EXPECT_EQ(materials[0].base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
    EXPECT_EQ(materials[0].metallic, 0.25f);
    EXPECT_EQ(materials[0].roughness, 0.75f);
    EXPECT_EQ(materials[0].emissive, glm::vec3(6, 3, 0));
    EXPECT_TRUE(materials[0].double_sided);
    EXPECT_EQ(materials[0].lighting_model, LightingModel::ggx);
    EXPECT_EQ(materials[1].alpha_mode, AlphaMode::mask);
    EXPECT_EQ(materials[1].mask_cutoff, 0.3f);
    EXPECT_EQ(materials[1].lighting_model, LightingModel::unlit);
    EXPECT_EQ(materials[2].base_color.w, 1) << "the alpha of an opaque material does not count";
}

TEST(ImportGltf, TransmissionBecomesChromaticTransmittance) {
    const Material material = imported(Gltf().with_triangle().text(showing(triangle, R"(,"materials":[
        {"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1],"metallicFactor":0},
         "extensions":{"KHR_materials_transmission":{"transmissionFactor":0.8}}}])")))
                                  .frame.materials[0];
    EXPECT_EQ(material.alpha_mode, AlphaMode::blend);
    EXPECT_NEAR(material.transmission.x, 0.8 * 0.96, 1e-6) << "a surface of index 1.5 turns 4 % back";
    EXPECT_NEAR(material.transmission.z, 0.2 * 0.96, 1e-6);
    EXPECT_NEAR(material.base_color.x, 0.2, 1e-6);
    EXPECT_NEAR(material.base_color.z, 0.05, 1e-6);
    EXPECT_EQ(material.base_color.w, 1);
}

TEST(ImportGltf, PngBecomesATextureWithLinearMips) {
    const Frame frame = imported(with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png), "")).frame;
    ASSERT_EQ(frame.textures.size(), 1u);
    const Texture& texture = frame.textures[0];
    EXPECT_EQ(texture.format, TextureFormat::rgba8_srgb);
    EXPECT_EQ(texture.address, AddressMode::clamp);
    EXPECT_EQ(texture.mips, 2u);
    ASSERT_EQ(texture.texels.size(), 20u);
    EXPECT_EQ(texture.texels[7], std::byte{128}) << "green is half covered";
    // Two of four texels have red: linear 0.5 is sRGB 188. Alpha is linear: (255 + 128 + 0 + 255) / 4 = 159.5.
    EXPECT_EQ(texture.texels[16], std::byte{188});
    EXPECT_NEAR(static_cast<int>(texture.texels[19]), 159.5, 0.6);
}

TEST(ImportGltf, SamplersWrapEachAxisTheirOwnWay) {
    constexpr int modes[] = {10497, 33071, 33648};
    std::vector<AddressMode> found;
    for (const int s : modes)
        for (const int t : modes) {
            std::string text = with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png), "");
            const std::string sampler = R"("wrapS":33071,"wrapT":33071)";
            text.replace(text.find(sampler), sampler.size(), fmt::format(R"("wrapS":{},"wrapT":{})", s, t));
            const ImportedScene scene = imported(text);
            found.push_back(scene.frame.textures[0].address);
            EXPECT_THAT(scene.warnings, testing::Not(Contains(HasSubstr("wraps"))));
        }
    EXPECT_THAT(found, testing::ElementsAre(AddressMode::repeat, AddressMode::repeat_clamp, AddressMode::repeat_mirror,
                                            AddressMode::clamp_repeat, AddressMode::clamp, AddressMode::clamp_mirror,
                                            AddressMode::mirror_repeat, AddressMode::mirror_clamp, AddressMode::mirror));
}

TEST(ImportGltf, SamplersChooseTheFilters) {
    const auto filters = [](const std::string& sampler) {
        std::string text = with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png), "");
        const std::string wraps = R"({"wrapS":33071,"wrapT":33071})";
        const Texture texture = imported(text.replace(text.find(wraps), wraps.size(), sampler)).frame.textures[0];
        return std::tuple(texture.magnify, texture.minify, texture.between_mips);
    };
    using enum MipFilter;
    constexpr TexelFilter smooth = TexelFilter::linear, sharp = TexelFilter::nearest;
    EXPECT_EQ(filters("{}"), std::tuple(smooth, smooth, linear)) << "glTF leaves it to the reader";
    EXPECT_EQ(filters(R"({"magFilter":9728})"), std::tuple(sharp, smooth, linear));
    EXPECT_EQ(filters(R"({"magFilter":9729,"minFilter":9728})"), std::tuple(smooth, sharp, none));
    EXPECT_EQ(filters(R"({"minFilter":9729})"), std::tuple(smooth, smooth, none));
    EXPECT_EQ(filters(R"({"minFilter":9984})"), std::tuple(smooth, sharp, nearest));
    EXPECT_EQ(filters(R"({"minFilter":9985})"), std::tuple(smooth, smooth, nearest));
    EXPECT_EQ(filters(R"({"minFilter":9986})"), std::tuple(smooth, sharp, linear));
    EXPECT_EQ(filters(R"({"minFilter":9987})"), std::tuple(smooth, smooth, linear));
}

TEST(ImportGltf, EqualImagesBecomeOneTexture) {
    const auto textures = [](const std::string& samplers) {
        Gltf gltf = Gltf().with_triangle();
        const std::string image = fmt::format(R"({{"uri":"data:image/png;base64,{}"}})", tiny_png);
        return imported(gltf.text(showing(
                            triangle, fmt::format(R"(,"images":[{0},{0}],"samplers":[{{}},{{"wrapS":33071}},{{"minFilter":9728}}],
            "textures":[{1}],"materials":[{{"emissiveTexture":{{"index":0}}}},{{"emissiveTexture":{{"index":1}}}}])",
                                                  image, samplers))))
            .frame.textures.size();
    };
    EXPECT_EQ(textures(R"({"source":0,"sampler":0},{"source":1})"), 1u);
    EXPECT_EQ(textures(R"({"source":0,"sampler":0},{"source":1,"sampler":1})"), 2u) << "they wrap differently";
    EXPECT_EQ(textures(R"({"source":0,"sampler":0},{"source":1,"sampler":2})"), 2u) << "they are filtered differently";
}

TEST(ImportGltf, JpegIsRead) {
    const Frame frame = imported(with_image(fmt::format(R"("uri":"data:image/jpeg;base64,{}")", tiny_jpeg), "")).frame;
    ASSERT_EQ(frame.textures.size(), 1u);
    EXPECT_EQ(frame.textures[0].mips, 4u);
    EXPECT_NEAR(static_cast<int>(frame.textures[0].texels[0]), 188, 2);
    EXPECT_NEAR(mean_color(frame.textures[0]).x, 0.5, 0.01);
}

TEST(ImportGltf, TextureTransformTurnsCounterClockwiseOnScreen) {
    const Frame frame = imported(with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png),
                                            R"(,"extensions":{"KHR_texture_transform":
        {"offset":[0.5,0.25],"rotation":1.5707963267948966,"scale":[2,3]}})"))
                            .frame;
    const std::array<float, 6>& m = frame.materials[0].base_color_texture.transform;
    const std::array<float, 6> expected = {0, 3, 0.5f, -2, 0, 0.25f};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(m[i], expected[i], 1e-6) << i;
}

TEST(ImportGltf, MissingImageIsAWarning) {
    const ImportedScene scene = imported(with_image(R"("uri":"not_there.png")", ""));
    EXPECT_TRUE(scene.frame.textures.empty());
    EXPECT_EQ(scene.frame.materials[0].base_color_texture.texture, no_index);
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("not_there.png")));
}

TEST(ImportGltf, NormalMapsGetTangentsAlongU) {
    Gltf gltf = Gltf().with_triangle();
    gltf.floats({0, 1, 1, 1, 0, 0}, "VEC2", 2);  // u grows with x, v falls with y
    gltf.floats({0, 1, 0, 0, 1, 1}, "VEC2", 2);  // u grows with y: mirrored
    const auto tangent = [&](int uv) {
        return imported(gltf.text(showing(fmt::format(R"({{"material":0,"attributes":{{"POSITION":0,"TEXCOORD_0":{}}}}})", uv)) +
                                  fmt::format(R"(,"images":[{{"uri":"data:image/png;base64,{}"}}],"textures":[{{"source":0}}],
            "materials":[{{"normalTexture":{{"index":0}}}}])",
                                              tiny_png)))
            .frame.meshes[0]
            .tangents[0];
    };
    EXPECT_EQ(tangent(1), glm::vec4(1, 0, 0, 1));  // cross(z, x) = y: towards smaller v
    EXPECT_EQ(glm::vec3(tangent(2)).y, 1);
}

TEST(ImportGltf, OddMipsWeighTexelsByArea) {
    Texture texture;
    texture.width = 3;
    texture.height = 1;
    for (const int gray : {30, 60, 120}) {
        for (int c = 0; c < 4; ++c) texture.texels.push_back(static_cast<std::byte>(gray));
    }
    const Texture done = with_mips(texture);
    EXPECT_EQ(done.mips, 2u);
    EXPECT_EQ(done.texels[12], std::byte{70});
}

class RealScene : public testing::TestWithParam<const char*> {};

TEST_P(RealScene, IsImportedAndValid) {
    const std::filesystem::path path = std::filesystem::path(STRATA_SOURCE_DIR) / "../shared/assets" / GetParam();
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    const auto scene = import_gltf(path, {});
    ASSERT_TRUE(scene) << scene.error().sentence;
    EXPECT_TRUE(check_frame(scene->frame));
    EXPECT_FALSE(scene->frame.draws.empty());
    for (const Mesh& mesh : scene->frame.meshes) ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << mesh.name;
}

INSTANTIATE_TEST_SUITE_P(
    Assets, RealScene,
    testing::Values("AlphaBlendModeTest/AlphaBlendModeTest.glb", "EmissiveStrengthTest/EmissiveStrengthTest.glb",
                    "FlightHelmet/FlightHelmet.gltf", "GlassTable/glass-table.glb", "GlassVaseFlowers/GlassVaseFlowers.glb",
                    "JungleScene/scene.gltf", "LightsPunctualLamp/LightsPunctualLamp.gltf", "Lights_playcanvas/Lights.glb",
                    "TransmissionRoughnessTest/TransmissionRoughnessTest.glb", "TransmissionTest/TransmissionTest.glb",
                    "hotel-room-lotus-carpet/hotel-room-lotus-carpet.glb"));

}  // namespace
}  // namespace strata
