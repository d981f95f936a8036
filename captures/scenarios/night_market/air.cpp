// What floats in the air of the night market: steam, smoke, haze, rain, sparks, and the glow around neon. Puffs and drops are
// recorded as lit by the lamps around them.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/night_market/night_market.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/random.h"

namespace strata::scenario::market {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// What rises from a place: everything about a puff follows from its number and the time.
struct Plume {
    glm::dvec3 source;
    glm::dvec3 drift;  ///< meters it moves while it lives
    int puffs = 0;
    double width = 0.1;     ///< of the source
    glm::dvec2 size{0, 0};  ///< of a puff when young and when old
    float alpha = 0.2f;
    float albedo = 0.8f;
};

void add_plume(std::vector<Particle>& particles, const Plume& plume, const FrameBuilder& builder, const Lamps& lamps) {
    for (int i = 0; i < plume.puffs; ++i) {
        Random random(builder.seed() * 0x10001 + static_cast<std::uint64_t>(i) * 31 + static_cast<std::uint64_t>(plume.puffs));
        const double age = std::fmod((i + 0.5) / plume.puffs + 0.25 * builder.progress(), 1.0),
                     spread = plume.width + 0.9 * plume.size.y * age;
        const double angle = random.between(0.0, full_turn), radius = spread * std::sqrt(random.unit());
        const double curl = 0.12 * std::sin(7 * age + 0.3 * i) * age;
        Particle puff;
        puff.center = plume.source + plume.drift * std::pow(age, 0.8) +
                      glm::dvec3(radius * std::cos(angle) + curl, 0.5 * radius * std::sin(2 * angle), radius * std::sin(angle));
        puff.size = static_cast<float>(glm::mix(plume.size.x, plume.size.y, age) * random.between(0.75, 1.25));
        puff.rotation = random.between(0.0f, 6.28f) + static_cast<float>(builder.progress());
        puff.alpha = plume.alpha * static_cast<float>(std::pow(1 - age, 1.3)) * random.between(0.6f, 1.0f);
        puff.color = lamps.scattered(puff.center) * plume.albedo;
        particles.push_back(puff);
    }
}

Emitter soft(const char* name, std::uint32_t texture, float fade) {
    Emitter emitter;
    emitter.name = name;
    emitter.texture = texture;
    emitter.soft_depth_fade = fade;
    return emitter;
}

void add_smoke_and_steam(FrameBuilder& builder, const Lamps& lamps, std::uint32_t puff) {
    Emitter steam = soft("steam", puff, 0.12f), smoke = soft("smoke", puff, 0.3f);
    add_plume(steam.particles,
              {.source = pot, .drift = {-0.25, 1.5, 0.2}, .puffs = 110, .width = 0.12, .size = {0.1, 0.42}, .alpha = 0.42f},
              builder, lamps);
    add_plume(smoke.particles,
              {.source = grill,
               .drift = {-2.3, 2.5, 1.4},
               .puffs = 420,
               .width = 0.25,
               .size = {0.12, 0.75},
               .alpha = 0.3f,
               .albedo = 0.6f},
              builder, lamps);
    builder.frame.emitters.push_back(std::move(steam));
    builder.frame.emitters.push_back(std::move(smoke));
}

/// Large thin puffs along the street, thicker where it ends.
void add_haze(FrameBuilder& builder, const Lamps& lamps, std::uint32_t puff) {
    Emitter haze = soft("haze", puff, 0.6f);
    Random random(builder.seed() + 5);
    for (int i = 0; i < 150; ++i) {
        const double away = random.unit(), z = -4 - 16 * away, drift = 0.4 * builder.progress();
        const double x = random.between(-2.4, 2.4) + drift, y = random.between(0.1, 1.0) + 2.2 * random.unit() * random.unit();
        Particle cloud;
        cloud.center = {x, y, z};
        cloud.size = random.between(0.6f, 1.3f);
        cloud.rotation = random.between(0.0f, 6.28f);
        cloud.alpha = random.between(0.02f, 0.06f) + 0.04f * static_cast<float>(away);
        cloud.color = lamps.scattered(cloud.center) * 0.8f;
        haze.particles.push_back(cloud);
    }
    builder.frame.emitters.push_back(std::move(haze));
}

/// Not below the awnings.
bool is_sheltered(glm::dvec3 p) {
    for (const glm::dvec2 stall : {glm::dvec2(1.5, -5.3), {-1.6, -3.6}, {-1.6, -6.6}, {1.6, -10.4}, {1.5, -15.6}})
        if (glm::distance(glm::dvec2(p.x, p.z), stall) < 1.35 && p.y < 2.5) return true;
    return p.x < 0.35 && p.z < -9;
}

void add_rain(FrameBuilder& builder, const Lamps& lamps) {
    Emitter rain = soft("rain", builder.add(streak()), 0);
    Random random(builder.seed() + 6);
    for (int i = 0; i < 900; ++i) {
        const double z = -1.5 - 13 * random.unit(), x = random.between(-2.5, 2.5), fallen = random.unit();
        const float length = random.between(0.09f, 0.17f), faint = random.between(0.12f, 0.4f);
        Particle drop;
        drop.center = {x, 5 * std::fmod(fallen + 3.7 * (1 - builder.progress()), 1.0), z};
        if (is_sheltered(drop.center)) continue;
        drop.size = length;
        drop.rotation = 0.1f;
        drop.alpha = faint;
        drop.color = lamps.scattered(drop.center) * 1.6f + glm::vec3(0.02f, 0.03f, 0.05f);
        rain.particles.push_back(drop);
    }
    builder.frame.emitters.push_back(std::move(rain));
}

/// Light only: sparks over the grill, and what the damp air shows around lamps and neon.
void add_glow(FrameBuilder& builder) {
    const std::uint32_t picture = builder.add(glow());
    Emitter sparks;
    sparks.name = "sparks";
    sparks.texture = picture;
    sparks.alpha_mode = AlphaMode::additive;
    Random random(builder.seed() + 8);
    for (int i = 0; i < 45; ++i) {
        const double age = std::fmod(random.unit() + 0.5 * builder.progress(), 1.0), x = random.between(-0.25, 0.25),
                     z = random.between(-0.2, 0.2);
        Particle spark;
        spark.center = grill + glm::dvec3(x - 0.6 * age * age + 0.08 * std::sin(20 * age + i), 1.3 * age, z);
        spark.size = random.between(0.012f, 0.024f);
        spark.color = glm::vec3(6, 2.2f, 0.4f) * static_cast<float>(1.2 - age);
        sparks.particles.push_back(spark);
    }
    builder.frame.emitters.push_back(std::move(sparks));
    Emitter halos = soft("glow", picture, 0.3f);
    halos.alpha_mode = AlphaMode::additive;
    const auto halo = [&](glm::dvec3 center, float size, glm::vec3 color) {
        halos.particles.push_back({.center = center, .size = size, .color = color});
    };
    for (const double x : {-1.7, -1.15, -0.6, -0.05}) halo({x, 3.27, -8.7}, 0.6f, {0.14f, 0.02f, 0.065f});
    for (const double x : {1.35, 1.7, 2.05}) halo({x, 2.7, -4.6 + 0.69 * (x - 1.35)}, 0.4f, {0.07f, 0.025f, 0.004f});
    for (const double y : {3.2, 3.8, 4.4}) halo({1.65, y, -11.6}, 0.7f, {0.012f, 0.08f, 0.11f});
    for (const Light& light : builder.frame.lights)
        if (light.type == LightType::sphere) halo(light.position, 0.8f, glm::normalize(light.intensity) * 0.07f);
    builder.frame.emitters.push_back(std::move(halos));
}

}  // namespace

void add_air(FrameBuilder& builder, const Lamps& lamps) {
    const std::uint32_t soft_puff = builder.add(puff(builder.seed()));
    add_haze(builder, lamps, soft_puff);
    add_smoke_and_steam(builder, lamps, soft_puff);
    add_rain(builder, lamps);
    add_glow(builder);
}

}  // namespace strata::scenario::market
