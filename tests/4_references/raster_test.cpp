// Why rasterize() can be believed: coverage that adds up, depths and barycentrics known by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>

#include "passes/reference/fragments.h"
#include "passes/reference/shade.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

std::vector<RasterPoint> points_of(const Frame& frame, RasterOptions options = {}) {
    std::vector<std::uint32_t> draws(frame.draws.size() + frame.emitters.size());
    std::iota(draws.begin(), draws.end(), 0u);
    std::vector<std::vector<RasterPoint>> rows(frame.view.height);
    rasterize(frame, draws, options, [&](const RasterPoint& p) { rows[p.y].push_back(p); });
    std::vector<RasterPoint> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
}

// How often each sample is covered, x fastest, then y, then sample.
std::vector<int> coverage_of(const Frame& frame) {
    const View& view = frame.view;
    std::vector<int> counts(std::size_t(view.width) * view.height * view.samples);
    for (const RasterPoint& p : points_of(frame)) ++counts[(std::size_t(p.sample) * view.height + p.y) * view.width + p.x];
    return counts;
}

// A rectangle of the image cut into triangles around random inner points on a jittered grid.
Frame cut_rectangle(std::uint32_t samples, std::uint64_t seed) {
    Frame frame = tiny::frame(64, 64, samples);
    tiny::Random random(seed);
    Mesh mesh;
    constexpr std::uint32_t n = 9;
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const bool edge_x = i == 0 || i == n - 1, edge_y = j == 0 || j == n - 1;
            const double x = 4 + 7 * (i + (edge_x ? 0 : random.between(-0.2, 0.2)));
            const double y = 4 + 7 * (j + (edge_y ? 0 : random.between(-0.2, 0.2)));
            mesh.positions.emplace_back(tiny::under(frame, x, y, 4));
        }
    }
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
        for (std::uint32_t i = 0; i + 1 < n; ++i) {
            const std::uint32_t a = j * n + i;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + n, a + n, a + 1, a + n + 1});
        }
    }
    tiny::add_mesh(frame, mesh);
    return frame;
}

TEST(Raster, ASharedEdgeIsCoveredOnce) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        for (const std::uint32_t samples : {1u, 4u}) {
            const std::vector<int> counts = coverage_of(cut_rectangle(samples, seed));
            EXPECT_EQ(*std::max_element(counts.begin(), counts.end()), 1) << "seed " << seed;
            EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 56 * 56 * static_cast<int>(samples)) << "seed " << seed;
        }
    }
}

TEST(Raster, TotalCoverageIsTheArea) {
    tiny::Random random(5);
    double area = 0, covered = 0;
    for (int i = 0; i < 200; ++i) {
        Frame frame = tiny::frame(48, 48, 4);
        std::array<glm::dvec3, 3> pixels, corners;
        for (std::size_t k = 0; k < 3; ++k) {
            pixels[k] = {random.between(1, 47), random.between(1, 47), 0};
            corners[k] = tiny::under(frame, pixels[k].x, pixels[k].y, random.between(1, 9));
        }
        tiny::add_triangles(frame, corners);
        area += 0.5 * std::abs(glm::cross(pixels[1] - pixels[0], pixels[2] - pixels[0]).z);
        covered += double(points_of(frame).size()) / 4;
    }
    // 200 triangles of about 175 pixels; a triangle's own error is below half a pixel rms (docs/algorithms/deferred.md 0.5).
    EXPECT_NEAR(covered / area, 1, 2e-3);
}

TEST(Raster, ASampleOnATopOrLeftEdgeIsCoveredAndOnABottomOrRightEdgeIsNot) {
    Frame frame = tiny::frame(8, 8);
    tiny::add_quad(frame, {.left = 1.5, .top = 2.5, .right = 4.5, .bottom = 6.5}, 2);
    for (const RasterPoint& p : points_of(frame)) {
        EXPECT_TRUE(p.x >= 1 && p.x < 4 && p.y >= 2 && p.y < 6) << p.x << ", " << p.y;
        EXPECT_EQ(p.undecided, p.x == 1 || p.y == 2) << p.x << ", " << p.y;
    }
    EXPECT_EQ(points_of(frame).size(), 12u);
}

