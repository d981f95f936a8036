// Surfaces of the night market.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/foliage.h"
#include "captures/scenarios/night_market/night_market.h"
#include "captures/scenarios/painting.h"

namespace strata::scenario::market {
namespace {

/// A place on a wall of staggered stones.
struct Stone {
    float border = 0;  ///< distance from the joint, 0.5 at the middle of a stone's shorter side
    float shade = 0;   ///< the stone's own, 0..1
};

Stone stone_at(glm::vec2 uv, glm::uvec2 count, std::uint64_t seed) {
    const float row = std::floor(uv.y * float(count.y));
    const float along = uv.x * float(count.x) + 0.5f * hashed(std::int64_t(row) % count.y, 7, seed) + 0.5f * std::fmod(row, 2.0f);
    const float column = std::floor(along);
    const glm::vec2 within(along - column, uv.y * float(count.y) - row), inward = glm::min(within, 1.0f - within);
    const float longer = float(count.y) / float(count.x);  // of a stone's sides
    return {.border = std::min(inward.x * longer, inward.y),
            .shade = hashed(std::int64_t(column) % count.x, std::int64_t(row) % count.y, seed + 1)};
}

constexpr glm::uvec2 setts_in_tile{16, 24}, bricks_in_tile{4, 12};
constexpr float setts_tile = 3.84f, brick_tile = 1;  // meters

/// Where water stands between and on the setts, 0..1.
float puddle(glm::vec2 uv) { return std::clamp((tiling_noise(uv, 3, 21) - 0.47f) * 6, 0.0f, 1.0f); }

float sett_height(glm::vec2 uv) {
    const Stone stone = stone_at(uv, setts_in_tile, 11);
    const float round = std::clamp(stone.border / 0.22f, 0.0f, 1.0f), dome = 1 - (1 - round) * (1 - round);
    const float rough = 0.35f * tiling_noise(uv, 48, 5);
    return 0.0042f * (dome + rough + 0.5f * stone.shade) * (1 - puddle(uv));
}

glm::vec4 sett_color(glm::vec2 uv) {
    const Stone stone = stone_at(uv, setts_in_tile, 11);
    const float joint = std::clamp(stone.border / 0.09f, 0.0f, 1.0f), dirt = 0.6f + 0.6f * tiling_noise(uv, 12, 3);
    const glm::vec3 color = glm::mix(glm::vec3(0.085f, 0.087f, 0.095f), glm::vec3(0.16f, 0.13f, 0.105f), stone.shade);
    const float wet = 1 - 0.55f * puddle(uv);
    return glm::vec4(glm::mix(glm::vec3(0.025f), color * dirt, joint) * wet, 1);
}

/// Roughness in y: damp stones, and water.
glm::vec4 sett_gloss(glm::vec2 uv) {
    const float damp = 0.27f + 0.17f * tiling_noise(uv, 9, 8) - 0.08f * stone_at(uv, setts_in_tile, 11).shade;
    return glm::vec4(1, glm::mix(damp, 0.07f, puddle(uv)), 0, 1);
}

glm::vec4 brick_color(glm::vec2 uv) {
    const Stone brick = stone_at(uv, bricks_in_tile, 31);
    const glm::vec3 color = glm::mix(glm::vec3(0.22f, 0.1f, 0.07f), glm::vec3(0.4f, 0.2f, 0.13f), brick.shade);
    const float soot = 0.5f + 0.7f * tiling_noise(uv, 5, 2);
    return glm::vec4(brick.border < 0.08f ? glm::vec3(0.2f, 0.18f, 0.16f) : color * soot, 1);
}

float brick_height(glm::vec2 uv) {
    return 0.01f * std::clamp(stone_at(uv, bricks_in_tile, 31).border / 0.15f, 0.0f, 1.0f) + 0.004f * tiling_noise(uv, 24, 4);
}

Material textured(std::string name, Texture texture, float meters, FrameBuilder& builder) {
    Material material = lambert(std::move(name), glm::vec3(1));
    material.lighting_model = LightingModel::ggx;
    material.roughness = 0.6f;
    material.base_color_texture.texture = builder.add(std::move(texture));
    material.base_color_texture.transform = {1 / meters, 0, 0, 0, 1 / meters, 0};
    return material;
}

std::uint32_t add_setts(FrameBuilder& builder) {
    Material material = textured("setts", painted("setts", {.edge = 256}, sett_color), setts_tile, builder);
    const auto& tile = material.base_color_texture.transform;
    material.normal_texture = {builder.add(relief("setts relief", 256, sett_height)), 0, tile};
    const Canvas gloss{.edge = 128, .format = TextureFormat::rgba8_unorm};
    material.metallic_roughness_texture = {builder.add(painted("setts gloss", gloss, sett_gloss)), 0, tile};
    material.roughness = 1;
    material.normal_scale = 0.9f;
    return builder.add(material);
}

std::uint32_t add_brick(FrameBuilder& builder) {
    Material material = textured("brick", painted("brick", {.edge = 128}, brick_color), brick_tile, builder);
    const std::uint32_t height = builder.add(relief("brick relief", 128, brick_height));
    material.normal_texture = {height, 0, material.base_color_texture.transform};
    material.roughness = 0.55f;
    return builder.add(material);
}

/// Planks along u, six a tile.
std::uint32_t add_planks(FrameBuilder& builder, const char* name, glm::vec3 color) {
    Material material = textured(name,
                                 painted(name, {.edge = 128},
                                         [color](glm::vec2 uv) {
                                             const float plank = std::floor(uv.y * 6), within = uv.y * 6 - plank;
                                             const float own = 0.7f + 0.5f * hashed(std::int64_t(plank), 1, 41);
                                             const glm::vec2 stretched(uv.x, uv.y * 8);
                                             const float grain =
                                                 0.7f + 0.6f * tiling_noise(glm::fract(stretched), 6, 43 + std::uint64_t(plank));
                                             const float gap = within < 0.05f || within > 0.95f ? 0.25f : 1.0f;
                                             return glm::vec4(color * (own * grain * gap), 1);
                                         }),
                                 0.9f, builder);
    material.roughness = 0.5f;
    return builder.add(material);
}

std::uint32_t add_plaster(FrameBuilder& builder) {
    Material material = textured("plaster",
                                 painted("plaster", {.edge = 128},
                                         [](glm::vec2 uv) {
                                             const float stain = tiling_noise(uv, 3, 51), fine = tiling_noise(uv, 20, 53);
                                             const float flaked = std::clamp((tiling_noise(uv, 5, 57) - 0.62f) * 20, 0.0f, 1.0f);
                                             const glm::vec3 paint =
                                                 glm::vec3(0.42f, 0.36f, 0.28f) * (0.6f + 0.5f * stain + 0.15f * fine);
                                             return glm::vec4(glm::mix(paint, glm::vec3(0.24f, 0.2f, 0.18f), flaked), 1);
                                         }),
                                 2.6f, builder);
    material.roughness = 0.75f;
    return builder.add(material);
}

/// Two stripes a tile of 0.4 m, dirtier towards the hem.
std::uint32_t add_cloth(FrameBuilder& builder, const char* name, glm::vec3 color) {
    Material material =
        textured(name,
                 painted(name, {},
                         [color](glm::vec2 uv) {
                             const float dirt = 0.75f + 0.35f * tiling_noise(uv, 4, 61);
                             const float weave = 0.94f + 0.06f * std::cos(uv.x * 2 * std::numbers::pi_v<float> * 16);
                             return glm::vec4((uv.x < 0.5f ? color : glm::vec3(0.68f, 0.62f, 0.5f)) * (dirt * weave), 1);
                         }),
                 0.4f, builder);
    material.lighting_model = LightingModel::cloth;
    material.roughness = 0.7f;
    material.double_sided = true;
    return builder.add(material);
}

Material glossy(const char* name, glm::vec3 color, float roughness) {
    Material material = lambert(name, color);
    material.lighting_model = LightingModel::ggx;
    material.roughness = roughness;
    return material;
}

std::uint32_t plain(FrameBuilder& builder, const char* name, glm::vec3 color, float roughness) {
    return builder.add(glossy(name, color, roughness));
}

std::uint32_t nylon(FrameBuilder& builder, const char* name, glm::vec3 color) {
    Material material = glossy(name, color, 0.35f);
    material.double_sided = true;
    return builder.add(material);
}

std::uint32_t metal(FrameBuilder& builder, const char* name, glm::vec3 color, float roughness) {
    Material material = glossy(name, color, roughness);
    material.metallic = 1;
    return builder.add(material);
}

std::uint32_t shining(FrameBuilder& builder, const char* name, glm::vec3 radiance) {
    Material material = lambert(name, glm::vec3(0.05f));
    material.emissive = radiance;
    return builder.add(material);
}

/// Ribs of bamboo behind paper that is brightest at the middle.
std::uint32_t add_paper(FrameBuilder& builder) {
    Material material = lambert("lantern", {0.5f, 0.12f, 0.04f});
    material.emissive = {2.1f, 0.52f, 0.12f};
    material.emissive_texture.texture = builder.add(painted("lantern", {}, [](glm::vec2 uv) {
        const float rib = 0.75f + 0.25f * std::abs(std::sin(uv.y * 9 * std::numbers::pi_v<float>));
        const float bright = std::max(0.0f, std::sin(uv.y * std::numbers::pi_v<float>));
        return glm::vec4(glm::vec3(1, 0.5f + 0.5f * bright, 0.3f + 0.7f * bright) * (rib * (0.25f + 0.75f * bright)), 1);
    }));
    return builder.add(material);
}

/// Six panes, a curtain, and something that stands on the sill.
std::uint32_t add_lit_window(FrameBuilder& builder) {
    Material material = lambert("lit window", glm::vec3(0.06f));
    material.emissive = {1.5f, 0.85f, 0.32f};
    material.emissive_texture.texture = builder.add(painted("lit window", {}, [](glm::vec2 uv) {
        const glm::vec2 pane = glm::fract(uv * glm::vec2(2, 3)), inward = glm::min(pane, 1.0f - pane);
        const bool bar = std::min(inward.x, 1.5f * inward.y) < 0.06f;
        const float curtain = 0.45f + 0.3f * std::sin(uv.x * 40) * (uv.x < 0.3f || uv.x > 0.75f ? 1.0f : 0.2f);
        const bool pot = uv.y > 0.8f && std::abs(uv.x - 0.6f) < 0.12f;
        const float light = (0.5f + 0.5f * uv.y) * (0.6f + curtain);
        return glm::vec4(glm::vec3(1, 0.9f, 0.75f) * (bar ? 0.04f : pot ? 0.15f : light), 1);
    }));
    return builder.add(material);
}

std::uint32_t lit_glass(FrameBuilder& builder, const char* name, glm::vec3 transmission) {
    Material material = glass(name, transmission);
    material.lighting_model = LightingModel::ggx;
    material.base_color = glm::vec4(glm::vec3(0.02f), 1);
    material.roughness = 0.16f;
    return builder.add(material);
}

}  // namespace

Materials add_materials(FrameBuilder& builder) {
    Material cut_leaf = masked("leaf", builder.add(leaf_spray(builder.seed(), 34, 0.25f)));
    cut_leaf.lighting_model = LightingModel::ggx;
    cut_leaf.roughness = 0.4f;
    return {.setts = add_setts(builder),
            .kerb = plain(builder, "kerb", glm::vec3(0.2f, 0.2f, 0.21f), 0.3f),
            .brick = add_brick(builder),
            .plaster = add_plaster(builder),
            .planks = add_planks(builder, "planks", {0.36f, 0.2f, 0.1f}),
            .boards = add_planks(builder, "boards", {0.13f, 0.16f, 0.17f}),
            .iron = plain(builder, "iron", glm::vec3(0.06f), 0.35f),
            .steel = metal(builder, "steel", glm::vec3(0.62f, 0.6f, 0.57f), 0.3f),
            .ceramic = plain(builder, "ceramic", {0.65f, 0.66f, 0.68f}, 0.2f),
            .dough = plain(builder, "dough", {0.8f, 0.65f, 0.42f}, 0.6f),
            .rubber = plain(builder, "rubber", glm::vec3(0.04f), 0.3f),
            .red_cloth = add_cloth(builder, "red awning", {0.5f, 0.045f, 0.03f}),
            .blue_cloth = add_cloth(builder, "blue awning", {0.04f, 0.12f, 0.34f}),
            .green_cloth = add_cloth(builder, "green awning", {0.04f, 0.26f, 0.14f}),
            .coat = plain(builder, "oilcloth", {0.42f, 0.3f, 0.05f}, 0.3f),
            .dark_coat = plain(builder, "dark coat", {0.07f, 0.075f, 0.1f}, 0.4f),
            .skin = plain(builder, "skin", {0.6f, 0.38f, 0.28f}, 0.5f),
            .red_nylon = nylon(builder, "red umbrella", {0.5f, 0.03f, 0.025f}),
            .dark_nylon = nylon(builder, "dark umbrella", {0.05f, 0.055f, 0.08f}),
            .paper = add_paper(builder),
            .lit_paper = shining(builder, "lit paper", {1.25f, 0.9f, 0.5f}),
            .lit_window = add_lit_window(builder),
            .dark_window = plain(builder, "dark window", {0.02f, 0.025f, 0.035f}, 0.12f),
            .warm_bulb = shining(builder, "bulb", {9, 5.5f, 2.4f}),
            .pink_neon = shining(builder, "pink neon", {6, 0.7f, 2.6f}),
            .amber_neon = shining(builder, "amber neon", {6, 1.5f, 0.16f}),
            .cyan_neon = shining(builder, "cyan neon", {0.5f, 3.4f, 4.6f}),
            .clear_glass = lit_glass(builder, "clear glass", {0.9f, 0.95f, 0.93f}),
            .green_glass = lit_glass(builder, "green glass", {0.25f, 0.7f, 0.3f}),
            .amber_glass = lit_glass(builder, "amber glass", {0.85f, 0.42f, 0.08f}),
            .blue_glass = lit_glass(builder, "blue glass", {0.15f, 0.35f, 0.85f}),
            .red_glass = lit_glass(builder, "red glass", {0.85f, 0.1f, 0.07f}),
            .orange = plain(builder, "oranges", {0.85f, 0.3f, 0.02f}, 0.4f),
            .apple = plain(builder, "apples", {0.6f, 0.05f, 0.03f}, 0.25f),
            .lime = plain(builder, "limes", {0.3f, 0.5f, 0.05f}, 0.3f),
            .plum = plain(builder, "plums", {0.14f, 0.04f, 0.16f}, 0.3f),
            .leaf = builder.add(cut_leaf)};
}

}  // namespace strata::scenario::market
