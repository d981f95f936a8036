// Facts of bloom (docs/algorithms/deferred.md 8.6, T-PP-3).
#include "passes/lens/bloom/bloom_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "passes/lens/bloom/glow.h"
#include "passes/lens/bloom/scattered.h"

namespace strata::lens {
namespace {

double energy(const ReferenceImage& image) {
    double sum = 0;
    for (const glm::dvec4& texel : image.texels) sum += texel.x;
    return sum;
}

TEST(Bloom, OfAConstantPictureIsThePicture) {
    const ReferenceImage constant(37, 21, 1, glm::dvec4(.3));
    for (const glm::dvec4& texel : pyramid_glow(constant, 4).texels) EXPECT_NEAR(texel.x, .3, 1e-12);
    for (const glm::dvec4& texel : scattered(constant, 4).texels) EXPECT_NEAR(texel.x, .3, 1e-12);
}

TEST(Bloom, KeepsTheEnergyOfOnePixelWhereverItLies) {
    for (const glm::uvec2 place : {glm::uvec2(128, 128), glm::uvec2(129, 127), glm::uvec2(130, 133), glm::uvec2(135, 122)}) {
        ReferenceImage picture(256, 256);
        picture.at(place.x, place.y) = glm::dvec4(1000);
        EXPECT_NEAR(energy(pyramid_glow(picture, 4)), 1000, 1e-9) << place.x << " " << place.y;
    }
}

TEST(Bloom, IsAsWideAsItsTruth) {
    ReferenceImage picture(256, 256);
    picture.at(128, 128) = glm::dvec4(1);
    const auto variance = [](const ReferenceImage& glow) {
        double sum = 0, mean = 0;
        for (std::uint32_t y = 0; y < 256; ++y)
            for (std::uint32_t x = 0; x < 256; ++x) {
                sum += glow.at(x, y).x * x * x;
                mean += glow.at(x, y).x * x;
            }
        return sum - mean * mean;
    };
    const double wanted = (1.5 + 7.5 + 31.5) / 3;
    EXPECT_NEAR(variance(scattered(picture, 3)), wanted, .02 * wanted);
    // Texels of 8 pixels do not lie around every pixel alike: the mean moves, too.
    EXPECT_NEAR(variance(pyramid_glow(picture, 3)), wanted, .02 * wanted);
}

TEST(Bloom, HasAsManyLevelsAsItsReachNeeds) {
    for (const std::uint32_t height : {1u, 36u, 180u, 1080u, 2160u})
        for (const double reach : {.005, .03, .12, .5}) EXPECT_EQ(glow_levels(reach, height), pyramid_levels(reach, height));
    EXPECT_EQ(glow_levels(.12, 1080), 8u) << "a deviation of 181 pixels for 130 wanted";
    EXPECT_EQ(glow_levels(.12, 2160), 9u) << "twice as many pixels, twice as wide";
}

TEST(Bloom, AboveAThresholdKeepsItsHue) {
    const Bloom bloom{.threshold = 1, .scale = .5};
    ReferenceImage picture(3, 1, 1);
    picture.at(0, 0) = {6, 3, 0, 1};
    picture.at(1, 0) = {2, 2, 2, 1};
    picture.at(2, 0) = glm::dvec4(NAN);
    const ReferenceImage glow = glowing(picture, bloom);
    EXPECT_EQ(glm::dvec3(glow.at(0, 0)), glm::dvec3(3, 1.5, 0) * (2. / 3)) << "3 after exposure: 2 are above the threshold";
    EXPECT_EQ(glm::dvec3(glow.at(1, 0)), glm::dvec3(0)) << "just at it";
    EXPECT_EQ(glm::dvec3(glow.at(2, 0)), glm::dvec3(0));
}

TEST(Bloom, WeightsOfXrayAreThoseOfTheChapter) {
    const double chapter[] = {.373478, .258507, .113238, .060249, .038828, .023495, .012751, .006193};
    double sum = -xray_taps()[0];
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(xray_taps()[i], chapter[i], 1e-6) << i;
        sum += 2 * xray_taps()[i];
    }
    EXPECT_NEAR(sum, 1.4, 1e-12);
}

TEST(Bloom, OfXrayMultipliesAConstantByItsGainsUntilItClips) {
    const auto glow = [](double hi) { return xray_glow(ReferenceImage(8, 8, 1, glm::dvec4(9 * hi)), 1).at(3, 3).x; };
    const double c = .05, rgb = 1.96 * 2 * c, alpha = 1.96 * (3 * 2 * c - 1e-5);
    EXPECT_NEAR(glow(c), rgb * alpha, 1e-9) << "two gains of 1.4 on the sum of four taps by 2";
    EXPECT_NEAR(glow(10), 1, 1e-12) << "clipped: energy is lost";
}

TEST(Bloom, IsAddedToEverySampleAlike) {
    ReferenceImage color(1, 1, 4);
    for (std::uint32_t i = 0; i < 4; ++i) color.at(0, 0, i) = glm::dvec4(i);
    const ReferenceImage result = with_glow(color, ReferenceImage(1, 1, 1, glm::dvec4(.6)), {.strength = .5, .scale = 2});
    for (std::uint32_t i = 0; i < 4; ++i) EXPECT_NEAR(result.at(0, 0, i).x, i + .15, 1e-12);
}

}  // namespace
}  // namespace strata::lens
