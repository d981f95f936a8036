// The hypotheses of docs/algorithms/transparency.md 9.7, and its hard case H12, held against the device's pictures.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "captures/hard_cases.h"
#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "replay/probe/probe.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// A technique and its settings.
struct Way {
    std::string technique;
    std::vector<std::string> sets;
};

HostImage color_of(const Frame& frame, const Way& way) {
    const Request request{.choices = chosen({way.technique}, way.sets), .outputs = {"color"}};
    return must(session_of_scenarios().run(frame, std::span(&request, 1))).front().images.at("color");
}

/// The most any channel of any pixel is apart.
double difference(const ReferenceImage& a, const ReferenceImage& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i)
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.texels[i][c] - b.texels[i][c]));
    return most;
}

Card card_at(double z, glm::vec3 color, float alpha) {
    return {.center = {0, 0, z}, .half = float(1.5 * z), .color = glm::vec4(color, alpha)};
}

constexpr int many_layers = 12;

/// Layers between 1 and 50 m, and two cards out of sight that pin the range of depth.
Frame layers_within(double nearest, double farthest) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> share(0, 1);
    std::vector<Card> cards;
    for (int i = 0; i < many_layers; ++i)
        cards.push_back(
            card_at(std::pow(50., double(share(random))), {share(random), share(random), share(random)}, .6f * share(random)));
    for (const double z : {nearest, farthest}) {
        cards.push_back(card_at(z, {}, .5f));
        cards.back().center.x = 1e4;
        cards.back().half = .1f;
    }
    Frame frame = frame_of_cards(cards, 8);
    frame.background = glm::vec3(.4f);
    return frame;
}

// docs/algorithms/transparency.md 9.7 (i). Cells lie at whole numbers from 0 to n - 1 over the range of depth, slices' centers
// half a slice further in: of a range that is half a slice larger at both ends the two are the same.
TEST(Hypotheses, AWaveletOfRankFourIsAVolumeOf32SlicesReadOneSliceInFront) {
    const Way wavelet{"transparency/wavelet", {"rank=4", "storage=single", "correction=none", "accumulation=single"}};
    const double half_slice = std::pow(50., .5 / 31);
    const ReferenceImage wanted = in_double(color_of(layers_within(1, 50), wavelet));
    const auto apart = [&](const std::string& bits, const std::string& shift) {
        const Way voxel{"transparency/voxel",
                        {"volume=dense", "slices=32", "curve=linear", fmt::format("linear={}", 1 / half_slice), "splat=words",
                         bits, shift, "accumulation=single"}};
        return difference(in_double(color_of(layers_within(1 / half_slice, 50 * half_slice), voxel)), wanted);
    };
    const double step = std::log(0xfffff) / 0xfffff;  // of optical depth, in 32 bits
    EXPECT_LT(apart("bits=32", "shift=1"), many_layers * step);
    EXPECT_GT(apart("bits=8", "shift=1"), many_layers * step);
    EXPECT_GT(apart("bits=32", "shift=0"), .01);  // read two slices in front
}

/// Ray C of docs/algorithms/transparency.md 9.3: the area between T(z) of voxels and the exact steps of a hundred layers.
double area_on_even_smoke(std::uint32_t slices, std::uint32_t bits) {
    ProbedStack stack{.nearest = 1, .farthest = 50};
    const double alpha = -std::expm1(-.03);
    for (std::uint32_t i = 0; i < 100; ++i)
        stack.fragments.push_back(
            {.depth = std::pow(50, (i + .5) / 100), .transmittance = glm::dvec3(1 - alpha), .alpha = alpha, .submission = i});
    const std::string variant =
        fmt::format("voxel volume=dense curve=linear linear=1 splatting=point sampling=point slices={} bits={}", slices, bits);
    const Probe made = must(probe(session_of_scenarios(), stack, {.variants = {variant}, .samples = 1600, .from = 1, .to = 50}));
    return made.curves.front().metrics.l1_logarithmic;
}

