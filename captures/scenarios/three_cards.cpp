// Three cards of alpha 0.99 within 2 cm of depth stand before a dark character on a bright wall. Exactly, one part in a million
// of the character comes through; a technique that treats the three as one lets a hundredth through, and the silhouette shows.
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/props.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {

Frame three_cards(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {0, 1.3, 4}, .target = {0, 1, 0}, .vertical_fov = 0.7});
    builder.draw(builder.add(quad({5, 3})), builder.add(unlit("bright wall", {3, 3, 2.8f, 1})), {.position = {0, 1.5, -2}});
    builder.draw(builder.add(box({5, 0.1f, 4})), builder.add(lambert("floor", glm::vec3(0.4f))), {.position = {0, -0.1, 0}});
    People(builder).add(builder, builder.add(lambert("dark cloth", glm::vec3(0.03f))), {.yaw = 0.3});
    const std::uint32_t card = builder.add(quad({0.55f, 0.7f}));
    builder.draw(card, builder.add(unlit("card 1", {0.25f, 0.3f, 0.35f, 0.99f})), {.position = {-0.25, 1.1, 1.00}});
    builder.draw(card, builder.add(unlit("card 2", {0.35f, 0.3f, 0.25f, 0.99f})), {.position = {0.0, 1.2, 1.01}});
    builder.draw(card, builder.add(unlit("card 3", {0.3f, 0.35f, 0.25f, 0.99f})), {.position = {0.25, 1.0, 1.02}});
    builder.frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(0.4f)};
    builder.frame.background = glm::vec3(1);
    return std::move(builder.frame);
}

}  // namespace strata::scenario
