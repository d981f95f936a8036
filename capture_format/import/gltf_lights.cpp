#include "capture_format/import/gltf_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"

namespace strata::gltf {
namespace {

/// glTF lights without a range reach infinitely far; ours end where less than this share of a white surface's light is left, or
/// of an irradiance of 1, but there only as far as the scene is wide.
constexpr double unnoticed_share = 1.0 / 256;
/// A scene ends within three times the distance that lights are judged at.
constexpr double scene_ends_within = 3;
/// Half angles from here on are no spot: the tangent of a shadow map's frustum grows without bound.
constexpr double widest_spot = 0.49 * std::numbers::pi;

glm::vec3 any_perpendicular(glm::vec3 axis) {
    return glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
}

/// Range of a light that has none, until end_lights().
constexpr float endless = std::numeric_limits<float>::max();

Light convert_light(const LightSource& source, const glm::dmat4& to_world) {
    Light light;
    light.name = source.name;
    light.position = glm::dvec3(to_world[3]);
    const glm::dvec3 forward = -glm::dvec3(to_world[2]);
    if (glm::length(forward) > 0) light.direction = glm::vec3(glm::normalize(forward));
    light.axis_u = any_perpendicular(light.direction);
    const glm::dvec3 intensity = source.color * source.intensity;
    light.intensity = glm::vec3(intensity);
    light.window = RangeWindow::quartic;
    light.range = source.range > 0 ? static_cast<float>(source.range) : endless;
    if (source.type == "directional") light.type = LightType::directional;
    if (source.type == "spot") {
        light.type = LightType::round_spot;
        const double outer = std::clamp(source.outer_angle, 1e-3, widest_spot);
        light.outer_angle = static_cast<float>(outer);
        light.inner_angle = static_cast<float>(std::clamp(source.inner_angle, 0.0, outer));
    }
    light.shadow.casts = facts_of(light.type).maps != LightMaps::none;
    return light;
}

/// What the specification of KHR_lights_punctual does not allow, and what becomes of it.
void warn_of_light(std::vector<std::string>& warnings, int number, const LightSource& source) {
    const auto warn = [&](const std::string& what) {
        warnings.push_back(fmt::format("light {} '{:.60}' {}", number, source.name, what));
    };
    if (source.type != "directional" && source.type != "point" && source.type != "spot")
        warn(fmt::format("has the unknown type '{:.60}'; a point light is used", source.type));
    if (source.intensity < 0) warn(fmt::format("has the intensity {:g}, which is below 0", source.intensity));
    constexpr double largest = std::numeric_limits<float>::max();
    if (std::abs(source.intensity) > largest)
        warn(fmt::format("has the intensity {:g}; a capture holds at most {:.2g}", source.intensity, largest));
    if (const glm::dvec3 c = source.color; c != glm::clamp(c, 0.0, 1.0))
        warn(fmt::format("has the color ({:g}, {:g}, {:g}); glTF allows 0 to 1", c.x, c.y, c.z));
    if (source.range < 0) warn(fmt::format("has the range {:g}, which is not above 0; it is ignored", source.range));
    if (source.type == "spot" && source.outer_angle > 1.0001 * std::numbers::pi / 2)  // some round the right angle up
        warn(fmt::format("has an outer cone of {:g} radians, more than a right angle; {:.3g} is used", source.outer_angle,
                         widest_spot));
    if (source.type == "spot" && source.inner_angle > source.outer_angle)
        warn(fmt::format("has an inner cone of {:g} and an outer of {:g} radians; the outer is used for both", source.inner_angle,
                         source.outer_angle));
}

double brightest(const glm::vec3& color) { return static_cast<double>(std::max({color.x, color.y, color.z})); }

double distance_to(const Bounds& scene, const Light& light) {
    return std::max(glm::length(light.position - scene.center()), scene.radius() * 0.5);
}

}  // namespace

std::vector<std::string> add_lights(Frame& frame, const Document& document, const Hierarchy& hierarchy,
                                    const std::vector<glm::dmat4>& to_world) {
    std::vector<std::string> warnings;
    bool has_sun = false;
    for (std::size_t step = 0; step < hierarchy.shown; ++step) {
        const auto index = static_cast<std::size_t>(hierarchy.steps[step].node);
        const Node& node = document.nodes[index];
        if (node.light < 0) continue;
        if (static_cast<std::size_t>(node.light) >= document.lights.size()) {
            warnings.push_back(fmt::format("node '{}' has light {}, which does not exist", node.name, node.light));
            continue;
        }
        warn_of_light(warnings, node.light, document.lights[static_cast<std::size_t>(node.light)]);
        const Light light = convert_light(document.lights[static_cast<std::size_t>(node.light)], to_world[index]);
        if (!has_range(light.type) && !has_sun) {
            has_sun = true;
            frame.sun.direction = light.direction;
            frame.sun.irradiance = light.intensity;
            frame.sun.shadow.casts = true;
        } else {
            if (!has_range(light.type))
                warnings.push_back(fmt::format("light {} '{:.60}' is another directional light than the sun; it casts no shadow",
                                               node.light, light.name));
            frame.lights.push_back(light);
        }
    }
    return warnings;
}

void add_default_light(Frame& frame) {
    frame.sun.direction = glm::normalize(glm::vec3(-0.5f, -1, -0.6f));
    frame.sun.irradiance = glm::vec3(2.6f, 2.5f, 2.3f);  // a white Lambert surface facing it reflects about 0.8
    frame.sun.shadow.casts = true;
    frame.hemisphere = {.sky = glm::vec3(0.45f, 0.5f, 0.6f), .ground = glm::vec3(0.2f, 0.18f, 0.16f)};
    frame.background = glm::vec3(0.25f, 0.3f, 0.38f);
}

void end_lights(Frame& frame, const Bounds& scene) {
    const double white = std::numbers::pi * white_radiance(frame, scene);
    for (Light& light : frame.lights) {
        if (light.range != endless) continue;
        const double intensity = std::max(brightest(light.intensity), 1e-6);
        const double in_scene = std::min(std::sqrt(intensity / unnoticed_share), scene_ends_within * distance_to(scene, light));
        light.range = static_cast<float>(std::max(in_scene, white > 0 ? std::sqrt(intensity / (unnoticed_share * white)) : 0));
    }
}

double white_radiance(const Frame& frame, const Bounds& scene) {
    double irradiance = brightest(frame.sun.irradiance);
    for (const Light& light : frame.lights) {
        const double distance = distance_to(scene, light);
        const bool reaches = !has_range(light.type) || distance < static_cast<double>(light.range);
        const double falloff = has_range(light.type) ? distance * distance : 1;
        if (reaches) irradiance += brightest(light.intensity) / falloff;
    }
    return irradiance / std::numbers::pi;
}

}  // namespace strata::gltf
