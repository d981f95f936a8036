// Opaque surfaces: none, a few, one in uniform light, and a table of materials.
#include <array>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {

Frame empty(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({});
    builder.frame.background = {0.1f, 0.2f, 0.3f};
    return std::move(builder.frame);
}

Frame opaque_only(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {2.5, 2, 4}, .target = {0, 0.6, 0}});
    const std::uint32_t cube = builder.add(box(glm::vec3(0.5f)));
    builder.draw(builder.add(box({6, 0.1f, 6})), builder.add(lambert("floor", glm::vec3(0.5f))), {.position = {0, -0.1, 0}});
    builder.draw(cube, builder.add(lambert("red box", {0.7f, 0.15f, 0.1f})), {.position = {-1, 0.5, 0}, .yaw = 0.5});
    builder.draw(cube, builder.add(lambert("blue box", {0.1f, 0.2f, 0.7f})), {.position = {1.1, 0.5, -0.6}, .yaw = -0.3});
    Material ball = lambert("ball", {0.8f, 0.7f, 0.3f});
    ball.lighting_model = LightingModel::ggx;
    ball.roughness = 0.4f;
    builder.draw(builder.add(sphere(0.6f, 32)), builder.add(ball), {.position = {0.2, 0.6, 1}});
    builder.frame.sun.direction = glm::normalize(glm::vec3(-0.5f, -1, -0.4f));
    builder.frame.sun.irradiance = glm::vec3(2.4f, 2.3f, 2.1f);
    builder.frame.hemisphere = {.sky = {0.4f, 0.5f, 0.7f}, .ground = {0.2f, 0.17f, 0.15f}};
    builder.frame.background = {0.4f, 0.5f, 0.7f};
    return std::move(builder.frame);
}

/// A white furnace with a gray sphere: radiance 1 from everywhere, so the sphere is 0.5 and the background 1.
Frame one_sphere(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    const double approach = 0.3 * (1 - builder.progress());
    builder.look({.eye = {0, 0, 3.2 + approach}, .target = {0, 0, 0}, .swing = 0});
    builder.draw(builder.add(sphere(1, 64)), builder.add(lambert("gray", glm::vec3(0.5f))), {});
    builder.frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(1)};
    builder.frame.background = glm::vec3(1);
    return std::move(builder.frame);
}

namespace {

/// Row by row: the three lit models by roughness, metal by roughness, then emissive, unlit and normal-mapped ones.
Material table_material(int row, int column, std::uint32_t stud_texture) {
    Material material = lambert("ball", {0.75f, 0.4f, 0.25f});
    constexpr std::array<LightingModel, 4> models = {LightingModel::lambert, LightingModel::burley, LightingModel::ggx,
                                                     LightingModel::ggx};
    if (row < 4) {
        material.lighting_model = models[static_cast<std::size_t>(row)];
        material.roughness = 0.1f + 0.2f * static_cast<float>(column);
        material.metallic = row == 3 ? 1.0f : 0.0f;
        return material;
    }
    material.lighting_model = column == 2 ? LightingModel::unlit : LightingModel::ggx;
    material.roughness = 0.35f;
    if (column < 2) material.emissive = glm::vec3(0.2f, 0.6f, 1.2f) * static_cast<float>(1 + column);
    if (column > 2) {
        material.normal_texture.texture = stud_texture;
        material.normal_texture.transform = {6, 0, 0, 0, 3, 0};
        material.metallic = column == 4 ? 0.8f : 0.0f;
    }
    return material;
}

}  // namespace

Frame materials(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 7}, .target = {0, 0, 0}});
    const std::uint32_t ball = builder.add(sphere(0.5f, 32)), stud_texture = builder.add(studs(1));
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 5; ++column) {
            const std::uint32_t material = builder.add(table_material(row, column, stud_texture));
            builder.draw(ball, material, {.position = {1.7 * (column - 2), 1.15 * (2 - row), 0}});
        }
    }
    builder.draw(builder.add(quad({9, 5})), builder.add(lambert("wall", glm::vec3(0.3f))), {.position = {0, 0, -1.2}});
    Light lamp;
    lamp.name = "lamp";
    lamp.position = {-3, 3, 4};
    lamp.intensity = glm::vec3(60);
    lamp.range = 20;
    builder.frame.lights.push_back(lamp);
    lamp.name = "blue lamp";
    lamp.position = {4, -1, 3};
    lamp.intensity = {6, 10, 20};
    builder.frame.lights.push_back(lamp);
    builder.frame.hemisphere = {.sky = glm::vec3(0.25f), .ground = glm::vec3(0.12f)};
    return std::move(builder.frame);
}

Frame lighting_models(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 7}, .target = {0, 0, 0}});
    const std::uint32_t ball = builder.add(sphere(0.55f, 32));
    constexpr auto models = std::to_array<LightingModel>({LightingModel::lambert, LightingModel::burley, LightingModel::ggx,
                                                          LightingModel::cloth, LightingModel::skin, LightingModel::hair,
                                                          LightingModel::plain_burley, LightingModel::multiscatter_ggx});
    for (int row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < models.size(); ++column) {
            Material material = lambert("ball", {0.7f, 0.42f, 0.3f});
            material.lighting_model = models[column];
            material.roughness = 0.25f * static_cast<float>(1 + row);
            material.metallic = row == 1 ? 0.3f : row == 3 ? 1.0f : 0.0f;
            const glm::dvec3 at(1.25 * (static_cast<double>(column) - 3.5), 1.35 * (1.5 - row), 0);
            builder.draw(ball, builder.add(material), {.position = at});
        }
    }
    Light lamp;
    lamp.name = "lamp";
    lamp.position = {-3, 3, 5};
    lamp.intensity = glm::vec3(70);
    lamp.range = 25;
    builder.frame.lights.push_back(lamp);
    lamp.name = "lamp behind";
    lamp.position = {3, 2, -5};
    lamp.intensity = {12, 15, 20};
    builder.frame.lights.push_back(lamp);
    builder.frame.hemisphere = {.sky = {0.2f, 0.25f, 0.3f}, .ground = glm::vec3(0.1f)};
    builder.frame.background = glm::vec3(0.05f);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
