// Edges on the device: whose sides, lines and planes are marked, and whether the stage's truth itself can be believed
// (docs/algorithms/deferred.md T-MS-2, T-MS-4, T-MS-5).
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/nearest.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/support/pixel_triangles.h"
#include "tests/support/session.h"

namespace strata::edge_marks {
namespace {

constexpr glm::uvec2 extent{64, 36};
constexpr glm::vec3 blue{.1f, .2f, .3f}, red{.9f, .1f, .1f};
/// Coverage has tests of its own: lavapipe cuts triangles at the picture's border, and the pieces have seams.
const std::vector<std::string> comparing = {"edges/bitwise", "edges/tolerant", "edges/depth", "edges/mean"};

PixelTriangle slanted(PixelTriangle triangle, double per_column, double per_row) {
    for (glm::dvec3& corner : triangle.corners) corner.z = 1 / (.25 + (corner.x - 15.5) * per_column + corner.y * per_row);
    triangle.color = red;
    return triangle;
}

PixelTriangle inside_the_picture(double depth) {
    return {.corners = {glm::dvec3(2.2, 1.2, depth), {2.2, 34.7, depth}, {61.7, 17.7, depth}}};
}

enum Scene : std::size_t {
    side_at_20_5,
    side_at_20_25,
    side_at_20,
    crossing,
    crossing_inside,
    one_triangle,
    half_sky,
    glowing_side
};

/// Walls with another before it from a column on; planes that cross at x = 15.5, over the picture and inside; one slanted plane;
/// and a wall beside the sky.
Session& scenes() {
    static const std::unique_ptr<Session> session = [] {
        const PixelTriangle wall = whole_picture(extent, 4);
        std::vector<Frame> frames;
        const auto add = [&](const std::vector<PixelTriangle>& triangles) {
            frames.push_back(frame_of_triangles(extent, 4, triangles));
        };
        for (const double column : {20.5, 20.25, 20.}) add({wall, right_of(extent, column, 2, blue)});
        add({wall, slanted(wall, 1. / 256, 0)});
        add({inside_the_picture(4), slanted(inside_the_picture(4), 1. / 256, 0)});
        add({slanted(wall, 1. / 512, 1. / 2048)});
        add({right_of(extent, 20.5, 2, blue)});
        PixelTriangle glowing = right_of(extent, 20.5, 3.9999, wall.color);  // the depth is stored in steps of 1.9e-4 of itself
        glowing.emissive = red;
        add({wall, glowing});
        return session_of(std::move(frames));
    }();
    return *session;
}

Run run_with(Scene scene, const std::string& edges, const std::vector<std::string>& sets = {}) {
    return must(scenes().run(
        {.variant = {.frame = scene}, .choices = chosen({edges}, sets), .outputs = {"edges", "display", "surface_color"}}));
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
    for (const std::string& edges : comparing) {
        EXPECT_TRUE(is_column(marked(run_with(side_at_20_5, edges)), 20)) << edges;
        EXPECT_TRUE(is_column(marked(run_with(side_at_20_25, edges)), 20)) << edges;
        EXPECT_TRUE(marked(run_with(side_at_20, edges)).empty()) << edges;
    }
}

TEST(Edges, AVerticalSideCoversTheSamplesRightOfItAndShadesThreeMorePerPixel) {
    for (const auto& [scene, left] : {std::pair(side_at_20_5, 0b0101u), std::pair(side_at_20_25, 0b0100u)}) {
        const auto run = run_with(scene, "edges/bitwise");
        const ReferenceImage color = in_double(run.images.at("surface_color"));
        for (std::uint32_t sample = 0; sample < 4; ++sample)
            EXPECT_EQ(color.at(20, 9, sample) == color.at(19, 9), (left >> sample & 1u) != 0) << "sample " << sample;
        // 2073600 + 3 * 1080 = 2076840 where the picture is 1920 x 1080.
        EXPECT_EQ(count_of(run, "lighting/", "samples_shaded"), extent.x * extent.y + 3 * extent.y);
        EXPECT_EQ(count_of(run, "edges/", "edge_samples"), 4 * extent.y);
    }
}

TEST(Edges, ASideThatOnlyEmissionTellsIsMarkedByWordsAndByMaterials) {
    for (const char* edges : {"edges/bitwise", "edges/tolerant"})
        EXPECT_TRUE(is_column(marked(run_with(glowing_side, edges)), 20)) << edges;
    EXPECT_TRUE(marked(run_with(glowing_side, "edges/mean")).empty()) << "X-Ray compares the first image alone";
    EXPECT_TRUE(is_column(marked(run_with(glowing_side, "edges/mean", {"compares=all"})), 20));
}

TEST(Edges, DepthAloneMissesASideThatHalvesThePixel) {
    EXPECT_TRUE(marked(run_with(side_at_20_5, "edges/depth", {"paired_with=nothing"})).empty());
    EXPECT_TRUE(is_column(marked(run_with(side_at_20_25, "edges/depth", {"paired_with=nothing"})), 20));
}

TEST(Edges, TheLineWhereTrianglesCrossIsMarked) {
    EXPECT_TRUE(is_column(marked(run_with(crossing, "edges/depth", {"paired_with=nothing"})), 15));
    for (const std::string& edges : comparing) EXPECT_TRUE(is_column(marked(run_with(crossing, edges)), 15)) << edges;
}

/// Marks within the triangles' sides.
std::vector<glm::uvec2> marked_inside(const std::vector<std::string>& sets) {
    std::vector<glm::uvec2> pixels = marked(run_with(crossing_inside, "edges/coverage", sets));
    EXPECT_GT(pixels.size(), 60u) << "the sides themselves";
    std::erase_if(pixels, [](const glm::uvec2& p) { return p.x < 8 || p.x > 24 || p.y < 13 || p.y > 23; });
    return pixels;
}

TEST(Edges, CoverageAloneMissesTheLineWhereTrianglesCross) {
    EXPECT_TRUE(marked_inside({}).empty());
    const std::vector<glm::uvec2> with_material = marked_inside({"with_tests=material"});
    EXPECT_EQ(with_material.size(), 11u);
    for (const glm::uvec2& pixel : with_material) EXPECT_EQ(pixel.x, 15u);
    EXPECT_TRUE(marked_inside({"with_tests=depth"}).empty()) << "on the line both have one depth at the pixel's center";
}

TEST(Edges, CoverageMarksTheColumnOfASideAndSeamsOfTheDevicesOwnClipping) {
    const auto has = [](const std::vector<glm::uvec2>& pixels, std::uint32_t column) {
        return std::ranges::count(pixels, column, [](const glm::uvec2& p) { return p.x; });
    };
    EXPECT_EQ(has(marked(run_with(side_at_20_5, "edges/coverage")), 20), std::ptrdiff_t(extent.y));
    const std::size_t seams = marked(run_with(one_triangle, "edges/coverage")).size();
    EXPECT_LT(seams, 3 * (extent.x + extent.y)) << "at most three lines across the picture; none with a guard band";
    RecordProperty("marked in one triangle", static_cast<int>(seams));
}

TEST(Edges, OneTriangleOverThePictureHasNone) {
    for (const std::string& edges : comparing) {
        const auto run = run_with(one_triangle, edges);
        EXPECT_TRUE(marked(run).empty()) << edges;
        EXPECT_EQ(count_of(run, "edges/", "plain_pixels"), extent.x * extent.y) << edges;
    }
}

TEST(Edges, PixelsAreCountedAsPlainEdgeOrSky) {
    for (const std::string& edges : comparing) {
        const auto run = run_with(half_sky, edges);
        EXPECT_EQ(count_of(run, "edges/", "sky_pixels"), 20 * extent.y) << edges;
        EXPECT_EQ(count_of(run, "edges/", "edge_pixels"), extent.y) << edges;
        EXPECT_EQ(count_of(run, "edges/", "plain_pixels"), 43 * extent.y) << edges;
        EXPECT_EQ(count_of(run, "edges/", "edge_samples"), 2 * extent.y) << edges << ": samples of the sky are not shaded";
    }
}

TEST(Edges, OneSampleHasNoneAndForcingTheStageChangesNoPixel) {
    const FrameVariant one_sample{.frame = side_at_20_5, .samples = 1};
    const std::string plain = hash_of(must(scenes().run({.variant = one_sample})).images.at("display"));
    for (const Technique* technique : techniques_of(Stage::edges)) {
        Request forced{.variant = one_sample, .choices = chosen({std::string(technique->name)}), .outputs = {"display", "edges"}};
        forced.variant.force.assign(all_features().begin(), all_features().end());
        const auto run = must(scenes().run(forced));
        EXPECT_EQ(hash_of(run.images.at("display")), plain) << technique->name;
        EXPECT_FALSE(run.images.contains("edges")) << technique->name;
    }
}

TEST(Edges, TheTableCountsSurfacesAndTheViewShowsWhatIsMissed) {
    const std::string table = "edges/mean:surfaces per pixel", view = "edges/mean:outcome";
    for (const Scene scene : {crossing, side_at_20_5}) {
        const auto run =
            must(scenes().run({.variant = {.frame = scene}, .choices = chosen({"edges/mean"}), .outputs = {table, view}}));
        const auto& rows = run.tables.at(table).rows;
        ASSERT_EQ(rows.size(), 5u);
        for (std::size_t surfaces = 0; surfaces < rows.size(); ++surfaces) {
            EXPECT_EQ(rows[surfaces][0], double(surfaces));
            EXPECT_EQ(rows[surfaces][1], surfaces == 1 ? 63. * extent.y : surfaces == 2 ? 1. * extent.y : 0);
            EXPECT_EQ(rows[surfaces][2], surfaces == 2 ? 1. * extent.y : 0);
        }
        const ReferenceImage outcome = in_double(run.images.at(view));
        const std::uint32_t column = scene == crossing ? 15 : 20;
        for (std::uint32_t x = 0; x < extent.x; ++x)
            EXPECT_EQ(outcome.at(x, 9).x == 1 && outcome.at(x, 9).z == 1, x == column) << x;
    }
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
    std::vector<Frame> frames;
    for (const std::string_view scenario : info(Stage::edges).scenarios)
        frames.push_back(must(find_scenario(scenario))->build(0, {.width = 96, .height = 54, .samples = 4}));
    const auto session = session_of(frames);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const std::string_view scenario = info(Stage::edges).scenarios[i];
        const ReferenceImage truth = must(session->truth({.variant = {.frame = i}}, Stage::edges)).at("edges");
        const auto surfaces = gbuffer::nearest_surfaces(frames[i], ShadeAt::pixel_center).nearest;
        const VisiblePoints visible = visible_points(frames[i], opaque_draws(frames[i]));
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
        EXPECT_LT(pixels[std::size_t(Geometry::unclear)], truth.texels.size() / 4) << scenario;
    }
}

}  // namespace
}  // namespace strata::edge_marks
