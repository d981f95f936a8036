// Facts about exact sorted blending (docs/algorithms/transparency.md 1, oracles R1 to R10) and about how its memory is bounded.
#include "passes/transparency/sorted_lists/model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/constants.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "captures/cards.h"
#include "passes/scene/fragment_bounds.h"
#include "passes/stage_input.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata {
namespace {

/// Model and truth are written differently and must agree to the last digits.
double blend(std::span<const Fragment> fragments, double behind) {
    const glm::dvec3 model = transparency::sorted_blend(fragments, glm::dvec3(behind));
    const glm::dvec3 truth = exact_blend(fragments, glm::dvec3(behind));
    EXPECT_NEAR(model.x, truth.x, 1e-14);
    return model.x;
}

std::vector<Fragment> ramp(std::size_t layers, double alpha) {
    std::vector<Fragment> fragments;
    for (std::size_t i = 0; i < layers; ++i) fragments.push_back(layer(1 + double(i), alpha, double(i) / double(layers - 1)));
    return fragments;
}

/// Mean over all orders of submission: the fair target at equal depths.
double mean_over_orders(std::vector<Fragment> fragments) {
    std::vector<std::size_t> order(fragments.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    double sum = 0, orders = 0;
    do {
        std::vector<Fragment> submitted;
        for (const std::size_t i : order) submitted.push_back(fragments[i]);
        sum += blend(submitted, 0);
        orders += 1;
    } while (std::ranges::next_permutation(order).found);
    return sum / orders;
}

TEST(SortedBlending, LetsHalfOfTheBackgroundThroughHalfOfEachLayer) {
    const std::array fragments{layer(1, .5, 1), layer(2, .5, 0)};
    EXPECT_DOUBLE_EQ(blend(fragments, 0), .5);
    EXPECT_DOUBLE_EQ(blend(fragments, 1), .75);
}

TEST(SortedBlending, GivesTheSameBitsInAnyOrderOfSubmission) {
    std::vector<Fragment> fragments = ramp(5, .3);
    const double expected = blend(fragments, .7);
    while (std::ranges::next_permutation(fragments, std::ranges::less{}, &Fragment::depth).found)
        EXPECT_EQ(blend(fragments, .7), expected);
}

TEST(SortedBlending, MultipliesTheColorsOfGlass) {
    Fragment red{.depth = 1, .transmittance = {1, .2, .2}, .alpha = 1},
        green{.depth = 2, .transmittance = {.2, 1, .2}, .alpha = 1};
    const glm::dvec3 seen = transparency::sorted_blend(std::array{red, green}, glm::dvec3(1));
    EXPECT_NEAR(seen.x, .2, 1e-15);
    EXPECT_NEAR(seen.y, .2, 1e-15);
    EXPECT_NEAR(seen.z, .04, 1e-15);
}

TEST(SortedBlending, DimsEmissionByWhatStandsInFrontOfIt) {
    const std::array fragments{layer(1, .5, 0), Fragment{.depth = 2, .emission = glm::dvec3(.3)}};
    EXPECT_DOUBLE_EQ(blend(fragments, 0), .15);
}

TEST(SortedBlending, KeepsTwoHundredThinLayers) {
    std::vector<Fragment> fragments(200, layer(1, .01, 1));
    EXPECT_NEAR(blend(fragments, 0), .8660203251, 1e-10);
    EXPECT_NEAR(1 - blend(fragments, 0), .1339796749, 1e-10);
    EXPECT_NEAR(blend(ramp(200, .01), 0), .296181, 1e-6);
    EXPECT_NEAR(blend(ramp(20, .3), 0), .121869, 1e-6);
}

TEST(SortedBlending, HidesEverythingBehindAnOpaqueLayer) {
    const std::array fragments{layer(1, 1, .25), layer(2, .5, 1000), Fragment{.depth = 3, .emission = glm::dvec3(1e6)}};
    EXPECT_EQ(blend(fragments, 1e9), .25);
}

TEST(SortedBlending, PutsTheLaterSubmissionInFrontAtEqualDepth) {
    const Fragment white = layer(1, .5, 1), black = layer(1, .5, 0);
    EXPECT_DOUBLE_EQ(blend(std::array{black, white}, 0), .5);
    EXPECT_DOUBLE_EQ(blend(std::array{white, black}, 0), .25);
    EXPECT_DOUBLE_EQ(mean_over_orders({white, black}), .375);
}

TEST(SortedBlending, GivesUnequalLayersAtEqualDepthTheirSymmetricShares) {
    EXPECT_NEAR(mean_over_orders({layer(1, .9, 1), layer(1, .1, 0)}), .855, 1e-15);
    EXPECT_NEAR(mean_over_orders({layer(1, .9, 0), layer(1, .1, 1)}), .055, 1e-15);
}

TEST(SortedBlending, BlendsTheMicroExampleOfTheChapter) {
    EXPECT_DOUBLE_EQ(blend(std::array{layer(1, .5, 1), layer(2, .5, 0), layer(4, .5, 1)}, 0), .625);
}

TEST(SortedBlending, MixesFoggedLayersAsTheFogItselfWould) {
    // docs/algorithms/transparency.md 0.4: alpha .5, c 1 where the fog leaves .8 and adds .1, over black where it leaves .5 and
    // adds .3.
    const Fragment fogged{.depth = 1, .color = glm::dvec3(.5 * .8 + .5 * .1), .transmittance = glm::dvec3(.5), .alpha = .5};
    EXPECT_DOUBLE_EQ(blend(std::array{fogged}, .3), .6);
}

TEST(SortedTruth, BlendsCardsInTheirOrderOfDepthPerSample) {
    const std::array cards{Card{.center = {0, 0, 2}, .color = {1, 1, 1, .5}}, Card{.center = {0, 0, 4}, .color = {0, 0, 0, .5}}};
    const Frame frame = frame_of_cards(cards, 8);
    const ImageSet before{{"color", ReferenceImage(8, 8, 1, glm::dvec4(1))}, {"depth_layers", ReferenceImage(8, 8)}};
    const ImageSet truth = transparency_truth({frame, before});
    for (const glm::dvec4& texel : truth.at("color").texels) EXPECT_DOUBLE_EQ(texel.x, .75);
}

TEST(RowBounds, CountEveryPixelOfAFullScreenQuadOnce) {
    Frame frame = frame_of_cards({}, 8);
    frame.emitters.push_back({.name = "smoke", .particles = {{.center = {0, 0, 5}, .size = 20}}});
    EXPECT_THAT(fragment_bounds(frame, draw_lists(frame), {8, 8, 1}, 1).by_row, testing::Each(8u));
}

TEST(RowBounds, CountNothingBehindTheEye) {
    Frame frame = frame_of_cards({}, 8);
    frame.emitters.push_back({.name = "smoke", .particles = {{.center = {0, 0, -5}, .size = 20}}});
    EXPECT_THAT(fragment_bounds(frame, draw_lists(frame), {8, 8, 1}, 1).by_row, testing::Each(0u));
}

TEST(RowBounds, AreNeverBelowWhatIsCovered) {
    std::vector<Card> cards;
    for (int i = 0; i < 40; ++i) {
        const double t = i;
        cards.push_back({.center = {2 * std::sin(7 * t), 2 * std::cos(3 * t), .2 + 5 * std::abs(std::sin(t))},
                         .half = float(.05 + 3 * std::abs(std::sin(5 * t))),
                         .color = glm::vec4(.5f),
                         .tilt = 1.5 * std::sin(11 * t)});
    }
    Frame frame = frame_of_cards(cards, 32);
    frame.emitters.push_back(
        {.name = "smoke",
         .particles = {{.center = {1, 0, .12}, .size = .3f, .rotation = 1}, {.center = {0, 1, 3}, .size = .01f}}});
    const FragmentLists lists = transparent_fragments(frame, ReferenceImage(32, 32));
    const FragmentBounds bounds = fragment_bounds(frame, draw_lists(frame), {32, 32, 1}, 1);
    std::uint64_t bound = 0;
    std::size_t deepest = 0;
    for (std::uint32_t y = 0; y < 32; ++y) {
        std::uint64_t covered = 0;
        for (std::uint32_t x = 0; x < 32; ++x) {
            covered += lists.at(x, y).size();
            deepest = std::max(deepest, lists.at(x, y).size());
        }
        EXPECT_LE(covered, bounds.by_row[y]) << "row " << y;
        bound += bounds.by_row[y];
    }
    EXPECT_LE(deepest, bounds.layers);
    EXPECT_LT(bounds.layers, 3 * deepest) << "rectangles around tilted cards and quads";
    EXPECT_GT(lists.total(), 1000u);
    EXPECT_LT(bound, 2 * lists.total()) << "a bound twice too high wastes memory";
}

/// A sphere of 2 r^2 triangles.
Mesh globe(std::uint32_t r) {
    Mesh mesh{.name = "globe"};
    for (std::uint32_t row = 0; row <= r; ++row)
        for (std::uint32_t column = 0; column <= r; ++column) {
            const double polar = row * glm::pi<double>() / r, around = column * 2 * glm::pi<double>() / r;
            mesh.positions.emplace_back(std::sin(polar) * std::cos(around), std::cos(polar), std::sin(polar) * std::sin(around));
        }
    for (std::uint32_t row = 0; row < r; ++row)
        for (std::uint32_t column = 0; column < r; ++column) {
            const std::uint32_t a = row * (r + 1) + column, below = a + r + 1;
            for (const std::uint32_t corner : {a, below, a + 1, a + 1, below, below + 1}) mesh.indices.push_back(corner);
        }
    return mesh;
}

TEST(RowBounds, OfTrianglesBelowAPixelCountTheMiddlesOfPixelsAndNotWhatTheyTouch) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame frame = frame_of_cards(std::array{Card{.center = {.1, .2, 1.7}, .half = 1, .color = glm::vec4(.5f)}}, 64);
        frame.meshes.front() = globe(96);
        frame.materials.front().double_sided = true;
        frame.view.samples = samples;
        const FragmentLists lists = transparent_fragments(frame, ReferenceImage(64, 64, samples));
        ASSERT_GT(lists.total(), 1500u * samples);
        const FragmentBounds bounds = fragment_bounds(frame, draw_lists(frame), {64, 64, 1}, samples);
        for (std::uint32_t y = 0; y < 64; ++y) {
            std::uint64_t covered = 0;
            for (std::uint32_t x = 0; x < 64; ++x)
                for (std::uint32_t s = 0; s < samples; ++s) covered += lists.at(x, y, s).size();
            EXPECT_LE(covered, bounds.by_row[y]) << "row " << y;
        }
        const std::uint64_t bound = std::accumulate(bounds.by_row.begin(), bounds.by_row.end(), std::uint64_t{0});
        if (samples == 1) {
            EXPECT_LT(double(bound), 3 * double(lists.total()))
                << "triangles of half a pixel each way and a sixteenth around them";
        }
    }
}

