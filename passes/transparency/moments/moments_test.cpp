// Facts about moment-based transparency (docs/algorithms/transparency.md 4: the tables of 4.3, 4.6, 4.8 and 4.9).
#include "passes/transparency/moments/model.h"
#include "passes/transparency/moments/moments.shared.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace strata::transparency {
namespace {

constexpr std::array all_kinds{moments_power4, moments_power6, moments_power8, moments_trig2, moments_trig3, moments_trig4};

MomentsParams defaults(std::uint32_t kind, std::uint32_t storage = storage_single) {
    return {.kind = kind, .storage = storage, .bias = 1, .overestimation = .25f};
}

const double half = std::log(2.);

std::vector<WarpedFragment> halves(std::initializer_list<double> places) {
    std::vector<WarpedFragment> projected;
    for (const double w : places) projected.push_back({w, half});
    return projected;
}

/// T at every fragment.
std::vector<double> through(std::uint32_t kind, std::initializer_list<double> places) {
    const std::vector<WarpedFragment> projected = halves(places);
    std::vector<double> found;
    for (const WarpedFragment& fragment : projected)
        found.push_back(transmittance_in_double(defaults(kind), projected, fragment.w));
    return found;
}

void expect_near(const std::vector<double>& got, std::initializer_list<double> wanted, double tolerance, std::uint32_t kind) {
    ASSERT_EQ(got.size(), wanted.size());
    for (std::size_t i = 0; i < got.size(); ++i)
        EXPECT_NEAR(got[i], wanted.begin()[i], tolerance) << "kind " << kind << " fragment " << i;
}

double tolerance_of(std::uint32_t kind) { return kind == moments_power8 ? 5e-4 : 1e-4; }

TEST(Moments, HideAQuarterOfASingleFragmentFromItself) {
    for (const std::uint32_t kind : all_kinds)
        for (const double w : {-.9, -.3, .001, .5, .99}) expect_near(through(kind, {w}), {.840896}, tolerance_of(kind), kind);
}

TEST(Moments, AreExactForAsManyFragmentsAsThereAreRootsAndOneMoreOnTheFragments) {
    for (const std::uint32_t kind : all_kinds) {
        expect_near(through(kind, {-.4, .3}), {.840896, .420448}, tolerance_of(kind), kind);
        expect_near(through(kind, {-.6, -.1, .5}), {.840896, .420448, .210224}, tolerance_of(kind), kind);
    }
}

TEST(Moments, BendTheCurveOfMoreFragments) {
    expect_near(through(moments_power4, {-.6, -.2, .2, .6}), {.833262, .466225, .251738, .108028}, 1e-4, moments_power4);
    for (const std::uint32_t kind : {moments_power6, moments_power8})
        expect_near(through(kind, {-.6, -.2, .2, .6}), {.8409, .4205, .2102, .1051}, 5e-4, kind);
    for (const std::uint32_t kind : {moments_power8, moments_trig4})
        expect_near(through(kind, {-.8, -.4, .001, .4, .8}), {.8408, .4204, .2103, .1051, .05257}, 5e-4, kind);
    expect_near(through(moments_power6, {-.8, -.4, .001, .4, .8}), {.83879, .424866, .252373, .115349, .0529549}, 1e-4,
                moments_power6);
}

/// Moments of uniform density on [-1, 1].
std::vector<double> uniform(std::uint32_t kind) {
    std::vector<double> moments;
    for (std::uint32_t i = 1; i <= 4 + 2 * kind; ++i) moments.push_back(i % 2 ? 0 : 1. / (i + 1));
    return moments;
}

TEST(Moments, ReconstructUniformSmoke) {
    EXPECT_NEAR(absorbance_share(moments_power4, uniform(moments_power4), 0, .25), 7. / 18, 1e-9);
    EXPECT_NEAR(absorbance_share(moments_power6, uniform(moments_power6), 1e-4, .25), 7. / 18, 1e-4);
    EXPECT_NEAR(absorbance_share(moments_power8, uniform(moments_power8), 0, .25), .428889, 1e-6);
    for (const std::uint32_t kind : {moments_power4, moments_power8})
        EXPECT_NEAR(absorbance_share(kind, uniform(kind), 0, .5), .5, 1e-9);
    EXPECT_NEAR(absorbance_share(moments_power4, uniform(moments_power4), .5, .25), .585856, 1e-6);
    EXPECT_NEAR(absorbance_share(moments_power6, uniform(moments_power6), .5, .25), .657734, 1e-6);
    EXPECT_NEAR(absorbance_share(moments_power8, uniform(moments_power8), .5, .25), .679162, 1e-6);
}

TEST(Moments, FitInto16BitsAndComeBack) {
    for (const std::uint32_t kind : {moments_power4, moments_power6, moments_power8})
        for (int i = 0; i <= 20000; ++i) {
            const double w = -1 + i / 10000.;
            std::vector<double> moments;
            for (std::uint32_t k = 1; k <= 4 + 2 * kind; ++k) moments.push_back(std::pow(w, k));
            const std::vector<double> back = dequantized(kind, quantized(kind, moments));
            // Half a step of 1/65535, times what the inverse transform adds up to in a row.
            for (std::size_t k = 0; k < back.size(); ++k)
                ASSERT_NEAR(back[k], moments[k], .5 / 65535 * 2.6) << kind << " at " << w;
        }
}

TEST(Moments, WithoutOverestimationOrWithCompensationLetSmokeInFrontOfACardAlone) {
    // Smoke of alpha .1, white, in front of a black card that is as opaque as moments can be: exactly .1 is seen.
    const std::vector<WarpedFragment> projected{{-.2, -std::log(.9)}, {.3, 10}};
    const auto seen = [&](MomentsParams params) {
        const double smoke = transmittance_in_double(params, projected, -.2, projected[0].optical_depth);
        const double card = transmittance_in_double(params, projected, .3, projected[1].optical_depth);
        return .1 * smoke / (.1 * smoke + card * (1 - std::exp(-10.)));
    };
    MomentsParams params = defaults(moments_power4);
    EXPECT_NEAR(seen(params), .5687, 1e-3);
    params.overestimation = .1f;
    EXPECT_NEAR(seen(params), .230, 1e-3);
    params.overestimation = .5f;
    EXPECT_NEAR(seen(params), .940, 1e-3);
    params.overestimation = 0;
    EXPECT_NEAR(seen(params), .1, 1e-3);
    params = defaults(moments_power4);
    params.compensation = compensation_own;
    EXPECT_NEAR(seen(params), .1, 1e-3);
}

/// Share of what is seen of three opaque cards that is not the first one's (hard case H1).
double leak(std::uint32_t kind, std::uint32_t storage, double spacing) {
    const std::vector<WarpedFragment> cards{{-spacing, 10}, {0, 10}, {spacing, 10}};
    double sum = 0, first = 0;
    for (const WarpedFragment& card : cards) {
        const double through = transmittance_in_double(defaults(kind, storage), cards, card.w);
        first = sum == 0 ? through : first;
        sum += through;
    }
    return 1 - first / sum;
}

TEST(Moments, LeakBetweenOpaqueCardsAsTheirBiasSays) {
    EXPECT_NEAR(leak(moments_power4, storage_single, .02), .002, 2e-3);
    EXPECT_NEAR(leak(moments_power4, storage_single, .002), .012, 4e-3);
    EXPECT_NEAR(leak(moments_power4, storage_single, .0005), .041, 6e-3);
    EXPECT_NEAR(leak(moments_power4, storage_single, .0001), .471, 2e-2);
    // Where the cards stand between two steps of 16 bits moves it: .104 here, .079 in the table of
    // docs/algorithms/transparency.md H1.
    EXPECT_NEAR(leak(moments_power4, storage_normalized, .005), .079, 3e-2);
    EXPECT_NEAR(leak(moments_power8, storage_normalized, .02), .029, 2e-2);
}

}  // namespace
}  // namespace strata::transparency