/// Sides at x 1.5, 4.4 and y 2.5, 6.4: samples in the middle of pixels are 0 or .1 pixel from them, in two columns and two rows
/// each.
TEST(Raster, SamplesNearSidesAreThoseWithinTheStepsAlsoBeyondThePolygon) {
    Frame frame = tiny::frame(8, 8);
    tiny::add_quad(frame, {.left = 1.5, .top = 2.5, .right = 4.4, .bottom = 6.4}, 2);
    const auto near = [&](double steps) {
        std::vector<std::pair<int, int>> found;
        const std::vector<bool> all = samples_near_sides(frame, steps);
        for (int i = 0; i < 64; ++i)
            if (all[std::size_t(i)]) found.emplace_back(i % 8, i / 8);
        return found;
    };
    const auto is_on = [](std::pair<int, int> at, bool coarse) {
        const auto [x, y] = at;
        const bool beside = (x == 1 || (coarse && x == 4)) && y >= 2 && y <= (coarse ? 6 : 5);
        const bool above = (y == 2 || (coarse && y == 6)) && x >= 1 && x <= (coarse ? 4 : 3);
        return beside || above;
    };
    for (const bool coarse : {false, true}) {
        std::vector<std::pair<int, int>> expected;
        for (int i = 0; i < 64; ++i)
            if (is_on({i % 8, i / 8}, coarse)) expected.emplace_back(i % 8, i / 8);
        EXPECT_EQ(near(coarse ? 26 : 1.5), expected);  // .1 pixel are 25.6 steps
    }
}

/// Of a square that covers all 8 x 8 pixels, one diagonal is a seam; it passes through the middles of 8 of them.
TEST(Raster, SeamsAreSidesForThoseWhoAskWhichTriangleCoversASample) {
    Frame frame = tiny::frame(8, 8);
    tiny::add_quad(frame, {.left = 0, .top = 0, .right = 8, .bottom = 8}, 2);
    for (const bool near_seams : {false, true}) {
        const std::vector<RasterPoint> points = points_of(frame, {.near_seams = near_seams});
        EXPECT_EQ(points.size(), 64u);
        EXPECT_EQ(std::ranges::count(points, true, &RasterPoint::undecided), near_seams ? 8 : 0);
    }
}

TEST(Raster, FourSamplesSeeAVerticalEdgeAsDeferredTMS2Says) {
    const std::array<std::pair<double, std::vector<std::uint32_t>>, 3> cases = {{{10.5, {0, 2}}, {10.25, {2}}, {10.0, {}}}};
    for (const auto& [edge, expected] : cases) {
        Frame frame = tiny::frame(20, 10, 4);
        tiny::add_quad(frame, {.left = -20, .top = -20, .right = edge, .bottom = 40}, 3);
        std::vector<std::uint32_t> partial;
        for (const RasterPoint& p : points_of(frame)) {
            EXPECT_FALSE(p.undecided);
            if (p.x == 10 && p.y == 4) partial.push_back(p.sample);
            EXPECT_LE(p.x, 10u);
        }
        EXPECT_EQ(partial, expected) << "edge at " << edge;
        EXPECT_EQ(points_of(frame).size(), 10u * (10 * 4 + expected.size()));
    }
}

TEST(Raster, DepthAndBarycentricsOfAKnownTriangle) {
    Frame frame = tiny::frame(16, 16, 4);
    const std::array<glm::dvec3, 3> corners = {tiny::under(frame, 1, 1, 2), tiny::under(frame, 15, 2, 8),
                                               tiny::under(frame, 3, 14, 0.5)};
    const std::uint32_t draw = tiny::add_triangles(frame, corners);
    const Mesh& mesh = frame.meshes[draw];
    const std::vector<RasterPoint> points = points_of(frame);
    ASSERT_GT(points.size(), 200u);
    for (const RasterPoint& p : points) {
        const glm::dvec2 at = glm::dvec2(p.x, p.y) + sample_position(4, p.sample);
        glm::dvec3 position(0);
        for (int i = 0; i < 3; ++i) position += p.barycentric[i] * glm::dvec3(mesh.positions[static_cast<std::size_t>(i)]);
        EXPECT_NEAR(p.barycentric.x + p.barycentric.y + p.barycentric.z, 1, 1e-12);
        EXPECT_LT(glm::length(position - tiny::under(frame, at.x, at.y, position.z)), 1e-9);
        EXPECT_NEAR(p.depth, 0.125 / position.z, 1e-12);
    }
}

