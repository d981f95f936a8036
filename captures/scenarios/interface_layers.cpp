// Three interface windows that overlap, in front of smoke and two panes though their surfaces lie among and behind them: blended
// by layer, tested by depth. The lowest layer is the nearest surface, the highest is submitted between the others.
#include <numbers>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

void add_world(FrameBuilder& builder) {
    Material wall = lambert("wall", glm::vec3(1));
    wall.lighting_model = LightingModel::unlit;
    wall.base_color_texture.texture = builder.add(checker(2, glm::vec3(0.9f), glm::vec3(0.3f)));
    wall.base_color_texture.transform = {8, 0, 0, 0, 8, 0};
    builder.draw(builder.add(quad({8, 8})), builder.add(wall), {.position = {0, 0, -6}});
    // Before the highest layer's surface, which it hides in spite of its layer.
    builder.draw(builder.add(quad({0.08f, 0.5f})), builder.add(unlit("post", {0.7f, 0.6f, 0.5f, 1})),
                 {.position = {0.75, 0.5, -2.4}});
    const std::uint32_t pane = builder.add(quad({1, 1}));
    builder.draw(pane, builder.add(unlit("near pane", {0.1f, 0.4f, 0.9f, 0.4f})),
                 {.position = {-0.6, 0, -0.9}, .scale = glm::dvec3(0.5)});
    builder.draw(pane, builder.add(unlit("far pane", {0.2f, 0.8f, 0.3f, 0.5f})), {.position = {0.4, 0.2, -4.5}, .yaw = 0.3});

    Emitter smoke;
    smoke.name = "smoke";
    smoke.texture = builder.add(puff(builder.seed()));
    smoke.soft_depth_fade = 0.4f;
    Random random(builder.seed());
    for (int i = 0; i < 60; ++i) {
        const double drift = 0.2 * builder.progress();
        Particle particle;
        particle.center = {random.between(-1.5, 1.5) + drift, random.between(-0.9, 0.9), -random.between(2.0, 4.0)};
        particle.size = random.between(0.3f, 0.6f);
        particle.rotation = random.between(0.0f, 2 * std::numbers::pi_v<float>);
        particle.color = glm::vec3(random.between(0.4f, 0.8f));
        particle.alpha = random.between(0.1f, 0.4f);
        smoke.particles.push_back(particle);
    }
    builder.frame.emitters.push_back(std::move(smoke));
}

}  // namespace

Frame interface_layers(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -4}});
    add_world(builder);
    const std::uint32_t window = builder.add(quad({0.8f, 0.6f}));
    builder.draw(window, builder.add(unlit("third", {0.9f, 0.8f, 0.2f, 0.6f})), {.position = {0.45, 0.15, -2.7}}).layer = 3;
    builder
        .draw(window, builder.add(unlit("first", {0.9f, 0.1f, 0.1f, 0.5f})),
              {.position = {-0.2, 0.1, -1.3}, .scale = glm::dvec3(0.5)})
        .layer = 1;
    const Particle marker{.center = {0.1, -0.4, -5}, .size = 1, .color = {0.1f, 0.9f, 0.9f}, .alpha = 0.7f};
    builder.frame.emitters.push_back({.name = "second", .layer = 2, .particles = {marker}});
    return std::move(builder.frame);
}

}  // namespace strata::scenario
