// Panes in front of a wall. Panes and walls are unlit, so every pixel can be computed by hand from the colors below.
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

/// A wall of two grays 6 m away that fills the view, and a quad of half size 1 for panes. The eye is the origin.
struct Stage {
    FrameBuilder builder;
    std::uint32_t pane = 0;

    Stage(std::uint32_t frame, const ScenarioOptions& options) : builder(frame, options) {
        builder.look({.eye = {0, 0, 0}, .target = {0, 0, -4}});
        Material wall = unlit("wall", glm::vec4(1));
        wall.base_color_texture.texture = builder.add(checker(2, glm::vec3(0.8f), glm::vec3(0.2f)));
        wall.base_color_texture.transform = {8, 0, 0, 0, 8, 0};
        builder.draw(builder.add(quad({8, 8})), builder.add(wall), {.position = {0, 0, -6}});
        pane = builder.add(quad({1, 1}));
        builder.frame.background = glm::vec3(0.5f);
    }

    Draw& add_pane(const Material& material, const Pose& place) { return builder.draw(pane, builder.add(material), place); }
};

/// `count` panes from 2 to 5 m, each a little turned against the last, submitted in shuffled order. Colors go once around.
Frame stack_of(std::uint32_t count, float alpha, Stage stage) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    Random random(stage.builder.seed());
    for (std::uint32_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (const std::uint32_t layer : order) {
        const double share = (layer + 0.5) / count, angle = 2 * std::numbers::pi * share;
        const glm::vec3 color(0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::cos(angle - 2.1), 0.5 + 0.5 * std::cos(angle + 2.1));
        const double depth = 2 + 3 * share;
        stage.add_pane(
            unlit("layer", glm::vec4(color, alpha)),
            {.position = {0.2 * std::cos(5 * angle), 0.2 * std::sin(3 * angle), -depth}, .scale = glm::dvec3(0.3 * depth)});
    }
    return std::move(stage.builder.frame);
}

}  // namespace

Frame one_pane(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    stage.add_pane(unlit("pane", {0.9f, 0.2f, 0.1f, 0.5f}), {.position = {-0.5, 0, -3}});
    return std::move(stage.builder.frame);
}

Frame three_panes(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    stage.add_pane(unlit("near red pane", {1, 0.1f, 0.1f, 0.5f}), {.position = {-0.5, 0.3, -3}});
    stage.add_pane(unlit("far blue pane", {0.1f, 0.1f, 1, 0.5f}), {.position = {0.5, 0.3, -4}});
    stage.add_pane(unlit("middle green pane", {0.1f, 1, 0.1f, 0.5f}), {.position = {0, -0.4, -3.5}});
    return std::move(stage.builder.frame);
}

Frame interpenetrating_panes(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    stage.add_pane(unlit("red pane", {1, 0.1f, 0.1f, 0.6f}), {.position = {0, 0, -3.5}, .yaw = 0.7});
    stage.add_pane(unlit("blue pane", {0.1f, 0.1f, 1, 0.6f}), {.position = {0, 0, -3.5}, .yaw = -0.7});
    stage.add_pane(unlit("green pane", {0.1f, 1, 0.1f, 0.6f}), {.position = {0, 0, -3.5}, .scale = {1.5, 0.4, 1}});
    return std::move(stage.builder.frame);
}

Frame sixty_layers(std::uint32_t frame, const ScenarioOptions& options) { return stack_of(60, 0.1f, Stage(frame, options)); }

Frame two_hundred_layers(std::uint32_t frame, const ScenarioOptions& options) {
    return stack_of(200, 0.01f, Stage(frame, options));
}

Frame pane_at_the_lens(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    stage.builder.look({.eye = {0, 0, 0}, .target = {0, 0, -4}, .swing = 0});  // a swing would carry the lens out of the pane
    const double slide = 0.02 * (1 - stage.builder.progress());
    stage.add_pane(unlit("pane at the lens", {1, 0.8f, 0.3f, 0.3f}),
                   {.position = {slide - 0.06, 0, -0.101}, .scale = glm::dvec3(0.08)});
    stage.add_pane(unlit("far pane", {0.1f, 0.3f, 1, 0.5f}), {.position = {0, 0, -4}});
    return std::move(stage.builder.frame);
}

