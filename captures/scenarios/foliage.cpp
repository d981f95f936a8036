#include "captures/scenarios/foliage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/painting.h"
#include "captures/scenarios/random.h"

namespace strata::scenario {
namespace {

struct Leaf {
    glm::vec2 center, along;
    float shade = 1;
};

/// Half edges of a card; cross(right, up) is its front.
struct CardPlace {
    glm::vec3 center, right, up;
};

/// A card that can be seen from both sides, lit as the round thing that it belongs to: by the given normal rather than its own,
/// as far as that is on the side that is seen. Each side is a face of its own.
void add_card(Mesh& mesh, const CardPlace& card, glm::vec3 normal) {
    for (const float side : {1.0f, -1.0f}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::vec3 right = side * card.right, front = glm::normalize(glm::cross(right, card.up));
        const glm::vec3 seen = glm::normalize(normal + front * std::max(0.0f, 0.2f - glm::dot(normal, front)));
        const glm::vec4 tangent(glm::normalize(right - seen * glm::dot(seen, right)), 1);
        for (const glm::vec2 corner : {glm::vec2(-1, 1), glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1)}) {
            mesh.positions.push_back(card.center + right * corner.x + card.up * corner.y);
            mesh.normals.push_back(seen);
            mesh.tangents.push_back(tangent);
            mesh.uv0.emplace_back(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
        }
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
    }
}

}  // namespace

Texture leaf_spray(std::uint64_t seed, int count, float length) {
    Random random(seed);
    std::vector<Leaf> all;
    for (int i = 0; i < count; ++i) {
        const float angle = random.between(0.0f, 6.2832f), radius = 0.38f * float(std::sqrt(random.unit()));
        const float turn = angle + random.between(-0.9f, 0.9f), shade = random.between(0.55f, 1.15f);
        all.push_back({.center = 0.5f + radius * glm::vec2(std::cos(angle), std::sin(angle)),
                       .along = length * glm::vec2(std::cos(turn), std::sin(turn)),
                       .shade = shade});
    }
    Texture texture = painted("leaves", {.edge = 128, .places = 4}, [&all](glm::vec2 uv) {
        glm::vec4 color(0.10f, 0.22f, 0.035f, 0);
        for (const Leaf& leaf : all) {
            const glm::vec2 from = uv - leaf.center;
            const float square = glm::dot(leaf.along, leaf.along), t = glm::dot(from, leaf.along) / square;
            const float aside = std::abs(from.x * leaf.along.y - from.y * leaf.along.x) / square;
            if (std::abs(t) > 0.5f || aside > 0.42f * (0.25f - t * t) * (1.2f - 0.8f * t)) continue;
            const float vein = aside < 0.012f ? 1.35f : 1.0f;
            color = glm::vec4(glm::vec3(0.11f, 0.25f, 0.04f) * (leaf.shade * vein * (0.85f + 0.3f * t)), 1);
        }
        return color;
    });
    texture.address = AddressMode::clamp;
    return texture;
}

Texture grass_blades(std::uint64_t seed) {
    Random random(seed);
    std::vector<glm::vec4> blades;  // foot, lean, height, shade
    for (int i = 0; i < 26; ++i) {
        const float foot = random.between(0.08f, 0.92f), lean = random.between(-0.3f, 0.3f);
        const float height = random.between(0.45f, 0.98f), shade = random.between(0.6f, 1.2f);
        blades.emplace_back(foot, lean, height, shade);
    }
    Texture texture = painted("grass", {.edge = 128, .places = 4}, [&blades](glm::vec2 uv) {
        glm::vec4 color(0.13f, 0.2f, 0.03f, 0);
        const float up = 1 - uv.y;
        for (const glm::vec4& blade : blades) {
            const float t = up / blade.z, middle = blade.x + blade.y * t * t;
            if (t < 1 && std::abs(uv.x - middle) < 0.022f * (1 - t))
                color = glm::vec4(glm::vec3(0.15f, 0.23f, 0.04f) * (blade.w * (0.55f + 0.6f * t)), 1);
        }
        return color;
    });
    texture.address = AddressMode::clamp;
    return texture;
}

Material masked(std::string name, std::uint32_t texture) {
    Material material = lambert(std::move(name), glm::vec3(1));
    material.alpha_mode = AlphaMode::mask;
    material.base_color_texture.texture = texture;
    return material;
}

Mesh crown(std::uint64_t seed, int cards, float half) {
    Random random(seed);
    Mesh mesh;
    mesh.name = "crown";
    for (int i = 0; i < cards; ++i) {
        const float height = 2 * (float(i) + 0.5f) / float(cards) - 1, around = 2.39996f * float(i);
        const float ring = std::sqrt(1 - height * height), radius = 1 - 0.55f * float(random.unit() * random.unit());
        const glm::vec3 outward(ring * std::cos(around), height, ring * std::sin(around));
        const glm::vec3 tilt{random.between(-0.5f, 0.5f), random.between(-0.5f, 0.5f), random.between(-0.5f, 0.5f)};
        const glm::vec3 front = glm::normalize(outward + tilt);
        const glm::vec3 side =
            glm::normalize(glm::cross(std::abs(front.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0), front));
        const float turn = random.between(0.0f, 6.2832f);
        const glm::vec3 right = half * (std::cos(turn) * side + std::sin(turn) * glm::cross(front, side));
        add_card(mesh, {.center = outward * radius, .right = right, .up = glm::cross(front, right)},
                 glm::normalize(outward + glm::vec3(0, 0.3f, 0)));
    }
    return mesh;
}

Mesh tuft() {
    Mesh mesh;
    mesh.name = "tuft";
    for (int i = 0; i < 3; ++i) {
        const float angle = std::numbers::pi_v<float> * float(i) / 3;
        add_card(mesh, {.center = {0, 0.5f, 0}, .right = {0.6f * std::cos(angle), 0, 0.6f * std::sin(angle)}, .up = {0, 0.5f, 0}},
                 {0, 1, 0});
    }
    return mesh;
}

}  // namespace strata::scenario
