// Readers of what is made for places, by bounds: never too few.
#include "passes/scene/readers.h"

#include <gtest/gtest.h>

#include <limits>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/scene_facts.h"
#include "tests/4_references/squares_in_view.h"

namespace strata {
namespace {

TEST(Readers, AreNotOfAFloorBehindTheEyeThoughItsSphereReachesIntoView) {
    Frame behind = empty_view(), below = empty_view();
    add_square(behind, {0, -1, -5.1}, 5);
    EXPECT_FALSE(SceneFacts(behind).readers().has_surfaces());
    add_square(below, {0, -1, 0}, 5);
    EXPECT_TRUE(SceneFacts(below).readers().has_surfaces());
}

/// At 10 m the image ends 5 m beside its middle.
TEST(Readers, ReachToTheEdgesOfTheImageAndNoFarther) {
    for (const glm::dvec3& side : {glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)}) {
        Frame within = empty_view(), beside = empty_view();
        add_square(within, 4.8 * side + glm::dvec3(0, 0, 10), .1f);
        add_square(beside, 5.3 * side + glm::dvec3(0, 0, 10), .1f);
        EXPECT_TRUE(SceneFacts(within).readers().has_surfaces());
        EXPECT_FALSE(SceneFacts(beside).readers().has_surfaces());
    }
}

TEST(Readers, AreWhereDrawsAndWhatTheyReadMeet) {
    Frame frame = empty_view();
    add_square(frame, {0, -.5, 10}, 1);
    const SceneFacts facts(frame);
    const Readers& readers = facts.readers();
    EXPECT_TRUE(readers.has_any_in({{-1, -1, 8}, {1, 1, 9.5}}));
    EXPECT_FALSE(readers.has_any_in({{-1, -1, 4}, {1, 1, 5}})) << "before it";
    EXPECT_FALSE(readers.has_any_in({{-1, -1, -9}, {1, 1, -8}})) << "behind the eye";
    EXPECT_TRUE(readers.has_surfaces_in({{0, 0, 7}, 2.5}));
    EXPECT_FALSE(readers.has_surfaces_in({{0, 0, 7}, 1}));
    EXPECT_TRUE(readers.has_surfaces_between(11, 20));
    EXPECT_FALSE(readers.has_surfaces_between(12, 20));
    frame.view.samples = 4;
    EXPECT_TRUE(readers.has_any_in({{-1, -1, 4}, {1, 1, 5}})) << "places of edges may lie anywhere";
}

TEST(Readers, OfParticlesAtInfinityAreEverywhere) {
    Frame frame = empty_view();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    frame.emitters.push_back({.particles = {{.center = {0, 0, 5}}, {.center = {infinity, 0, 0}}}});
    const SceneFacts facts(frame);
    EXPECT_TRUE(facts.readers().has_any_in({{-1, -1, 4}, {1, 1, 6}}));
    frame.emitters[0].particles.pop_back();
    frame.emitters[0].particles[0].center.z = -5;
    EXPECT_FALSE(SceneFacts(frame).readers().has_any_in({{-1, -1, -6}, {1, 1, 6}})) << "behind the eye";
}

}  // namespace
}  // namespace strata
