// Facts of partial coverage, on the model: docs/algorithms/deferred.md T-MS-2, T-MS-4 and T-MS-5.
#include <array>

#include <gtest/gtest.h>

#include "passes/reference/shade.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/pixel_triangles.h"

namespace strata::edges {

Technique coverage();

namespace {

constexpr glm::uvec2 extent{32, 18};

/// Marked pixels that do not hang on rounding.
std::uint32_t marked_pixels(const Frame& frame) {
    static const Technique technique = coverage();
    const ImageSet before{{"depth_layers", ReferenceImage(extent.x, extent.y, 4, glm::dvec4(.5))}};
    const ReferenceImage edges = technique.model({frame, before}, Settings(technique.params)).at("edges");
    std::uint32_t marked = 0;
    for (std::size_t i = 0; i < edges.texels.size(); ++i) marked += edges.texels[i].x != 0 && !edges.undecided[i];
    return marked;
}

Frame wall_right_of(double column) {
    return frame_of_triangles(extent, 4, std::array{whole_picture(extent, 4), right_of(extent, column, 2, {.1f, .2f, .3f})});
}

/// Samples of a pixel right of the column, as bits.
std::uint32_t covered_right_of(double column, std::uint32_t pixel) {
    std::uint32_t covered = 0;
    for (std::uint32_t sample = 0; sample < 4; ++sample)
        if (pixel + sample_position(4, sample).x > column) covered |= 1u << sample;
    return covered;
}

TEST(CoverageEdges, OneTriangleOverThePictureHasNone) {
    EXPECT_EQ(marked_pixels(frame_of_triangles(extent, 4, std::array{whole_picture(extent, 4)})), 0u);
}

// Left of 10.5 lie samples 0 and 2, at .375 and .125; left of 10.25 sample 2 alone.
TEST(CoverageEdges, AVerticalSideMarksAColumnAndASideBetweenPixelsNone) {
    EXPECT_EQ(covered_right_of(10.5, 10), 0b1010u);
    EXPECT_EQ(covered_right_of(10.25, 10), 0b1011u);
    EXPECT_EQ(marked_pixels(wall_right_of(10.5)), extent.y);
    EXPECT_EQ(marked_pixels(wall_right_of(10.25)), extent.y);
    EXPECT_EQ(marked_pixels(wall_right_of(10)), 0u);
}

// Planes z = 4 and 1 / z = 1/8 + (x + .5) / 128, which cross at x = 15.5.
TEST(CoverageEdges, TrianglesThatCrossAreMissed) {
    PixelTriangle slanted = whole_picture(extent, 4, {.9f, .1f, .1f});
    for (glm::dvec3& corner : slanted.corners) corner.z = 1 / (.125 + (corner.x + .5) / 128);
    EXPECT_EQ(marked_pixels(frame_of_triangles(extent, 4, std::array{whole_picture(extent, 4), slanted})), 0u);
}

TEST(CoverageEdges, SeamsInsideAMeshAreMarked) {
    Frame quad = frame_of_triangles(extent, 4, std::array{whole_picture(extent, 4)});
    Mesh& mesh = quad.meshes[0];
    mesh.positions = {{-8, 8, 4}, {8, 8, 4}, {8, -8.1f, 4}, {-8, -8.1f, 4}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    EXPECT_GT(marked_pixels(quad), 10u) << "two triangles of one plane, whose samples are all the same";
}

}  // namespace
}  // namespace strata::edges
