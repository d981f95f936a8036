// Materials with extensions: what goes through glass, computed by hand, and what is ignored by name.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/export/png.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/import/gltf_materials.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A scene of materials; the arguments are JSON objects.
ImportedScene with_materials(const std::string& materials) {
    return imported(Gltf().with_triangle().text(showing(triangle, R"(,"materials":[)" + materials + "]")));
}

/// White glass with these extensions beside its transmission, and these members.
Material glass(const std::string& extensions, const std::string& members = "") {
    return with_materials(fmt::format(R"({{"pbrMetallicRoughness":{{"metallicFactor":0}},"extensions":
        {{"KHR_materials_transmission":{{"transmissionFactor":1}}{}}}{}}})",
                                      extensions, members))
        .frame.materials[0];
}

TEST(GltfGlass, TheSurfaceTurnsBackWhatItsIndexOfRefractionSays) {
    EXPECT_NEAR(gltf::head_on_reflectance(1.5), 0.04, 1e-12);
    EXPECT_FLOAT_EQ(glass(R"(,"KHR_materials_ior":{"ior":1})").transmission.x, 1);
    EXPECT_FLOAT_EQ(glass(R"(,"KHR_materials_ior":{"ior":3})").transmission.x, 0.75f) << "(2/4)^2 is turned back";
}

TEST(GltfGlass, AVolumeAttenuatesByItsThickness) {
    const std::string volume = R"(,"KHR_materials_ior":{"ior":1},"KHR_materials_volume":
        {"thicknessFactor":0.5,"attenuationDistance":0.25,"attenuationColor":[1,0.5,0.1]})";
    const Material single = glass(volume);
    EXPECT_FLOAT_EQ(single.transmission.x, 1);
    EXPECT_FLOAT_EQ(single.transmission.y, 0.25f) << "twice the distance: 0.5^2";
    EXPECT_FLOAT_EQ(single.transmission.z, 0.01f);
    const Material both = glass(volume, R"(,"doubleSided":true)");
    EXPECT_FLOAT_EQ(both.transmission.y, 0.5f) << "each of the two faces takes half of the way";
}

TEST(GltfGlass, WithoutDistanceOrThicknessAVolumeAttenuatesNothing) {
    EXPECT_FLOAT_EQ(glass(R"(,"KHR_materials_volume":{"thicknessFactor":5,"attenuationColor":[0,0,0]})").transmission.x, 0.96f);
    EXPECT_FLOAT_EQ(glass(R"(,"KHR_materials_volume":{"attenuationDistance":0.1,"attenuationColor":[0,0,0]})").transmission.x,
                    0.96f);
}

TEST(GltfGlass, AThicknessTextureIsReplacedByTheMeanOfItsGreen) {
    const ImportedScene scene = imported(Gltf().with_triangle().text(
        showing(triangle, fmt::format(R"(,"images":[{{"uri":"data:image/jpeg;base64,{}"}}],"textures":[{{"source":0}}],
            "materials":[{{"pbrMetallicRoughness":{{"metallicFactor":0}},"extensions":{{
            "KHR_materials_transmission":{{"transmissionFactor":1}},"KHR_materials_ior":{{"ior":1}},
            "KHR_materials_volume":{{"thicknessFactor":2,"thicknessTexture":{{"index":0}},"attenuationDistance":1,
            "attenuationColor":[0.5,0.5,0.5]}}}}}}])",
                                      tiny_jpeg))));
    EXPECT_NEAR(scene.frame.materials[0].transmission.x, std::pow(0.5, 2 * 188 / 255.0), 0.01) << "the picture is gray 188";
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("thickness texture is replaced by its mean")));
}

/// A quad whose uvs cover columns from `left` to `right` of an atlas of four columns, as glass with these textures.
Material glass_of_atlas(double left, double right, const std::string& textures) {
    const auto l = static_cast<float>(left / 4), r = static_cast<float>(right / 4);
    Gltf gltf;
    gltf.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 3);
    gltf.floats({l, 1, r, 1, l, 0, r, 0}, "VEC2", 2);
    constexpr unsigned char atlas[] = {0, 0, 0, 255, 0, 255, 0, 255, 255, 255, 255, 0};
    const auto png = encode_png(4, 1, 3, std::as_bytes(std::span(atlas)));
    const std::string texels(reinterpret_cast<const char*>(png.data()), png.size());
    return imported(gltf.text(showing(R"({"mode":5,"material":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}})",
                                      fmt::format(R"(,"images":[{{"uri":"data:image/png;base64,{}"}}],"textures":[{{"source":0}}],
        "materials":[{}])",
                                                  base64(texels), textures))))
        .frame.materials[0];
}

TEST(GltfGlass, ItsMeansAreThoseOfTheTexelsThatItsTrianglesCover) {
    // Blue is metal: columns 1 and 2 are, which belong to other things of the atlas.
    const std::string metal = R"({"pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}},"extensions":{
        "KHR_materials_ior":{"ior":1},"KHR_materials_transmission":{"transmissionFactor":1}}})";
    EXPECT_FLOAT_EQ(glass_of_atlas(0, 1, metal).transmission.x, 1);
    EXPECT_FLOAT_EQ(glass_of_atlas(3, 4, metal).transmission.x, 1);
    EXPECT_NEAR(glass_of_atlas(0, 2, metal).transmission.x, 0.5, 0.01);
    EXPECT_EQ(glass_of_atlas(1, 3, metal).alpha_mode, AlphaMode::opaque) << "nothing goes through metal";
    // Red transmits: half of columns 2 and 3.
    const std::string red = R"({"pbrMetallicRoughness":{"metallicFactor":0},"extensions":{"KHR_materials_ior":{"ior":1},
        "KHR_materials_transmission":{"transmissionFactor":1,"transmissionTexture":{"index":0}}}})";
    const Material half = glass_of_atlas(2, 4, red);
    EXPECT_NEAR(half.transmission.x, 0.5, 0.01);
    EXPECT_NEAR(half.base_color.x, 0.5, 0.01);
}