TEST(RowBounds, CountPixelsWhoseMiddlesAreASixteenthOfAPixelAway) {
    // A square of so many pixels each way from the middle of the image, where pixel 32 begins.
    const auto rows = [](double pixels) {
        const Card square{.center = {0, 0, 2}, .half = float(pixels / 32 * 2), .color = glm::vec4(.5f)};
        const Frame frame = frame_of_cards(std::array{square}, 64);
        return fragment_bounds(frame, draw_lists(frame), {64, 64, 1}, 1).by_row;
    };
    // Two triangles, which share the diagonal.
    EXPECT_GE(rows(8.5 - 1. / 32)[23], 18u) << "a device may snap the edge to the middles of pixels 23 and 40";
    EXPECT_GE(rows(8.5 - 1. / 32)[40], 18u);
    EXPECT_EQ(rows(8.5 - 1. / 8)[23], 0u) << "but not from here";
    EXPECT_EQ(rows(8.5 - 1. / 8)[40], 0u);
}

TEST(RowBounds, AreWiderWhereFloatsAreCoarse) {
    // Where a mesh lies so far from its own origin a device may be off by more than a pixel, even if its corners are floats.
    const auto bound = [](double away) {  // in halves of the card
        Frame frame = frame_of_cards(std::array{Card{.center = {0, 0, 2}, .half = 1.f / 32, .color = glm::vec4(.5f)}}, 64);
        for (glm::vec3& p : frame.meshes.front().positions) p.x += float(away);
        frame.draws.front().to_world = glm::translate(frame.draws.front().to_world, glm::dvec3(-away, 0, 0));
        const FragmentBounds bounds = fragment_bounds(frame, draw_lists(frame), {64, 64, 1}, 1);
        return std::accumulate(bounds.by_row.begin(), bounds.by_row.end(), std::uint64_t{0});
    };
    ASSERT_GE(bound(0), 4u);
    EXPECT_LE(bound(0), 8u);
    EXPECT_GE(bound(0x1p22), 2 * bound(0));
}

