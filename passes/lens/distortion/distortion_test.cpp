// Facts of radial distortion (docs/algorithms/deferred.md 8.8, T-PP-5).
#include <cmath>

#include <gtest/gtest.h>

#include "passes/lens/distortion/radial.h"
#include "passes/lens/distortion/radial_model.h"

namespace strata::lens {
namespace {

constexpr glm::dvec2 extent{64, 36};

ReferenceImage ramp() {
    ReferenceImage image(64, 36, 1);
    for (std::uint32_t y = 0; y < 36; ++y)
        for (std::uint32_t x = 0; x < 64; ++x) image.at(x, y) = {double(x), double(y), 1, 1};
    return image;
}

TEST(Distortion, OfNothingChangesNothing) { EXPECT_EQ(radial_model(ramp(), 0).texels, ramp().texels); }

TEST(Distortion, ShowsNothingFromBeyondTheBorderAndAllOfOneCorner) {
    for (const double k1 : {-.3, -.1, .1, 1.})
        for (double x = 0; x <= 64; x += 4)
            for (double y = 0; y <= 36; y += 3) {
                const glm::dvec2 source = radial_source(k1, {x, y}, extent);
                EXPECT_TRUE(source.x >= -1e-9 && source.x <= 64 + 1e-9 && source.y >= -1e-9 && source.y <= 36 + 1e-9) << k1;
            }
    EXPECT_NEAR(radial_source(.2, {0, 0}, extent).x, 0, 1e-12) << "a barrel keeps the corners";
    EXPECT_NEAR(radial_source(-.2, {32, 0}, extent).y, 0, 1e-12) << "a pincushion keeps the middle of the longer sides";
}

TEST(Distortion, MagnifiesTheMiddleByWhatItTakesFromTheCorners) {
    // Near the middle r is 0: sources lie 1 / (1 + k1) of the distance away.
    EXPECT_NEAR(radial_source(.25, {33, 18}, extent).x - 32, 1 / 1.25, 1e-3);
}

TEST(Distortion, OfARampIsThePlaceItReads) {
    const ReferenceImage bent = radial_model(ramp(), .2);
    for (const glm::uvec2 pixel : {glm::uvec2(5, 7), glm::uvec2(40, 30), glm::uvec2(32, 18)}) {
        const glm::dvec2 source = radial_source(.2, glm::dvec2(pixel) + .5, extent) - .5;
        EXPECT_NEAR(bent.at(pixel.x, pixel.y).x, source.x, 1e-9);
        EXPECT_NEAR(bent.at(pixel.x, pixel.y).y, source.y, 1e-9);
    }
}

TEST(Distortion, OfTheDeviceHasTheScaleOfItsModel) {
    for (const double k1 : {-.3, -.1, .1, 1.}) {
        const glm::dvec2 near_middle = radial_source(k1, glm::dvec2(32.001, 18), extent);
        EXPECT_NEAR(radial_scale(k1, 64, 36), (near_middle.x - 32) / .001, 1e-6) << k1;
    }
}

}  // namespace
}  // namespace strata::lens
