// Facts of combining and developing, on the model: the tone curve of docs/algorithms/deferred.md 8.1, the hemisphere of 8.3, fog.
#include <gtest/gtest.h>

#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/tone_curve.h"
#include "tests/support/one_pixel.h"

namespace strata::combine {

Technique hi_lo();
ImageSet hi_lo_model(const StageInput&, const Settings&);

namespace {

const Settings& default_settings() {
    static const Technique technique = hi_lo();
    static const Settings settings(technique.params);
    return settings;
}

constexpr double depth = 2;

/// A white Lambert surface two meters before the eye.
ImageSet white_surface(const glm::dvec3& normal) {
    return {{"surface_normal", ReferenceImage(1, 1, 1, {normal, depth})},
            {"surface_color", ReferenceImage(1, 1, 1, {1, 1, 1, 1})},
            {"surface_material", ReferenceImage(1, 1, 1, {double(LightingModel::lambert), 0, 1, 0})},
            {"emission", ReferenceImage(1, 1, 1, {0, 0, 0, 1})},
            {"color", ReferenceImage(1, 1, 1)}};
}

glm::dvec3 color_of(const Frame& frame, const ImageSet& before) {
    return glm::dvec3(hi_lo_model({frame, before}, default_settings()).at("color").at(0, 0));
}

double display_of(const Frame& frame, const ReferenceImage& color, const Settings& settings = default_settings()) {
    ImageSet before = white_surface({0, 0, -1});
    for (const std::string_view name : {"surface_normal", "surface_color", "surface_material", "emission"})
        before.find(name)->second = ReferenceImage(1, 1, color.layers);
    before["color"] = color;
    return hi_lo_model({frame, before}, settings).at("display").at(0, 0).x;
}

TEST(HiLoCombine, ToneCurveHasTheValuesOfTheChapter) {
    const Frame frame = one_pixel(1);
    for (const glm::dvec2 row : {glm::dvec2(0, 0), glm::dvec2(.18, .162043), glm::dvec2(.5, .391003), glm::dvec2(1, .673010),
                                 glm::dvec2(1.7, 1), glm::dvec2(2, 1), glm::dvec2(1e30, 1), glm::dvec2(-1, 0)})
        EXPECT_NEAR(display_of(frame, ReferenceImage(1, 1, 1, glm::dvec4(row.x))), row.y, 1e-6) << "radiance " << row.x;
}

TEST(HiLoCombine, ExposureScalesBeforeTheToneCurve) {
    Frame frame = one_pixel(1);
    frame.view.exposure = 2;
    EXPECT_NEAR(display_of(frame, ReferenceImage(1, 1, 1, glm::dvec4(.25))), .391003, 1e-6);
}

TEST(HiLoCombine, SamplesAreToneMappedBeforeTheyAreAveraged) {
    const Frame frame = one_pixel(4);
    ReferenceImage color(1, 1, 4, glm::dvec4(.1));
    color.at(0, 0, 3) = glm::dvec4(100);
    EXPECT_NEAR(display_of(frame, color), .320541, 1e-6) << "the other order gives 1";
}

/// Of three samples of .1 and one of 100, whose mean is 25.075 (docs/algorithms/deferred.md 3.5).
double display_of_a_firefly(std::string_view resolve) {
    static const Technique technique = hi_lo();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("resolve", resolve)) << resolve;
    const Frame frame = one_pixel(4);
    ReferenceImage color(1, 1, 4, glm::dvec4(.1));
    color.at(0, 0, 3) = glm::dvec4(100);
    return display_of(frame, color, settings);
}

TEST(HiLoCombine, ResolvesTheSamplesOfTheChapterToItsDigits) {
    EXPECT_NEAR(display_of_a_firefly("tone_mapped"), .320541, 1e-6);
    EXPECT_NEAR(display_of_a_firefly("linear"), 1, 1e-12);
    // Weights 1 / (1 + L): (3 * .1 / 1.1 + 100 / 101) / (3 / 1.1 + 1 / 101) = .461361, which the curve makes .366106.
    EXPECT_NEAR(display_of_a_firefly("weighted"), .366106, 1e-6);
    // 24 / 255 three times and 255 / 255: their mean is 81.75 / 255.
    EXPECT_DOUBLE_EQ(display_of_a_firefly("lo_hi"), 82. / 255);
}

TEST(HiLoCombine, EveryResolveIsTheToneCurveWhereSamplesAreEqual) {
    static const Technique technique = hi_lo();
    const Frame frame = one_pixel(4);
    for (const std::string_view resolve : {"tone_mapped", "linear", "weighted"}) {
        Settings settings(technique.params);
        EXPECT_TRUE(settings.set("resolve", resolve));
        for (const double radiance : {0., .18, 1., 1e6})
            EXPECT_NEAR(display_of(frame, ReferenceImage(1, 1, 4, glm::dvec4(radiance)), settings), tone_mapped(radiance, 1.7),
                        1e-6)
                << resolve << " of " << radiance;
    }
}

TEST(HiLoCombine, EightBitsAreOffByHalfAStepPerSampleAndByHalfAStepOfTheMean) {
    static const Technique technique = hi_lo();
    Settings settings(technique.params);
    EXPECT_TRUE(settings.set("resolve", "lo_hi"));
    const Frame frame = one_pixel(4);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        ReferenceImage color(1, 1, 4);
        for (std::uint32_t sample = 0; sample < 4; ++sample) color.at(0, 0, sample) = glm::dvec4(.00097 * i * (sample + 1));
        worst =
            std::max(worst, std::abs(display_of(frame, color, settings) - display_of(frame, color, Settings(technique.params))));
    }
    EXPECT_LE(worst, 1. / 255) << "docs/algorithms/deferred.md H12 allows a half and a whole step";
    EXPECT_GT(worst, .5 / 255);
}