TEST(RowBounds, CountWhatADeviceMayTakeToBeInFrontOfTheNearPlane) {
    // The eye turned by 45 degrees, 100 km from the mesh's own origin: the depth of the card is a difference of large numbers.
    Frame frame = frame_of_cards(std::array{Card{.center = {0, 0, 1}, .half = 1, .color = glm::vec4(.5f)}}, 16);
    const double away = 1e5;
    frame.view.to_view = glm::dmat3(glm::rotate(glm::dmat4(1), glm::radians(45.), glm::dvec3(0, 1, 0)));
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(frame.view.to_view));
    Mesh& mesh = frame.meshes.front();
    const double z = double(frame.view.near) - .005;
    for (glm::vec3& p : mesh.positions) p = to_world * glm::dvec3(double(p.x), double(p.y), 0) + glm::dvec3(away, 0, 0);
    frame.draws.front().to_world = glm::translate(glm::dmat4(1), to_world * glm::dvec3(0, 0, z) - glm::dvec3(away, 0, 0));
    const FragmentBounds bounds = fragment_bounds(frame, draw_lists(frame), {16, 16, 1}, 1);
    EXPECT_THAT(bounds.by_row, testing::Each(testing::Ge(16u)));
}

TEST(RowBands, HoldEveryRowOnceAndNoMoreThanTheirLimit) {
    const std::array<std::uint64_t, 7> rows{10, 10, 50, 60, 5, 5, 100};
    const std::vector<RowBand> bands = row_bands(rows, 120);
    ASSERT_EQ(bands.size(), 3u);
    EXPECT_EQ(bands[0].rows, 2u);
    EXPECT_EQ(bands[1].first_row, 2u);
    EXPECT_EQ(bands[1].rows, 4u);
    EXPECT_EQ(bands[1].bound, 120u);
    EXPECT_EQ(bands[2].first_row, 6u);
    EXPECT_EQ(bands[2].rows, 1u);
}

TEST(RowBands, HaveAtMostSoManyRows) {
    const std::array<std::uint64_t, 7> rows{1, 1, 1, 1, 1, 1, 1};
    const std::vector<RowBand> bands = row_bands(rows, 100, 4);
    ASSERT_EQ(bands.size(), 2u);
    EXPECT_EQ(bands[0].rows, 4u);
    EXPECT_EQ(bands[1].rows, 3u);
    EXPECT_EQ(row_bands(rows, 100, 1).size(), 4u) << "but no fewer than a quad has";
}

TEST(RowBands, GrowBeyondTheLimitRatherThanSplitAQuadOfPixels) {
    const std::array<std::uint64_t, 4> rows{1000, 1000, 1, 1};
    const std::vector<RowBand> bands = row_bands(rows, 10);
    ASSERT_EQ(bands.size(), 2u);
    EXPECT_EQ(bands[0].bound, 2000u);
}

}  // namespace
}  // namespace strata
