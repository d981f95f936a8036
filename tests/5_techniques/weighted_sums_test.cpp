// What transparency/weighted adds up on the device for a single fragment: its weight, computed by hand from the published
// formulas (docs/algorithms/transparency.md 3.1). The picture of one fragment does not show its weight, and that of many shows
// ratios of weights only.
#include <algorithm>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

// Half floats have 11 bits, and lavapipe rounds them towards zero.
constexpr double half_float_step = 1. / 1024;

/// A card of alpha 1/2 and base color 1/5 that glows by radiance 1 in green, at a depth.
Frame glowing_card(double depth) {
    Frame frame =
        frame_of_cards(std::array{Card{.center = {0, 0, depth}, .half = float(depth), .color = {.2f, .2f, .2f, .5f}}}, 4);
    frame.materials[0].emissive = {0, 1, 0};
    return frame;
}

/// Red, green, blue and coverage, each times the weight.
glm::dvec4 sum_of(double depth, const std::string& weight) {
    const auto session = session_of({glowing_card(depth)});
    const Request request{.choices = chosen({"transparency/weighted"}, {"weight=" + weight})};
    glm::dvec4 sum(0);
    for (const StepImages& step : must(session->step_images(request, Stage::transparency)))
        if (const auto found = step.images.find("weighted sum"); found != step.images.end())
            sum = in_double(found->second).at(2, 2);
    return sum;
}

TEST(WeightedSums, HoldAFragmentsWeightByTheFormulasToAHalfFloat) {
    struct Row {
        const char* weight;
        double depth, expected;
    };
    // alpha 10 / (1e-5 + (z / 5)^2 + (z / 200)^6), alpha 10 / (1e-5 + (z / 10)^3 + (z / 200)^6), alpha .03 / (1e-5 + (z /
    // 200)^4); alpha 3000 (.1 / z)^3; the blog's with max(r, g, b) alpha = .6; 1e8 (8 alpha + .01)^3 (.05 + .095 / z)^3 (1e4
    // z)^-1.5, without the root 300 everywhere.
    const Row rows[] = {{"w7", 20, .3125},       {"w7", 3, 13.8885},    {"w8", 20, .625},      {"w8", 3, 185.117},
                        {"w9", 20, 136.364},     {"w9", 50, 3.83019},   {"w10", 1, 1.5},       {"w10", 3, .0555556},
                        {"blog", 20, 163.636},   {"blog", 50, 4.59623}, {"w2015", 1, 19.6579}, {"w2015", 4, .323317},
                        {"w2015_plain", 4, 300}, {"constant", 4, 1}};
    for (const Row& row : rows) {
        const glm::dvec4 sum = sum_of(row.depth, row.weight);
        EXPECT_NEAR(sum.w, .5 * row.expected, .5 * row.expected * half_float_step) << row.weight << " at " << row.depth << " m";
        EXPECT_NEAR(sum.y, .6 * row.expected, .6 * row.expected * half_float_step) << row.weight << " at " << row.depth << " m";
        EXPECT_NEAR(sum.z, .1 * row.expected, .1 * row.expected * half_float_step) << row.weight << " at " << row.depth << " m";
    }
}

}  // namespace
}  // namespace strata
