// Why a tile may believe what it is told of blockers (docs/algorithms/lighting.md 2.3, 2.4, 2.10): classes never contradict the
// test of a point, in float, over random tiles. tests/5_techniques/blocker_cells_test.cpp asks a device about the same tiles.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/reference/blockers.h"
#include "passes/scene/light_blockers.h"
#include "tests/support/blocker_cases.h"

namespace strata {
namespace {

using lighting::Cell;
using lighting::Reach;

std::size_t points_stopped(const BlockerCases& cases, std::size_t index, glm::uvec2 masks) {
    const auto begin = cases.points.begin() + static_cast<std::ptrdiff_t>(index * points_per_case);
    return static_cast<std::size_t>(std::count_if(begin, begin + points_per_case, [&](const glm::vec3& p) {
        return !blockers_pass(cases, cases.lights[index], p, masks);
    }));
}

TEST(BlockerCells, WhatATileLeavesToTestIsTheSameAsTestingEverything) {  // docs/algorithms/lighting.md T2.0
    constexpr std::size_t count = 60000;
    const BlockerCases cases = blocker_cases(count, 20);
    std::size_t killed = 0, tests = 0, left = 0, dark = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const LightRecord& light = cases.lights[i];
        const CaseMasks tile = masks(cases, i, classes(cases, i));
        for (std::size_t k = 0; k < points_per_case; ++k) {
            const glm::vec3& p = cases.points[i * points_per_case + k];
            const bool lit = blockers_pass(cases, light, p, {low_bits(light.blockers), low_bits(light.portals)});
            ASSERT_EQ(!tile.killed && blockers_pass(cases, light, p, {tile.blockers, tile.portals}), lit)
                << "case " << i << " point " << k;
            dark += lit ? 0 : 1;
        }
        killed += tile.killed ? 1 : 0;
        tests += light.blockers;
        left += tile.killed ? 0 : static_cast<std::size_t>(std::popcount(tile.blockers));
    }
    // The cases are worth something: lights are killed, tests are saved, and a good part of the points is dark.
    EXPECT_NEAR(double(killed) / count, .12, .02);
    EXPECT_NEAR(double(left) / double(tests), .47, .03);
    EXPECT_GT(double(dark) / double(count * points_per_case), .15);
}

TEST(BlockerCells, ClassesHoldForEveryPointAndAreUndecidedForHalfOfWhatTheyAreAskedAtMost) {  // 2.3
    constexpr std::size_t count = 20000;
    const BlockerCases cases = blocker_cases(count, 23);
    std::array<std::size_t, 3> told{}, true_of_points{};
    for (std::size_t i = 0; i < count; ++i) {
        const CaseClasses found = classes(cases, i);
        for (std::uint32_t b = 0; b < found.blockers.size(); ++b) {
            const std::size_t stopped = points_stopped(cases, i, {1u << b, 0});
            const Reach truth = stopped == 0 ? Reach::none : stopped == points_per_case ? Reach::full : Reach::partial;
            ++told[static_cast<std::size_t>(found.blockers[b])];
            ++true_of_points[static_cast<std::size_t>(truth)];
            if (found.blockers[b] != Reach::partial) {
                ASSERT_EQ(found.blockers[b], truth) << "case " << i << " blocker " << b;
            }
        }
    }
    const double all = double(told[0] + told[1] + told[2]);
    // Of 48 points. Of 3000 points .42 of the blockers divide their cell.
    EXPECT_NEAR(double(true_of_points[1]) / all, .32, .01);
    EXPECT_NEAR(double(told[1]) / all, .50, .01);
    EXPECT_NEAR(double(told[0]) / all, .43, .01);
    EXPECT_NEAR(double(told[2]) / all, .07, .01);
}

/// One blocker, one light, the tile in the middle of the view between two depths.
BlockerCases one_case(const BlockerRecord& blocker, const glm::vec3& light, const Cell<float>& cell) {
    BlockerCases cases;
    cases.blockers = {blocker};
    cases.light_blockers = {{0, 0}};
    cases.cells = {cell};
    cases.lights.emplace_back();
    cases.lights[0].position = light;
    cases.lights[0].blockers = 1;
    return cases;
}

Reach class_of(const BlockerCases& cases) { return classes(cases, 0).blockers[0]; }

constexpr lighting::TileRays<float> middle_tile{-.05f, .05f, -.05f, .05f};

TEST(BlockerCells, ATileBehindABlockerIsFullBesideItNoneAndAcrossItsEdgePartial) {
    const Cell<float> cell = lighting::cell_between(middle_tile, 4.f, 6.f);
    BlockerRecord blocker{.normal = {0, 0, -1}, .half_u = 1, .center = {0, 0, 2}, .half_v = 1, .u = {1, 0, 0}, .one_sided = 0};
    EXPECT_EQ(class_of(one_case(blocker, {0, 0, 1}, cell)), Reach::full);
    blocker.center.x = 1;
    EXPECT_EQ(class_of(one_case(blocker, {0, 0, 1}, cell)), Reach::partial);
    blocker.center.x = 1.5f;
    EXPECT_EQ(class_of(one_case(blocker, {0, 0, 1}, cell)), Reach::none);
    blocker.center = {0, 0, 5};
    EXPECT_EQ(class_of(one_case(blocker, {0, 0, 1}, cell)), Reach::partial) << "half of it lies before the blocker";
    EXPECT_EQ(class_of(one_case(blocker, {0, 0, 4.99f}, cell)), Reach::none) << "the light is in the blocker's plane";
    blocker.one_sided = 1;
    EXPECT_EQ(class_of(one_case(blocker, {0, 0, 8}, cell)), Reach::none) << "it stops nothing from behind";
}

TEST(BlockerCells, ATilePlaneProvesWhatNoShadowPlaneCan) {
    // A board on its corner, left of a tall tile: each of its edges' planes has a part of the tile inside, the tile's left plane
    // has all of the board's shadow outside.
    const Cell<float> cell = lighting::cell_between<float>({.2f, .3f, -.3f, .3f}, 1, 10);
    const float s = std::sqrt(.5f);
    BlockerRecord board{
        .normal = {0, 0, -1}, .half_u = .4f, .center = {-.116f, 0, 3}, .half_v = .4f, .u = {s, s, 0}, .one_sided = 0};
    EXPECT_EQ(class_of(one_case(board, {-.1f, 0, 0}, cell)), Reach::none);
    board.center.x = .1f;
    EXPECT_EQ(class_of(one_case(board, {-.1f, 0, 0}, cell)), Reach::partial) << "now its corner's shadow enters the tile";
}

TEST(BlockerCells, GrazingLightsNeverProveMoreThanIsTrue) {  // docs/algorithms/lighting.md N1
    std::mt19937 random(1);
    std::uniform_real_distribution<float> within(-1, 1), height(.0205f, .2f);
    std::size_t full = 0, partial = 0;
    for (int i = 0; i < 20000; ++i) {
        // A floor board seen from the side; the light hovers over its plane, far away or near.
        const BlockerRecord board{
            .normal = {0, 1, 0}, .half_u = 2, .center = {0, -.3f, 5}, .half_v = 2, .u = {1, 0, 0}, .one_sided = 0};
        const glm::vec3 light(30 * within(random), -.3f + height(random), 5 + 30 * within(random));
        const float left = within(random), bottom = within(random) * .3f, near = 1 + 4 * std::abs(within(random));
        const Cell<float> cell = lighting::cell_between<float>({left, left + .05f, bottom, bottom + .05f}, near, near * 1.2f);
        const BlockerCases cases = one_case(board, light, cell);
        const Reach told = class_of(cases);
        full += told == Reach::full ? 1 : 0;
        partial += told == Reach::partial ? 1 : 0;
        for (int k = 0; k < 16; ++k) {
            const float z = cell.z_near + .5f * (1 + within(random)) * (cell.z_far - cell.z_near);
            const glm::vec3 p(z * (left + .025f * (1 + within(random))), z * (bottom + .025f * (1 + within(random))), z);
            const bool stopped = !blockers_pass(cases, cases.lights[0], p, {1, 0});
            if (told != Reach::partial) {
                ASSERT_EQ(stopped, told == Reach::full) << i;
            }
        }
    }
    EXPECT_GT(full, 20u);
    EXPECT_GT(partial, 200u);
}

TEST(BlockerCells, NothingChangesWhereTheEyeIsInABlocker) {  // docs/algorithms/lighting.md N4
    std::mt19937 random(4);
    std::uniform_real_distribution<float> within(-1, 1);
    for (const float offset : {-.01f, 0.f, .01f})
        for (int i = 0; i < 3000; ++i) {
            const glm::vec3 normal = glm::normalize(glm::vec3(within(random), within(random), within(random)));
            const glm::vec3 u = glm::normalize(glm::cross(normal, glm::vec3(within(random), within(random), within(random))));
            const BlockerRecord blocker{
                .normal = normal, .half_u = .5f, .center = offset * normal, .half_v = .5f, .u = u, .one_sided = 0};
            const float left = 1.7f * within(random), near = .1f + std::abs(within(random));
            const Cell<float> cell = lighting::cell_between<float>({left, left + .05f, .95f, 1}, near, near + 1);
            const BlockerCases cases = one_case(blocker, 3.f * glm::vec3(within(random), within(random), within(random)), cell);
            const Reach told = class_of(cases);
            for (const glm::vec3& p : cell.corners) {
                const bool stopped = !blockers_pass(cases, cases.lights[0], p, {1, 0});
                if (told != Reach::partial) {
                    ASSERT_EQ(stopped, told == Reach::full) << i << " " << offset;
                }
            }
        }
}

/// Two halves of a rectangle somewhere, a light before it, and of `points` behind them every other seen across the seam.
struct Halves {
    BlockerCases grown, bare;  ///< as they are uploaded, and as wide as they were recorded
    LightRecord light{};
    std::vector<glm::vec3> points;

