// Ambient light alone in a corner of a room, so that its occlusion is the picture.
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

void add_box(FrameBuilder& builder, std::uint32_t material, const glm::vec3& half, const Pose& place) {
    builder.draw(builder.add(box(half)), material, place);
}

void add_room(FrameBuilder& builder, std::uint32_t plaster) {
    add_box(builder, plaster, {5, 0.1f, 5}, {.position = {2.4, -0.1, 2.4}});
    add_box(builder, plaster, {0.1f, 2, 5}, {.position = {-2.6, 2, 2.4}});
    add_box(builder, plaster, {5, 2, 0.1f}, {.position = {2.4, 2, -2.6}});
}

void add_stairs(FrameBuilder& builder, std::uint32_t plaster) {
    for (int i = 0; i < 4; ++i) {
        const float half_height = 0.1f * float(i + 1);
        add_box(builder, plaster, {0.5f, half_height, 0.175f}, {.position = {-2, half_height, 0.9 - 0.35 * i}});
    }
}

/// A map that says .5 everywhere, as if the crate were worn in a way that its triangles do not show.
std::uint32_t add_worn_wood(FrameBuilder& builder) {
    Texture map{
        .name = "worn", .width = 1, .height = 1, .texels = {std::byte{128}, std::byte{128}, std::byte{128}, std::byte{255}}};
    Material material = lambert("worn crate", glm::vec3(0.8f));
    material.occlusion_texture.texture = builder.add(std::move(map));
    return builder.add(std::move(material));
}

}  // namespace

/// Two pillars before a wall, stairs, a ball that rests on the floor, a board that floats over it, a crate whose material has
/// occlusion of its own.
Frame corners(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {2.7, 2.1, 3.1}, .target = {-0.55, 0.55, -0.75}, .vertical_fov = 0.8});
    const std::uint32_t plaster = builder.add(lambert("plaster", glm::vec3(0.8f)));
    add_room(builder, plaster);
    add_stairs(builder, plaster);
    add_box(builder, plaster, {0.2f, 1.5f, 0.2f}, {.position = {-0.7, 1.5, -1.6}});
    builder.draw(builder.add(capsule(0.2f, 1.3f, 32)), plaster, {.position = {0.5, 1.3, -1.9}});
    builder.draw(builder.add(sphere(0.45f, 48)), plaster, {.position = {0.3, 0.45, 0.5}});
    add_box(builder, plaster, {0.5f, 0.03f, 0.35f}, {.position = {-0.9, 0.4, 0.3}, .yaw = 0.4});
    add_box(builder, add_worn_wood(builder), {0.3f, 0.3f, 0.3f}, {.position = {1.3, 0.3, -0.7}, .yaw = 0.5});
    builder.frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(1)};
    builder.frame.background = glm::vec3(0.8f);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
