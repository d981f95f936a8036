// Beams of sunlight through a grate into foggy air: what sun shafts are judged on.
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

/// Bars of a grate at a height of 3 m: holes of about 1.1 by .7 m between them, and a fourth row wide open.
void add_grate(FrameBuilder& builder, std::uint32_t iron) {
    const std::uint32_t along = builder.add(box({0.25f, 0.08f, 3})), across = builder.add(box({3.2f, 0.08f, 0.3f}));
    for (const double x : {-2.8, -1.2, 0.4, 2.0}) builder.draw(along, iron, {.position = {x, 3, -2.5}});
    for (const double z : {-5.2, -3.9, -2.6, -1.3}) builder.draw(across, iron, {.position = {-0.4, 3, z}});
}

}  // namespace

/// The grate hangs over a floor; before its open end a vine hangs, whose leaves are holes of a masked card. A post stands in a
/// beam.
Frame beams(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0.6, 1.5, 4.2}, .target = {-0.4, 1.5, -2.5}, .vertical_fov = 0.9, .swing = 0.15});
    builder.draw(builder.add(box({6, 0.1f, 6})), builder.add(lambert("floor", {0.4f, 0.38f, 0.35f})),
                 {.position = {0, -0.1, -2}});
    add_grate(builder, builder.add(lambert("iron", {0.25f, 0.22f, 0.2f})));
    builder.draw(builder.add(box({0.15f, 0.8f, 0.15f})), builder.add(lambert("post", {0.5f, 0.4f, 0.3f})),
                 {.position = {-1.4, 0.8, -1.8}, .yaw = 0.4});
    Material vine = lambert("vine", glm::vec3(1));
    vine.alpha_mode = AlphaMode::mask;
    vine.double_sided = true;
    vine.base_color_texture.texture = builder.add(foliage(builder.seed()));
    builder.draw(builder.add(quad({0.7f, 0.7f})), builder.add(std::move(vine)), {.position = {1.5, 2.3, 0.4}, .yaw = 0.9});
    Frame& f = builder.frame;
    f.sun.direction = glm::normalize(glm::vec3(0.45f, -1, 0.25f));
    f.sun.irradiance = {12, 10.5f, 8};
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