TEST(HiLoCombine, HemisphereIsFullAboveHalfAtTheHorizonAndNothingBelow) {
    Frame frame = one_pixel(1);
    frame.hemisphere.sky = glm::vec3(1);
    EXPECT_NEAR(color_of(frame, white_surface({0, 1, 0})).x, 1, 1e-12);
    EXPECT_NEAR(color_of(frame, white_surface({0, 0, -1})).x, .5, 1e-12);
    EXPECT_NEAR(color_of(frame, white_surface({0, -1, 0})).x, 0, 1e-12);
}

TEST(HiLoCombine, OcclusionDarkensWhatComesFromAllAroundAndNotTheLights) {
    Frame frame = one_pixel(1);
    frame.hemisphere.sky = glm::vec3(1);
    ImageSet before = white_surface({0, 1, 0});
    before["light"] = ReferenceImage(1, 1, 1, glm::dvec4(3));
    before["indirect"] = ReferenceImage(1, 1, 1, glm::dvec4(.5));
    before["occlusion"] = ReferenceImage(1, 1, 1, glm::dvec4(.5));
    before["surface_material"].at(0, 0).z = .5;
    EXPECT_NEAR(color_of(frame, before).x, 3 + .5 * .5 * (1 + .5), 1e-12);
}

TEST(HiLoCombine, MetalsMirrorTheHemisphere) {
    Frame frame = one_pixel(1);
    frame.hemisphere.sky = glm::vec3(1);
    ImageSet before = white_surface(glm::normalize(glm::dvec3(0, 1, -1)));
    before["surface_material"].at(0, 0) = {double(LightingModel::ggx), 1, 1, 0};
    before["surface_color"].at(0, 0) = glm::dvec4(1, 1, 1, .2);
    EXPECT_GT(color_of(frame, before).x, .9);
    before["surface_color"].at(0, 0) = glm::dvec4(0, 0, 0, .2);
    EXPECT_LT(color_of(frame, before).x, .05) << "black metal";
}

