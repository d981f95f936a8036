// A car's tail light from 30 cm: one clear cover 3 mm before a red, an amber and a clear lens, turned, over a bulb and a mirror.
// Both layers color what is behind them, and both scatter a little light of their own; the cover's must not come out red.
#include <array>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

/// Full coverage: what is behind is multiplied by `transmission`, `scattered` is added.
Material plastic(std::string name, glm::vec3 transmission, glm::vec3 scattered) {
    Material material = glass(std::move(name), transmission);
    material.base_color = glm::vec4(scattered, 1);
    return material;
}

}  // namespace

Frame tail_light(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {-0.03, 0, 0.3}, .target = {-0.03, 0, 0}, .vertical_fov = 0.7, .near = 0.02});
    constexpr double turned = 0.5;
    // Along the lamp's own axes: x to its right, z out of it.
    const auto in_lamp = [&](glm::dvec3 position) {
        return Pose{.position = glm::dvec3(transform({.yaw = turned}) * glm::dvec4(position, 1)), .yaw = turned};
    };
    Material mirror = unlit("mirror", glm::vec4(1));
    mirror.base_color_texture.texture = builder.add(checker(8, glm::vec3(0.9f), glm::vec3(0.35f)));
    builder.draw(builder.add(quad({0.2f, 0.08f})), builder.add(mirror), in_lamp({0, 0, -0.06}));
    builder.draw(builder.add(sphere(0.018f, 24)), builder.add(unlit("bulb", {4, 3.6f, 3, 1})), in_lamp({-0.085, 0, -0.035}));

    struct Segment {
        const char* name;
        glm::vec3 transmission;
    };
    const std::array<Segment, 3> segments = {
        {{"red lens", {0.85f, 0.04f, 0.03f}}, {"amber lens", {0.9f, 0.45f, 0.03f}}, {"clear lens", {0.9f, 0.92f, 0.92f}}}};
    // The cover is submitted first, and its middle is farther than that of the lens on the near side: neither order is right.
    builder.draw(builder.add(quad({0.14f, 0.045f})), builder.add(plastic("clear cover", {0.88f, 0.9f, 0.9f}, glm::vec3(0.06f))),
                 in_lamp({0, 0.012, 0}));
    const std::uint32_t lens = builder.add(quad({0.045f, 0.045f}));
    for (std::size_t i = 0; i < segments.size(); ++i)
        builder.draw(lens, builder.add(plastic(segments[i].name, segments[i].transmission, 0.05f * segments[i].transmission)),
                     in_lamp({-0.095 + 0.095 * static_cast<double>(i), -0.012, -0.003}));
    builder.frame.background = glm::vec3(0.08f, 0.09f, 0.1f);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
