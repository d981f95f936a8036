// Facts about the bounded A-buffer (docs/algorithms/transparency.md 2.1): its formats, what it stores, what it merges, its
// memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/scene_facts.h"
#include "passes/technique.h"
#include "passes/transparency/a_buffer/model.h"
#include "passes/transparency/truth.h"
#include "tests/support/layers.h"

namespace strata::transparency {

Technique a_buffer();

namespace {

double blend(std::span<const Fragment> fragments, double behind, StoredAs kind = StoredAs::rgb, std::size_t layers = 9) {
    return a_buffer_blend(fragments, glm::dvec3(behind), layers, kind).x;
}

TEST(ABuffer, RoundsToTheNearestNumberOfItsFormats) {
    EXPECT_EQ(nearest_r11g11b10(glm::dvec3(1 + 1.01 / 128)), glm::dvec3(1 + 1. / 64, 1 + 1. / 64, 1));
    EXPECT_EQ(nearest_r11g11b10(glm::dvec3(1 + 1. / 128)), glm::dvec3(1)) << "halfway: down, whatever the last bit";
    EXPECT_EQ(nearest_r11g11b10(glm::dvec3(1e9)), glm::dvec3(65024, 65024, 64512));
    EXPECT_EQ(nearest_r11g11b10(glm::dvec3(.4 * 0x1p-19, .6 * 0x1p-20, 0)), glm::dvec3(0x1p-20, 0x1p-20, 0));
    EXPECT_EQ(nearest_half(2049), 2048);
    EXPECT_EQ(nearest_half(1e6), 65504);
    EXPECT_EQ(nearest_half(-3), 0);
    EXPECT_EQ(nearest_unorm8(.5), 127. / 255);
    for (const double exact : {0., 1., 51. / 255}) EXPECT_EQ(nearest_unorm8(exact), exact);
}

TEST(ABuffer, IsAsExactAsItsFormatsUpToNineLayersInAnyOrder) {
    std::vector<Fragment> fragments;
    fragments.reserve(9);
    for (int i = 0; i < 9; ++i) fragments.push_back(layer(1 + i, .1 + .05 * i, 1. / (1 + i)));
    for (int turn = 0; turn < 9; ++turn) {
        std::rotate(fragments.begin(), fragments.begin() + 1, fragments.end());
        const glm::dvec3 exact = exact_blend(fragments, glm::dvec3(.3));
        for (const StoredAs kind : {StoredAs::mono, StoredAs::rgb}) {
            const glm::dvec3 error = glm::abs(a_buffer_blend(fragments, glm::dvec3(.3), 9, kind) - exact) / exact;
            EXPECT_LT(error.x, 0x1p-7);
            EXPECT_LT(error.z, 0x1p-6);
        }
    }
}

TEST(ABuffer, HidesTheBackgroundBehindAnOverflowExactly) {
    // Ten equal layers of .5: the merged one multiplies transmittance.
    const std::vector<Fragment> ten(10, layer(1, .5, 0));
    EXPECT_DOUBLE_EQ(blend(ten, 1), std::pow(.5, 10));
    const std::vector<Fragment> many(300, layer(1, .5, 0));
    EXPECT_DOUBLE_EQ(blend(many, 1e80), 1e80 * std::pow(.5, 300));
}

TEST(ABuffer, MergesWhatComesLateWhereverItIs) {
    // The last of ten lies in front of all, white before black, and is put behind them.
    std::vector<Fragment> fragments(9, layer(5, .5, 0));
    fragments.push_back(layer(1, .5, 1));
    EXPECT_DOUBLE_EQ(exact_blend(fragments, glm::dvec3(0)).x, .5);
    EXPECT_DOUBLE_EQ(blend(fragments, 0), std::pow(.5, 10));
    std::ranges::reverse(fragments);
    EXPECT_DOUBLE_EQ(blend(fragments, 0), .5) << "submitted first it is stored";
}

TEST(ABuffer, AveragesWhatItMergesByCoverage) {
    std::vector<Fragment> fragments{layer(1, .5, 0), layer(2, .5, 1), layer(3, .5, 0)};
    EXPECT_DOUBLE_EQ(blend(fragments, 0, StoredAs::rgb, 1), .5 * .75 * .5);
    fragments.push_back({.depth = 9, .emission = glm::dvec3(8)});
    EXPECT_DOUBLE_EQ(blend(std::array{fragments[0], fragments[3]}, 0, StoredAs::rgb, 1), .5 * 8) << "light just adds";
}

TEST(ABuffer, PutsTheLaterSubmissionInFrontWhereHalfFloatsCannotTellDepths) {
    // Neighbors at 1 m are 1 mm apart: a nearer fragment submitted first ends up behind.
    const Fragment near = layer(1.0002, .5, 1), far = layer(1.0004, .5, 0);
    EXPECT_DOUBLE_EQ(blend(std::array{far, near}, 0), .5);
    EXPECT_DOUBLE_EQ(blend(std::array{near, far}, 0), .25);
    EXPECT_DOUBLE_EQ(exact_blend(std::array{near, far}, glm::dvec3(0)).x, .5);
}

TEST(ABuffer, PutsTheLaterSubmissionInFrontAtEqualDepthAsTheTruthDoes) {
    std::vector<Fragment> fragments{layer(2, .5, 0), layer(2, .25, 1), layer(2, .75, .5)};
    do EXPECT_DOUBLE_EQ(blend(fragments, 1), exact_blend(fragments, glm::dvec3(1)).x);
    while (std::ranges::next_permutation(fragments, {}, &Fragment::alpha).found);
}

TEST(ABuffer, KeepsTwoHundredThinLayersButForItsNine) {
    // T_total is .1340, within .003 but for blue, whose nine stored layers are 63/64 each.
    const std::vector<Fragment> layers(200, layer(1, .01, 0));
    const auto through = [&](StoredAs kind) { return a_buffer_blend(layers, glm::dvec3(1), 9, kind); };
    EXPECT_NEAR(through(StoredAs::mono).x, .1319, 1e-4);
    EXPECT_NEAR(through(StoredAs::rgb).x, .1367, 1e-4);
    EXPECT_NEAR(through(StoredAs::rgb).z, .1273, 1e-4);
}

TEST(ABuffer, SeesColoredGlassAsGrayInTheMonoLayout) {
    const Fragment red{.depth = 1, .transmittance = {1, .2, .2}, .alpha = 1};
    const auto seen = [&](StoredAs kind) { return a_buffer_blend(std::array{red}, glm::dvec3(1), 9, kind); };
    EXPECT_NEAR(seen(StoredAs::mono).x, 1.4 / 3, .5 / 255);
    EXPECT_EQ(seen(StoredAs::mono).x, seen(StoredAs::mono).z);
    EXPECT_EQ(seen(StoredAs::rgb).x, 1);
    EXPECT_NEAR(seen(StoredAs::rgb).z, .2, .2 * 0x1p-6);
}

TEST(ABuffer, ErrsByHalfAStepOfCoveragePerLayerInTheMonoLayout) {
    for (const double alpha : {.01, .1, .25, .5, .9})
        for (const std::size_t n : {1u, 3u, 9u}) {
            const std::vector<Fragment> layers(n, layer(1, alpha, 0));
            EXPECT_NEAR(blend(layers, 1, StoredAs::mono), std::pow(1 - alpha, n), double(n) * .51 / 255);
        }
}

TEST(ABuffer, LosesThinLayersToItsFormats) {
    // 8 bits: alpha below 1/510 hides nothing. R11G11B10F: 1 - .01 becomes 1 - 1/128 in red and 1 - 1/64 in blue.
    EXPECT_EQ(blend(std::array{layer(1, .0019, 0)}, 1, StoredAs::mono), 1);
    const glm::dvec3 through = a_buffer_blend(std::array{layer(1, .01, 0)}, glm::dvec3(1), 9, StoredAs::rgb);
    EXPECT_EQ(through, glm::dvec3(127. / 128, 127. / 128, 63. / 64));
}

TEST(ABuffer, LeavesThePixelAloneWithoutFragments) { EXPECT_EQ(blend({}, .123), .123); }

/// Bytes per pixel of what the technique keeps per fragment, and of the count.
double bytes_per_pixel(std::string_view layout, std::uint32_t samples) {
    const Technique technique = a_buffer();
    Settings settings(technique.params);
    if (!settings.set("layout", layout)) throw std::runtime_error("no such layout");
    Frame frame = frame_of_cards({}, 32);
    const SceneFacts facts(frame);
    Graph graph;
    FrameImages images{
        .recorded = &frame, .features = &facts.features(), .facts = &facts, .extent = {32, 32, 1}, .samples = samples};
    images.depth = graph.create("depth", {.extent = images.extent, .format = Format::d32f, .samples = samples});
    images.color = graph.create("color", {.extent = images.extent, .format = Format::rgba32f, .layers = samples});
    technique.declare(graph, images, settings);
    std::uint64_t sum = bytes(graph.shape(graph.find_image("a_buffer colors"))) +
                        bytes(graph.shape(graph.find_image("a_buffer transmittances"))) +
                        bytes(graph.shape(graph.find_image("a_buffer depths")));
    sum += graph.record(graph.find_buffer("a_buffer counts")).bytes;
    return double(sum) / (32 * 32);
}

TEST(ABuffer, TakesAsManyBytesPerPixelAsTheChapterSays) {
    EXPECT_EQ(bytes_per_pixel("mono", 1), 64);
    EXPECT_EQ(bytes_per_pixel("rgb", 1), 91);
    EXPECT_EQ(bytes_per_pixel("automatic", 4), 4 * 64);
}

}  // namespace
}  // namespace strata::transparency
