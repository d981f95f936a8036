// The scenes of two public demonstrations of per-pixel lists, so that replays can stand beside the times published for them.
#include <numbers>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

// Both demonstrations divide a sphere 32 times around.
constexpr std::uint32_t segments = 32;

/// 1024 spheres at random in a cube of 8 m, as vk_order_independent_transparency of nvpro-samples has them: radii of .045 to .45
/// m, colors squared, alphas of .2 to .5. The hemisphere stands for its Gooch light, which mixes the same two colors by the
/// normal.
Frame thousand_spheres(std::uint32_t frame, const ScenarioOptions& options, AlphaMode mode) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 12}, .target = {0, 0, 0}, .vertical_fov = std::numbers::pi / 4});
    const std::uint32_t ball = builder.add(sphere(1, segments));
    Random random(builder.seed());
    for (int i = 0; i < 1024; ++i) {
        const glm::dvec3 center{random.between(-4.0, 4.0), random.between(-4.0, 4.0), random.between(-4.0, 4.0)};
        const double radius = 0.45 * random.between(0.1, 1.0);
        const glm::vec3 root{random.between(0.0f, 1.0f), random.between(0.0f, 1.0f), random.between(0.0f, 1.0f)};
        Material material = lambert("sphere", root * root);
        material.base_color.w = random.between(0.2f, 0.5f);
        material.alpha_mode = mode;
        material.double_sided = mode == AlphaMode::blend;
        builder.draw(ball, builder.add(material), {.position = center, .scale = glm::dvec3(radius)});
    }
    builder.frame.hemisphere = {.sky = glm::vec3(1), .ground = {0, 0.25f, 0.75f}};
    builder.frame.background = glm::vec3(0.2f);
    return std::move(builder.frame);
}

}  // namespace

/// Five spheres each way a meter apart and two cubes, of which back faces are left out: the example `oit` of the Vulkan examples
/// by S. Willems.
Frame spheres_125(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 6}, .target = {0, 0, 0}, .vertical_fov = std::numbers::pi / 3});
    Material red = unlit("red sphere", {1, 0, 0, 0.5f}), blue = unlit("blue cube", {0, 0, 1, 0.5f});
    red.double_sided = blue.double_sided = false;
    const std::uint32_t ball = builder.add(sphere(0.3f, segments)), paint = builder.add(red);
    for (int i = 0; i < 125; ++i) builder.draw(ball, paint, {.position = {i / 25 - 2, i / 5 % 5 - 2, i % 5 - 2}});
    const std::uint32_t cube = builder.add(box(glm::vec3(0.2f))), cube_paint = builder.add(blue);
    for (const double x : {-1.5, 1.5}) builder.draw(cube, cube_paint, {.position = {x, 0, 0}});
    builder.frame.background = glm::vec3(0.025f);
    return std::move(builder.frame);
}

Frame spheres_1024(std::uint32_t frame, const ScenarioOptions& options) {
    return thousand_spheres(frame, options, AlphaMode::blend);
}

Frame opaque_spheres_1024(std::uint32_t frame, const ScenarioOptions& options) {
    return thousand_spheres(frame, options, AlphaMode::opaque);
}

}  // namespace strata::scenario
