// A chain-link fence along a meadow and one across it, 2 to 60 m away, with trees, shrubs and grass of masked cards: alpha that
// is magnified near the eye and far smaller than a pixel at the end. The eye walks along the fence.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "capture_format/codec/texture_mips.h"
#include "capture_format/srgb.h"
#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

constexpr float tile = 0.5f, mesh_width = tile / 4, wire = 0.016f;  // metres: of a texture, of a mesh of the fence, of its wire
constexpr double fence_height = 1.8, panel_length = 3;

/// Each texel is the mean of 4 x 4 places; `paint` gets uv in 0..1 and returns linear color and alpha. Alpha does not weigh
/// color, so `paint` gives what is not there the color of what is beside it.
Texture painted(std::string name, std::uint32_t edge, const std::function<glm::vec4(glm::vec2)>& paint) {
    constexpr std::uint32_t places = 4;
    Texture texture;
    texture.name = std::move(name);
    texture.format = TextureFormat::rgba8_srgb;
    texture.width = texture.height = edge;
    for (std::uint32_t y = 0; y < edge; ++y)
        for (std::uint32_t x = 0; x < edge; ++x) {
            glm::vec4 sum(0);
            for (std::uint32_t i = 0; i < places * places; ++i) {
                const glm::vec2 within = (glm::vec2(i % places, i / places) + 0.5f) / float(places);
                sum += paint((glm::vec2(x, y) + within) / float(edge));
            }
            const glm::vec4 mean = sum / float(places * places);
            for (int c = 0; c < 3; ++c) texture.texels.push_back(unorm8(encode_srgb(mean[c])));
            texture.texels.push_back(unorm8(mean.w));
        }
    return with_mips(std::move(texture));
}

/// Wires along both diagonals, 4 meshes a side.
Texture chain_link() {
    return painted("chain link", 128, [](glm::vec2 uv) {
        const auto across = [](float at) {  // metres from the nearest wire
            return std::abs(at - std::round(at)) * mesh_width / std::numbers::sqrt2_v<float>;
        };
        const glm::vec2 at = uv * 4.0f;
        const float distance = std::min(across(at.x + at.y), across(at.x - at.y)), share = distance / (0.5f * wire);
        const float shine = 0.35f + 0.35f * std::sqrt(std::max(0.0f, 1 - share * share));
        return glm::vec4(glm::vec3(0.9f, 0.95f, 1.0f) * shine, share < 1 ? 1 : 0);
    });
}

struct Leaf {
    glm::vec2 center, along;
    float shade = 1;
};

