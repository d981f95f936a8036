#include "captures/cards.h"

#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"

namespace strata {

Frame frame_of_cards(std::span<const Card> cards, std::uint32_t extent) {
    Frame frame;
    frame.view.width = frame.view.height = extent;
    frame.view.projection = perspective(std::numbers::pi / 2, 1, double(frame.view.near));
    Mesh& square = frame.meshes.emplace_back();
    square.name = "square";
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.normals.assign(4, glm::vec3(0, 0, 1));  // the outward side: the eye sees the back
    square.indices = {0, 1, 2, 0, 2, 3};
    for (const Card& card : cards) {
        Material& material = frame.materials.emplace_back();
        material.name = "card";
        material.lighting_model = LightingModel::unlit;
        material.alpha_mode = card.alpha_mode;
        material.double_sided = true;
        material.base_color = card.color;
        material.distortion = card.distortion;
        material.transmission = card.transmission;
        glm::dmat4 to_world = glm::translate(glm::dmat4(1), card.center);
        to_world = glm::rotate(to_world, card.tilt, glm::dvec3(0, 1, 0));
        to_world = glm::scale(to_world, glm::dvec3(double(card.half)));
        frame.draws.push_back({.name = "card",
                               .material = static_cast<std::uint32_t>(frame.materials.size() - 1),
                               .to_world = to_world,
                               .previous_to_world = to_world,
                               .sort_priority = card.sort_priority});
    }
    return frame;
}

}  // namespace strata
