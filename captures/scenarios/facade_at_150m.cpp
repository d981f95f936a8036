// A glass facade of three skins 0.3 m apart, seen from 150 m at an angle and in a long lens: parked cars behind it, smoke between
// the glass and the cars. The skins are a five hundredth of their depth apart, the whole scene is a twentieth deep.
#include <array>
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

// The facade is the plane z = 0, a skin is every 0.3 m behind it.
constexpr double skin_gap = 0.3, pane_width = 2.4, pane_height = 3.2;

/// Each skin is shifted by a third of a pane against the next, so every number of skins overlaps somewhere. The middle one is
/// submitted first; and seen at an angle, some panes' middles are nearer than those of the panes before them.
void add_facade(FrameBuilder& builder) {
    const std::uint32_t pane = builder.add(quad({0.43f * float(pane_width), 0.44f * float(pane_height)}));
    const std::array<std::uint32_t, 3> skins = {builder.add(unlit("near blue glass", {0.15f, 0.3f, 0.6f, 0.3f})),
                                                builder.add(unlit("middle amber glass", {0.7f, 0.45f, 0.1f, 0.35f})),
                                                builder.add(unlit("far green glass", {0.1f, 0.5f, 0.25f, 0.4f}))};
    for (const int skin : {1, 0, 2})
        for (int storey = 0; storey < 2; ++storey)
            for (int bay = -2; bay <= 2; ++bay)
                builder.draw(
                    pane, skins[static_cast<std::size_t>(skin)],
                    {.position = {(bay + (skin - 1) / 3.0) * pane_width, (storey + 0.55) * pane_height, -skin * skin_gap}});
}

void add_cars(FrameBuilder& builder) {
    const std::uint32_t body = builder.add(box({2.1f, 0.4f, 0.9f})), cabin = builder.add(box({1.1f, 0.35f, 0.8f}));
    const std::array<glm::vec3, 3> paints = {glm::vec3(0.9f, 0.05f, 0.04f), {0.05f, 0.05f, 0.06f}, {0.03f, 0.1f, 0.8f}};
    for (std::size_t i = 0; i < paints.size(); ++i) {
        const std::uint32_t paint = builder.add(lambert("car", paints[i]));
        const double x = -4.6 + 4.6 * static_cast<double>(i);
        builder.draw(body, paint, {.position = {x, 0.75, -4}, .yaw = 0.1 * static_cast<double>(i)});
        builder.draw(cabin, paint, {.position = {x - 0.2, 1.45, -4}, .yaw = 0.1 * static_cast<double>(i)});
    }
}

void add_plume(FrameBuilder& builder) {
    Emitter smoke;
    smoke.name = "smoke between glass and cars";
    smoke.texture = builder.add(puff(builder.seed()));
    smoke.soft_depth_fade = 0.3f;
    Random random(builder.seed());
    for (int i = 0; i < 60; ++i) {
        const double rise = std::fmod(random.unit() + 0.4 * builder.progress(), 1.0);
        Particle particle;
        particle.center = {random.between(-6.0, 6.0), 0.4 + 4 * rise, -random.between(1.0, 2.8)};
        particle.size = static_cast<float>(0.6 + 0.7 * rise);
        particle.rotation = random.between(0.0f, 2 * std::numbers::pi_v<float>);
        particle.color = glm::vec3(0.3f, 0.28f, 0.26f) * random.between(0.8f, 1.2f);
        particle.alpha = static_cast<float>(0.6 * (1 - 0.6 * rise));
        smoke.particles.push_back(particle);
    }
    builder.frame.emitters.push_back(std::move(smoke));
}

}  // namespace

Frame facade_at_150m(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {-30, 3, 147}, .target = {0, 3, 0}, .vertical_fov = 0.046, .swing = 0.02});
    Material wall = unlit("bright wall", glm::vec4(1));
    wall.base_color_texture.texture = builder.add(checker(2, glm::vec3(1.5f), glm::vec3(0.9f)));
    wall.base_color_texture.transform = {8, 0, 0, 0, 4, 0};
    builder.draw(builder.add(quad({16, 8})), builder.add(wall), {.position = {0, 4, -6}});
    builder.draw(builder.add(box({16, 0.1f, 4})), builder.add(lambert("street", glm::vec3(0.25f))), {.position = {0, -0.1, -2}});
    add_cars(builder);
    add_facade(builder);
    add_plume(builder);
    builder.frame.hemisphere = {.sky = {0.9f, 1, 1.1f}, .ground = {0.3f, 0.28f, 0.25f}};
    builder.frame.background = {0.7f, 0.8f, 1};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