    Halves(std::mt19937& random, int count) {
        std::uniform_real_distribution<double> within(-.99, .99), beyond(.05, 30);
        const auto somewhere = [&] { return glm::dvec3(within(random), within(random), within(random)); };
        const glm::vec3 n = glm::normalize(somewhere()), u = glm::normalize(glm::cross(glm::dvec3(n), somewhere()));
        const glm::vec3 v = glm::cross(n, u);
        const glm::dvec3 center = 10. * somewhere(), from = center + glm::dvec3(n) + .5 * glm::dvec3(u) * within(random);
        Frame frame;
        for (const double side : {-.5, .5}) {
            frame.blockers.push_back({.center = center + side * glm::dvec3(u), .u = u, .v = v, .half_u = .5f, .half_v = 1});
            grown.light_blockers.push_back({static_cast<std::uint32_t>(grown.light_blockers.size()), 0});
        }
        grown.blockers = blocker_records(frame);
        bare = grown;
        for (BlockerRecord& b : bare.blockers) b.half_u = .5f;
        light.position = from;
        for (int i = 0; i < count; ++i) {
            const double across = i % 2 == 0 ? 0 : within(random);
            const glm::dvec3 crossed = center + across * glm::dvec3(u) + within(random) * glm::dvec3(v);
            points.emplace_back(crossed + (crossed - from) * beyond(random));
        }
    }
    std::size_t cracks(const BlockerCases& cases) const {
        return static_cast<std::size_t>(std::ranges::count_if(points, [&](const glm::vec3& p) {
            return blockers_pass(cases, light, p, {3, 0});
        }));
    }
};

TEST(BlockerCells, TwoBlockersThatShareAnEdgeLeaveNoCrack) {  // docs/algorithms/lighting.md T2.9
    std::mt19937 random(29);
    std::size_t cracks = 0, bare_cracks = 0;
    for (int i = 0; i < 500; ++i) {
        const Halves halves(random, 2000);
        cracks += halves.cracks(halves.grown);
        bare_cracks += halves.cracks(halves.bare);
    }
    EXPECT_EQ(cracks, 0u) << "of a million points";
    EXPECT_GT(bare_cracks, 100u) << "no point needed that blockers grow by 1e-5";
}

/// A closed box of half size 1 around a light in the middle of the view, 5 m away.
struct ClosedBox {
    Frame frame;
    Light light;
    ClosedBox() {
        light.position = {.2, -.1, 5};
        for (std::uint32_t i = 0; i < 6; ++i) {
            glm::vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
            const std::uint32_t axis = i / 2;
            const glm::dvec3 out = (i % 2 == 0 ? 1.f : -1.f) * axes[axis];
            frame.blockers.push_back({.center = glm::dvec3(0, 0, 5) + out, .u = axes[(axis + 1) % 3], .v = axes[(axis + 2) % 3]});
            light.blockers.push_back(i);
        }
    }
};

TEST(BlockerCells, NoLightLeavesAClosedBox) {  // docs/algorithms/lighting.md T2.10
    const ClosedBox box;
    const LightBlockers all = light_blockers(box.frame, box.light);
    const glm::dvec4 from = light_point(box.frame, box.light);
    ASSERT_EQ(all.blockers.size(), 6u);
    std::mt19937 random(10);
    std::uniform_real_distribution<double> within(-8, 8);
    for (int i = 0; i < 200000; ++i) {
        const glm::dvec3 p = glm::dvec3(0, 0, 5) + glm::dvec3(within(random), within(random), within(random));
        const glm::dvec3 d = glm::abs(p - glm::dvec3(0, 0, 5));
        const double out = std::max({d.x, d.y, d.z});
        if (std::abs(out - 1) > .0051) {
            ASSERT_EQ(lets_through(all, from, p), out < 1) << p.x << " " << p.y << " " << p.z;
        }
    }
}

TEST(BlockerCells, TilesBehindAFaceOfAClosedBoxLoseTheLight) {  // docs/algorithms/lighting.md T2.10
    const ClosedBox box;
    const std::vector<BlockerRecord> all = blocker_records(box.frame);
    const auto edge = [](int i) { return float(i) / 22.5f; };
    int killed = 0, undecided = 0;
    for (int y = -22; y < 22; ++y)
        for (int x = -40; x < 40; ++x) {
            const lighting::TileRays<float> rays{edge(x), edge(x + 1), edge(y), edge(y + 1)};
            const Cell<float> cell = lighting::cell_between(rays, 7.f, 8.f);
            int full = 0, partial = 0;
            for (const BlockerRecord& face : all) {
                const Reach told = lighting::classify(face, glm::vec4(light_point(box.frame, box.light)), cell);
                full += told == Reach::full ? 1 : 0;
                partial += told == Reach::partial ? 1 : 0;
            }
            ASSERT_TRUE(full > 0 || partial > 1) << "a tile behind the box that no face, or no seam of two, keeps dark";
            killed += full > 0 ? 1 : 0;
            undecided += full > 0 ? 0 : 1;
        }
    EXPECT_GT(killed, 3000) << "of 3520 tiles";
    EXPECT_GT(undecided, 100) << "seams between two faces are left to the pixels";
}

}  // namespace
}  // namespace strata
