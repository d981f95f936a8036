// A clearing at dusk after rain: the sun stands low behind the edge of a wood, and its shafts come between the trunks. A yard of
// wet concrete with puddles, a hut whose floor is dry under its roof, a camp fire's smoke, a broken pane, light rain.
//
//   z = -24  trees and shrubs, the sun behind them
//   z = -9   hut at the left, open to the front and to the right; fence posts; wreck of a water tank at the right
//   z = 0    the yard; eye at z = 6
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/foliage.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/modeling.h"
#include "captures/scenarios/painting.h"
#include "captures/scenarios/parts.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace zone {
namespace {

constexpr glm::dvec3 fire{0.9, 0.1, -3.4};
const Pose hut{.position = {-3.4, 0, -4.2}, .yaw = -0.35};
constexpr glm::vec3 towards_sun{0.3f, 0.2f, -0.93f};

/// 0 dry, 1 under water: hollows of the concrete, 6 m a tile.
float puddles(glm::vec2 uv) { return std::clamp((tiling_noise(uv, 4, 71) - 0.52f) * 12, 0.0f, 1.0f); }

/// Slabs of 2 m, cracked and stained; where water stands it is dark, flat and smooth.
std::uint32_t wet_concrete(FrameBuilder& builder) {
    const auto joint = [](glm::vec2 uv) {
        const glm::vec2 within = glm::fract(uv * 3.0f), border = glm::min(within, 1.0f - within);
        return std::min(border.x, border.y) < 0.014f;
    };
    Material material = lambert("wet concrete", glm::vec3(1));
    material.lighting_model = LightingModel::ggx;
    material.base_color_texture.texture = builder.add(painted("concrete", {.edge = 256}, [joint](glm::vec2 uv) {
        const float stain = 0.7f + 0.5f * tiling_noise(uv, 6, 72), grain = 0.9f + 0.2f * tiling_noise(uv, 64, 73);
        const glm::vec3 dry = glm::vec3(0.25f, 0.24f, 0.22f) * (stain * grain * (joint(uv) ? 0.45f : 1.0f));
        return glm::vec4(dry * (1 - 0.5f * puddles(uv)), 1);
    }));
    const std::array<float, 6> tile = {1.0f / 6, 0, 0, 0, 1.0f / 6, 0};
    material.base_color_texture.transform = tile;
    material.normal_texture.texture = builder.add(relief("concrete relief", 128, [joint](glm::vec2 uv) {
        return 0.0016f * (tiling_noise(uv, 24, 74) + (joint(uv) ? 0.0f : 0.6f)) * (1 - puddles(uv));
    }));
    material.normal_texture.transform = tile;
    material.metallic_roughness_texture.texture =
        builder.add(painted("concrete gloss", {.edge = 128, .format = TextureFormat::rgba8_unorm}, [](glm::vec2 uv) {
            return glm::vec4(1, glm::mix(0.38f + 0.2f * tiling_noise(uv, 12, 75), 0.06f, puddles(uv)), 0, 1);
        }));
    material.metallic_roughness_texture.transform = tile;
    return builder.add(material);
}

std::uint32_t boards(FrameBuilder& builder, const char* name, glm::vec3 color) {
    Material material = lambert(name, glm::vec3(1));
    material.base_color_texture.texture = builder.add(painted(name, {.edge = 64}, [color](glm::vec2 uv) {
        const float row = std::floor(uv.y * 6), within = uv.y * 6 - row;
        const float shade = 0.65f + 0.5f * hashed(std::int64_t(row), 3, 81), grain = 0.8f + 0.4f * tiling_noise(uv, 16, 82);
        return glm::vec4(color * (shade * grain * (within < 0.08f ? 0.3f : 1.0f)), 1);
    }));
    return builder.add(material);
}

void add_ground(FrameBuilder& builder) {
    Mesh yard, meadow;
    yard.name = "yard";
    part::box(yard, {-7, -0.3f, -10}, {7, 0, 9});
    builder.draw(builder.add(std::move(yard)), wet_concrete(builder), {});
    part::box(meadow, {-70, -0.4f, -90}, {70, -0.02f, 30});
    builder.draw(builder.add(std::move(meadow)), builder.add(lambert("meadow", {0.09f, 0.1f, 0.035f})), {});
}

/// Two walls and a roof that keeps the floor dry; a table and a lamp below it.
void add_hut(FrameBuilder& builder) {
    Parts parts(builder);
    const std::uint32_t wood = boards(builder, "weathered boards", {0.26f, 0.2f, 0.15f});
    const std::uint32_t rust = builder.add(lambert("rusty sheet", {0.3f, 0.13f, 0.07f}));
    Mesh &walls = parts.of(wood), &roof = parts.of(rust);
    part::box(walls, {-2.1f, 0, -1.6f}, {-2.0f, 2.3f, 1.6f});
    part::box(walls, {-2.0f, 0, -1.6f}, {1.4f, 2.4f, -1.5f});
    part::box(walls, {-2.0f, 0, 1.5f}, {-1.9f, 2.4f, 1.6f});
    part::box(walls, {-2, 0, -1.5f}, {1.4f, 0.06f, 1.5f});
    for (const float z : {-1.5f, 1.4f}) part::box(walls, {1.3f, 0, z}, {1.4f, 2.5f, z + 0.1f});
    part::sheet(roof, {40, 1}, {4, 4}, [](glm::vec2 t) {  // corrugated, both sides seen
        return glm::vec3(-2.4f + 4.3f * t.x, 2.42f + 0.35f * t.x + 0.03f * std::sin(t.x * 120), 1.95f - 3.9f * t.y);
    });
    builder.frame.materials[rust].double_sided = true;
    part::box(walls, {-1.6f, 0.7f, -1.1f}, {-0.4f, 0.76f, -0.3f});
    for (const float x : {-1.5f, -0.55f}) part::box(walls, {x, 0.06f, -0.8f}, {x + 0.08f, 0.7f, -0.6f});
    part::box(walls, {-0.3f, 0.06f, 0.5f}, {0.4f, 0.55f, 1.1f});
    parts.draw(hut);
    const glm::dvec3 lamp_at(transform(hut) * glm::dvec4(-0.9, 1.75, 0, 1));
    Material bulb = lambert("lamp", glm::vec3(0.1f));
    bulb.emissive = {7, 4, 1.6f};
    builder.draw(builder.add(sphere(0.06f, 12)), builder.add(bulb), {.position = lamp_at}).casts_shadow = false;
    Light lamp;
    lamp.name = "lamp in the hut";
    lamp.position = lamp_at;
    lamp.intensity = {13, 8, 3.6f};
    lamp.range = 6;
    lamp.shadow = {.casts = true, .map_size = 256, .bias = 0.03f, .soft = false};
    builder.frame.lights.push_back(lamp);
}

/// A tank on legs, a leaning frame with what is left of its pane, barrels, posts.
void add_wrecks(FrameBuilder& builder) {
    Parts parts(builder);
    Material rusty = lambert("tank", {0.24f, 0.12f, 0.075f});
    rusty.lighting_model = LightingModel::ggx;
    rusty.roughness = 0.5f;
    const std::uint32_t rust = builder.add(rusty), wood = builder.add(lambert("posts", {0.17f, 0.13f, 0.1f}));
    constexpr glm::vec2 tank[] = {{0.0f, 3.5f}, {0.7f, 3.35f}, {0.85f, 3.2f}, {0.85f, 1.9f}, {0.7f, 1.75f}, {0.0f, 1.65f}};
    constexpr glm::vec2 barrel[] = {{0.0f, 0.86f},   {0.27f, 0.86f}, {0.29f, 0.88f}, {0.29f, 0.6f},
                                    {0.305f, 0.58f}, {0.29f, 0.56f}, {0.29f, 0.0f}};
    part::turned(parts.of(rust), tank, {4.2f, 0, -6.5f}, 28);
    for (const glm::vec2 leg : {glm::vec2(-0.6f, -0.6f), {0.6f, -0.6f}, {-0.6f, 0.6f}, {0.6f, 0.6f}})
        part::beam(parts.of(rust), {4.2f + leg.x, 0, -6.5f + leg.y}, {4.2f + 0.8f * leg.x, 1.9f, -6.5f + 0.8f * leg.y},
                   {0.04f, 0.04f});
    for (const glm::vec3 foot : {glm::vec3(2.5f, 0, -5.2f), {3.1f, 0, -4.8f}, {-5.3f, 0, -1.6f}})
        part::turned(parts.of(rust), barrel, foot, 20);
    for (int i = 0; i < 9; ++i) {
        const float x = -9 + 2.3f * float(i), lean = 0.15f * std::sin(5.0f * float(i));
        part::beam(parts.of(wood), {x, -0.1f, -10.6f}, {x + lean, 1.25f, -10.6f}, {0.05f, 0.05f});
        if (i == 0 || i == 5) continue;
        for (const float y : {0.55f, 1.1f})
            part::beam(parts.of(wood), {x - 2.3f, y, -10.55f}, {x, y + 0.05f, -10.55f}, {0.045f, 0.02f});
    }
    part::beam(parts.of(wood), {1.7f, 0, -1.2f}, {1.75f, 1.5f, -1.35f}, {0.04f, 0.04f});
    part::beam(parts.of(wood), {2.9f, 0, -1.6f}, {2.95f, 1.5f, -1.75f}, {0.04f, 0.04f});
    part::beam(parts.of(wood), {1.7f, 1.5f, -1.35f}, {3.0f, 1.5f, -1.75f}, {0.04f, 0.04f});
    for (int i = 0; i < 7; ++i) {  // logs of the fire
        const float angle = 0.9f * float(i);
        const glm::vec3 at(fire);
        part::beam(parts.of(wood), at + glm::vec3(0.4f * std::cos(angle), -0.06f, 0.4f * std::sin(angle)),
                   at + glm::vec3(0, 0.2f, 0), {0.04f, 0.04f});
    }
    parts.draw({});
    Material pane = glass("pane", {0.6f, 0.8f, 0.75f});
    pane.lighting_model = LightingModel::ggx;
    pane.base_color = glm::vec4(glm::vec3(0.02f), 1);
    pane.roughness = 0.15f;
    const std::uint32_t green = builder.add(pane), sheet = builder.add(quad({0.6f, 0.5f})),
                        shard = builder.add(quad({0.3f, 0.4f}));
    builder.draw(sheet, green, {.position = {2.32, 0.95, -1.47}, .yaw = 0.3});
    builder.draw(shard, green, {.position = {2.55, 0.75, -1.45}, .yaw = -0.5});
}

void add_wood(FrameBuilder& builder) {
    const std::uint32_t leaf = builder.add(masked("leaves", builder.add(leaf_spray(builder.seed(), 34, 0.24f))));
    const std::uint32_t grass = builder.add(masked("grass", builder.add(grass_blades(builder.seed() + 2))));
    const std::uint32_t ball = builder.add(crown(builder.seed() + 1, 56, 0.44f)), blades = builder.add(tuft());
    const std::uint32_t bark = builder.add(lambert("bark", {0.1f, 0.075f, 0.06f}));
    Mesh trunks;
    trunks.name = "trunks";
    Random random(builder.seed() + 3);
    for (int i = 0; i < 16; ++i) {
        const double x = -17 + 2.3 * i + random.between(-0.7, 0.7), z = -15 - random.between(0.0, 7.0);
        const double height = random.between(3.2, 4.8), radius = random.between(1.5, 2.3);
        if (i == 9) continue;  // the gap through which the sun is seen
        part::beam(trunks, {x, -0.2, z}, {x + 0.2, height, z}, {0.13f, 0.13f});
        builder.draw(ball, leaf, {.position = {x, height, z}, .yaw = x, .scale = glm::dvec3(radius)});
        if (i % 3 == 0) builder.draw(ball, leaf, {.position = {x + 1.1, 0.6, z + 1.5}, .yaw = z, .scale = glm::dvec3(0.9)});
    }
    builder.draw(builder.add(std::move(trunks)), bark, {});
    for (int i = 0; i < 90; ++i) {
        const double around = random.unit(), tall = random.between(0.25, 0.6), yaw = random.between(0.0, 3.0);
        const glm::dvec3 foot =
            i % 3 == 0 ? glm::dvec3(i % 2 == 0 ? -7.2 - 2 * random.unit() : 7.2 + 2 * random.unit(), 0, 4 - 14 * around)
                       : glm::dvec3(-10 + 20 * around, 0, -10.3 - 4 * random.unit());
        builder.draw(blades, grass, {.position = foot, .yaw = yaw, .scale = glm::dvec3(tall)});
    }
}

/// Clouds before the low sun, 60 m away: fog takes more than half of their light.
void add_sky(FrameBuilder& builder) {
    Material clouds = lambert("sky", glm::vec3(0));
    clouds.emissive = glm::vec3(4.5f);
    clouds.emissive_texture.texture = builder.add(painted("sky", {.edge = 128}, [](glm::vec2 uv) {
        const glm::vec2 from_sun = (uv - glm::vec2(0.64f, 0.53f)) * glm::vec2(1.8f, 1.0f);
        const float near_sun = std::exp(-9 * glm::length(from_sun)), up = 1 - uv.y;
        const float banks = fractal_noise(uv * glm::vec2(5, 22), 91), gap = std::clamp((banks - 0.45f) * 5, 0.0f, 1.0f);
        const glm::vec3 sky =
            glm::mix(glm::vec3(0.34f, 0.18f, 0.09f), glm::vec3(0.055f, 0.085f, 0.16f), std::clamp(up * 1.7f - 0.6f, 0.0f, 1.0f));
        const glm::vec3 lit = sky * (1 - 0.45f * gap) + glm::vec3(0.9f, 0.42f, 0.14f) * near_sun;
        return glm::vec4(glm::min(lit, glm::vec3(1)), 1);
    }));
    clouds.emissive_texture.transform = {1, 0, 0, 0, 1, 0};
    builder.draw(builder.add(quad({80, 40})), builder.add(clouds), {.position = {0, 18, -60}}).casts_shadow = false;
}

/// Smoke of the fire, lit by the sun from behind and by the flames from below; rain; flames and sparks.
void add_particles(FrameBuilder& builder) {
    Emitter smoke, rain, flames;
    smoke.name = "smoke", rain.name = "rain", flames.name = "flames";
    smoke.texture = builder.add(puff(builder.seed()));
    smoke.soft_depth_fade = 0.3f;
    flames.texture = builder.add(glow());
    rain.texture = builder.add(streak());
    flames.alpha_mode = AlphaMode::additive;
    Random random(builder.seed() + 4);
    const auto around = [&](double width) {
        const double x = random.between(-width, width), z = random.between(-width, width);
        return glm::dvec3(x, 0, z);
    };
    for (int i = 0; i < 260; ++i) {
        const double age = std::fmod((i + 0.5) / 260 + 0.2 * builder.progress(), 1.0);
        const glm::dvec3 at = fire + glm::dvec3(-1.5 * age, 3.4 * age, 0.5 * age) + around(0.12 + 0.6 * age);
        const float flame = float(std::exp(-5 * age));
        smoke.particles.push_back({.center = at,
                                   .size = float(0.14 + 0.6 * age),
                                   .rotation = random.between(0.0f, 6.28f),
                                   .color = glm::vec3(0.42f, 0.3f, 0.24f) + glm::vec3(0.9f, 0.35f, 0.08f) * flame,
                                   .alpha = float(0.16 * std::pow(1 - age, 1.2))});
    }
    for (int i = 0; i < 70; ++i) {
        const double age = std::fmod(random.unit() + 0.6 * builder.progress(), 1.0);
        const glm::vec3 heat = glm::mix(glm::vec3(3, 1.5f, 0.4f), glm::vec3(0.8f, 0.12f, 0.01f), float(age));
        flames.particles.push_back({.center = fire + glm::dvec3(0, 0.1 + 0.7 * age, 0) + around(0.2 * (1 - age)),
                                    .size = float(0.17 * (1.2 - age)),
                                    .color = heat * 0.5f});
    }
    const glm::dmat4 to_hut = glm::inverse(transform(hut));
    for (int i = 0; i < 500; ++i) {
        const double z = 4 - 14 * random.unit(), x = random.between(-6.0, 6.0);
        const double y = 5 * std::fmod(random.unit() + 2.3 * (1 - builder.progress()), 1.0);
        const glm::dvec3 from_hut(to_hut * glm::dvec4(x, y, z, 1));
        if (std::abs(from_hut.x + 0.25) < 2.2 && std::abs(from_hut.z) < 2 && y < 2.6) continue;  // below its roof
        rain.particles.push_back(
            {.center = {x, y, z}, .size = 0.13f, .rotation = -0.14f, .color = {0.75f, 0.55f, 0.42f}, .alpha = 0.22f});
    }
    builder.frame.emitters.push_back(std::move(smoke));
    builder.frame.emitters.push_back(std::move(rain));
    builder.frame.emitters.push_back(std::move(flames));
    Light glow_of_fire;
    glow_of_fire.name = "fire";
    glow_of_fire.type = LightType::sphere;
    glow_of_fire.position = fire + glm::dvec3(0, 0.4, 0);
    glow_of_fire.source_radius = 0.2f;
    glow_of_fire.intensity = glm::vec3(6.5f, 2.4f, 0.5f) * (9 + 0.6f * float(std::sin(40 * builder.progress())));
    glow_of_fire.range = 7;
    builder.frame.lights.push_back(glow_of_fire);
}

void add_dusk(Frame& frame) {
    frame.sun.direction = -glm::normalize(towards_sun);
    frame.sun.irradiance = {8.5f, 4.2f, 1.7f};
    frame.sun.shadow = {.casts = true, .map_size = 512, .bias = 0.03f, .soft = false};
    frame.sun.cascades = 2;
    frame.sun.shadow_distance = 32;
    frame.sun.shafts = true;
    frame.hemisphere = {.sky = {0.13f, 0.16f, 0.25f}, .ground = {0.09f, 0.07f, 0.055f}};
    frame.background = {0.3f, 0.33f, 0.42f};
    frame.fog = {.density = 0.014f, .color = {0.42f, 0.27f, 0.2f}};
    frame.rain = {.intensity = 0.35f, .wetness = 0.85f, .direction = glm::normalize(glm::vec3(-0.15f, -1, 0.05f))};
    frame.lens = {.bloom = 0.12f,
                  .bloom_threshold = 1,
                  .auto_exposure = true,
                  .exposure_speed = 1,
                  .focus_distance = 0,
                  .aperture = 0,
                  .distortion = false};
    frame.film = {.grain = 0.02f, .fade = 0, .white = 1.7f};
}

}  // namespace
}  // namespace zone

Frame zone_at_dusk(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    const double walked = 0.5 * (builder.progress() - 1);
    builder.look({.eye = {0.6, 1.6, 6 - walked}, .target = {0.2, 1.5, -6 - walked}, .vertical_fov = 0.8, .swing = 0.06});
    zone::add_ground(builder);
    zone::add_hut(builder);
    zone::add_wrecks(builder);
    zone::add_wood(builder);
    zone::add_sky(builder);
    zone::add_particles(builder);
    zone::add_dusk(builder.frame);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
