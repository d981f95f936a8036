// Facts about wavelet transparency (docs/algorithms/transparency.md 5, oracles (a) to (d), section 11, hard cases H5 and H14).
#include "passes/transparency/wavelet/model.h"
#include "tests/support/layers.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace strata::transparency {
namespace {

/// Place in cells of a depth in 0..1.
CellFragment at(std::uint32_t rank, double depth, double optical_depth) { return {depth * ((2u << rank) - 1), optical_depth}; }

TEST(Wavelet, HasTheCoefficientsOfTheChapter) {
    const std::array fragment{at(1, .3, 1)};
    const std::vector<double> c = haar_coefficients(1, fragment);
    ASSERT_EQ(c.size(), 4u);
    EXPECT_NEAR(c[0], .225, 1e-12);
    EXPECT_NEAR(c[1], .318198052, 1e-9);
    EXPECT_NEAR(c[2], 0, 1e-12);
    EXPECT_NEAR(c[3], .775, 1e-12);
    EXPECT_NEAR(haar_depth(c, fragment[0].place), .09, 1e-12);

    const std::array half{at(2, .5, std::log(2.))};
    const std::vector<double> d = haar_coefficients(2, half);
    const double wanted[] = {.303251891, .061266134, 0, 0, .086643398, 0, 0, .389895289};
    for (std::size_t i = 0; i < d.size(); ++i) EXPECT_NEAR(d[i], wanted[i], 1e-9) << i;
    EXPECT_NEAR(std::exp(-haar_depth(d, half[0].place)), .840896415, 1e-9);
}

TEST(Wavelet, IsAVoxelColumnWithLinearSplatsOneSliceBiasAndOtherNumbers) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    for (std::uint32_t rank = 1; rank <= 4; ++rank)
        for (int pixel = 0; pixel < 200; ++pixel) {
            std::vector<CellFragment> projected;
            for (int i = 0; i < 12; ++i) projected.push_back(at(rank, share(random), 3 * share(random)));
            const std::vector<double> c = haar_coefficients(rank, projected);
            for (int i = 0; i < 20; ++i) {
                const double place = at(rank, share(random), 0).place;
                ASSERT_NEAR(haar_depth(c, place), voxel_column_depth(2u << rank, projected, place), 1e-12) << rank;
            }
        }
}

TEST(Wavelet, KnowsWhatShowsThroughEverything) {
    for (std::uint32_t rank = 1; rank <= 4; ++rank) {
        const std::array projected{at(rank, 0, .5), at(rank, .37, 2), at(rank, 1, .25)};
        EXPECT_NEAR(haar_depth(haar_coefficients(rank, projected), (2u << rank) - 1), 2.5 + .25 * 0, 1e-12);
    }
}

/// A pixel whose fragments lie at d = depth.
double blend(std::uint32_t rank, std::uint32_t correction, std::span<const Fragment> fragments, double behind) {
    std::vector<CellFragment> projected;
    for (const Fragment& f : fragments) projected.push_back(at(rank, f.depth, optical_depth_in_double(f.transmittance.x)));
    const std::vector<double> c = haar_coefficients(rank, projected);
    const Transmittance function = [&](const Fragment& f) {
        const double place = at(rank, f.depth, 0).place, share = place - std::floor(place);
        double depth = haar_depth(c, place);
        if (correction == correction_own) depth -= share * (1 - share) * optical_depth_in_double(f.transmittance.x);
        return glm::dvec3(std::exp(-depth));
    };
    return function_blend(fragments, glm::dvec3(behind), function).x;
}

TEST(Wavelet, BlendsTheMicroExampleOfTheChapter) {
    const std::array fragments{layer(.2, .5, 1), layer(.5, .5, 0), layer(.8, .5, 1)};
    EXPECT_NEAR(blend(2, correction_none, fragments, 0), .626237, 2e-6);
    EXPECT_NEAR(blend(2, correction_own, fragments, 0), .625, 1e-9);
}

TEST(Wavelet, BlendsTwoHundredThinLayersBetterWithEveryRank) {
    std::vector<Fragment> ramp;
    for (int i = 0; i < 200; ++i) ramp.push_back(layer((i + .5) / 200, .01, i / 199.));
    const double wanted[] = {.3178, .3016, .2975, .2965};
    for (std::uint32_t rank = 1; rank <= 4; ++rank)
        EXPECT_NEAR(blend(rank, correction_none, ramp, 0), wanted[rank - 1], 1e-3) << rank;
}

TEST(Wavelet, SeesThinSmokeInFrontOfACardOnlyWhenCorrected) {
    const std::array fragments{layer(.2, .1, 1), layer(.8, 1, 0)};
    EXPECT_NEAR(blend(2, correction_own, fragments, 0), .1, 1e-6);
    EXPECT_GT(blend(2, correction_none, fragments, 0), .15);
}

}  // namespace
}  // namespace strata::transparency
