// Facts of the Clear Sky packing: the exact halves of docs/algorithms/deferred.md 2.4, the errors of 2.5 and the depth steps of
// 2.3.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/gbuffer/packed/model.h"
#include "tests/support/normal_errors.h"

namespace strata::gbuffer {
namespace {

glm::dvec3 packed_stored(const glm::dvec3& n) { return packed_normal(packed_halves(n)); }

TEST(PackedGBuffer, StoresTheHalvesOfTheChapter) {
    struct Row {
        glm::dvec3 normal;
        std::uint16_t x, y;
    };
    for (const Row& row : {Row{{0, 0, 1}, 0x3800, 0x3800}, Row{{0, 0, -1}, 0xb800, 0x3800}, Row{{1, 0, 0}, 0x3c00, 0x3800},
                           Row{{-1, 0, 0}, 0x0000, 0x3800}, Row{{0, 1, 0}, 0x3800, 0x3c00}, Row{{0, -1, 0}, 0x3800, 0x0000},
                           Row{{.6, 0, -.8}, 0xba66, 0x3800}}) {
        const glm::dvec2 q = packed_halves(row.normal);
        EXPECT_EQ(half_bits(q.x), row.x);
        EXPECT_EQ(half_bits(q.y), row.y);
    }
}

TEST(PackedGBuffer, DecodesTheExampleOfTheChapter) {
    const glm::dvec3 n(.6, 0, -.8), stored = packed_normal(packed_halves(n));
    EXPECT_NEAR(stored.x, .599609, 1e-6);
    EXPECT_EQ(stored.y, 0);
    EXPECT_NEAR(stored.z, -.800293, 1e-6);
    EXPECT_NEAR(degrees_between(stored, n), .0280, 5e-5);
}

TEST(PackedGBuffer, AClearedTexelWouldLookLikeANormal) {
    const glm::dvec3 decoded = packed_normal({0, 0});
    EXPECT_NEAR(decoded.x, decoded.y, 1e-15) << "so the background is told by the material code, which a surface never leaves 0";
    EXPECT_NE(half_bits(half_value(half_of_code(0))), 0);
}

TEST(PackedGBuffer, NormalsOfAnyDirectionAreOffByTheMeanOfTheTable) {
    EXPECT_NEAR(errors_of_a_million_normals(packed_stored).mean, 0.0473, 0.05 * 0.0473);
}

TEST(PackedGBuffer, NormalsSeenEdgeOnAreTheWorst) {
    // The ring z = 0 near x = y: z_err = sqrt(2 |x dx + y dy|) with dx, dy up to 2^-11.
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> around(0, 2 * std::numbers::pi), above(-0.04, 0.04);
    const auto on_the_ring = [&] {
        const double a = around(random), z = above(random), r = std::sqrt(1 - z * z);
        return glm::dvec3(r * std::cos(a), r * std::sin(a), z);
    };
    EXPECT_NEAR(normal_errors(1000000, on_the_ring, packed_stored).worst, 2.124, 0.05 * 2.124);
}

TEST(PackedGBuffer, DepthStepsAreThoseOfHalfFloats) {
    struct Row {
        double z, step;
    };
    for (const Row row : {Row{0.1, 6.1e-5}, Row{0.3, 2.44e-4}, Row{1, 9.77e-4}, Row{2, 1.95e-3}, Row{5, 3.91e-3},
                          Row{10, 7.81e-3}, Row{20, .015625}, Row{50, .03125}, Row{100, .0625}, Row{200, .125}, Row{500, .25},
                          Row{1000, .5}, Row{2000, 1}, Row{5000, 4}}) {
        const double stored = half_depth(row.z, 0.01);
        const double next = half_value(static_cast<std::uint16_t>(half_bits(stored) + 1));
        EXPECT_NEAR((next - stored) / row.step, 1, 0.01) << row.z << " m";
        EXPECT_LE(std::abs(stored - row.z), row.step / 2 * 1.01);
    }
}

TEST(PackedGBuffer, NoValueIsSubnormalOrInfinite) {
    EXPECT_EQ(nearest_half(1e-9), 0);
    EXPECT_EQ(nearest_half(4e-5), 0x1p-14);
    EXPECT_EQ(nearest_half(1e9), 65504);
    EXPECT_EQ(nearest_half(1 + 0x1p-11), 1) << "a tie goes to the even neighbor";
    EXPECT_EQ(nearest_half(1 + 3 * 0x1p-11), 1 + 0x1p-9);
}

TEST(PackedGBuffer, DepthsBeforeTheNearPlaneAreTheNearPlane) { EXPECT_EQ(half_depth(-3, 0.5), 0.5); }

/// docs/algorithms/deferred.md 9, H3: the stored x and y of a normal may be longer than 1 by rounding, by 2^-10 at most; z is
/// then 0 and not a root of less.
TEST(PackedGBuffer, NormalsOnTheRingStayNumbers) {
    double longest = 0;
    for (int i = 0; i < 100000; ++i) {
        const double a = 2 * std::numbers::pi * i / 100000;
        const glm::dvec2 q = packed_halves({std::cos(a), std::sin(a), 0});
        longest = std::max(longest, glm::length(2.0 * glm::abs(q) - 1.0));
        ASSERT_NEAR(glm::length(packed_normal(q)), 1, 1e-12);
    }
    EXPECT_GT(longest, 1);
    EXPECT_LE(longest, 1 + 0x1p-10);
}

/// docs/algorithms/deferred.md 9, H4: the sign of z is lost where x is stored as 0, with |z| of .0157 at most, and a lost sign
/// is 1.79 degrees at most.
TEST(PackedGBuffer, ASignIsLostOnlyWhereItSaysLittle) {
    for (int i = 1; i < 20000; ++i) {
        const double z = -1e-6 * i;
        const glm::dvec3 n(-std::sqrt(1 - z * z), 0, z), stored = packed_normal(packed_halves(n));
        if (packed_halves(n).x != 0) continue;
        EXPECT_LE(-z, .0157);
        EXPECT_LE(std::asin(glm::length(glm::cross(n, stored))) * 180 / std::numbers::pi, 1.79);
    }
}

}  // namespace
}  // namespace strata::gbuffer
