// What a frame contains decides which stages it needs; every bit says why it is set.

#include <gmock/gmock.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame_features.h"
#include "tests/1_capture/sample_frames.h"

namespace strata {
namespace {

std::vector<std::string> names_of(const Features& features) {
    std::vector<std::string> names;
    for (const Feature feature : all_features()) {
        if (features.has(feature)) names.emplace_back(name(feature));
    }
    return names;
}

TEST(Features, ALitTriangleIsOpaqueAndHasASun) {
    EXPECT_THAT(names_of(frame_features(triangle_frame())), testing::ElementsAre("opaque", "sun"));
}

TEST(Features, TheReasonNamesWhatIsUsed) {
    const Features features = frame_features(rich_frame());
    EXPECT_EQ(features.reason(Feature::transparent), "draw 'pane' uses material 'glass' with alpha mode blend");
    EXPECT_EQ(features.reason(Feature::soft_particles), "emitter 'smoke' fades over 0.5 m");
    EXPECT_EQ(features.reason(Feature::area_lights), "light 'tube' is a tube");
    EXPECT_EQ(features.reason(Feature::masked), "");
}

TEST(Features, SomethingOfEverythingSetsAlmostEverything) {
    const Features features = frame_features(rich_frame());
    for (const Feature feature : all_features()) {
        const bool absent = feature == Feature::masked || feature == Feature::additive || feature == Feature::sun_shafts;
        EXPECT_EQ(features.has(feature), !absent) << name(feature);
        EXPECT_EQ(features.reason(feature).empty(), absent) << name(feature);
    }
}

TEST(Features, WhatIsDeclaredButNotUsedSetsNothing) {
    Frame frame = rich_frame();
    frame.draws.clear();
    frame.emitters[0].particles.clear();
    for (Light& light : frame.lights) light.intensity = {0, 0, 0};
    const Features features = frame_features(frame);
    for (const Feature feature : {Feature::opaque, Feature::transparent, Feature::particles, Feature::low_resolution,
                                  Feature::local_lights, Feature::blockers, Feature::darks, Feature::shadows}) {
        EXPECT_FALSE(features.has(feature)) << features.reason(feature);
    }
}

TEST(Features, MaskedSurfacesAreOpaqueOnes) {
    Frame frame = triangle_frame();
    frame.materials[0].alpha_mode = AlphaMode::mask;
    EXPECT_THAT(names_of(frame_features(frame)), testing::ElementsAre("opaque", "masked", "sun"));
}

TEST(Features, OnlyColoredTransmissionIsChromatic) {
    Frame frame = triangle_frame();
    frame.materials[0].alpha_mode = AlphaMode::blend;
    frame.materials[0].transmission = {.5f, .5f, .5f};
    EXPECT_FALSE(frame_features(frame).has(Feature::chromatic));
    frame.materials[0].transmission.x = .75f;
    EXPECT_TRUE(frame_features(frame).has(Feature::chromatic));
}

TEST(Features, LightWithoutCoverageIsAdditive) {
    Frame frame = triangle_frame();
    frame.materials[0].alpha_mode = AlphaMode::premultiplied;
    EXPECT_FALSE(frame_features(frame).has(Feature::additive));
    frame.materials[0].base_color.w = 0;
    EXPECT_TRUE(frame_features(frame).has(Feature::additive));
    Frame sparks = triangle_frame();
    sparks.emitters = {{.name = "sparks", .particles = {{.alpha = .5f, .emissive = {1, 1, 1}}}}};
    EXPECT_FALSE(frame_features(sparks).has(Feature::additive));
    sparks.emitters[0].particles[0].alpha = 0;
    EXPECT_TRUE(frame_features(sparks).has(Feature::additive));
}

TEST(Features, AShadowNeedsSomethingThatThrowsIt) {
    Frame frame = triangle_frame();
    frame.sun.shadow.casts = true;
    EXPECT_TRUE(frame_features(frame).has(Feature::shadows));
    frame.draws[0].casts_shadow = false;
    EXPECT_FALSE(frame_features(frame).has(Feature::shadows));
}

TEST(Features, EveryFeatureIsFoundByItsName) {
    for (const Feature feature : all_features()) EXPECT_EQ(find_feature(name(feature)), feature);
    EXPECT_FALSE(find_feature("count_"));
    EXPECT_EQ(all_features().size(), static_cast<std::size_t>(Feature::count_));
}

TEST(Features, TheFirstReasonStays) {
    Features features;
    features.set(Feature::fog, "first");
    features.set(Feature::fog, "second");
    EXPECT_EQ(features.reason(Feature::fog), "first");
}

}  // namespace
}  // namespace strata
