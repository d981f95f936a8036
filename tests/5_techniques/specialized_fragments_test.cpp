// Shaders of surfaces are specialized to what the frame draws, to its meshes, materials and textures. What a frame has besides,
// out of sight, makes them general and must not change a bit.
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "capture_format/view.h"
#include "passes/frame_images.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"
#include "passes/shaders/scene/no_index.shared.h"
#include "passes/shaders/uses.shared.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::uint32_t bit(AddressMode mode) { return 1u << static_cast<std::uint32_t>(mode); }

/// 2 x 2 texels of another format than the scenarios' textures.
std::uint32_t add_texture(Frame& frame, AddressMode address) {
    Texture texture{.name = "unseen", .format = TextureFormat::rgba32f, .width = 2, .height = 2, .address = address};
    texture.texels.resize(4 * sizeof(glm::vec4));
    frame.textures.push_back(std::move(texture));
    return static_cast<std::uint32_t>(frame.textures.size() - 1);
}

glm::dvec3 behind_the_camera(const View& view) { return view.origin + glm::inverse(view.to_view) * glm::dvec3(0, 0, -1e4); }

/// A transparent draw of the first mesh behind the camera, with a mirrored texture.
void add_unseen_mesh(Frame& frame) {
    Material material = frame.materials.front();
    material.alpha_mode = AlphaMode::blend;
    material.base_color_texture.texture = add_texture(frame, AddressMode::mirror);
    frame.materials.push_back(material);
    Draw draw = frame.draws.front();
    draw.material = static_cast<std::uint32_t>(frame.materials.size() - 1);
    draw.to_world[3] = glm::dvec4(behind_the_camera(frame.view), 1);
    frame.draws.push_back(draw);
}

void add_unseen_particle(Frame& frame) {
    Emitter emitter{.particles = {{.center = behind_the_camera(frame.view)}}};
    emitter.texture = add_texture(frame, AddressMode::repeat);
    frame.emitters.push_back(std::move(emitter));
}

/// A draw behind the camera of a mesh that has every attribute, with a material that has everything that others may lack.
void add_unseen_variety(Frame& frame, AlphaMode mode) {
    Mesh mesh = frame.meshes.front();
    const std::size_t vertices = mesh.positions.size();
    mesh.normals.assign(vertices, {0, 0, 1});
    mesh.tangents.assign(vertices, {1, 0, 0, 1});
    mesh.uv0.assign(vertices, {.25f, .5f});
    mesh.uv1.assign(vertices, {.5f, .25f});
    mesh.colors.assign(vertices, glm::vec4(.5f));
    frame.meshes.push_back(std::move(mesh));
    Material material{.name = "unseen", .lighting_model = LightingModel::ggx, .alpha_mode = mode};
    material.base_color = glm::vec4(.5f);
    material.metallic = .5f;
    material.emissive = glm::vec3(1);
    material.double_sided = !frame.materials.front().double_sided;
    for (TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
                            &material.emissive_texture, &material.occlusion_texture})
        use->texture = add_texture(frame, AddressMode::mirror);
    frame.materials.push_back(material);
    Draw draw = frame.draws.front();
    draw.mesh = static_cast<std::uint32_t>(frame.meshes.size() - 1);
    draw.material = static_cast<std::uint32_t>(frame.materials.size() - 1);
    draw.to_world[3] = glm::dvec4(behind_the_camera(frame.view), 1);
    frame.draws.push_back(draw);
}

Frame smoke_alone(std::uint32_t samples) {
    Frame frame = scenario_frames("smoke_grenade", samples).front();
    frame.view.width = 96, frame.view.height = 54;
    return frame;
}

Frame glass_alone(std::uint32_t samples) {
    Frame frame = scenario_frames("glass_and_smoke", samples).front();
    frame.view.width = 96, frame.view.height = 54;
    frame.emitters.clear();
    return frame;
}

