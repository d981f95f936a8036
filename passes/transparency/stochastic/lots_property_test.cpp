// What the lots of stochastic transparency must achieve, by exact probabilities (Enderton et al. 2010, sections 3.1 and 3.3;
// hashed alpha: Wyman and McGuire 2017). The model draws them by the shader's own integer hash, so comparing the two cannot find
// a hash that is not fair: these tests can. They know of it only that a fragment has a key.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "passes/transparency/stochastic/model.h"
#include "tests/support/exact_binomial.h"

namespace strata::transparency {
namespace {

constexpr std::uint32_t fragments = 20000;

struct FragmentId {
    glm::uvec3 at{0};  ///< pixel, sample
    std::uint32_t draw = 3, triangle = 10, seed = 0;
};

/// Pixels that are no neighbors: a test of neighbors uses each of them once.
FragmentId place(std::uint32_t i) { return {.at = {i % 160 * 2, i / 160 * 2, 0}}; }

struct Drawn {
    std::uint32_t subsamples = 8, subset = subset_stratified;
};

std::uint64_t mask(double alpha, const FragmentId& p, const Drawn& drawn) {
    return covered_subset(alpha, subset_key(p.seed, p.at, p.draw, p.triangle), drawn.subsamples, drawn.subset);
}

TEST(StochasticLots, CoverEachSubsampleWithProbabilityAlpha) {
    for (const std::uint32_t subset : {subset_bernoulli, subset_stratified})
        for (const std::uint32_t subsamples : {4u, 8u, 16u, 32u, 64u})
            for (const double alpha : {.003, .1, .3, .5, .75, .97}) {
                std::array<std::uint32_t, 64> covered{};
                for (std::uint32_t i = 0; i < fragments; ++i) {
                    const std::uint64_t bits = mask(alpha, place(i), {subsamples, subset});
                    for (std::uint32_t s = 0; s < subsamples; ++s) covered[s] += bits >> s & 1;
                }
                for (std::uint32_t s = 0; s < subsamples; ++s)
                    EXPECT_GT(binomial_tail(covered[s], fragments, alpha), hardly_ever)
                        << "subset " << subset << ", subsample " << s << " of " << subsamples << ", alpha " << alpha << ": "
                        << covered[s];
            }
}

TEST(StochasticLots, OnTheirOwnCoverABinomialNumberOfSubsamples) {
    for (const double alpha : {.05, .3, .5, .9}) {
        std::array<std::uint32_t, 9> of_size{};
        for (std::uint32_t i = 0; i < fragments; ++i)
            ++of_size[std::size_t(std::popcount(mask(alpha, place(i), {8, subset_bernoulli})))];
        for (std::uint32_t size = 0; size <= 8; ++size)
            EXPECT_GT(binomial_tail(of_size[size], fragments, binomial(size, 8, alpha)), hardly_ever)
                << size << " of 8, " << alpha;
    }
}

TEST(StochasticLots, StratifiedCoverTheWholeNumberBelowOrAboveAlphaTimesTheSubsamples) {
    for (const std::uint32_t subsamples : {4u, 8u, 64u})
        for (const double alpha : {.01, .25, .3, .5, .55, .97}) {
            const double wanted = alpha * subsamples, whole = std::floor(wanted);
            std::uint32_t above = 0;
            for (std::uint32_t i = 0; i < fragments; ++i) {
                const int covered = std::popcount(mask(alpha, place(i), {subsamples, subset_stratified}));
                ASSERT_TRUE(covered == whole || covered == whole + 1) << covered << " for " << wanted;
                above += covered > whole;
            }
            EXPECT_GT(binomial_tail(above, fragments, wanted - whole), hardly_ever) << above << " for " << wanted;
        }
}

TEST(StochasticLots, StratifiedTakeEverySubsetOfASizeAsOften) {
    constexpr double subsets_of_3 = 56;  // of 8
    constexpr std::uint32_t many = 56000;
    std::map<std::uint64_t, std::uint32_t> taken;
    for (std::uint32_t i = 0; i < many; ++i) ++taken[mask(3. / 8, place(i), {8, subset_stratified})];
    EXPECT_EQ(double(taken.size()), subsets_of_3);
    for (const auto& [bits, count] : taken) EXPECT_GT(binomial_tail(count, many, 1 / subsets_of_3), hardly_ever) << bits;
}

/// What makes another fragment of one, by name.
struct Neighbor {
    const char* name;
    FragmentId (*of)(FragmentId);
};
constexpr Neighbor neighbors[] = {{"pixel to the right", [](FragmentId p) { return ++p.at.x, p; }},
                                  {"pixel below", [](FragmentId p) { return ++p.at.y, p; }},
                                  {"sample", [](FragmentId p) { return ++p.at.z, p; }},
                                  {"draw", [](FragmentId p) { return ++p.draw, p; }},
                                  {"pair of triangles", [](FragmentId p) { return p.triangle += 2, p; }},
                                  {"draw and pair, swapped", [](FragmentId p) { return p.draw = 5, p.triangle = 6, p; }},
                                  {"seed", [](FragmentId p) { return ++p.seed, p; }}};

TEST(StochasticLots, OfTwoFragmentsHaveNothingToDoWithEachOther) {
    constexpr double alpha = .5, other_alpha = .25;
    for (const std::uint32_t subset : {subset_bernoulli, subset_stratified})
        for (const Neighbor& neighbor : neighbors) {
            std::array<std::uint32_t, 64> both{};  // by subsample of the one, then of the other
            for (std::uint32_t i = 0; i < fragments; ++i) {
                const std::uint64_t one = mask(alpha, place(i), {8, subset}),
                                    other = mask(other_alpha, neighbor.of(place(i)), {8, subset});
                for (std::uint32_t s = 0; s < 64; ++s) both[s] += one >> s / 8 & other >> s % 8 & 1;
            }
            for (std::uint32_t s = 0; s < 64; ++s)
                EXPECT_GT(binomial_tail(both[s], fragments, alpha * other_alpha), hardly_ever)
                    << neighbor.name << ", subset " << subset << ", subsamples " << s / 8 << " and " << s % 8 << ": " << both[s];
        }
}

TEST(StochasticLots, OfManyLayersLetThroughTheProductOfWhatEachLetsThrough) {
    constexpr std::array alphas{.3, .1, .5, .2, .05};
    double through = 1;
    for (const double alpha : alphas) through *= 1 - alpha;
    for (const std::uint32_t subset : {subset_bernoulli, subset_stratified})
        for (std::uint32_t s = 0; s < 8; ++s) {
            std::uint32_t seen = 0;
            for (std::uint32_t i = 0; i < fragments; ++i) {
                std::uint64_t covered = 0;
                for (std::uint32_t layer = 0; layer < alphas.size(); ++layer) {
                    FragmentId p = place(i);
                    p.draw = layer;
                    covered |= mask(alphas[layer], p, {8, subset});
                }
                seen += !(covered >> s & 1);
            }
            EXPECT_GT(binomial_tail(seen, fragments, through), hardly_ever) << "subsample " << s << ": " << seen;
        }
}

TEST(StochasticLots, OfHashedAlphaPassWithProbabilityAlphaBetweenOctaves) {
    // A point a meter from the next is in cells of its own: cells are an eighth of a meter and smaller.
    const auto point = [](std::uint32_t i) { return glm::dvec3(i % 50, i / 50 % 20, i / 1000) + .3; };
    for (const double octave : {3., 3.1, 3.5, 3.9})
        for (const double alpha : {.02, .25, .5, .9}) {
            std::uint32_t passing = 0;
            for (std::uint32_t i = 0; i < fragments; ++i) passing += hashed_threshold(point(i), octave, 0) <= alpha;
            EXPECT_GT(binomial_tail(passing, fragments, alpha), hardly_ever) << octave << ", " << alpha << ": " << passing;
        }
}

}  // namespace
}  // namespace strata::transparency
