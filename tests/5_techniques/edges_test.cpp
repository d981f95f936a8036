// Edges on the device: whose sides, lines and planes are marked, and whether the stage's truth itself can be believed
// (docs/algorithms/deferred.md T-MS-2, T-MS-4, T-MS-5).
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "captures/scenarios.h"
#include "passes/gbuffer/nearest.h"
#include "passes/registry.h"
#include "replay/images/image_io.h"
#include "tests/support/pixel_triangles.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr glm::uvec2 extent{64, 36};
const std::vector<std::string> comparing = {"edges/bitwise", "edges/tolerant", "edges/coverage", "edges/depth", "edges/mean"};

std::unique_ptr<Session> session_of(const std::vector<PixelTriangle>& triangles, std::uint32_t samples = 4) {
    return must(Session::open({frame_of_triangles(extent, samples, triangles)}, {.validation = true}));
}

/// A wall, and before it another from a column on.
std::unique_ptr<Session> wall_right_of(double column) {
    return session_of({whole_picture(extent, 4), right_of(extent, column, 2, {.1f, .2f, .3f})});
}

/// Planes z = 4 and 1 / z = 1/4 + (x - 15.5) / 128, which cross at x = 15.5.
std::unique_ptr<Session> crossing_planes() {
    PixelTriangle slanted = whole_picture(extent, 4, {.9f, .1f, .1f});
    for (glm::dvec3& corner : slanted.corners) corner.z = 1 / (.25 + (corner.x - 15.5) / 256);
    return session_of({whole_picture(extent, 4), slanted});
}

Run run_with(Session& session, const std::string& edges, const std::vector<std::string>& sets = {}) {
    return must(session.run({.choices = chosen({edges}, sets), .outputs = {"edges", "display", "surface_color"}}));
}

std::uint64_t count_of(const Run& run, std::string_view stage, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique.starts_with(stage) && counter.name == name) return counter.value;
    throw std::runtime_error(fmt::format("no counter {} of {}", name, stage));
}

std::vector<glm::uvec2> marked(const Run& run) {
    const ReferenceImage edges = in_double(run.images.at("edges"));
    std::vector<glm::uvec2> pixels;
    for (std::uint32_t y = 0; y < edges.height; ++y)
        for (std::uint32_t x = 0; x < edges.width; ++x)
            if (edges.at(x, y).x != 0) pixels.emplace_back(x, y);
    return pixels;
}

bool is_column(const std::vector<glm::uvec2>& pixels, std::uint32_t column) {
    if (pixels.size() != extent.y) return false;
    for (const glm::uvec2& pixel : pixels)
        if (pixel.x != column) return false;
    return true;
}

TEST(Edges, AVerticalSideMarksItsColumnAndOneBetweenPixelsNothing) {
    for (const double column : {20.5, 20.25}) {
        const auto session = wall_right_of(column);
        for (const std::string& edges : comparing)
            EXPECT_TRUE(is_column(marked(run_with(*session, edges)), 20)) << edges << " at " << column;
    }
    const auto session = wall_right_of(20);
    for (const std::string& edges : comparing) EXPECT_TRUE(marked(run_with(*session, edges)).empty()) << edges;
}

TEST(Edges, AVerticalSideCoversTheSamplesRightOfItAndShadesThreeMorePerPixel) {
    for (const auto& [column, left] : {std::pair(20.5, 0b0101u), std::pair(20.25, 0b0100u)}) {
        const auto session = wall_right_of(column);
        const auto run = run_with(*session, "edges/bitwise");
        const ReferenceImage color = in_double(run.images.at("surface_color"));
        for (std::uint32_t sample = 0; sample < 4; ++sample)
            EXPECT_EQ(color.at(20, 9, sample) == color.at(19, 9), (left >> sample & 1u) != 0) << column << " sample " << sample;
        // 2073600 + 3 * 1080 = 2076840 where the picture is 1920 x 1080.
        EXPECT_EQ(count_of(run, "lighting/", "samples_shaded"), extent.x * extent.y + 3 * extent.y);
        EXPECT_EQ(count_of(run, "edges/", "edge_samples"), 4 * extent.y);
    }
}

