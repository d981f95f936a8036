#include "captures/scenarios/frame_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

namespace strata::scenario {

double progress(std::uint32_t frame, const ScenarioOptions& options) {
    return std::min(1.0, (frame + 1.0) / std::max(1u, options.frames));
}

glm::dmat4 transform(const Pose& place) {
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), place.position);
    return glm::scale(glm::rotate(moved, place.yaw, glm::dvec3(0, 1, 0)), place.scale);
}

Material lambert(std::string name, glm::vec3 color) {
    Material material;
    material.name = std::move(name);
    material.lighting_model = LightingModel::lambert;
    material.base_color = glm::vec4(color, 1);
    return material;
}

Material unlit(std::string name, glm::vec4 color) {
    Material material;
    material.name = std::move(name);
    material.lighting_model = LightingModel::unlit;
    material.alpha_mode = color.w < 1 ? AlphaMode::blend : AlphaMode::opaque;
    material.base_color = color;
    material.double_sided = color.w < 1;
    return material;
}

Material glass(std::string name, glm::vec3 transmission) {
    Material material = unlit(std::move(name), glm::vec4(0, 0, 0, 1));
    material.alpha_mode = AlphaMode::blend;
    material.transmission = transmission;
    material.double_sided = true;
    return material;
}

FrameBuilder::FrameBuilder(std::uint32_t index, const ScenarioOptions& options)
    : progress_(scenario::progress(index, options)),
      previous_progress_(index == 0 ? progress_ : scenario::progress(index - 1, options)) {
    frame.index = index;
    frame.time = index / 30.0;
    frame.seed = options.seed;
    frame.view.width = options.width;
    frame.view.height = options.height;
    frame.view.samples = options.samples;
}

void FrameBuilder::look(const Camera& camera) {
    const glm::dmat4 swung = glm::rotate(glm::dmat4(1), camera.swing * (1 - progress_), glm::dvec3(0, 1, 0));
    View seen = look_at({.eye = camera.target + glm::dvec3(swung * glm::dvec4(camera.eye - camera.target, 0)),
                         .target = camera.target,
                         .vertical_fov = camera.vertical_fov,
                         .near = camera.near,
                         .width = frame.view.width,
                         .height = frame.view.height});
    seen.samples = frame.view.samples;
    frame.view = seen;
}

std::uint32_t FrameBuilder::add(Mesh mesh) {
    frame.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(frame.meshes.size() - 1);
}

std::uint32_t FrameBuilder::add(Material material) {
    frame.materials.push_back(std::move(material));
    return static_cast<std::uint32_t>(frame.materials.size() - 1);
}

std::uint32_t FrameBuilder::add(Texture texture) {
    frame.textures.push_back(std::move(texture));
    return static_cast<std::uint32_t>(frame.textures.size() - 1);
}

Draw& FrameBuilder::draw(std::uint32_t mesh, std::uint32_t material, const Pose& place) {
    Draw& draw = frame.draws.emplace_back();
    draw.name = frame.materials[material].name;
    draw.mesh = mesh;
    draw.material = material;
    draw.to_world = draw.previous_to_world = transform(place);
    return draw;
}

}  // namespace strata::scenario
