// Facts of comparing the mean: how often rounding makes an edge of one surface (docs/algorithms/deferred.md H10), and what
// cancels.
#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::edges {

Technique mean();

namespace {

// The sum of two floats of like exponents is exact in double.
float rounded_to_nearest(double sum) { return static_cast<float>(sum); }
float rounded_towards_zero(double sum) {
    const auto nearest = static_cast<float>(sum);
    return std::abs(double(nearest)) > std::abs(sum) ? std::nextafterf(nearest, 0.f) : nearest;
}

using Round = float (*)(double);

/// Whether the mean of so many equal values is another value.
bool differs(float value, int samples, Round round) {
    float sum = value;
    for (int i = 1; i < samples; ++i) sum = round(double(sum) + double(value));
    return double(sum) / samples != double(value);
}

double share_of_floats(int samples, Round round) {
    std::mt19937 random(1);
    constexpr int count = 400000;
    int differing = 0;
    for (int i = 0; i < count; ++i)
        differing += differs(std::bit_cast<float>(0x3f800000u | (std::uint32_t(random()) & 0x007fffffu)), samples, round);
    return double(differing) / count;
}

TEST(MeanEdges, NearlyHalfOfAllFloatsDifferFromTheMeanOfEightOfThem) {
    EXPECT_EQ(share_of_floats(4, rounded_to_nearest), 0);
    EXPECT_NEAR(share_of_floats(8, rounded_to_nearest), .467, .003);
    EXPECT_NEAR(share_of_floats(4, rounded_towards_zero), .667, .003);
    EXPECT_NEAR(share_of_floats(8, rounded_towards_zero), .857, .003);
}

// Against the chapter, which has 46.7 % for whatever a G-buffer holds: 11 bits and three more for a sum of eight are 14.
TEST(MeanEdges, HalfFloatsNeverDifferFromTheirMeanAndBytesDo) {
    for (int half = 1024; half < 2048; ++half) EXPECT_FALSE(differs(float(half), 8, rounded_to_nearest)) << half;
    int bytes = 0;
    for (int byte = 0; byte < 256; ++byte) bytes += differs(float(byte) / 255.f, 8, rounded_to_nearest);
    EXPECT_NEAR(bytes, 256 * .467, 40) << "UNORM8 texels are floats of 24 bits";
}

/// Words of gbuffer0, red alone.
double mark_of(const std::array<double, 4>& red, std::string_view compares = "gbuffer0", double color = .5) {
    static const Technique technique = mean();
    const Frame frame = one_pixel(4);
    ImageSet before{{"depth_layers", ReferenceImage(1, 1, 4, glm::dvec4(.5))},
                    {"gbuffer0", ReferenceImage(1, 1, 4)},
                    {"gbuffer1", ReferenceImage(1, 1, 4, glm::dvec4(.5))},
                    {"emission", ReferenceImage(1, 1, 4, glm::dvec4(0, 0, 0, 1))}};
    for (std::uint32_t sample = 0; sample < 4; ++sample) before.at("gbuffer0").at(0, 0, sample).x = red[sample];
    before.at("gbuffer1").at(0, 0, 3) = glm::dvec4(color);
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("compares", compares));
    return technique.model({frame, before}, settings).at("edges").at(0, 0).x;
}

TEST(MeanEdges, TwoSurfacesAlwaysDiffer) {
    EXPECT_EQ(mark_of({.25, .25, .25, .25}), 0);
    EXPECT_EQ(mark_of({.25, .25, .25, .75}), 1);
    EXPECT_EQ(mark_of({.25, .75, .75, .75}), 1);
}

TEST(MeanEdges, ThreeSurfacesCancelWhereTheFirstLiesInTheMiddle) {
    EXPECT_EQ(mark_of({.5, .25, .75, .5}), 0) << "an edge that is missed";
    EXPECT_EQ(mark_of({.25, .5, .75, .5}), 1) << "the same surfaces in another order";
}

TEST(MeanEdges, WhatTheFirstImageDoesNotHoldIsMissed) {
    EXPECT_EQ(mark_of({.25, .25, .25, .25}, "gbuffer0", .9), 0);
    EXPECT_EQ(mark_of({.25, .25, .25, .25}, "all", .9), 1);
}

}  // namespace
}  // namespace strata::edges
