// Facts of the talk's table of materials (docs/algorithms/deferred.md 1.6): its slices, what bytes and half texels cost, gloss.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "passes/lighting/material_table_model.h"

namespace strata::lighting {
namespace {

using std::numbers::pi;

TEST(MaterialTable, HasTheSlicesOfTheChapter) {
    const double ld = std::pow(.5, 32), ls = .5;  // ls of n_h = 1
    EXPECT_NEAR(material_formula(slice_rough, ld, 1).y, .5 * std::pow(ls, 16), 1e-15);
    EXPECT_NEAR(material_formula(slice_rough, .0625, 1).x, .125, 1e-12);
    EXPECT_NEAR(material_formula(slice_blinn, 1, .9).y, .0797664430768, 1e-10);
    EXPECT_NEAR(material_formula(slice_phong, 1, .98).y, .269199, 1e-6);
    EXPECT_EQ(material_formula(slice_phong, 1, .995).y, 1);
    EXPECT_EQ(material_formula(slice_phong, .25, .5).x, .25);
    EXPECT_NEAR(material_formula(slice_metal, .7, .7 / std::pow(.7, 1. / 32)).y, std::pow(.7, 1. / 7), 1e-12);
}

TEST(MaterialTable, LosesAFactorOfTheRootOfEPerTexelInTheNarrowestLobe) {
    const double here = material_formula(slice_phong, 1, .985).y, next = material_formula(slice_phong, 1, .985 - 1. / 255).y;
    EXPECT_NEAR(next / here, std::exp(-.5), .01);
}

TEST(MaterialTable, HoldsBytesAtTheCentersOfItsTexels) {
    // Texel (95, 204) of the blinn slice: light 95 / 127, halfway 204 / 255.
    const double n_l = 95.5 / 128, n_h = 204.5 / 256;
    const glm::dvec2 exact = material_formula(slice_blinn, 95. / 127, 204. / 255);
    const glm::dvec2 kept = material_in_table(slice_blinn, n_l, n_h).shares;
    EXPECT_NEAR(kept.x, std::floor(255.5 * exact.x) / 255, 1e-12);
    EXPECT_NEAR(kept.y, std::floor(255.5 * exact.y) / 255, 1e-12);
    EXPECT_GT(kept.x, .7);
}

/// The largest error of what is specular, over lights at a cosine of .02 and more and halfway vectors within 45 degrees.
double worst_specular(std::uint32_t slice, double shift) {
    double worst = 0;
    for (double n_l = .02; n_l <= 1; n_l += .01)
        for (double n_h = .7; n_h <= 1; n_h += .001) {
            const double read = material_in_table(slice, n_l + shift / 128, n_h + shift / 256).shares.y;
            worst = std::max(worst, std::abs(read - material_formula(slice, n_l, n_h).y));
        }
    return worst;
}

/// Cosines taken for coordinates are half a texel off at the far end, where texel 255 stands for a cosine of 1: a quarter of the
/// narrow lobe. In the wide one it is less than what bytes and straight lines between them cost.
TEST(MaterialTable, IsOffByItsBytesAndByHalfATexelOfTheNarrowLobe) {
    EXPECT_NEAR(worst_specular(slice_rough, 0), .016, .002);
    EXPECT_NEAR(worst_specular(slice_blinn, 0), .048, .003);
    EXPECT_NEAR(worst_specular(slice_phong, 0), .225, .01);
}

/// pi over the integral of the specular part over lights, seen along the normal.
double gloss_of_formula(std::uint32_t slice) {
    constexpr int steps = 100'000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + .5) / steps * pi / 2;
        sum += material_formula(slice, std::cos(angle), std::cos(angle / 2)).y * std::sin(angle);
    }
    return 1 / (2 * sum * (pi / 2 / steps));
}

TEST(MaterialTable, GlossMakesEveryHighlightReflectAsMuchAsItsRecordedOne) {
    EXPECT_NEAR(gloss_of_formula(slice_rough), double(gloss_rough), .005);
    EXPECT_NEAR(gloss_of_formula(slice_blinn), double(gloss_blinn), .005);
    EXPECT_NEAR(gloss_of_formula(slice_phong), double(gloss_phong), .005);
    EXPECT_NEAR(gloss_of_formula(slice_metal), double(gloss_metal), .005);
}

}  // namespace
}  // namespace strata::lighting