TEST(Edges, DepthAloneMissesASideThatHalvesThePixel) {
    EXPECT_TRUE(marked(run_with(*wall_right_of(20.5), "edges/depth", {"paired_with=nothing"})).empty());
    EXPECT_TRUE(is_column(marked(run_with(*wall_right_of(20.25), "edges/depth", {"paired_with=nothing"})), 20));
}

TEST(Edges, TheLineWhereTrianglesCrossIsMarkedByAllButCoverageAlone) {
    const auto session = crossing_planes();
    EXPECT_TRUE(marked(run_with(*session, "edges/coverage")).empty());
    EXPECT_TRUE(is_column(marked(run_with(*session, "edges/coverage", {"with_tests=material"})), 15));
    EXPECT_TRUE(is_column(marked(run_with(*session, "edges/depth", {"paired_with=nothing"})), 15));
    for (const char* edges : {"edges/bitwise", "edges/tolerant", "edges/depth", "edges/mean"})
        EXPECT_TRUE(is_column(marked(run_with(*session, edges)), 15)) << edges;
}

TEST(Edges, OneTriangleOverThePictureHasNone) {
    PixelTriangle slanted = whole_picture(extent, 4);
    for (glm::dvec3& corner : slanted.corners) corner.z = 1 / (.25 + (corner.x - 15.5) / 512 + corner.y / 2048);
    const auto session = session_of({slanted});
    for (const std::string& edges : comparing) {
        const auto run = run_with(*session, edges);
        EXPECT_TRUE(marked(run).empty()) << edges;
        EXPECT_EQ(count_of(run, "edges/", "plain_pixels"), extent.x * extent.y) << edges;
    }
}

TEST(Edges, PixelsAreCountedAsPlainEdgeOrSky) {
    const auto session = session_of({right_of(extent, 20.5, 2, {.1f, .2f, .3f})});
    for (const std::string& edges : comparing) {
        const auto run = run_with(*session, edges);
        EXPECT_EQ(count_of(run, "edges/", "sky_pixels"), 20 * extent.y) << edges;
        EXPECT_EQ(count_of(run, "edges/", "edge_pixels"), extent.y) << edges;
        EXPECT_EQ(count_of(run, "edges/", "plain_pixels"), 43 * extent.y) << edges;
        EXPECT_EQ(count_of(run, "edges/", "edge_samples"), 2 * extent.y) << edges << ": samples of the sky are not shaded";
    }
}

TEST(Edges, OneSampleHasNoneAndForcingTheStageChangesNoPixel) {
    const auto session = session_of({whole_picture(extent, 4), right_of(extent, 20.5, 2, {.1f, .2f, .3f})}, 1);
    const std::string plain = hash_of(must(session->run({})).images.at("display"));
    for (const Technique* technique : techniques_of(Stage::edges)) {
        Request forced{.choices = chosen({std::string(technique->name)}), .outputs = {"display", "edges"}};
        forced.variant.force.assign(all_features().begin(), all_features().end());
        const auto run = must(session->run(forced));
        EXPECT_EQ(hash_of(run.images.at("display")), plain) << technique->name;
        EXPECT_FALSE(run.images.contains("edges")) << technique->name;
    }
}

