// Why surface_at() can be believed: normals, normal maps under mirroring, and factors times textures.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "passes/reference/shade.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

Texture one_texel(std::array<std::uint8_t, 4> rgba) {
    Texture texture;
    texture.width = texture.height = 1;
    for (const std::uint8_t channel : rgba) texture.texels.push_back(static_cast<std::byte>(channel));
    return texture;
}

// A quad facing the eye with tangents along +x, w = 1: the bitangent is cross((0,0,-1), (1,0,0)) = (0,-1,0).
Frame quad_with_tangents() {
    Frame frame = tiny::frame(8, 8);
    const std::uint32_t draw = tiny::add_quad(frame, {.left = -9, .top = -9, .right = 17, .bottom = 17}, 2, AlphaMode::opaque);
    Mesh& mesh = frame.meshes[draw];
    std::swap(mesh.positions[1], mesh.positions[3]);
    std::swap(mesh.uv0[1], mesh.uv0[3]);
    if (glm::cross(mesh.positions[1] - mesh.positions[0], mesh.positions[2] - mesh.positions[0]).z > 0) {
        std::swap(mesh.positions[1], mesh.positions[3]);
        std::swap(mesh.uv0[1], mesh.uv0[3]);
    }
    mesh.normals.assign(4, {0, 0, -1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    return frame;
}

SurfacePoint surface_of(const Frame& frame) { return surface_at(frame, visible_points(frame, opaque_draws(frame)).at(3, 5)); }

TEST(Surfaces, LieWhereTheirPixelLooks) {
    const Frame frame = quad_with_tangents();
    EXPECT_LT(glm::length(surface_of(frame).position - tiny::under(frame, 3.5, 5.5, 2)), 1e-6);
    EXPECT_LT(glm::length(surface_of(frame).normal - glm::dvec3(0, 0, -1)), 1e-12);
}

TEST(Surfaces, MeshesWithoutNormalsAreFlat) {
    Frame frame = quad_with_tangents();
    frame.meshes[0].normals.clear();
    EXPECT_LT(glm::length(surface_of(frame).normal - glm::dvec3(0, 0, -1)), 1e-6);
}

TEST(Surfaces, BackFacesTurnTheirNormalToTheEye) {
    Frame frame = quad_with_tangents();
    std::swap(frame.meshes[0].indices[1], frame.meshes[0].indices[2]);
    std::swap(frame.meshes[0].indices[4], frame.meshes[0].indices[5]);
    frame.meshes[0].normals.assign(4, {0, 0, 1});
    EXPECT_LT(glm::length(surface_of(frame).normal - glm::dvec3(0, 0, -1)), 1e-12);
}

TEST(Surfaces, NormalsStayPerpendicularUnderUnevenScale) {
    Frame frame = tiny::frame(8, 8);
    // A plane tilted 45 degrees, flattened to a quarter in z: its slope becomes 1 in 4.
    const std::array<glm::dvec3, 3> corners = {{{-90, -90, 8 + 90}, {0, 90, 8 - 90}, {90, -90, 8 + 90}}};
    const std::uint32_t draw = tiny::add_triangles(frame, corners);
    frame.meshes[draw].normals.assign(3, glm::normalize(glm::vec3(0, -1, -1)));
    frame.draws[draw].to_world[2][2] = 0.25;
    const glm::dvec3 expected = glm::normalize(glm::dvec3(0, -1, -4));
    EXPECT_LT(glm::length(surface_of(frame).normal - expected), 1e-7);
}

TEST(Surfaces, ANormalMapTurnsTheNormalInItsTangentFrame) {
    Frame frame = quad_with_tangents();
    // (0.6, 0, 0.8) and (0, 0.6, 0.8) as floats.
    for (const glm::vec3 local : {glm::vec3(0.6f, 0, 0.8f), glm::vec3(0, 0.6f, 0.8f)}) {
        Texture texture = one_texel({0, 0, 0, 0});
        texture.format = TextureFormat::rgba32f;
        const glm::vec4 coded(local * 0.5f + 0.5f, 1);
        const auto* bytes = reinterpret_cast<const std::byte*>(&coded);
        texture.texels.assign(bytes, bytes + sizeof coded);
        frame.textures = {texture};
        frame.materials[0].normal_texture.texture = 0;
        EXPECT_LT(glm::length(surface_of(frame).normal - glm::dvec3(local.x, -local.y, -local.z)), 1e-6);
        // Mirrored in x, the whole picture is mirrored: tangent and x turn around, up stays up.
        Frame mirrored = frame;
        mirrored.draws[0].to_world[0][0] = -1;
        EXPECT_LT(glm::length(surface_of(mirrored).normal - glm::dvec3(-local.x, -local.y, -local.z)), 1e-6);
        // w = -1 mirrors the texture instead.
        Frame other_hand = frame;
        other_hand.meshes[0].tangents.assign(4, {1, 0, 0, -1});
        EXPECT_LT(glm::length(surface_of(other_hand).normal - glm::dvec3(local.x, local.y, -local.z)), 1e-6);
    }
}

TEST(Surfaces, OfHairLieAlongTheTangentAndStickOutWithoutOne) {
    Frame frame = quad_with_tangents();
    frame.materials[0].lighting_model = LightingModel::hair;
    frame.meshes[0].tangents.assign(4, {0.6f, 0.8f, 0, -1});
    frame.draws[0].to_world[0][0] = -1;
    EXPECT_LT(glm::length(surface_of(frame).normal - glm::dvec3(-0.6, 0.8, 0)), 1e-7) << "mirrored as the mesh is";
    frame.meshes[0].tangents.clear();
    EXPECT_LT(glm::length(surface_of(frame).normal - glm::dvec3(0, 0, -1)), 1e-12);
}

TEST(Surfaces, FactorsMultiplyTextures) {
    Frame frame = quad_with_tangents();
    frame.textures = {one_texel({51, 102, 204, 128})};
    frame.meshes[0].colors.assign(4, {0.5f, 1, 1, 0.5f});
    Material& m = frame.materials[0];
    m.base_color = {1, 0.5f, 0.25f, 1};
    m.metallic = 0.5f;
    m.roughness = 0.5f;
    m.emissive = {10, 0, 1};
    m.occlusion_strength = 0.5f;
    for (TextureUse* use : {&m.base_color_texture, &m.metallic_roughness_texture, &m.emissive_texture, &m.occlusion_texture})
        use->texture = 0;
    const SurfacePoint s = surface_of(frame);
    EXPECT_LT(glm::length(s.base_color - glm::dvec3(0.1, 0.2, 0.2)), 1e-12);
    EXPECT_NEAR(s.alpha, 0.5 * 128 / 255, 1e-12);
    EXPECT_EQ(s.metallic, 0) << "unlit: a model that has no metals";
    m.lighting_model = LightingModel::multiscatter_ggx;
    EXPECT_NEAR(surface_of(frame).metallic, 0.4, 1e-12);
    EXPECT_NEAR(s.roughness, 0.2, 1e-12);
    EXPECT_NEAR(s.occlusion, 0.6, 1e-12);
    EXPECT_LT(glm::length(s.emissive - glm::dvec3(2, 0, 0.8)), 1e-12);
}

TEST(Surfaces, MaskedPointsBelowTheCutoffAreNotThere) {
    Frame frame = quad_with_tangents();
    Material& m = frame.materials[0];
    m.alpha_mode = AlphaMode::mask;
    for (const auto& [alpha, there, undecided] : {std::tuple(0.25f, false, false), {0.75f, true, false}, {0.5f, true, true}}) {
        m.base_color.w = alpha;
        const RasterPoint point = visible_points(frame, opaque_draws(frame)).at(3, 5);
        EXPECT_EQ(point.draw == 0, there);
        EXPECT_EQ(point.undecided, undecided);
    }
}

}  // namespace
}  // namespace strata
