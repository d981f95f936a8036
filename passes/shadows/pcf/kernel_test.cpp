// Facts of the filter kernel, computable by hand (docs/algorithms/deferred.md 5.2).
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "passes/shadows/kernel.h"

namespace strata::shadows {

namespace {

constexpr std::uint32_t size = 64;

// Something at the light covers texels left of x = 32; elsewhere nothing was drawn.
ReferenceImage half_covered() {
    ReferenceImage map(size, size);
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) map.at(x, y).x = 1;
    }
    return map;
}

double share(const ReferenceImage& map, glm::dvec2 u, std::int64_t taps, double depth = 0.5) {
    return filter_map(map, {.size = size, .u = u, .depth = depth}, taps).lit;
}

// The mean of (taps - 1)^2 bilinear lookups one texel apart.
double mean_of_bilinear(const ReferenceImage& map, glm::dvec2 u, int taps, double depth) {
    const auto lit = [&](double x, double y) {
        return depth >= map.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)).x ? 1.0 : 0.0;
    };
    double sum = 0;
    for (int row = 0; row < taps - 1; ++row) {
        for (int column = 0; column < taps - 1; ++column) {
            const glm::dvec2 at = u - 0.5 + glm::dvec2(column, row) - double(taps / 2 - 1);
            const glm::dvec2 i = glm::floor(at), f = at - i;
            sum += (1 - f.y) * ((1 - f.x) * lit(i.x, i.y) + f.x * lit(i.x + 1, i.y)) +
                   f.y * ((1 - f.x) * lit(i.x, i.y + 1) + f.x * lit(i.x + 1, i.y + 1));
        }
    }
    return sum / ((taps - 1) * (taps - 1));
}

}  // namespace

TEST(pcf_kernel, crosses_a_straight_edge_as_a_ramp_of_seven_texels) {
    const ReferenceImage map = half_covered();
    EXPECT_NEAR(share(map, {32 + 1, 20.5}, 8), 9.0 / 14, 1e-12);
    EXPECT_NEAR(share(map, {32 + 3, 20.5}, 8), 0.928571, 1e-6);
    EXPECT_NEAR(share(map, {32 - 3, 20.5}, 8), 0.071429, 1e-6);
    for (double offset = -5; offset <= 5; offset += 0.125) {
        EXPECT_NEAR(share(map, {32 + offset, 20.5}, 8), std::clamp(offset / 7 + 0.5, 0.0, 1.0), 1e-12) << offset;
    }
}

TEST(pcf_kernel, gives_a_single_lit_texel_its_weight) {
    const glm::dvec2 u = glm::dvec2(30, 30) + 0.5 + glm::dvec2(0.25, 0.5);  // its first texel is (29, 29)
    const auto lit_at = [&](std::uint32_t x, std::uint32_t y) {
        ReferenceImage map(size, size, 1, glm::dvec4(1));
        map.at(29 + x, 29 + y).x = 0;
        return share(map, u, 4);
    };
    EXPECT_NEAR(lit_at(0, 0), 0.0416667, 1e-7);
    EXPECT_NEAR(lit_at(1, 0), 0.0555556, 1e-7);
    EXPECT_NEAR(lit_at(1, 1), 0.1111111, 1e-7);
    EXPECT_NEAR(lit_at(3, 3), 0.0138889, 1e-7);
    EXPECT_EQ(lit_at(4, 0), 0);
}

TEST(pcf_kernel, is_exactly_1_where_all_is_lit_and_exactly_0_where_nothing_is) {
    const ReferenceImage empty(size, size), full(size, size, 1, glm::dvec4(1));
    for (const std::int64_t taps : {2, 4, 8}) {
        for (int i = 0; i < 100; ++i) {
            const glm::dvec2 u(20 + 0.137 * i, 40 - 0.071 * i);
            EXPECT_EQ(share(empty, u, taps), 1.0);
            EXPECT_EQ(share(full, u, taps), 0.0);
        }
    }
}

TEST(pcf_kernel, equals_the_mean_of_bilinear_lookups) {
    ReferenceImage map(size, size);
    for (std::size_t i = 0; i < map.texels.size(); ++i) map.texels[i].x = double((i * 2654435761u >> 7) % 97) / 97;
    for (const int taps : {2, 4, 8}) {
        for (int i = 0; i < 50; ++i) {
            const glm::dvec2 u(10 + i * 41 / 64.0, 50 - i * 27 / 64.0);  // fractions of 1/64 are kept whole
            EXPECT_NEAR(share(map, u, taps, 0.4), mean_of_bilinear(map, u, taps, 0.4), 1e-12);
        }
    }
}

TEST(pcf_kernel, lights_what_lies_at_the_map_depth_and_what_lies_outside_the_map) {
    const ReferenceImage map(size, size, 1, glm::dvec4(0.5));
    EXPECT_EQ(share(map, {30, 30}, 4, 0.5), 1);
    EXPECT_EQ(share(map, {30, 30}, 4, 0.4999), 0);
    EXPECT_EQ(share(map, {-3, 30}, 4, 0), 1);
    EXPECT_EQ(share(map, {0, 30}, 2, 0), 0.5);
    EXPECT_EQ(share(map, {size, size}, 2, 0), 0.75);
}

}  // namespace strata::shadows
