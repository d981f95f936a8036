// Transparent back faces are drawn where the material is double-sided, as glTF asks in every alpha mode.
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/particles.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/support/session.h"

namespace strata {
namespace {

enum class Sides { one, both };

/// The eye looks through a sphere of black glass, alpha .5, at a white wall. A mirrored sphere is turned inside out by its
/// transform.
Frame sphere_before_wall(Sides sides, bool mirrored) {
    scenario::FrameBuilder builder(0, {.width = 8, .height = 8, .samples = 1, .frames = 1});
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -1}, .swing = 0});
    builder.draw(builder.add(scenario::sphere(50, 16)), builder.add(scenario::unlit("wall", glm::vec4(1))),
                 {.position = {0, 0, -100}});
    Material glass = scenario::unlit("glass", {0, 0, 0, .5f});
    glass.alpha_mode = AlphaMode::blend;
    glass.double_sided = sides == Sides::both;
    builder.draw(builder.add(scenario::sphere(8, 16)), builder.add(glass), {.position = {0, 0, -20}});
    if (mirrored) builder.frame.draws.back().to_world[0] *= -1.f;
    return std::move(builder.frame);
}

/// The device culls where every transparent surface is single-sided. Beside smoke, here in a corner, shaders do.
Frame beside_smoke(Frame frame) {
    Emitter smoke{.name = "smoke"};
    smoke.particles.push_back({.center = {6, 6, -10}, .size = .5f, .color = glm::vec3(0), .alpha = .5f});
    frame.emitters.push_back(std::move(smoke));
    return frame;
}

TEST(BackFaces, OfTransparentSurfacesAreDrawnWhereTheMaterialIsDoubleSided) {
    const auto session = must(
        Session::open({sphere_before_wall(Sides::one, false), sphere_before_wall(Sides::one, true),
                       sphere_before_wall(Sides::both, false), sphere_before_wall(Sides::both, true),
                       beside_smoke(sphere_before_wall(Sides::one, false)), beside_smoke(sphere_before_wall(Sides::one, true))},
                      {.validation = true}));
    const auto center = [&](std::size_t frame, std::string_view technique) {
        const Request request{.variant = {.frame = frame}, .choices = chosen({std::string(technique)}), .outputs = {"color"}};
        return in_double(must(session->run(request)).images.at("color")).at(4, 4).x;
    };
    for (const Technique* technique : techniques_of(Stage::transparency))
        EXPECT_NEAR(center(0, technique->name), .5, .02) << technique->name;
    EXPECT_NEAR(center(1, "transparency/sorted_lists"), .5, 1e-5);
    EXPECT_NEAR(center(2, "transparency/sorted_lists"), .25, 1e-5);
    EXPECT_NEAR(center(3, "transparency/sorted_lists"), .25, 1e-5);
    for (const std::size_t frame : {4u, 5u}) EXPECT_NEAR(center(frame, "transparency/sorted_lists"), .5, 1e-5) << frame;
}

}  // namespace
}  // namespace strata