void expect_same_bits(const Frame& alone, const Frame& with_more) {
    const auto session = session_of({alone, with_more});
    for (const char* technique : {"transparency/alpha_blend", "transparency/sorted_lists"}) {
        Request first{.choices = chosen({technique})}, second{.variant = {.frame = 1}, .choices = chosen({technique})};
        first.outputs = second.outputs = {"color"};
        const auto a = must(session->run(first)), b = must(session->run(second));
        EXPECT_GT(counted(a, "fragments"), 1000u);
        EXPECT_EQ(counted(a, "fragments"), counted(b, "fragments"));
        EXPECT_TRUE(a.images.at("color").texels == b.images.at("color").texels) << technique;
    }
}

TEST(SpecializedFragments, OfParticlesAreThoseOfAFrameWithMeshesToo) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame more = smoke_alone(samples);
        add_unseen_mesh(more);
        expect_same_bits(smoke_alone(samples), more);
    }
}

TEST(SpecializedFragments, OfMeshesAreThoseOfAFrameWithParticlesToo) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame more = glass_alone(samples);
        add_unseen_particle(more);
        expect_same_bits(glass_alone(samples), more);
    }
}

TEST(SpecializedFragments, OfPlainMaterialsAreThoseOfAFrameWithAllKinds) {
    for (const std::uint32_t samples : {1u, 4u})
        for (const AlphaMode mode : {AlphaMode::blend, AlphaMode::premultiplied}) {
            Frame more = glass_alone(samples);
            add_unseen_variety(more, mode);
            expect_same_bits(glass_alone(samples), more);
        }
}

/// Glass that colors what is behind it, or hair, whose fibers run along tangents: what the variety lacks.
Frame glass_like(LightingModel model, glm::vec3 transmission) {
    Frame frame = glass_alone(1);
    for (Mesh& mesh : frame.meshes) mesh.tangents.assign(mesh.positions.size(), {.6f, .8f, 0, 1});
    for (Material& material : frame.materials) {
        if (!is_transparent(material.alpha_mode)) continue;
        material.lighting_model = model;
        material.transmission = transmission;
    }
    return frame;
}

TEST(SpecializedFragments, OfHairAndColoredGlassAreThoseOfAFrameWithAllKinds) {
    for (const Frame& alone : {glass_like(LightingModel::hair, glm::vec3(0)), glass_like(LightingModel::ggx, {.2f, .5f, .9f})}) {
        Frame more = alone;
        add_unseen_variety(more, AlphaMode::blend);
        expect_same_bits(alone, more);
    }
}

/// A spot light's box with holes, of which shadows know through the material's texture; at (0, 0), the mean of its texels, it has
/// none.
Frame box_with_holes() {
    Frame frame = scenario_frames("spot_and_box", 1).front();
    frame.view.width = 96, frame.view.height = 54;
    Texture holes{.name = "holes", .format = TextureFormat::rgba8_unorm, .width = 2, .height = 2};
    for (const int alpha : {255, 0, 255, 255})
        holes.texels.insert(holes.texels.end(), {std::byte{255}, std::byte{255}, std::byte{255}, std::byte(alpha)});
    frame.textures.push_back(holes);
    for (Mesh& mesh : frame.meshes)
        for (const glm::vec3& p : mesh.positions) mesh.uv0.emplace_back(p.x + p.z, p.y + p.z);
    for (Material& material : frame.materials) {
        material.alpha_mode = AlphaMode::mask;
        material.base_color_texture.texture = static_cast<std::uint32_t>(frame.textures.size() - 1);
    }
    return frame;
}

TEST(SpecializedSurfaces, CastTheShadowsOfAFrameWithAllKinds) {
    const Frame alone = box_with_holes();
    Frame whole = alone, more = alone;
    for (Material& material : whole.materials) material.base_color_texture.texture = no_index;
    add_unseen_variety(more, AlphaMode::opaque);
    const auto session = session_of({alone, more, whole});
    std::vector<HostImage> visible;
    for (const std::size_t frame : {0u, 1u, 2u})
        visible.push_back(
            must(session->run(Request{.variant = {.frame = frame}, .outputs = {"visibility"}})).images.at("visibility"));
    EXPECT_TRUE(visible[0].texels == visible[1].texels);
    EXPECT_FALSE(visible[0].texels == visible[2].texels) << "light falls through the holes";
}