TEST(Edges, TheTableCountsSurfacesAndTheViewShowsWhatIsMissed) {
    const auto session = crossing_planes();
    const std::string table = "edges/coverage:surfaces per pixel", view = "edges/coverage:outcome";
    const auto run = must(session->run({.choices = chosen({"edges/coverage"}), .outputs = {table, view}}));
    const auto& rows = run.tables.at(table).rows;
    ASSERT_EQ(rows.size(), 5u);
    for (std::size_t surfaces = 0; surfaces < rows.size(); ++surfaces) {
        EXPECT_EQ(rows[surfaces][0], double(surfaces));
        EXPECT_EQ(rows[surfaces][1], surfaces == 1 ? 63. * extent.y : surfaces == 2 ? 1. * extent.y : 0);
        EXPECT_EQ(rows[surfaces][2], 0) << "coverage alone marks nothing";
    }
    const ReferenceImage outcome = in_double(run.images.at(view));
    for (std::uint32_t x = 0; x < extent.x; ++x) EXPECT_EQ(outcome.at(x, 9).x == 1, x == 15) << x;
}

/// Whether what is stored of two surfaces must differ, however coarsely a layout stores it.
bool clearly_differ(const SurfacePoint& a, const SurfacePoint& b) {
    if (a.model != b.model || glm::dot(a.normal, b.normal) < .999) return true;
    if (std::abs(a.position.z - b.position.z) > 3e-3 * std::min(a.position.z, b.position.z)) return true;
    return glm::length(a.base_color - b.base_color) > .1;
}

/// What the surfaces of a pixel in double say of it.
enum class Geometry { unclear, plain, edge };

Geometry geometry_of(const std::vector<gbuffer::NearestSurface>& surfaces, const VisiblePoints& visible, glm::uvec2 pixel) {
    bool is_edge = false, is_one = true;
    const std::size_t first = visible.index(pixel.x, pixel.y, 0);
    for (std::uint32_t sample = 0; sample < visible.samples; ++sample) {
        const std::size_t i = visible.index(pixel.x, pixel.y, sample);
        if (surfaces[i].undecided) return Geometry::unclear;
        is_one = is_one && visible.points[i].draw == visible.points[first].draw &&
                 visible.points[i].triangle == visible.points[first].triangle;
        if (surfaces[i].exists != surfaces[first].exists) is_edge = true;
        else if (surfaces[i].exists) is_edge = is_edge || clearly_differ(surfaces[i].point, surfaces[first].point);
    }
    if (is_edge) return Geometry::edge;
    return is_one ? Geometry::plain : Geometry::unclear;
}

// The truth reads the words that the device stored. Here is what does not: the triangles of the recorded frame in double.
TEST(EdgesTruth, IsWhatTheTrianglesUnderTheSamplesSay) {
    for (const std::string_view scenario : info(Stage::edges).scenarios) {
        const Frame frame = must(find_scenario(scenario))->build(0, {.width = 96, .height = 54, .samples = 4});
        const auto session = must(Session::open({frame}, {.validation = true}));
        const ReferenceImage truth = must(session->truth({}, Stage::edges)).at("edges");
        const auto surfaces = gbuffer::nearest_surfaces(frame, ShadeAt::pixel_center);
        const VisiblePoints visible = visible_points(frame, opaque_draws(frame));
        std::array<std::uint32_t, 3> pixels{}, wrong{};
        for (std::uint32_t y = 0; y < truth.height; ++y)
            for (std::uint32_t x = 0; x < truth.width; ++x) {
                const Geometry geometry = geometry_of(surfaces, visible, {x, y});
                ++pixels[std::size_t(geometry)];
                if (geometry == Geometry::unclear) continue;
                wrong[std::size_t(geometry)] += (truth.at(x, y).x != 0) != (geometry == Geometry::edge);
            }
        EXPECT_EQ(wrong[std::size_t(Geometry::plain)], 0u) << scenario << ": one triangle covers all samples of these";
        EXPECT_EQ(wrong[std::size_t(Geometry::edge)], 0u) << scenario << ": samples of these show different surfaces";
        EXPECT_GT(pixels[std::size_t(Geometry::edge)], 60u) << scenario;
        EXPECT_LT(pixels[std::size_t(Geometry::unclear)], truth.texels.size() / 8) << scenario;
    }
}

}  // namespace
}  // namespace strata
