// How far what functions of depth show has moved (docs/algorithms/transparency.md 6.13).
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/reference/shade.h"
#include "passes/reference/triangles.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/transparency/sample_blend.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using transparency::luminance;

std::string motion_of(std::string_view technique) { return fmt::format("{}:motion", technique); }

std::vector<std::string> with_motion() {
    std::vector<std::string> names;
    for (const Technique& technique : techniques())
        if (std::ranges::count(technique.views, std::string_view("motion"), &DebugView::name)) names.emplace_back(technique.name);
    return names;
}

ReferenceImage device_motion(Session& session, const std::string& technique, std::vector<std::string> sets = {}) {
    const std::string view = motion_of(technique);
    const auto run = must(session.run({.choices = chosen({technique}, std::move(sets)), .outputs = {view}}));
    return in_double(run.images.at(view));
}

/// A pane of alpha .5 that has moved so many pixels to the right over a wall that has moved one.
Frame pane_over_wall(double pane_pixels) {
    constexpr std::uint32_t extent = 64;
    Frame frame = frame_of_cards(std::array{Card{.center = {0, 0, 2}, .color = {1, 1, 1, .5f}},
                                            Card{.center = {0, 0, 4}, .half = 20, .alpha_mode = AlphaMode::opaque}},
                                 extent);
    // Half the image is as wide as it is far away.
    const auto meters = [&](double pixels, double z) { return pixels * z / (extent / 2); };
    frame.draws[0].previous_to_world[3].x -= meters(pane_pixels, 2);
    frame.draws[1].previous_to_world[3].x -= meters(1, 4);
    return frame;
}

TEST(Motion, IsAnAverageOfWhatIsSeen) {
    const std::vector<std::string> techniques = with_motion();
    ASSERT_GE(techniques.size(), 5u);
    for (const std::uint32_t samples : {1u, 4u}) {
        std::vector<Frame> frames{pane_over_wall(4)};
        frames[0].view.samples = samples;
        const auto session = session_of(std::move(frames));
        for (const std::string& technique : techniques) {
            const glm::dvec4 seen = device_motion(*session, technique).at(30, 33);
            EXPECT_NEAR(seen.x, .5 * 4 + .5 * 1, 2e-3) << technique;
            EXPECT_NEAR(seen.y, 0, 2e-3) << technique;
            EXPECT_NEAR(seen.w, .5, 1e-3) << technique;
        }
    }
}

TEST(Motion, IsComputedForNobodyWhoDoesNotAsk) {
    const auto session = session_of({pane_over_wall(4)});
    for (const std::string& technique : with_motion()) {
        const auto run = must(session->run({.choices = chosen({technique}), .outputs = {"color"}}));
        for (const StepRecord& step : run.steps) EXPECT_EQ(step.name.find("motion"), std::string::npos) << technique;
    }
}

/// In pixels, x right and y down, of a point of a draw in view space; emitters stand still.
glm::dvec2 pixels_moved(const Frame& frame, std::uint32_t draw, glm::dvec3 position) {
    if (draw >= frame.draws.size()) return glm::dvec2(0);
    const Draw& d = frame.draws[draw];
    const glm::dvec3 world = glm::transpose(frame.view.to_view) * position + frame.view.origin;
    const glm::dvec3 before = to_view(frame, glm::dvec3(d.previous_to_world * (glm::inverse(d.to_world) * glm::dvec4(world, 1))));
    const glm::dmat4 projection(frame.view.projection);
    const auto pixel = [&](glm::dvec3 p) {
        const glm::dvec4 clip = projection * glm::dvec4(p, 1);
        return glm::dvec2(clip) / clip.w * .5 * glm::dvec2(frame.view.width, frame.view.height);
    };
    return pixel(position) - pixel(before);
}

/// By Fragment::submission.
std::vector<std::uint32_t> draws_of_triangles(const Frame& frame) {
    std::vector<std::uint32_t> draws;
    for (const std::uint32_t draw : transparent_draws(frame)) draws.insert(draws.end(), triangle_count(frame, draw), draw);
    return draws;
}

/// Of one pixel from its exact list over what is opaque; w: what the background is seen with.
glm::dvec4 exact_motion(const Frame& frame, std::span<const Fragment> fragments, const RasterPoint& behind, glm::dvec3 ray,
                        std::span<const std::uint32_t> draws) {
    glm::dvec3 left(1);
    glm::dvec2 sum(0);
    for (const Fragment& f : fragments) {
        left *= f.transmittance;
        const double weight = luminance((1. - f.transmittance) * transparency::transmittance_before(fragments, f.depth));
        sum += weight * pixels_moved(frame, draws[f.submission], ray * f.depth);
    }
    if (behind.depth > 0)
        sum += luminance(left) * pixels_moved(frame, behind.draw, ray * (double(frame.view.near) / behind.depth));
    return {sum, 0, luminance(left)};
}

/// A room with panes, a plant with holes, a person and smoke; everything but the room's floor has moved and turned.
Frame moving_room() {
    Frame frame = scenario_frames("glass_and_smoke").front();
    frame.view.width = 160, frame.view.height = 90;
    for (std::size_t i = 1; i < frame.draws.size(); ++i) {
        Draw& draw = frame.draws[i];
        const glm::dvec3 moved(.01 * double(i % 4), -.005 * double(i % 3), .02 * double(i % 2));
        draw.previous_to_world = glm::translate(glm::dmat4(1), moved) * glm::rotate(draw.to_world, .02, glm::dvec3(0, 1, 0));
    }
    return frame;
}

TEST(Motion, OfTheExactFunctionIsWhatTheExactListsSay) {
    const Frame frame = moving_room();
    const auto session = session_of({frame});
    const std::string exact = "transparency/exact_function";
    const ReferenceImage got = device_motion(*session, exact, {"accumulation=single"});
    const FragmentLists& lists = *must(session->transparent_fragments({.choices = chosen({exact})}));
    const VisiblePoints opaque = visible_points(frame, opaque_draws(frame));
    const std::vector<std::uint32_t> draws = draws_of_triangles(frame);
    double worst = 0, fastest = 0;
    std::size_t compared = 0, through_glass = 0;
    for (std::uint32_t y = 0; y < frame.view.height; ++y)
        for (std::uint32_t x = 0; x < frame.view.width; ++x) {
            if (lists.undecided(x, y) || opaque.at(x, y).undecided) continue;
            const glm::dvec3 ray = pixel_ray(frame, x + .5, y + .5);
            const glm::dvec4 wanted = exact_motion(frame, lists.at(x, y), opaque.at(x, y), ray, draws);
            worst = std::max(worst, glm::length(got.at(x, y) - wanted));
            fastest = std::max(fastest, glm::length(glm::dvec2(wanted)));
            ++compared;
            through_glass += wanted.w > .01 && wanted.w < .99;
        }
    EXPECT_LT(worst, 2e-3);
    EXPECT_GT(fastest, 1);
    EXPECT_GT(compared, 10000u);
    EXPECT_GT(through_glass, 500u);
    RecordProperty("worst", std::to_string(worst));
}

}  // namespace
}  // namespace strata
