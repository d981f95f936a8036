// Beams of sunlight through the holes of a roof into foggy air: what sun shafts are judged on.
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

/// A roof at 3 m of crossing planks, between which holes of .5 by .7 m are left, over walls towards the sun and a floor.
void add_shed(FrameBuilder& builder) {
    const std::uint32_t wood = builder.add(lambert("wood", {0.3f, 0.26f, 0.22f}));
    const std::uint32_t along = builder.add(box({0.85f, 0.06f, 7})), across = builder.add(box({6.5f, 0.06f, 0.65f}));
    for (const double x : {-4.4, -2.2, 0.0, 2.2, 4.4}) builder.draw(along, wood, {.position = {x, 3, -1.5}});
    for (const double z : {-7.0, -5.0, -3.0, -1.0, 1.0, 3.0}) builder.draw(across, wood, {.position = {0, 3.12, z}});
    builder.draw(builder.add(box({0.1f, 1.6f, 7})), wood, {.position = {-5.6, 1.6, -1.5}});
    builder.draw(builder.add(box({6.5f, 1.6f, 0.1f})), wood, {.position = {0, 1.6, -7.6}});
    builder.draw(builder.add(box({6.5f, 0.1f, 7.5f})), builder.add(lambert("floor", {0.4f, 0.38f, 0.35f})),
                 {.position = {0, -0.1, -1.5}});
}

}  // namespace

/// A post stands in the beams, and a vine hangs in them, whose leaves are holes of a masked card.
Frame beams(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {1.2, 1.5, 4.2}, .target = {0, 1.45, -3}, .vertical_fov = 0.9, .swing = 0.15});
    add_shed(builder);
    builder.draw(builder.add(box({0.15f, 0.9f, 0.15f})), builder.add(lambert("post", {0.5f, 0.4f, 0.3f})),
                 {.position = {-1.2, 0.9, -1.2}, .yaw = 0.4});
    Material vine = lambert("vine", glm::vec3(1));
    vine.alpha_mode = AlphaMode::mask;
    vine.double_sided = true;
    vine.base_color_texture.texture = builder.add(foliage(builder.seed()));
    builder.draw(builder.add(quad({0.6f, 0.7f})), builder.add(std::move(vine)), {.position = {1.6, 2.2, 0.2}, .yaw = 0.9});
    Frame& f = builder.frame;
    f.sun.direction = glm::normalize(glm::vec3(0.45f, -1, 0.25f));
    f.sun.irradiance = {24, 21, 16};
    f.sun.shadow = {.casts = true, .map_size = 256};
    f.sun.cascades = 2;
    f.sun.shadow_distance = 14;
    f.sun.shafts = true;
    f.fog = {.density = 0.06f, .color = {0.03f, 0.035f, 0.04f}};
    f.hemisphere = {.sky = {0.1f, 0.12f, 0.15f}, .ground = {0.05f, 0.05f, 0.05f}};
    f.background = {0.1f, 0.13f, 0.18f};
    return std::move(f);
}

}  // namespace strata::scenario
