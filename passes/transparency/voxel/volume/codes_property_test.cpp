// What the integers of voxel transparency must achieve, by exact probabilities and by sums without words
// (docs/algorithms/transparency.md 6.3 and 6.4). The model rounds by the shader's own hash and packs codes as the shader does, so
// comparing the two cannot find a mistake in both.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "passes/transparency/voxel/model.h"
#include "passes/transparency/voxel/volume/column.h"
#include "tests/support/exact_binomial.h"
#include "tests/support/random_numbers.h"

namespace strata::transparency {
namespace {

constexpr std::uint32_t fragment_count = 20000;

struct Rounded {
    glm::uvec2 texel{0};
    std::uint32_t draw = 2, triangle = 8;
    double number() const { return random_rounding(texel, draw, triangle); }
};

Rounded rounded_at(std::uint32_t i) { return {.texel = {i % 160 * 2, i / 160 * 2}}; }

TEST(VoxelRounding, IsUniform) {
    for (const double share : {.01, .1, .25, .5, .75, .99}) {
        std::uint32_t below = 0;
        for (std::uint32_t i = 0; i < fragment_count; ++i) {
            const double number = rounded_at(i).number();
            ASSERT_TRUE(number >= 0 && number < 1) << number;
            below += number < share;
        }
        EXPECT_GT(binomial_tail(below, fragment_count, share), hardly_ever) << share << ": " << below;
    }
}

TEST(VoxelRounding, RoundsUpAsOftenAsTheFractionSays) {
    for (const double codes : {.05, .4, 2.5, 31.75}) {
        std::uint32_t up = 0;
        for (std::uint32_t i = 0; i < fragment_count; ++i) {
            const double rounded = std::floor(codes + rounded_at(i).number());
            ASSERT_TRUE(rounded == std::floor(codes) || rounded == std::floor(codes) + 1);
            up += rounded > codes;
        }
        EXPECT_GT(binomial_tail(up, fragment_count, codes - std::floor(codes)), hardly_ever) << codes << ": " << up;
    }
}

TEST(VoxelRounding, OfTwoFragmentsHasNothingToDoWithEachOther) {
    constexpr double share = .5, other_share = .25;
    const auto both_below = [&](Rounded (*neighbor)(Rounded)) {
        std::uint32_t both = 0;
        for (std::uint32_t i = 0; i < fragment_count; ++i)
            both += rounded_at(i).number() < share && neighbor(rounded_at(i)).number() < other_share;
        return binomial_tail(both, fragment_count, share * other_share);
    };
    EXPECT_GT(both_below([](Rounded r) { return ++r.texel.x, r; }), hardly_ever);
    EXPECT_GT(both_below([](Rounded r) { return ++r.texel.y, r; }), hardly_ever);
    EXPECT_GT(both_below([](Rounded r) { return ++r.draw, r; }), hardly_ever);
    EXPECT_GT(both_below([](Rounded r) { return r.triangle += 2, r; }), hardly_ever);
    EXPECT_GT(both_below([](Rounded r) { return r.draw = 4, r.triangle = 4, r; }), hardly_ever);
    Rounded half = rounded_at(7), other_half = half;
    ++other_half.triangle;
    EXPECT_EQ(half.number(), other_half.number()) << "the halves of a particle meet without a seam";
}

/// Sums without words: each slice has a number of its own, however large.
std::vector<std::uint64_t> plain_integral(const std::vector<std::uint64_t>& slices, std::uint64_t full) {
    std::vector<std::uint64_t> integral;
    std::uint64_t sum = 0;
    for (const std::uint64_t slice : slices) integral.push_back(sum = std::min(sum + slice, full));
    return integral;
}

TEST(VoxelColumn, IntegratesWhatWasAddedWhateverFieldsCarryIntoTheNext) {
    Numbers numbers(6);
    constexpr std::array fields{std::pair{8u, 255u}, std::pair{10u, 1023u}, std::pair{16u, 65535u},
                                std::pair{32u, (1u << 20) - 1}};
    std::uint32_t overflowed = 0;
    for (int i = 0; i < 4000; ++i) {
        const auto [bits, full] = fields[numbers.below(4)];
        const std::uint32_t splat = numbers.below(2) == 0 ? splat_overflow_minimum : splat_saturating;
        const std::uint32_t slices = 1 + numbers.below(40);
        Column column({.slices = slices, .splat = splat, .field_bits = bits, .full_code = full});
        std::vector<std::uint64_t> plain(slices);
        const std::uint32_t largest = 1 + numbers.below(numbers.below(2) == 0 ? full : full / 50);
        for (std::uint32_t k = numbers.below(120); k > 0; --k) {
            const std::uint32_t slice = numbers.below(slices), code = numbers.below(largest + 1);
            column.add(slice, code);
            plain[slice] += code;
        }
        const std::vector<std::uint64_t> expected = plain_integral(plain, full);
        const std::vector<std::uint32_t> got = column.integral();
        ASSERT_TRUE(std::ranges::equal(got, expected)) << "column " << i << " of fields of " << bits << " bits";
        overflowed += column.overflow() != no_overflow;
    }
    EXPECT_GT(overflowed, 200u);
}

}  // namespace
}  // namespace strata::transparency
