// Small emitters: light without coverage, and values that are no numbers.
#include <cmath>
#include <limits>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {

Frame additive_sparks(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -4}});
    builder.draw(builder.add(quad({8, 8})), builder.add(unlit("dark wall", {0.05f, 0.06f, 0.08f, 1})), {.position = {0, 0, -6}});
    builder.draw(builder.add(quad({1, 1})), builder.add(unlit("gray pane", {0.3f, 0.3f, 0.3f, 0.5f})),
                 {.position = {-0.9, 0, -3}});
    Emitter sparks;
    sparks.name = "sparks";
    sparks.texture = builder.add(glow());
    sparks.alpha_mode = AlphaMode::additive;
    Random random(builder.seed());
    for (int i = 0; i < 60; ++i) {
        const double age = builder.progress() * random.between(0.15, 0.75);  // seconds since they left the fountain
        const glm::dvec3 velocity{random.between(-1.6, 1.6), random.between(1.0, 4.0), random.between(-1.2, 1.2)};
        Particle particle;
        particle.center = glm::dvec3(0, -1, -4) + velocity * age - glm::dvec3(0, 4.9, 0) * age * age;
        particle.size = random.between(0.03f, 0.12f);
        particle.color = glm::vec3(0);
        particle.emissive = glm::vec3(3, 1.4f, 0.4f) * random.between(0.3f, 1.2f);
        particle.alpha = 1;
        sparks.particles.push_back(particle);
    }
    builder.frame.emitters.push_back(std::move(sparks));
    return std::move(builder.frame);
}

Frame nan_particles(std::uint32_t frame, const ScenarioOptions& options) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -4}});
    builder.draw(builder.add(quad({8, 8})), builder.add(unlit("wall", {0.4f, 0.4f, 0.4f, 1})), {.position = {0, 0, -6}});
    Emitter emitter;
    emitter.name = "not all numbers";
    emitter.texture = builder.add(glow());
    for (int i = 0; i < 12; ++i) {
        Particle particle;
        particle.center = {-1.5 + i % 4, 0.8 - 0.8 * (i / 4), -4 + 0.1 * i};
        particle.size = 0.8f;  // each overlaps its neighbors
        particle.rotation = static_cast<float>(0.3 * i + builder.progress());
        particle.color = {0.9f, 0.5f, 0.1f * static_cast<float>(i % 5)};
        particle.alpha = 0.6f;
        switch (i) {  // the others are ordinary
            case 1:
                particle.alpha = nan;
                break;
            case 3:
                particle.color.y = nan;
                break;
            case 5:
                particle.color = glm::vec3(infinity);
                break;
            case 6:
                particle.alpha = infinity;
                break;
            case 8:
                particle.emissive = {nan, -infinity, 0};
                break;
            case 10:
                particle.alpha = -1;
                break;
            default:
                break;
        }
        emitter.particles.push_back(particle);
    }
    builder.frame.emitters.push_back(std::move(emitter));
    return std::move(builder.frame);
}

namespace {

/// Eight layers over every pixel, whatever the extent and its shape: flakes are laid evenly over the view and a margin as wide as
/// half of the largest, so many that their areas add up. Squares without a texture, because the mips of a round one cover the
/// more of their quad the fewer pixels it has.
Frame storm_of(float thinnest, float thickest, std::uint32_t frame, const ScenarioOptions& options) {
    constexpr double layers = 8, vertical_fov = 0.8, smallest = 0.04, largest = 0.1;  // half an edge at a depth of 1 m
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -4}, .vertical_fov = vertical_fov, .swing = 0});
    builder.draw(builder.add(quad({60, 60})), builder.add(unlit("dusk", {0.25f, 0.2f, 0.3f, 1})), {.position = {0, 0, -22}});
    const double half_height = std::tan(vertical_fov / 2);
    const glm::dvec2 laid_over(half_height * options.width / options.height + largest, half_height + largest);
    const double mean_area = 4 * (smallest * smallest + smallest * largest + largest * largest) / 3;  // of edges drawn evenly
    const int count = static_cast<int>(layers * 4 * laid_over.x * laid_over.y / mean_area);
    Emitter storm;
    storm.name = "ash";
    Random random(builder.seed());
    for (int i = 0; i < count; ++i) {
        const double depth = 2 * std::pow(10, random.unit()), drift = 0.2 * builder.progress();
        const double across = std::fmod(random.unit() + drift, 1.0) * 2 - 1;
        const glm::dvec2 at = laid_over * glm::dvec2(across, random.between(-1.0, 1.0));
        Particle particle;
        particle.center = glm::dvec3(at, -1) * depth;
        particle.size = static_cast<float>(random.between(smallest, largest) * depth);
        particle.rotation = random.between(0.0f, 1.6f);
        particle.color = glm::mix(glm::vec3(0.9f, 0.6f, 0.3f), glm::vec3(0.2f, 0.3f, 0.5f), random.between(0.0f, 1.0f));
        particle.alpha = random.between(thinnest, thickest);
        storm.particles.push_back(particle);
    }
    builder.frame.emitters.push_back(std::move(storm));
    return std::move(builder.frame);
}

}  // namespace

Frame particle_storm(std::uint32_t frame, const ScenarioOptions& options) { return storm_of(0.1f, 0.6f, frame, options); }
/// Flakes of which two in a slice are more than a byte of optical depth holds.
Frame ash_storm(std::uint32_t frame, const ScenarioOptions& options) { return storm_of(0.85f, 1, frame, options); }

}  // namespace strata::scenario