TEST(Raster, ShadingAtThePixelCenterKeepsCoverageAndDepthOfTheSample) {
    Frame frame = tiny::frame(16, 16, 4);
    const std::array<glm::dvec3, 3> corners = {tiny::under(frame, 1, 1, 2), tiny::under(frame, 15, 2, 8),
                                               tiny::under(frame, 3, 14, 0.5)};
    tiny::add_triangles(frame, corners);
    const std::vector<RasterPoint> at_sample = points_of(frame),
                                   at_center = points_of(frame, {.shade_at = ShadeAt::pixel_center});
    ASSERT_EQ(at_sample.size(), at_center.size());
    for (std::size_t i = 0; i < at_sample.size(); ++i) {
        const RasterPoint& p = at_center[i];
        EXPECT_EQ(p.depth, at_sample[i].depth);
        glm::dvec3 position(0);
        for (int k = 0; k < 3; ++k) position += p.barycentric[k] * corners[static_cast<std::size_t>(k)];
        EXPECT_LT(glm::length(position - tiny::under(frame, p.x + 0.5, p.y + 0.5, position.z)), 1e-5 * position.z);
    }
}

TEST(Raster, ATriangleThroughTheNearPlaneIsCutThere) {
    Frame frame = tiny::frame(64, 64);
    // A floor 1 m below the eye from 4 m behind it to far ahead: it fills the rows below the horizon down to the near plane.
    const std::array<glm::dvec3, 3> corners = {{{-4000, -1, -4}, {0, -1, 4000}, {4000, -1, -4}}};
    tiny::add_triangles(frame, corners);
    const std::vector<int> counts = coverage_of(frame);
    for (std::size_t y = 0; y < 64; ++y) EXPECT_EQ(counts[y * 64 + 32], y < 32 ? 0 : 1) << "row " << y;
    for (const RasterPoint& p : points_of(frame)) {
        EXPECT_GE(0.125 / p.depth, 0.125);
        EXPECT_NEAR(0.125 / p.depth, 1 / ((p.y + 0.5) / 32 - 1), 1e-6);
    }
}

TEST(Raster, NothingBehindTheNearPlaneIsSeen) {
    Frame frame = tiny::frame(16, 16);
    tiny::add_quad(frame, {.left = 0, .top = 0, .right = 16, .bottom = 16}, 0.1);
    tiny::add_quad(frame, {.left = 0, .top = 0, .right = 16, .bottom = 16}, -2);
    EXPECT_TRUE(points_of(frame).empty());
}

TEST(Raster, BackFacesOfSingleSidedTrianglesAreCulledInEveryAlphaMode) {
    Frame frame = tiny::frame(16, 16);
    // cross(b - a, c - a) points towards the eye (-z): the front.
    const std::array<glm::dvec3, 3> front = {{{0, 0, 2}, {0, 1, 2}, {1, 0, 2}}}, back = {{{0, 0, 2}, {0, 1, 2}, {-1, 0, 2}}};
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend}) {
        Frame f = frame;
        tiny::material(f, tiny::add_triangles(f, front, mode)).double_sided = false;
        tiny::material(f, tiny::add_triangles(f, back, mode)).double_sided = false;
        int fronts = 0, backs = 0;
        for (const RasterPoint& p : points_of(f)) ++(p.front_facing ? fronts : backs);
        EXPECT_GT(fronts, 0);
        EXPECT_EQ(backs, 0);
    }
}

TEST(Raster, AMirroredDrawShowsTheSameFace) {
    Frame frame = tiny::frame(16, 16);
    const std::array<glm::dvec3, 3> front = {{{0, 0, 2}, {0, 1, 2}, {1, 0, 2}}};
    const std::uint32_t draw = tiny::add_triangles(frame, front);
    tiny::material(frame, draw).double_sided = false;
    frame.draws[draw].to_world[0][0] = -1;
    const std::vector<RasterPoint> points = points_of(frame);
    ASSERT_FALSE(points.empty());
    for (const RasterPoint& p : points) EXPECT_TRUE(p.front_facing && p.x < 8);
}

