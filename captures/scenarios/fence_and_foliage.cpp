// A chain-link fence along a meadow and one across it, 2 to 60 m away, with trees, shrubs and grass of masked cards: alpha that
// is magnified near the eye and far smaller than a pixel at the end. The eye walks along the fence.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/foliage.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/painting.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

constexpr float tile = 0.5f, mesh_width = tile / 4, wire = 0.016f;  // meters: of a texture, of a mesh of the fence, of its wire
constexpr double fence_height = 1.8, panel_length = 3;

/// Wires along both diagonals, 4 meshes a side.
Texture chain_link() {
    return painted("chain link", {.edge = 128, .places = 4}, [](glm::vec2 uv) {
        const auto across = [](float at) {  // meters from the nearest wire
            return std::abs(at - std::round(at)) * mesh_width / std::numbers::sqrt2_v<float>;
        };
        const glm::vec2 at = uv * 4.0f;
        const float distance = std::min(across(at.x + at.y), across(at.x - at.y)), share = distance / (0.5f * wire);
        const float shine = 0.35f + 0.35f * std::sqrt(std::max(0.0f, 1 - share * share));
        return glm::vec4(glm::vec3(0.9f, 0.95f, 1.0f) * shine, share < 1 ? 1 : 0);
    });
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
          leaf_(builder.add(masked("leaves", builder.add(leaf_spray(builder.seed(), 30, 0.26f))))),
          shrub_(builder.add(masked("shrub", builder.add(leaf_spray(builder.seed() + 1, 60, 0.14f))))),
          grass_(builder.add(masked("grass", builder.add(grass_blades(builder.seed() + 2))))) {
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