// docs/algorithms/transparency.md 9.7 (ii)
TEST(Hypotheses, OfThinLayersEightBitsLoseMoreThanFewSlices) {
    EXPECT_NEAR(area_on_even_smoke(32, 8), .1058, 2e-3);
    EXPECT_NEAR(area_on_even_smoke(128, 8), .0946, 2e-3);
    // However many slices: each layer's .03 is rounded to a step of .0217.
    const double rounded = std::log(255.) / 255 * 100, exact = 3;
    const double left = -std::expm1(-rounded) / rounded + std::expm1(-exact) / exact;
    EXPECT_NEAR(area_on_even_smoke(1024, 8), left, 3e-3);
    EXPECT_LT(area_on_even_smoke(32, 16), .2 * left);
}

// docs/algorithms/transparency.md 9.7 (iv)
TEST(Hypotheses, WhatIsTakenOutOfItsOwnFragmentRemovesNineTenthsOfTheErrorOfACardBehindSmoke) {
    const auto cases = hard_cases();
    const auto h14b = std::ranges::find_if(cases, [](const HardCase& c) { return c.name.starts_with("H14b"); });
    ASSERT_NE(h14b, cases.end());
    const Frame frame = h14b->build().front();
    const auto error = [&](const std::string& technique, const std::vector<std::string>& sets) {
        const ReferenceImage made = in_double(color_of(frame, {technique, sets}));
        ReferenceImage exact = made;
        for (glm::dvec4& texel : exact.texels) texel = glm::dvec4(.1);  // white smoke of .1 before a black card
        return difference(made, exact);
    };
    for (const char* kind : {"kind=power4", "kind=power6", "kind=power8", "kind=trig2", "kind=trig3", "kind=trig4"}) {
        const double uncorrected = error("transparency/moments", {kind, "compensation=none"});
        EXPECT_GT(uncorrected, .4) << kind;
        EXPECT_LT(error("transparency/moments", {kind, "compensation=own"}), .1 * uncorrected) << kind;
    }
    // Of rank 1 smoke and card share one of four cells: it is .017 without and .027 with it.
    for (const char* rank : {"rank=2", "rank=3", "rank=4"}) {
        const double uncorrected = error("transparency/wavelet", {rank, "correction=none"});
        EXPECT_LT(error("transparency/wavelet", {rank, "correction=own"}), .1 * uncorrected) << rank;
    }
}

/// Red behind 40 green layers of .5 within 4 mm: 1280 of 255 in a slice. What wraps leaves nothing there but a carry of 5 behind.
Frame red_behind_an_overflow() {
    std::vector<Card> cards{card_at(7, {1, 0, 0}, 1)};
    for (int i = 0; i < 40; ++i) cards.push_back(card_at(5 + 1e-4 * i, {0, 1, 0}, .5f));
    return frame_of_cards(cards, 8);
}

Way with_splat(const char* splat, std::vector<std::string> sets) {
    sets.push_back(splat);
    return {"transparency/voxel", std::move(sets)};
}

double most_red(const HostImage& image) {
    double most = 0;
    for (const glm::dvec4& texel : in_double(image).texels) most = std::max(most, texel.x);
    return most;
}

TEST(Hypotheses, NothingIsSeenBehindASliceThatOverflowed) {
    const Frame frame = red_behind_an_overflow();
    const std::vector<std::string> few_slices = {"volume=dense", "range=fixed", "splatting=point", "sampling=point"};
    const std::vector<std::string> settings[] = {few_slices, {"volume=dense", "range=fixed"}, {}, {"bits=10"}, {"bits=16"}};
    for (const std::vector<std::string>& sets : settings) {
        const HostImage packed = color_of(frame, with_splat("splat=overflow_minimum", sets));
        EXPECT_EQ(most_red(packed), 0) << sets.size();
        EXPECT_EQ(color_of(frame, with_splat("splat=saturating", sets)).texels, packed.texels) << sets.size();
        EXPECT_EQ(color_of(frame, with_splat("splat=words", sets)).texels, packed.texels) << sets.size();
    }
    // .897 of the red card's light, beside 20 of green.
    EXPECT_NEAR(most_red(color_of(frame, with_splat("splat=wrapping", few_slices))), .0429, 1e-3);
}

}  // namespace
}  // namespace strata
