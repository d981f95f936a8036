// One light of every type before a wall and over a floor of strips: matt, Burley, rough, glossy, metal.
#include <array>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

struct Strip {
    const char* name;
    LightingModel model;
    float roughness, metallic;
};

// From the wall to the eye.
constexpr std::array<Strip, 5> strips = {{{"matt", LightingModel::lambert, 1, 0},
                                          {"Burley", LightingModel::burley, 0.6f, 0},
                                          {"rough", LightingModel::ggx, 0.8f, 0.5f},
                                          {"glossy", LightingModel::ggx, 0.5f, 0},
                                          {"metal", LightingModel::ggx, 0.3f, 1}}};

void add_bare_room(FrameBuilder& builder) {
    const std::uint32_t slab = builder.add(box({4, 0.1f, 0.4f}));
    double z = -1.6;
    for (const Strip& strip : strips) {
        Material material = lambert(strip.name, {0.7f, 0.6f, 0.5f});
        material.lighting_model = strip.model;
        material.roughness = strip.roughness;
        material.metallic = strip.metallic;
        builder.draw(slab, builder.add(material), {.position = {0, -0.1, z}});
        z += 0.8;
    }
    Material wall = lambert("wall", glm::vec3(0.6f));
    wall.lighting_model = LightingModel::ggx;
    wall.roughness = 0.6f;
    builder.draw(builder.add(box({4, 1.6f, 0.1f})), builder.add(wall), {.position = {0, 1.6, -2.1}});
}

/// A light of 2 m reach.
Light light(const char* name, LightType type, glm::dvec3 position, glm::vec3 intensity) {
    Light result;
    result.name = name;
    result.type = type;
    result.position = position;
    result.intensity = intensity;
    result.range = 2;
    return result;
}

void add_points(Frame& frame, double sway, std::uint32_t picture) {
    Light omni = light("bulb", LightType::omni, {-3.3 + sway, 0.8, -1}, {2, 1.6f, 1});
    omni.clip_planes = {{.normal = {0, 1, 0}, .distance = -0.1}, {.normal = {0, 0, -1}, .distance = 0.4}};  // the wall alone
    frame.lights.push_back(omni);
    Light round = light("slide projector", LightType::round_spot, {-2.1, 1.4, -0.2}, glm::vec3(9));
    round.direction = glm::normalize(glm::vec3(0.1f, -0.45f, -1));
    round.axis_u = glm::normalize(glm::cross(round.direction, glm::vec3(0, 1, 0)));
    round.inner_angle = 0.3f;
    round.outer_angle = 0.45f;
    round.range = 3.5f;
    round.texture = picture;
    frame.lights.push_back(round);
    Light square = light("barn door", LightType::square_spot, {-1.1, 1.9, 0.4}, {4, 5, 7});
    square.direction = {0, -1, 0};
    square.outer_angle = 0.25f;
    square.inner_angle = 0.5f;
    square.range = 3;
    frame.lights.push_back(square);
    Light dark = light("dark", LightType::omni, {2.2, 0.4, 0.6}, glm::vec3(-0.15f));
    dark.range = 1;
    frame.lights.push_back(dark);
    Light moon = light("moon", LightType::directional, {0, 0, 0}, {0.05f, 0.06f, 0.1f});
    moon.direction = glm::normalize(glm::vec3(0.4f, -1, -0.6f));
    frame.lights.push_back(moon);
}

void add_areas(Frame& frame, double sway, std::uint32_t picture) {
    Light tube = light("neon tube", LightType::tube, {0, 0.5 + sway, -1.2}, {3, 7, 9});
    tube.axis_u = glm::normalize(glm::vec3(1, 0.3f, 0.2f));
    tube.half_extent = {0.45f, 0};
    tube.source_radius = 0.04f;
    frame.lights.push_back(tube);
    Light sphere = light("globe", LightType::sphere, {1.1, 0.5, 0.2}, {6, 4, 2});
    sphere.source_radius = 0.18f;
    frame.lights.push_back(sphere);
    Light disc = light("lamp", LightType::disc, {2.1, 1.1, -0.9}, {5, 5, 4});
    disc.direction = glm::normalize(glm::vec3(0, -1, -0.5f));
    disc.source_radius = 0.25f;
    frame.lights.push_back(disc);
    Light screen = light("screen", LightType::rectangle, {3.2, 0.7, -0.8}, glm::vec3(4));
    screen.direction = glm::normalize(glm::vec3(-1, -0.1f, 0.3f));
    screen.axis_u = glm::normalize(glm::cross(screen.direction, glm::vec3(0, 1, 0)));
    screen.half_extent = {0.6f, 0.4f};
    screen.texture = picture;
    frame.lights.push_back(screen);
}

}  // namespace

Frame light_types(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 1.7, 3.6}, .target = {0, 0.7, -1}, .vertical_fov = 0.75, .swing = 0.1});
    add_bare_room(builder);
    const std::uint32_t slide = builder.add(checker(4, {1, 0.8f, 0.3f}, {0.05f, 0.1f, 0.3f}));
    const double sway = 0.2 * (1 - builder.progress());
    add_points(builder.frame, sway, slide);
    add_areas(builder.frame, sway, slide);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
