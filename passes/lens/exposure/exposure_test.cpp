// Facts of exposure (docs/algorithms/deferred.md 8.5, T-PP-2).
#include "passes/lens/exposure/exposure_model.h"
#include "passes/lens/lens.shared.h"

#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/stage_input.h"
#include "tests/support/one_pixel.h"

namespace strata::lens {
namespace {

constexpr double amount = .7, gray = 1;

LensParams with(std::uint32_t form) { return {.exposure = form, .exposure_amount = .7f, .exposure_grey = 1}; }

double of(const StageInput& input, std::uint32_t form = exposure_exponential) { return exposure_model(input, with(form)); }

TEST(Exposure, TargetsAreThoseOfTheChapterToTheirDigits) {
    for (const glm::dvec2 row : {glm::dvec2(0, 3.332556), glm::dvec2(.1, 2.702191), glm::dvec2(.5, 1.538296),
                                 glm::dvec2(1, .999930), glm::dvec2(2, .588211)})
        EXPECT_NEAR(exposure_target(row.x, amount, gray), row.y, 1e-6) << "luminance " << row.x;
}

TEST(Exposure, IsBoundedWhereXrayDiscardsItsBounds) {
    EXPECT_DOUBLE_EQ(exposure_target(0, 1, 1), 20);
    EXPECT_DOUBLE_EQ(exposure_target(1e9, amount, gray), 1. / 128);
    EXPECT_DOUBLE_EQ(exposure_target(.3, 0, gray), 1) << "without an amount, exposure stays as recorded";
}

TEST(Exposure, SharesOfTheWayAreThoseOfTheChapter) {
    EXPECT_NEAR(exponential_share(1. / 60, 1), .0165285, 1e-7);
    double share = 0;
    for (int frame = 0; frame < 400; ++frame) share = xray_share(share, 1. / 60, 1);
    EXPECT_NEAR(share, .0166667, 1e-7);
    EXPECT_NEAR(std::log(.01) / std::log(1 - exponential_share(1. / 60, 1)), 276.3, .05) << "frames to 99 %";
    EXPECT_NEAR(std::log(.01) / std::log(1 - share), 274.0, .05);
}

TEST(Exposure, IsWhereItIsAfterASecondHoweverManyFramesTheSecondHas) {
    const auto after_a_second = [](int frames) {
        double exposure = 3;
        for (int i = 0; i < frames; ++i) exposure += (1 - exposure) * exponential_share(1. / frames, 2);
        return exposure;
    };
    EXPECT_NEAR(after_a_second(1), after_a_second(240), 1e-12);
    EXPECT_NEAR(after_a_second(24), 1 + 2 * std::exp(-2.), 1e-12);
}

TEST(Exposure, OfWhiteIsPointNineInXrayAndOneInLuminance) {
    const Frame frame = one_pixel(1);
    const ReferenceImage white(1, 1, 1, glm::dvec4(1));
    EXPECT_NEAR(*measured_luminance(frame, white, exposure_xray, 1), .9, 1e-12);
    EXPECT_NEAR(*measured_luminance(frame, white, exposure_exponential, 1), 1, 1e-12);
}

TEST(Exposure, OneSunPixelOf65536AddsWhatTheChapterSays) {
    const Frame frame = one_pixel(1);
    ReferenceImage picture(256, 256, 1);
    picture.at(100, 50) = glm::dvec4(1e4);
    EXPECT_NEAR(*measured_luminance(frame, picture, exposure_xray, 1), 1.2e-4, .05e-4) << "9 after Hi clips";
}

TEST(Exposure, AdaptsAtOnceInAFirstFrameAndByTheTimeInLaterOnes) {
    const Frame frame = one_pixel(1);
    ImageSet before{{"color", ReferenceImage(1, 1, 1, glm::dvec4(.5))}};
    EXPECT_NEAR(of({frame, before}), 1.538296, 1e-6);
    before["exposure"] = ReferenceImage(1, 1, 1, {2.5, .1, 0, 0});
    EXPECT_NEAR(of({frame, before}), 2.5 + (1.538296 - 2.5) * (1 - std::exp(-.1)), 1e-6);
    EXPECT_EQ(of({frame, before}, exposure_off), 1);
}

TEST(Exposure, XrayMeasuresWhatTheLastExposureShows) {
    const Frame frame = one_pixel(1);
    ImageSet before{{"color", ReferenceImage(1, 1, 1, glm::dvec4(.5))}, {"exposure", ReferenceImage(1, 1, 1, {2, .1, .05, 0})}};
    const double share = .9 * .05 + .1 * .1;
    EXPECT_NEAR(of({frame, before}, exposure_xray), 2 + (exposure_target(.9, amount, gray) - 2) * share, 1e-6);
}

TEST(Exposure, IsNotPoisonedByPixelsThatAreNoNumbers) {
    const Frame frame = one_pixel(1);
    ReferenceImage picture(2, 1, 1, glm::dvec4(.5));
    picture.at(1, 0) = glm::dvec4(NAN);
    EXPECT_NEAR(of({frame, {{"color", picture}}}), 1.538296, 1e-6);
    picture.at(1, 0) = glm::dvec4(INFINITY);
    EXPECT_NEAR(of({frame, {{"color", picture}}}), 1. / 128, 1e-12) << "as bright as a half float can be";
    const ReferenceImage nothing(1, 1, 1, glm::dvec4(NAN));
    EXPECT_EQ(of({frame, {{"color", nothing}, {"exposure", ReferenceImage(1, 1, 1, {2.5, .1, 0, 0})}}}), 2.5) << "the one before";
}

}  // namespace
}  // namespace strata::lens
