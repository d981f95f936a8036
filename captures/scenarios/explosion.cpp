// A ball of fire inside its smoke: fire covers and emits up to radiance 12, smoke before it dims it, smoke behind it must not.
// Hot air before it all is a sheet that distorts and barely covers.
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

constexpr glm::dvec3 heart{0, 1.3, 0};

/// A direction, evenly over the sphere.
glm::dvec3 direction(Random& random) {
    const double z = random.between(-1.0, 1.0), angle = random.between(0.0, 2 * std::numbers::pi);
    return {std::sqrt(1 - z * z) * std::cos(angle), z, std::sqrt(1 - z * z) * std::sin(angle)};
}

/// What all sprites of a cloud have, as its age goes from 0 to 1.
struct Cloud {
    const char* name;
    int sprites;
    double inner, outer;  ///< meters from the heart at age 1
    double size;
    float alpha;
    float thinnest = 0.6f;  ///< of alpha
};

Emitter cloud(const Cloud& about, std::uint32_t texture, FrameBuilder& builder) {
    Emitter emitter;
    emitter.name = about.name;
    emitter.texture = texture;
    emitter.soft_depth_fade = 0.2f;
    Random random(builder.seed() * 0x10001 + static_cast<std::uint64_t>(about.sprites));
    const double grown = std::sqrt(0.2 + 0.8 * builder.progress());
    for (int i = 0; i < about.sprites; ++i) {
        const glm::dvec3 towards = direction(random);
        Particle particle;
        particle.center = heart + towards * grown * std::cbrt(random.between(std::pow(about.inner, 3), std::pow(about.outer, 3)));
        particle.size = static_cast<float>(about.size * grown * random.between(0.7, 1.3));
        particle.rotation = random.between(0.0f, 2 * std::numbers::pi_v<float>);
        particle.alpha = about.alpha * random.between(about.thinnest, 1.0f);
        emitter.particles.push_back(particle);
    }
    return emitter;
}

/// Hottest at the heart; covers a little where it burns, so no sprite is light alone.
void add_fire(FrameBuilder& builder) {
    Emitter fire = cloud({"fire", 90, 0, 0.75, 0.28, 0.3f}, builder.add(puff(builder.seed() + 1)), builder);
    for (Particle& particle : fire.particles) {
        const auto heat = static_cast<float>(std::exp(-3 * glm::length(particle.center - heart)));
        particle.color = {0.1f, 0.05f, 0.02f};
        particle.emissive = glm::mix(glm::vec3(1.6f, 0.3f, 0.03f), glm::vec3(12, 7, 2.5f), heat);
    }
    builder.frame.emitters.push_back(std::move(fire));
}

/// A flat square in the xy plane whose normals rise in waves: what air of uneven heat bends light by.
Mesh ripples(float half, std::uint32_t cells) {
    Mesh mesh;
    mesh.name = "ripples";
    for (std::uint32_t y = 0; y <= cells; ++y)
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const glm::vec2 at = glm::vec2(x, y) / float(cells) * 2.0f - 1.0f;
            mesh.positions.emplace_back(at * half, 0.0f);
            const glm::vec3 normal = glm::normalize(glm::vec3(std::sin(9 * at.y + 2 * at.x), std::sin(7 * at.x - 5 * at.y), 1));
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal)), 1.0f);
            mesh.uv0.emplace_back(0.5f + 0.5f * at.x, 0.5f - 0.5f * at.y);
        }
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t corner = y * (cells + 1) + x, above = corner + cells + 1;
            mesh.indices.insert(mesh.indices.end(), {corner, corner + 1, above + 1, corner, above + 1, above});
        }
    return mesh;
}

void add_smoke_column(FrameBuilder& builder, const Cloud& about) {
    Emitter smoke = cloud(about, builder.add(puff(builder.seed())), builder);
    for (Particle& particle : smoke.particles) particle.color = glm::vec3(static_cast<float>(0.08 + 0.08 * particle.center.y));
    builder.frame.emitters.push_back(std::move(smoke));
}

Frame explosion_in(const Cloud& smoke, std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.4, 1.7, 4.5}, .target = {0, 1.2, 0}, .vertical_fov = 0.75});
    Material tiles = lambert("tiles", glm::vec3(1));
    tiles.base_color_texture.texture = builder.add(checker(2, glm::vec3(0.5f), glm::vec3(0.25f)));
    tiles.base_color_texture.transform = {6, 0, 0, 0, 6, 0};
    builder.draw(builder.add(box({6, 0.1f, 6})), builder.add(tiles), {.position = {0, -0.1, 0}});
    add_crate(builder, builder.add(lambert("wood", {0.45f, 0.28f, 0.12f})), glm::dvec3(0.4),
              {.position = {1.5, 0, -0.6}, .yaw = 0.4});
    People(builder).add(builder, builder.add(lambert("coat", {0.1f, 0.2f, 0.5f})), {.position = {-1.6, 0, -1}, .yaw = 0.3});
    add_smoke_column(builder, smoke);
    add_fire(builder);
    Material hot_air = unlit("hot air", {0.9f, 0.85f, 0.8f, 0.04f});
    hot_air.distortion = 0.02f;
    builder.draw(builder.add(ripples(1.1f, 24)), builder.add(hot_air), {.position = {0, 1.6, 1.5}});
    builder.frame.hemisphere = {.sky = {0.5f, 0.55f, 0.65f}, .ground = {0.25f, 0.22f, 0.2f}};
    builder.frame.background = {0.3f, 0.38f, 0.5f};
    return std::move(builder.frame);
}

}  // namespace

Frame explosion(std::uint32_t frame, const ScenarioOptions& options) {
    return explosion_in({"smoke", 200, 0.45, 1.2, 0.36, 0.5f}, frame, options);
}
/// Smoke of which four sprites in a slice are more than a byte of optical depth holds.
Frame thick_explosion(std::uint32_t frame, const ScenarioOptions& options) {
    return explosion_in({"smoke", 2000, 0.45, 1.2, 0.36, 1, 0.97f}, frame, options);
}

}  // namespace strata::scenario
