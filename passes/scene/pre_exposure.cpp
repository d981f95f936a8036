#include "passes/scene/pre_exposure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/light_types.h"
#include "passes/scene/draw_bounds.h"

namespace strata {
namespace {

// Exposed light within these is stored as well as light of 1: half floats have 10 bits from 2^-14 to 2^16, and what techniques
// sum and weigh takes the rest.
constexpr double least_white = 0x1p-6, most_white = 0x1p6;

double brightest(const glm::vec3& color) { return std::max({std::abs(color.x), std::abs(color.y), std::abs(color.z)}); }

/// Area of a light that a surface beside it sees, square meters.
double seen_area(const Light& light) {
    const double radius = double(light.source_radius), disc = std::numbers::pi * radius * radius;
    const LightShape shape = facts_of(light.type).shape;
    if (shape == LightShape::rectangle) return 4 * double(light.half_extent.x) * double(light.half_extent.y);
    return shape == LightShape::tube ? disc + 4 * radius * double(light.half_extent.x) : disc;
}

/// The box around those of all draws, in world space; nothing without draws.
std::optional<BoundingBox> scene_box(const Frame& frame) {
    std::vector<BoundingBox> of_meshes;
    of_meshes.reserve(frame.meshes.size());
    for (const Mesh& mesh : frame.meshes) of_meshes.push_back(box_around(mesh.positions));
    std::optional<BoundingBox> scene;
    for (const Draw& draw : frame.draws) {
        for (const glm::dvec3& corner : corners_of(of_meshes[draw.mesh])) {
            const glm::dvec3 placed(draw.to_world * glm::dvec4(corner, 1));
            if (!scene) scene = BoundingBox{placed, placed};
            scene->low = glm::min(scene->low, placed), scene->high = glm::max(scene->high, placed);
        }
    }
    return scene;
}

/// From the light to what it lights: a quarter of its range, or as far as the scene's middle, where that is nearer. Within the
/// scene it is half of the scene's radius.
double lit_distance(const Light& light, const std::optional<BoundingBox>& scene) {
    const double own = double(light.range) / 4;
    if (!scene) return own;
    const double radius = glm::distance(scene->low, scene->high) / 2;
    const double away = std::max(glm::distance(light.position, (scene->low + scene->high) / 2.), radius / 2);
    return away > 0 ? std::min(own, away) : own;
}

/// Radiance of a white surface that faces the light there.
double lit_white(const Light& light, const std::optional<BoundingBox>& scene) {
    const double intensity = brightest(light.intensity);
    const LightShape shape = facts_of(light.type).shape;
    if (shape == LightShape::parallel) return intensity / std::numbers::pi;
    const double distance = lit_distance(light, scene), sphere = distance * distance * std::numbers::pi;
    if (!(sphere > 0)) return 0;
    return shape == LightShape::point ? intensity / sphere : intensity * std::min(1., seen_area(light) / sphere);
}

double lit_level(const Frame& frame) {
    double level = brightest(frame.sun.irradiance) / std::numbers::pi;
    for (const glm::vec3& color : {frame.hemisphere.sky, frame.hemisphere.ground}) level = std::max(level, brightest(color));
    if (frame.fog.density > 0) level = std::max(level, brightest(frame.fog.color));
    const std::optional<BoundingBox> scene = frame.lights.empty() ? std::nullopt : scene_box(frame);
    for (const Light& light : frame.lights) level = std::max(level, lit_white(light, scene));
    return level;
}

bool is_usable(double factor) {
    return factor >= double(std::numeric_limits<float>::min()) && factor <= double(std::numeric_limits<float>::max());
}

}  // namespace

std::optional<double> white_level(const Frame& frame) {
    const double level = lit_level(frame);
    return level > 0 && is_usable(1 / level) ? std::optional(level) : std::nullopt;
}

double pre_exposure(const Frame& frame) {
    const double exposure = double(frame.view.exposure);
    const std::optional<double> white = white_level(frame);
    if (!white) return is_usable(exposure) ? exposure : 1;
    const double exposed = exposure * *white;
    return is_usable(exposure) && exposed >= least_white && exposed <= most_white ? exposure : 1 / *white;
}

void pre_expose(Frame& frame, double factor) {
    if (factor == 1) return;
    const auto scale = [&](glm::vec3& color) { color = glm::vec3(glm::dvec3(color) * factor); };
    frame.pre_exposure *= factor;
    frame.view.exposure = static_cast<float>(double(frame.view.exposure) / factor);
    scale(frame.sun.irradiance);
    for (Light& light : frame.lights) scale(light.intensity);
    scale(frame.hemisphere.sky);
    scale(frame.hemisphere.ground);
    scale(frame.background);
    scale(frame.fog.color);
    for (Material& material : frame.materials) scale(material.emissive);
    for (Emitter& emitter : frame.emitters)
        for (Particle& particle : emitter.particles) {
            scale(particle.color);
            scale(particle.emissive);
        }
}

}  // namespace strata