TEST(SpecializedSurfaces, OfPlainMaterialsAreThoseOfAFrameWithAllKinds) {
    for (const char* scenario : {"opaque_only", "glass_and_smoke"})
        for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask}) {
            Frame alone = scenario_frames(scenario, 1).front();
            alone.view.width = 96, alone.view.height = 54;
            Frame more = alone;
            add_unseen_variety(more, mode);
            const auto session = session_of({alone, more});
            Request first{.outputs = {"gbuffer0", "gbuffer1", "emission", "color"}}, second = first;
            second.variant.frame = 1;
            const auto a = must(session->run(first)), b = must(session->run(second));
            for (const std::string& image : first.outputs)
                EXPECT_TRUE(a.images.at(image).texels == b.images.at(image).texels) << scenario << ": " << image;
        }
}

MaterialUses transparent_uses(const Frame& frame) {
    return material_uses(frame, SceneFacts(frame).lists(), Surfaces::transparent);
}

TEST(MaterialUses, AreThoseOfTheDrawnMeshesAndMaterialsAlone) {
    Frame frame = smoke_alone(1);
    EXPECT_EQ(transparent_uses(frame).drawn, particles_drawn);
    EXPECT_EQ(transparent_uses(frame).models, 1u) << "sprites are unlit";
    EXPECT_EQ(transparent_uses(frame).attributes, 0u);
    add_unseen_variety(frame, AlphaMode::opaque);
    EXPECT_EQ(transparent_uses(frame).properties, property_both_sides) << "of opaque draws nothing";
    add_unseen_variety(frame, AlphaMode::blend);
    const MaterialUses all = transparent_uses(frame);
    EXPECT_EQ(all.drawn, meshes_drawn | particles_drawn);
    EXPECT_EQ(all.models, 1u | 1u << static_cast<std::uint32_t>(LightingModel::ggx));
    EXPECT_EQ(all.attributes, attribute_normal | attribute_tangent | attribute_uv0 | attribute_uv1 | attribute_color);
    EXPECT_EQ(all.properties & (property_metallic | property_emissive | property_transmission),
              property_metallic | property_emissive);
    frame.materials.back().transmission.y = .5f;
    EXPECT_TRUE(transparent_uses(frame).properties & property_transmission);
}

TEST(MaterialUses, HaveNoAttributesThatNothingReads) {
    Frame frame = glass_alone(1);
    std::erase_if(frame.draws, [&](const Draw& draw) { return is_transparent(frame.materials[draw.material].alpha_mode); });
    add_unseen_variety(frame, AlphaMode::blend);
    Material& material = frame.materials.back();
    for (TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
                            &material.emissive_texture, &material.occlusion_texture})
        use->texture = no_index;
    EXPECT_EQ(transparent_uses(frame).attributes, attribute_normal | attribute_color) << "tangents and uv are for textures";
    material.lighting_model = LightingModel::unlit;
    EXPECT_EQ(transparent_uses(frame).attributes, attribute_color) << "normals are for light";
    material.distortion = .1f;
    EXPECT_EQ(transparent_uses(frame).attributes, attribute_normal | attribute_color) << "and for distortion";
    material.lighting_model = LightingModel::hair;
    EXPECT_EQ(transparent_uses(frame).attributes, attribute_normal | attribute_tangent | attribute_color) << "fibers";
}

std::uint32_t addresses(const Frame& frame) { return transparent_uses(frame).addresses; }

TEST(SpecializedFragments, KnowTheAddressModesOfBothDirections) {
    Frame frame = smoke_alone(1);
    EXPECT_EQ(addresses(frame), bit(AddressMode::clamp)) << "of the puff";
    frame.emitters.front().texture = add_texture(frame, AddressMode::clamp_repeat);
    EXPECT_EQ(addresses(frame), bit(AddressMode::clamp) | bit(AddressMode::repeat));
}

TEST(SpecializedFragments, ClampThePicturesOfLights) {
    Frame frame = smoke_alone(1);
    for (Emitter& emitter : frame.emitters) emitter.texture = add_texture(frame, AddressMode::repeat);
    EXPECT_EQ(addresses(frame), bit(AddressMode::repeat));
    Light light;
    light.texture = 0;
    frame.lights.push_back(light);
    EXPECT_EQ(addresses(frame), bit(AddressMode::repeat) | bit(AddressMode::clamp));
}

}  // namespace
}  // namespace strata