TEST(GltfGlass, AThicknessTextureLetsThroughTheMeanOfWhatEachThicknessLets) {
    // Green is thickness: column 1 has none and column 2 all of it.
    const Material glass = glass_of_atlas(1, 3, R"({"pbrMetallicRoughness":{"metallicFactor":0},"extensions":{
        "KHR_materials_ior":{"ior":1},"KHR_materials_transmission":{"transmissionFactor":1},
        "KHR_materials_volume":{"thicknessFactor":4,"thicknessTexture":{"index":0},"attenuationDistance":1,
        "attenuationColor":[0.5,0.5,0.5]}}})");
    EXPECT_NEAR(glass.transmission.x, (1 + 1.0 / 16) / 2, 0.01) << "0.25 would be that of the mean thickness";
}

TEST(GltfMaterials, IgnoredExtensionsAreNamedWithTheNumberOfMaterialsTheyWouldChange) {
    const ImportedScene scene = with_materials(R"({"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":1},
            "KHR_materials_sheen":{"sheenColorFactor":[0,0.1,0]},"KHR_materials_ior":{"ior":1.33}}},
        {"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0.5},"KHR_materials_anisotropy":{"anisotropyStrength":1},
            "KHR_materials_dispersion":{"dispersion":0.1},"KHR_materials_iridescence":{"iridescenceFactor":1}}},
        {"extensions":{"KHR_materials_clearcoat":{"clearcoatFactor":0},"KHR_materials_specular":{"specularColorFactor":[1,0.5,1]}}})");
    EXPECT_THAT(scene.warnings, Contains("KHR_materials_clearcoat is ignored; it would change 2 materials"));
    for (const char* once : {"sheen", "anisotropy", "dispersion", "iridescence", "specular"}) {
        EXPECT_THAT(scene.warnings, Contains(fmt::format("KHR_materials_{} is ignored; it would change 1 material", once)));
    }
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("KHR_materials_ior (but for what goes through) is ignored")));
}

TEST(GltfMaterials, FactorsBeyondTheSchemaAreSetToTheEndOfTheirRangeWithAWarning) {
    const ImportedScene scene = with_materials(R"({},{"pbrMetallicRoughness":{"baseColorFactor":[1,2,-0.5,1],"metallicFactor":-1,
        "roughnessFactor":1.5},"alphaMode":"MASK","alphaCutoff":-0.25,"emissiveFactor":[0,3,0],
        "extensions":{"KHR_materials_ior":{"ior":0.5}}},
        {"pbrMetallicRoughness":{"baseColorFactor":[1,4,1,2]},"extensions":{"KHR_materials_unlit":{}}})");
    EXPECT_EQ(scene.frame.materials[2].base_color, glm::vec4(1, 4, 1, 1)) << "what is unlit shines";
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("materials[2].pbrMetallicRoughness.baseColorFactor[3] is 2")));
    EXPECT_THAT(scene.warnings, Not(Contains(HasSubstr("materials[2].pbrMetallicRoughness.baseColorFactor[1]"))));
    const Material& material = scene.frame.materials[1];
    EXPECT_EQ(material.base_color, glm::vec4(1, 1, 0, 1));
    EXPECT_EQ(material.metallic, 0);
    EXPECT_EQ(material.roughness, 1);
    EXPECT_EQ(material.mask_cutoff, 0);
    EXPECT_EQ(material.emissive, glm::vec3(0, 1, 0));
    for (const char* warning :
         {"glTF.materials[1].pbrMetallicRoughness.baseColorFactor[1] is 2; glTF allows 0 to 1, 1 is used",
          "glTF.materials[1].pbrMetallicRoughness.baseColorFactor[2] is -0.5; glTF allows 0 to 1, 0 is used",
          "glTF.materials[1].pbrMetallicRoughness.metallicFactor is -1; glTF allows 0 to 1, 0 is used",
          "glTF.materials[1].pbrMetallicRoughness.roughnessFactor is 1.5; glTF allows 0 to 1, 1 is used",
          "glTF.materials[1].alphaCutoff is -0.25; glTF allows 0 and more, 0 is used",
          "glTF.materials[1].emissiveFactor[1] is 3; glTF allows 0 to 1, 1 is used",
          "glTF.materials[1].extensions.KHR_materials_ior.ior is 0.5; glTF allows 1 and more, 1 is used"})
        EXPECT_THAT(scene.warnings, Contains(warning));
}

TEST(GltfMaterials, ExtensionsThatChangeNothingAreNotMentioned) {
    const ImportedScene scene = with_materials(R"({"extensions":{"KHR_materials_clearcoat":{},"KHR_materials_ior":{"ior":1.5},
        "KHR_materials_specular":{"specularFactor":1,"specularColorFactor":[1,1,1]}}})");
    EXPECT_THAT(scene.warnings, Not(Contains(HasSubstr("KHR_materials"))));
}

TEST(GltfMaterials, AnIgnoredExtensionMayBeRequired) {
    EXPECT_TRUE(import_text(Gltf().with_triangle().text(
        showing(triangle, R"(,"extensionsRequired":["KHR_materials_clearcoat","KHR_materials_volume","KHR_materials_ior"])"))));
}

}  // namespace
}  // namespace strata
