// Frames of as many particles and triangles as a lookdev scene has, where every pixel's value is known. Small images: what grows
// is what the frame holds.
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/particles.h"
#include "capture_format/view.h"
#include "passes/frame_images.h"
#include "passes/scene/view_space.h"
#include "passes/shaders/scene/no_index.shared.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// Nothing in front of a black background, 80 x 45.
Frame empty_frame() {
    Frame frame = scenario_frames("additive_sparks").front();
    frame.view.width = 80;
    frame.view.height = 45;
    frame.draws.clear();
    frame.emitters.front().particles.clear();
    frame.emitters.front().texture = no_index;
    frame.background = glm::vec3(0);
    return frame;
}

glm::dvec3 in_world(const View& view, const glm::dvec3& in_view) { return view.origin + glm::transpose(view.to_view) * in_view; }

/// Bytes that the scene holds on the device beyond an empty frame's, per element.
double bytes_per(const strata::Run& run, const strata::Run& empty, std::size_t elements) {
    return double(run.memory.scene - empty.memory.scene) / double(elements);
}

Run run_alone(Frame frame, const std::vector<std::string>& outputs) {
    std::vector<Frame> frames;
    frames.push_back(std::move(frame));
    const auto session = must(Session::open(std::move(frames), {}));
    return must(session->run({.choices = chosen({"transparency/alpha_blend"}), .outputs = outputs}));
}

// 1400 steps of 1/1024 are exact in half floats.
TEST(ExhaustiveScale, FiveMillionParticlesAddUpInEveryPixel) {
    constexpr std::uint32_t per_pixel = 1400;
    Frame frame = empty_frame();
    const strata::Run empty = run_alone(frame, {"color"});
    const View& view = frame.view;
    for (std::uint32_t y = 0; y < view.height; ++y)
        for (std::uint32_t x = 0; x < view.width; ++x) {
            const glm::dvec3 ray = ray_through(view, x + .5, y + .5), right = ray_through(view, x + 1.5, y + .5);
            Particle particle;
            particle.center = in_world(view, ray);
            particle.size = float(.3 * glm::length(right - ray));  // of an edge of a pixel: its center alone is covered
            particle.color = glm::vec3(0);
            particle.emissive = glm::vec3(1.f / 1024);
            frame.emitters.front().particles.insert(frame.emitters.front().particles.end(), per_pixel, particle);
        }
    const std::size_t particles = frame.emitters.front().particles.size();
    ASSERT_GE(particles, 5'000'000u);
    const strata::Run run = run_alone(std::move(frame), {"color"});
    for (const glm::dvec4& texel : in_double(run.images.at("color")).texels)
        ASSERT_EQ(glm::dvec3(texel), glm::dvec3(per_pixel / 1024.));
    RecordProperty("bytes per particle", fmt::format("{:.1f}", bytes_per(run, empty, particles)));
    EXPECT_LT(bytes_per(run, empty, particles), 160);  // a record of 84, 12 indices and 6 places
}

TEST(ExhaustiveScale, TwentyMillionTrianglesAreOnePlane) {
    constexpr std::uint32_t edge = 3163;
    constexpr double distance = 4;
    Frame frame = empty_frame();
    const strata::Run empty = run_alone(frame, {"depth"});
    Mesh grid;
    const View& view = frame.view;
    for (std::uint32_t y = 0; y <= edge; ++y)
        for (std::uint32_t x = 0; x <= edge; ++x) {
            grid.positions.emplace_back(8. * x / edge - 4, 4. - 8. * y / edge, 0);
            grid.normals.emplace_back(0, 0, 1);
        }
    for (std::uint32_t y = 0; y < edge; ++y)
        for (std::uint32_t x = 0; x < edge; ++x) {
            const std::uint32_t corner = y * (edge + 1) + x, below = corner + edge + 1;
            for (const std::uint32_t index : {corner, below, below + 1, corner, below + 1, corner + 1})
                grid.indices.push_back(index);
        }
    ASSERT_GE(grid.indices.size() / 3, 20'000'000u);
    const std::size_t vertices = grid.positions.size();
    frame.meshes = {std::move(grid)};
    Draw draw;
    draw.mesh = 0;
    draw.material = 0;
    draw.to_world = glm::dmat4(1);
    draw.to_world[3] = glm::dvec4(in_world(view, {0, 0, distance}), 1);
    draw.previous_to_world = draw.to_world;
    frame.draws = {draw};
    const double near = double(view.near);
    const strata::Run run = run_alone(std::move(frame), {"depth"});
    for (const glm::dvec4& texel : in_double(run.images.at("depth")).texels)
        ASSERT_NEAR(texel.x, near / distance, 1e-6 * near / distance);
    RecordProperty("bytes per vertex", fmt::format("{:.1f}", bytes_per(run, empty, vertices)));
    EXPECT_LT(bytes_per(run, empty, vertices), 50);  // position, normal and 6 indices
}

}  // namespace
}  // namespace strata