/// A spray of pointed leaves.
Texture leaves(std::uint64_t seed, int count, float length) {
    Random random(seed);
    std::vector<Leaf> all;
    for (int i = 0; i < count; ++i) {
        const float angle = random.between(0.0f, 6.2832f), radius = 0.38f * float(std::sqrt(random.unit()));
        const float turn = angle + random.between(-0.9f, 0.9f), shade = random.between(0.55f, 1.15f);
        all.push_back({.center = 0.5f + radius * glm::vec2(std::cos(angle), std::sin(angle)),
                       .along = length * glm::vec2(std::cos(turn), std::sin(turn)),
                       .shade = shade});
    }
    Texture texture = painted("leaves", 128, [&all](glm::vec2 uv) {
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

/// Blades that lean, from the lower edge up.
Texture grass(std::uint64_t seed) {
    Random random(seed);
    std::vector<glm::vec4> blades;  // foot, lean, height, shade
    for (int i = 0; i < 26; ++i) {
        const float foot = random.between(0.08f, 0.92f), lean = random.between(-0.3f, 0.3f);
        const float height = random.between(0.45f, 0.98f), shade = random.between(0.6f, 1.2f);
        blades.emplace_back(foot, lean, height, shade);
    }
    Texture texture = painted("grass", 128, [&blades](glm::vec2 uv) {
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

/// Cards all around in a ball of radius 1, their fronts outwards.
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

/// Crossed cards that stand on y = 0.
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

class Meadow {
public:
    explicit Meadow(FrameBuilder& builder)
        : builder_(&builder),
          cube_(builder.add(box(glm::vec3(0.5f)))),
          crown_(builder.add(crown(builder.seed() + 3, 90, 0.42f))),
          tuft_(builder.add(tuft())),
          panel_(builder.add(quad({float(panel_length / 2), float(fence_height / 2)}))),
          post_(builder.add(lambert("posts", {0.34f, 0.36f, 0.35f}))),
          bark_(builder.add(lambert("bark", {0.16f, 0.1f, 0.06f}))),
          leaf_(builder.add(masked("leaves", builder.add(leaves(builder.seed(), 30, 0.26f))))),
          shrub_(builder.add(masked("shrub", builder.add(leaves(builder.seed() + 1, 60, 0.14f))))),
          grass_(builder.add(masked("grass", builder.add(grass(builder.seed() + 2))))) {
        Material link = masked("chain link", builder.add(chain_link()));
        link.double_sided = true;
        link.base_color_texture.transform = {float(panel_length) / tile, 0, 0, 0, float(fence_height) / tile, 0};
        link_ = builder.add(link);
    }

    void build() {
        add_ground();
        for (int i = 0; i < 20; ++i) add_panel(along(i), along(i + 1));
        for (int i = 0; i < 6; ++i)
            if (i != 2) add_panel({-4.5 + panel_length * i, 0, -30}, {-4.5 + panel_length * (i + 1), 0, -30});
        add_tree({3.4, 0, -8}, 1.5);
        add_tree({7.5, 0, -17}, 2.2);
        add_tree({0.6, 0, -37}, 2.4);
        add_tree({9.5, 0, -44}, 2.8);
        add_tree({-11, 0, -32}, 2.6);
        add_tree({-2.5, 0, -57}, 3);
        add_tree({5, 0, -60}, 3);
        add_shrub({1.9, 0, -3.2}, 0.55);
        add_shrub({2.3, 0, -14}, 0.7);
        add_shrub({-6.5, 0, -13}, 0.8);
        add_grass();
    }

private:
    static glm::dvec3 along(int i) { return {-1.5 - 0.22 * i, 0, -1 - 2.95 * i}; }

    void block(glm::dvec3 low, glm::dvec3 high, std::uint32_t material) {
        builder_->draw(cube_, material, {.position = 0.5 * (low + high), .scale = high - low});
    }

    void add_ground() {
        block({-120, -0.2, -160}, {120, 0, 40}, builder_->add(lambert("meadow", {0.12f, 0.17f, 0.05f})));
        block({-0.7, 0, -90}, {1, 0.01, 10}, builder_->add(lambert("path", {0.36f, 0.29f, 0.2f})));
        const std::uint32_t plaster = builder_->add(lambert("plaster", {0.72f, 0.66f, 0.55f}));
        block({-16, 0, -84}, {3, 5, -76}, plaster);
        block({-16.4, 5, -84.4}, {3.4, 6.4, -75.6}, builder_->add(lambert("roof", {0.35f, 0.12f, 0.08f})));
    }

    /// From post to post, the far one included.
    void add_panel(glm::dvec3 from, glm::dvec3 to) {
        const glm::dvec3 way = to - from, middle = 0.5 * (from + to);
        const double yaw = std::atan2(-way.z, way.x), length = glm::length(way);
        builder_->draw(
            panel_, link_,
            {.position = middle + glm::dvec3(0, fence_height / 2, 0), .yaw = yaw, .scale = {length / panel_length, 1, 1}});
        builder_->draw(cube_, post_,
                       {.position = middle + glm::dvec3(0, fence_height, 0), .yaw = yaw, .scale = {length, 0.045, 0.045}});
        for (const glm::dvec3& end : {from, to})
            builder_->draw(cube_, post_, {.position = end + glm::dvec3(0, 0.97, 0), .yaw = yaw, .scale = {0.07, 1.94, 0.07}});
    }

    void add_tree(glm::dvec3 foot, double radius) {
        const double height = 2.1 * radius;
        builder_->draw(
            cube_, bark_,
            {.position = foot + glm::dvec3(0, height / 2, 0), .yaw = 0.4, .scale = {0.16 * radius, height, 0.16 * radius}});
        builder_->draw(crown_, leaf_, {.position = foot + glm::dvec3(0, height, 0), .yaw = foot.x, .scale = glm::dvec3(radius)});
    }

    void add_shrub(glm::dvec3 foot, double radius) {
        builder_->draw(crown_, shrub_,
                       {.position = foot + glm::dvec3(0, 0.75 * radius, 0), .yaw = foot.z, .scale = glm::dvec3(radius)});
    }

    void add_grass() {
        Random random(builder_->seed() + 4);
        for (int i = 0; i < 200; ++i) {
            const double place = random.unit() * random.unit() * 20, aside = random.between(-0.5, 0.5);
            const double height = random.between(0.18, 0.42), yaw = random.between(0.0, 3.1);
            const glm::dvec3 near(i % 3 == 0 ? 1.4 + 0.2 * place + aside : -1.6 - 0.22 * place + aside, 0, -1.2 - 2.95 * place);
            builder_->draw(tuft_, grass_, {.position = near, .yaw = yaw, .scale = glm::dvec3(height)});
        }
    }

    FrameBuilder* builder_;
    std::uint32_t cube_, crown_, tuft_, panel_, post_, bark_, leaf_, shrub_, grass_, link_ = no_index;
};

}  // namespace

Frame fence_and_foliage(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    const double walked = 1.5 * (builder.progress() - 1);
    builder.look({.eye = {0, 1.65, 1 - walked}, .target = {-0.7, 1.35, -20 - walked}, .swing = 0});
    Meadow(builder).build();
    builder.frame.sun.direction = glm::normalize(glm::vec3(-0.55f, -1, -0.55f));
    builder.frame.sun.irradiance = {5.2f, 4.8f, 4.1f};
    builder.frame.sun.shadow = {.casts = true, .map_size = 512};
    builder.frame.sun.cascades = 3;
    builder.frame.sun.shadow_distance = 60;
    builder.frame.hemisphere = {.sky = {0.4f, 0.52f, 0.72f}, .ground = {0.14f, 0.15f, 0.08f}};
    builder.frame.background = {0.55f, 0.72f, 1.0f};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