TEST(HiLoCombine, FogHidesWhatItCoversAndAddsItsOwnColor) {
    Frame frame = one_pixel(1);
    frame.fog.density = float(std::log(2) / depth);
    frame.fog.color = glm::vec3(.3f);
    ImageSet before = white_surface({0, 1, 0});
    before["emission"].at(0, 0) = {1, 1, 1, 1};
    EXPECT_NEAR(color_of(frame, before).x, .5 * 1 + .5 * .3, 1e-6) << "half is left after one half-length";
}

TEST(HiLoCombine, SunShaftsAreAddedToSurfacesAndToTheBackgroundWithoutFog) {
    Frame frame = one_pixel(1);
    frame.background = {.1f, .2f, .3f};
    frame.fog.density = float(std::log(2) / depth);
    ImageSet before = white_surface({0, 1, 0});
    before["emission"].at(0, 0) = {1, 1, 1, 1};
    before["shafts"] = ReferenceImage(1, 1, 1, {.25, .5, 0, 1});
    EXPECT_NEAR(color_of(frame, before).x, .5 * 1 + .25, 1e-6);
    before["emission"].at(0, 0) = glm::dvec4(0);
    EXPECT_NEAR(color_of(frame, before).y, .2 + .5, 1e-6);
}

TEST(HiLoCombine, TheBackgroundIsNotFogged) {
    Frame frame = one_pixel(1);
    frame.background = {.1f, .2f, .3f};
    frame.fog.density = 10;
    ImageSet before = white_surface({0, 1, 0});
    before["emission"].at(0, 0) = glm::dvec4(0);
    EXPECT_EQ(color_of(frame, before), glm::dvec3(frame.background));
    EXPECT_EQ(color_of(frame, {{"color", ReferenceImage(1, 1, 1)}}), glm::dvec3(frame.background)) << "no G-buffer at all";
}

TEST(HiLoCombine, UnlitSurfacesShowTheirEmissionAndNothingElse) {
    Frame frame = one_pixel(1);
    frame.hemisphere.sky = glm::vec3(1);
    ImageSet before = white_surface({0, 1, 0});
    before["surface_material"].at(0, 0).x = double(LightingModel::unlit);
    before["emission"].at(0, 0) = {.7, .7, .7, 1};
    before["indirect"] = ReferenceImage(1, 1, 1, glm::dvec4(1));
    EXPECT_EQ(color_of(frame, before).x, .7);
}

TEST(HiLoCombine, PlainPixelsShowTheirFirstSample) {
    const Frame frame = one_pixel(4);
    ImageSet before;
    for (const auto& [name, image] : white_surface({0, 1, 0})) before[name] = ReferenceImage(1, 1, 4, image.at(0, 0));
    before["light"] = ReferenceImage(1, 1, 4);
    before["light"].at(0, 0, 0) = glm::dvec4(2);
    before["emission"].at(0, 0, 3) = glm::dvec4(5, 5, 5, 1);
    before["edges"] = ReferenceImage(1, 1, 1, glm::dvec4(0));
    const ImageSet plain = hi_lo_model({frame, before}, default_settings());
    for (std::uint32_t sample = 0; sample < 4; ++sample) EXPECT_EQ(plain.at("color").at(0, 0, sample).x, 2);
    before["edges"] = ReferenceImage(1, 1, 1, glm::dvec4(1));
    EXPECT_EQ(hi_lo_model({frame, before}, default_settings()).at("color").at(0, 0, 3).x, 5);
}

TEST(HiLoCombine, LinearColorIsOnlyClaimedWhereNothingIsDrawnOverIt) {
    Frame frame = one_pixel(1);
    frame.emitters.emplace_back();
    const ImageSet before = white_surface({0, 1, 0});
    EXPECT_FALSE(hi_lo_model({frame, before}, default_settings()).contains("color"));
    EXPECT_TRUE(hi_lo_model({frame, before}, default_settings()).contains("display"));
}

}  // namespace
}  // namespace strata::combine
