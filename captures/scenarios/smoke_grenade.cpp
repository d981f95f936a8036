// A smoke grenade among people and crates: 2000 soft sprites that grow and rise, and the orange smoke of a signal that the wind
// drives through them, 400 sprites of an emitter of its own. Some people stand behind the smoke, one in it, one before it; an
// average of the layers cannot tell them apart, and neither can an order of whole emitters.
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

constexpr int sprite_count = 2000, signal_count = 400;

/// Properties in which the scenarios differ.
struct Cloud {
    double radius = 1.5;  ///< meters, where it is widest
    float opacity = 1;    ///< factor of the sprites' alphas
    float soft_depth_fade = 0.25f;
    double vertical_fov = 0.75;
};

/// Everything random about a sprite is drawn from its own seed, so a sprite keeps its way through the frames.
Particle sprite(int index, double progress, std::uint64_t seed, const Cloud& cloud) {
    Random random(seed * 0x10001 + static_cast<std::uint64_t>(index));
    const double rank = (index + 0.5) / sprite_count;                        // 0: on the ground, 1: the top of the cloud
    const double grown = std::sqrt(0.15 + 0.85 * progress);                  // a puff's radius goes with the root of its age
    const double bulge = std::sin(std::numbers::pi * (0.15 + 0.75 * rank));  // the cloud is widest at middle height
    const double angle = random.between(0.0, 2 * std::numbers::pi) + 0.8 * progress * (1 - rank);
    const double radius = cloud.radius * grown * bulge * std::sqrt(random.unit());
    Particle particle;
    particle.center = {radius * std::cos(angle), 0.1 + 2.3 * rank * grown + random.between(-0.1, 0.1), radius * std::sin(angle)};
    particle.size = static_cast<float>(random.between(0.2, 0.45) * grown);
    const double first_turn = random.between(0.0, 2 * std::numbers::pi), turning = random.between(-1.0, 1.0);
    particle.rotation = static_cast<float>(first_turn + turning * progress);
    const double lit = 0.35 + 0.4 * rank + 0.25 * radius * std::cos(angle - 0.8);  // the sun stands at +x, and above
    particle.color = glm::vec3(1, 0.97f, 0.92f) * static_cast<float>(std::max(0.1, lit));
    particle.alpha = cloud.opacity * static_cast<float>(random.between(0.03, 0.16));
    return particle;
}

/// The signal burns on the ground in front of the cloud, to its left; the wind blows its smoke through the cloud to the back.
Particle signal_sprite(int index, double progress, std::uint64_t seed) {
    Random random(seed * 0x10001 + static_cast<std::uint64_t>(sprite_count + index));
    const glm::dvec3 source{-1.9, 0.15, 1.3}, way{4.2, 2.1, -2.4};
    const double age = (index + 0.5) / signal_count * progress;  // share of the way
    const double spread = 0.08 + 0.55 * std::sqrt(age);          // half a width
    const auto aside = [&] {
        const double side = random.between(-1.0, 1.0);
        return spread * side * random.unit();  // denser in the middle
    };
    const double z = aside(), y = aside(), x = aside();  // arguments of one call would be drawn in the compiler's order
    Particle particle;
    particle.center = source + way * age + glm::dvec3(x, y, z);
    particle.size = static_cast<float>(0.12 + 0.33 * std::sqrt(age) * random.between(0.8, 1.2));
    particle.rotation = static_cast<float>(random.between(0.0, 2 * std::numbers::pi) + progress);
    particle.color = glm::vec3(1, 0.38f, 0.08f) * random.between(0.6f, 1.0f);
    particle.alpha = random.between(0.08f, 0.25f);
    return particle;
}

void add_smoke(FrameBuilder& builder, const Cloud& cloud) {
    Emitter smoke;
    smoke.name = "smoke";
    smoke.texture = builder.add(puff(builder.seed()));
    smoke.soft_depth_fade = cloud.soft_depth_fade;
    Emitter signal = smoke;
    signal.name = "signal";
    for (int i = 0; i < sprite_count; ++i) smoke.particles.push_back(sprite(i, builder.progress(), builder.seed(), cloud));
    for (int i = 0; i < signal_count; ++i) signal.particles.push_back(signal_sprite(i, builder.progress(), builder.seed()));
    builder.frame.emitters.push_back(std::move(smoke));
    builder.frame.emitters.push_back(std::move(signal));
}

void add_surroundings(FrameBuilder& builder) {
    Material tiles = lambert("tiles", glm::vec3(1));
    tiles.base_color_texture.texture = builder.add(checker(2, glm::vec3(0.5f), glm::vec3(0.25f)));
    tiles.base_color_texture.transform = {6, 0, 0, 0, 6, 0};
    builder.draw(builder.add(box({6, 0.1f, 6})), builder.add(tiles), {.position = {0, -0.1, 0}});
    Material plaster = lambert("plaster", {0.55f, 0.5f, 0.42f});
    builder.draw(builder.add(box({6, 2, 0.1f})), builder.add(plaster), {.position = {0, 2, -4.1}});
    const std::uint32_t wood = builder.add(lambert("wood", {0.45f, 0.28f, 0.12f}));
    add_crate(builder, wood, glm::dvec3(0.45), {.position = {1.9, 0, -1.6}, .yaw = 0.4});
    add_crate(builder, wood, glm::dvec3(0.35), {.position = {-0.6, 0, 0.3}, .yaw = -0.2});
    add_crate(builder, wood, glm::dvec3(0.4), {.position = {-2.4, 0, -0.4}, .yaw = 0.9});
}

Frame smoke_of(const Cloud& cloud, std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.6, 1.7, 6}, .target = {0, 1.2, 0}, .vertical_fov = cloud.vertical_fov});
    add_surroundings(builder);
    const People people(builder);
    people.add(builder, builder.add(lambert("red coat", {0.7f, 0.08f, 0.06f})), {.position = {-1.7, 0, -2.6}, .yaw = 0.2});
    people.add(builder, builder.add(lambert("blue coat", {0.08f, 0.15f, 0.6f})), {.position = {0.5, 0, 0.1}, .yaw = -0.4});
    people.add(builder, builder.add(lambert("green coat", {0.1f, 0.45f, 0.12f})), {.position = {2.3, 0, 1.8}, .yaw = 0.9});
    people.add(builder, builder.add(lambert("yellow coat", {0.7f, 0.55f, 0.08f})), {.position = {0.9, 0, -2.2}, .yaw = -0.6});
    add_smoke(builder, cloud);
    builder.frame.sun.direction = glm::normalize(glm::vec3(-0.7f, -1, -0.4f));
    builder.frame.sun.irradiance = {2.6f, 2.5f, 2.3f};
    builder.frame.sun.shadow.casts = true;
    builder.frame.sun.cascades = 1;
    builder.frame.sun.shadow_distance = 14;
    builder.frame.hemisphere = {.sky = {0.4f, 0.48f, 0.6f}, .ground = {0.2f, 0.18f, 0.15f}};
    builder.frame.background = {0.45f, 0.55f, 0.7f};
    return std::move(builder.frame);
}

}  // namespace

Frame smoke_grenade(std::uint32_t frame, const ScenarioOptions& options) { return smoke_of({}, frame, options); }

/// Wider, nearer and six times as dense, and without soft particles: a depth from which on nothing is seen may then be known
/// before opaque surfaces are drawn.
Frame smoke_core(std::uint32_t frame, const ScenarioOptions& options) {
    return smoke_of({.radius = 2.1, .opacity = 6, .soft_depth_fade = 0, .vertical_fov = 0.62}, frame, options);
}

}  // namespace strata::scenario