TEST(Raster, JitterMovesTheImageInClipSpace) {
    Frame frame = tiny::frame(20, 10);
    tiny::add_quad(frame, {.left = 2.25, .top = 3.25, .right = 5.25, .bottom = 6.25}, 2);
    const std::size_t still = points_of(frame).size();
    frame.view.jitter = {2.0f / 20, 4.0f / 10};
    const std::vector<RasterPoint> moved = points_of(frame);
    EXPECT_EQ(moved.size(), still);
    for (const RasterPoint& p : moved) EXPECT_TRUE(p.x >= 3 && p.x < 6 && p.y >= 5 && p.y < 8) << p.x << ", " << p.y;
}

TEST(Raster, NearMissesAreVisitedOnRequest) {
    Frame frame = tiny::frame(8, 8);
    // One step of 1/256 right of the centers of column 2, so that the device may or may not cover them.
    tiny::add_quad(frame, {.left = 2.5 + 1.0 / 256, .top = 1, .right = 5, .bottom = 3}, 2);
    EXPECT_EQ(points_of(frame).size(), 4u);
    std::size_t misses = 0;
    for (const RasterPoint& p : points_of(frame, {.near_misses = true})) {
        misses += p.covered ? 0 : 1;
        EXPECT_EQ(p.undecided, !p.covered);
        EXPECT_EQ(p.covered, p.x > 2);
    }
    EXPECT_EQ(misses, 2u);
}

TEST(Raster, ParticlesAreQuadsInTheViewPlaneWithVDown) {
    Frame frame = tiny::frame(32, 32);
    Emitter emitter;
    Particle particle;
    particle.center = tiny::under(frame, 20, 12, 4);
    particle.size = 0.5f;  // 2 pixels at 4 m: 16 pixels are 4 m there
    particle.rotation = 0;
    emitter.particles = {particle};
    frame.emitters = {emitter};
    const std::vector<RasterPoint> points = points_of(frame);
    EXPECT_EQ(points.size(), 16u);
    for (const RasterPoint& p : points) {
        EXPECT_TRUE(p.x >= 18 && p.x < 22 && p.y >= 10 && p.y < 14);
        EXPECT_NEAR(p.depth, 0.125 / 4, 1e-12);
        EXPECT_TRUE(p.front_facing);
        EXPECT_FALSE(p.undecided) << "the diagonal decides nothing";
    }
}

TEST(Raster, UndecidedSamplesAreFew) {
    Frame frame = cut_rectangle(4, 3);
    const auto undecided = [&] {
        const VisiblePoints visible = visible_points(frame, opaque_draws(frame));
        EXPECT_EQ(visible.at(1, 1).draw, no_index);
        EXPECT_EQ(visible.at(30, 30, 2).draw, 0u);
        const auto count =
            std::count_if(visible.points.begin(), visible.points.end(), [](const RasterPoint& p) { return p.undecided; });
        return double(count) / double(visible.points.size());
    };
    EXPECT_EQ(undecided(), 0) << "one flat piece: no matter which of two triangles covers a sample";
    // The same pixels at other depths: now every side counts, each 3 steps of 1/256 pixel wide.
    tiny::Random random(1);
    for (glm::vec3& position : frame.meshes[0].positions) position *= static_cast<float>(random.between(0.8, 1.2));
    EXPECT_GT(undecided(), 0);
    EXPECT_LT(undecided(), 0.02);
}

TEST(Raster, TheNearestSurfaceIsVisibleAndTiesAreUndecided) {
    Frame frame = tiny::frame(16, 16);
    tiny::add_quad(frame, {.left = -1, .top = -1, .right = 17, .bottom = 17}, 5);
    tiny::add_quad(frame, {.left = 4, .top = -1, .right = 17, .bottom = 17}, 3);
    tiny::add_quad(frame, {.left = 8, .top = -1, .right = 17, .bottom = 17}, 4);
    tiny::add_quad(frame, {.left = 12, .top = -1, .right = 17, .bottom = 17}, 3);
    const VisiblePoints visible = visible_points(frame, opaque_draws(frame));
    for (std::uint32_t x = 0; x < 16; ++x) {
        EXPECT_EQ(visible.at(x, 7).draw, x < 4 ? 0u : x < 12 ? 1u : 3u) << x;
        EXPECT_EQ(visible.at(x, 7).undecided, x >= 12) << x;
    }
}

}  // namespace
}  // namespace strata
