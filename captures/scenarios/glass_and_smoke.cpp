// A room with the sun through its window, a lamp and a spot; two panes of colored glass with smoke between them, and a plant
// of alpha-masked cards. Everything the pipeline has meets here.
#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/props.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

Material tiled(FrameBuilder& builder, std::string name, glm::vec3 light, glm::vec3 dark) {
    Material material = lambert(std::move(name), glm::vec3(1));
    material.lighting_model = LightingModel::burley;
    material.roughness = 0.6f;
    material.base_color_texture.texture = builder.add(checker(2, light, dark));
    material.base_color_texture.transform = {3, 0, 0, 0, 3, 0};
    return material;
}

/// 6 x 3 x 6 m inside, walls 20 cm thick. The left wall has a window of 1.6 x 1.2 m at 1 m height; the side behind the eye
/// is open but for the roof.
void add_room(FrameBuilder& builder) {
    const std::uint32_t floor = builder.add(tiled(builder, "floor", glm::vec3(0.6f), glm::vec3(0.3f)));
    const std::uint32_t wall = builder.add(tiled(builder, "wall", {0.65f, 0.6f, 0.5f}, {0.5f, 0.46f, 0.4f}));
    const auto slab = [&](glm::vec3 low, glm::vec3 high, std::uint32_t material) {
        builder.draw(builder.add(box((high - low) * 0.5f)), material, {.position = glm::dvec3(low + high) * 0.5});
    };
    slab({-3.2f, -0.2f, -3.2f}, {3.2f, 0, 3.2f}, floor);
    slab({-3.2f, 3, -3.2f}, {3.2f, 3.2f, 3.2f}, wall);
    slab({-3.2f, 0, -3.2f}, {3.2f, 3, -3}, wall);
    slab({3, 0, -3}, {3.2f, 3, 3.2f}, wall);
    slab({-3.2f, 0, -3}, {-3, 1, 3.2f}, wall);      // below the window,
    slab({-3.2f, 2.2f, -3}, {-3, 3, 3.2f}, wall);   // above it,
    slab({-3.2f, 1, -3}, {-3, 2.2f, -1.6f}, wall);  // and beside it
    slab({-3.2f, 1, 0}, {-3, 2.2f, 3.2f}, wall);
}

void add_lights(FrameBuilder& builder) {
    Frame& frame = builder.frame;
    frame.sun.direction = glm::normalize(glm::vec3(1, -0.75f, -0.15f));
    frame.sun.irradiance = {9, 8, 6.5f};
    frame.sun.shadow.casts = true;
    frame.sun.cascades = 2;
    frame.sun.shadow_distance = 12;
    Light lamp;
    lamp.name = "lamp";
    lamp.position = {1.8, 2.4, -1.8};
    lamp.intensity = {5, 3.6f, 2.2f};
    lamp.range = 6;
    frame.lights.push_back(lamp);
    Light spot;
    spot.name = "spot";
    spot.type = LightType::round_spot;
    spot.position = {0.6, 2.9, 1.2};
    spot.direction = glm::normalize(glm::vec3(-0.2f, -1, -0.75f));
    spot.axis_u = glm::normalize(glm::cross(spot.direction, glm::vec3(0, 0, 1)));
    spot.intensity = {9, 10, 12};
    spot.range = 8;
    spot.inner_angle = 0.4f;
    spot.outer_angle = 0.6f;
    spot.shadow.casts = true;
    frame.lights.push_back(spot);
    frame.hemisphere = {.sky = {0.12f, 0.14f, 0.18f}, .ground = {0.09f, 0.08f, 0.07f}};
    frame.background = {0.6f, 0.75f, 1};
}

void add_plant(FrameBuilder& builder) {
    Material leaves = lambert("leaves", glm::vec3(1));
    leaves.alpha_mode = AlphaMode::mask;
    leaves.double_sided = true;
    leaves.base_color_texture.texture = builder.add(foliage(builder.seed()));
    const std::uint32_t material = builder.add(leaves), card = builder.add(quad({0.4f, 0.55f}));
    add_crate(builder, builder.add(lambert("pot", {0.5f, 0.2f, 0.1f})), {0.2, 0.2, 0.2}, {.position = {-1.7, 0, -1.2}});
    for (int i = 0; i < 3; ++i) {
        builder.draw(card, material, {.position = {-1.7, 0.95, -1.2}, .yaw = 0.3 + i * std::numbers::pi / 3});
    }
}

void add_haze(FrameBuilder& builder) {
    Emitter smoke;
    smoke.name = "smoke between the panes";
    smoke.texture = builder.add(puff(builder.seed()));
    smoke.soft_depth_fade = 0.2f;
    Random random(builder.seed());
    for (int i = 0; i < 120; ++i) {
        const double rise = std::fmod(random.unit() + 0.3 * builder.progress(), 1.0), angle = random.between(0.0, 6.28);
        const double radius = (0.15 + 0.45 * rise) * random.unit();
        Particle particle;
        particle.center = {0.2 + radius * std::cos(angle), 0.2 + 2.2 * rise, -0.7 + 0.6 * radius * std::sin(angle)};
        particle.size = static_cast<float>(0.15 + 0.3 * rise);
        particle.rotation = random.between(0.0f, 6.28f);
        particle.color = glm::vec3(0.5f, 0.52f, 0.55f) * random.between(0.8f, 1.2f);
        particle.alpha = static_cast<float>(0.25 * (1 - 0.7 * rise));
        smoke.particles.push_back(particle);
    }
    builder.frame.emitters.push_back(std::move(smoke));
}

/// A pane of 1.4 x 1.8 m that lets a color through and reflects a little of the room's light.
Material pane(std::string name, glm::vec3 transmission) {
    Material material = glass(std::move(name), transmission);
    material.lighting_model = LightingModel::ggx;
    material.base_color = glm::vec4(glm::vec3(0.02f), 1);
    material.roughness = 0.25f;
    return material;
}

}  // namespace

Frame glass_and_smoke(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.3, 1.6, 4}, .target = {0, 1.2, -1}, .vertical_fov = 0.8, .swing = 0.2});
    add_room(builder);
    add_plant(builder);
    const People people(builder);
    people.add(builder, builder.add(lambert("coat", {0.6f, 0.12f, 0.08f})), {.position = {0.5, 0, -2}, .yaw = 0.2});
    add_crate(builder, builder.add(lambert("wood", {0.45f, 0.28f, 0.12f})), glm::dvec3(0.35),
              {.position = {1.7, 0, -1.4}, .yaw = 0.5});
    const std::uint32_t sheet = builder.add(quad({0.7f, 0.9f}));
    builder.draw(sheet, builder.add(pane("amber glass", {0.95f, 0.6f, 0.15f})), {.position = {-0.2, 1.0, 0.1}, .yaw = 0.25});
    builder.draw(sheet, builder.add(pane("blue glass", {0.15f, 0.45f, 0.9f})), {.position = {0.5, 1.0, -1.4}, .yaw = -0.2});
    add_haze(builder);
    add_lights(builder);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
