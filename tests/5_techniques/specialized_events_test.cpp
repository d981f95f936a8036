// Shaders of transparent surfaces are specialized to what the frame draws and to its textures. What a frame has besides, out of
// sight, makes them general and must not change a bit.
#include <gtest/gtest.h>

#include "passes/scene/scene_facts.h"
#include "passes/scene/texture_uses.h"
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
    const auto session = must(Session::open({alone, with_more}, {.validation = true}));
    for (const char* technique : {"transparency/alpha_blend", "transparency/sorted_lists"}) {
        Request first{.choices = chosen({technique})}, second{.variant = {.frame = 1}, .choices = chosen({technique})};
        first.outputs = second.outputs = {"color"};
        const auto a = must(session->run(first)), b = must(session->run(second));
        EXPECT_GT(counted(a, "fragments"), 1000u);
        EXPECT_EQ(counted(a, "fragments"), counted(b, "fragments"));
        EXPECT_TRUE(a.images.at("color").texels == b.images.at("color").texels) << technique;
    }
}

TEST(SpecializedEvents, OfParticlesAreThoseOfAFrameWithMeshesToo) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame more = smoke_alone(samples);
        add_unseen_mesh(more);
        expect_same_bits(smoke_alone(samples), more);
    }
}

TEST(SpecializedEvents, OfMeshesAreThoseOfAFrameWithParticlesToo) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame more = glass_alone(samples);
        add_unseen_particle(more);
        expect_same_bits(glass_alone(samples), more);
    }
}

std::uint32_t addresses(const Frame& frame) {
    return texture_uses(frame, SceneFacts(frame).lists(), Surfaces::transparent).addresses;
}

TEST(SpecializedEvents, KnowTheAddressModesOfBothDirections) {
    Frame frame = smoke_alone(1);
    EXPECT_EQ(addresses(frame), bit(AddressMode::clamp)) << "of the puff";
    frame.emitters.front().texture = add_texture(frame, AddressMode::clamp_repeat);
    EXPECT_EQ(addresses(frame), bit(AddressMode::clamp) | bit(AddressMode::repeat));
}

TEST(SpecializedEvents, ClampThePicturesOfLights) {
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