/// Over white the overlap is exactly (0.2, 0.2, 0.04): docs/algorithms/transparency.md R3.
Frame red_and_green_glass(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    stage.builder.frame.materials[0] = unlit("white wall", glm::vec4(1));
    stage.add_pane(glass("green glass", {0.2f, 1, 0.2f}), {.position = {0.5, 0, -4}});
    stage.add_pane(glass("red glass", {1, 0.2f, 0.2f}), {.position = {-0.5, 0, -3}});
    return std::move(stage.builder.frame);
}

Frame coincident_panes(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    stage.add_pane(unlit("red pane", {1, 0.1f, 0.1f, 0.5f}), {.position = {-0.6, 0, -3}});
    stage.add_pane(unlit("green pane", {0.1f, 1, 0.1f, 0.5f}), {.position = {0, 0.3, -3}});
    stage.add_pane(unlit("blue pane", {0.1f, 0.1f, 1, 0.5f}), {.position = {0.6, 0, -3}});
    return std::move(stage.builder.frame);
}

/// Twelve sheets of each gel, a tenth of a millimeter apart, which is one slice: their codes of red, 255 each, are more than the
/// 1023 that 10 bits hold, and carry. Six gray cards before them are more than a byte.
Frame stack_of_gels(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    stage.builder.frame.materials[0] = unlit("white wall", glm::vec4(1));
    for (int sheet = 0; sheet < 12; ++sheet) {
        const double behind = 1e-4 * sheet;
        stage.add_pane(glass("green gel", {0.002f, 0.95f, 0.9f}), {.position = {-0.5, 0.2, -4 - behind}});
        stage.add_pane(glass("cyan gel", {0.002f, 0.97f, 0.97f}), {.position = {0.5, -0.2, -3.5 - behind}});
        if (sheet < 6) stage.add_pane(unlit("card", {0.5f, 0.45f, 0.4f, 0.9f}), {.position = {0, 0.9, -3 - behind}});
    }
    return std::move(stage.builder.frame);
}

Frame foggy_panes(std::uint32_t frame, const ScenarioOptions& options) {
    Stage stage(frame, options);
    constexpr std::array<glm::vec4, 3> colors = {glm::vec4(1, 0.1f, 0.1f, 0.6f), {0.1f, 1, 0.1f, 0.6f}, {0.1f, 0.1f, 1, 0.6f}};
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const double depth = 2 + 1.5 * static_cast<double>(i);
        stage.add_pane(unlit("pane", colors[i]), {.position = {-0.6 + 0.6 * static_cast<double>(i), 0, -depth}});
    }
    stage.builder.frame.fog = {.density = 0.2f, .color = {0.6f, 0.65f, 0.7f}, .path = FogPath::distance};
    return std::move(stage.builder.frame);
}

/// Two columns of 200 panes of alpha .01 over black, each grays i / 199: nearest darkest on the left, nearest brightest on the
/// right. All that is seen are two numbers, .296181 (docs/algorithms/transparency.md R6) and .569839.
Frame thin_layers(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -4}, .swing = 0.1});
    constexpr std::uint32_t count = 200;
    const std::uint32_t pane = builder.add(quad({1, 1}));
    std::vector<std::uint32_t> grays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto gray = static_cast<float>(i) / static_cast<float>(count - 1);
        grays.push_back(builder.add(unlit("thin layer", {gray, gray, gray, 0.01f})));
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const double depth = 3 + 0.01 * i;  // each pane's inner edge lies on the view's middle plane
        builder.draw(pane, grays[i], {.position = {-depth, 0, -depth}, .scale = glm::dvec3(depth)});
        builder.draw(pane, grays[count - 1 - i], {.position = {depth, 0, -depth}, .scale = glm::dvec3(depth)});
    }
    return std::move(builder.frame);
}

}  // namespace strata::scenario
