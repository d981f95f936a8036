// Facts about object-sorted alpha blending: its order, where it is exact, and where it must fail.
#include <array>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "captures/cards.h"
#include "passes/scene/object_order.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/transparency/truth.h"

namespace strata {
namespace transparency {
ImageSet alpha_blend_model(const StageInput&, const Settings&);
}
namespace {

using testing::ElementsAre;

ImageSet before(const Frame& frame, double color) {
    return {{"color", ReferenceImage(frame.view.width, frame.view.height, 1, glm::dvec4(color))},
            {"depth_layers", ReferenceImage(frame.view.width, frame.view.height)}};
}

ReferenceImage blended(const Frame& frame, double behind) {
    const ImageSet images = before(frame, behind);
    return transparency::alpha_blend_model({frame, images}, Settings()).at("color");
}

ReferenceImage exact(const Frame& frame, double behind) {
    const ImageSet images = before(frame, behind);
    return transparency_truth({frame, images}).at("color");
}

TEST(ObjectOrder, DrawsFarObjectsFirst) {
    const std::array cards{Card{.center = {0, 0, 2}}, Card{.center = {0, 0, 5}}, Card{.center = {0, 0, 3}}};
    EXPECT_THAT(back_to_front_draws(frame_of_cards(cards, 8)), ElementsAre(1, 2, 0));
}

TEST(ObjectOrder, DrawsLowerPrioritiesFirstWhateverTheirDepth) {
    const std::array cards{Card{.center = {0, 0, 2}, .sort_priority = -1}, Card{.center = {0, 0, 5}}};
    EXPECT_THAT(back_to_front_draws(frame_of_cards(cards, 8)), ElementsAre(0, 1));
}

TEST(ObjectOrder, DrawsInterfacesAfterTheWorldByLayerThenPriorityThenSubmission) {
    const std::array cards{Card{.center = {0, 0, 7}}, Card{.center = {0, 0, 2}}, Card{.center = {0, 0, 5}},
                           Card{.center = {0, 0, 3}, .sort_priority = -1}, Card{.center = {0, 0, 1}, .sort_priority = 9}};
    Frame frame = frame_of_cards(cards, 8);
    frame.draws[0].layer = 2;
    for (const std::size_t i : {1u, 2u, 3u}) frame.draws[i].layer = 1;
    EXPECT_THAT(back_to_front_draws(frame), ElementsAre(4, 3, 1, 2, 0));
}

TEST(ObjectOrder, DrawsParticlesOfAnInterfaceAsTheyAreSubmitted) {
    Frame frame = frame_of_cards(std::array{Card{}}, 8);
    frame.emitters.push_back({.layer = 1, .particles = {{.center = {0, 0, 3}}, {.center = {0, 0, 5}}}});
    EXPECT_THAT(back_to_front_particles(frame, frame.emitters[0]), ElementsAre(0, 1));
}

TEST(ObjectOrder, KeepsTheOrderOfSubmissionAtEqualDepth) {
    const std::array cards{Card{.center = {0, 0, 2}}, Card{.center = {1, 0, 2}}, Card{.center = {0, 1, 2}}};
    EXPECT_THAT(back_to_front_draws(frame_of_cards(cards, 8)), ElementsAre(0, 1, 2));
}

TEST(ObjectOrder, SortsEmittersAmongTheDrawsAndLeavesOutEmptyOnes) {
    const std::array cards{Card{.center = {0, 0, 2}}, Card{.center = {0, 0, 6}}};
    Frame frame = frame_of_cards(cards, 8);
    frame.emitters.emplace_back();
    frame.emitters.push_back({.name = "smoke", .particles = {{.center = {0, 0, 3}}, {.center = {0, 0, 5}}}});
    EXPECT_THAT(back_to_front_draws(frame), ElementsAre(1, 3, 0));
}

TEST(ObjectOrder, LeavesOutOpaqueDraws) {
    const std::array cards{Card{.center = {0, 0, 2}}, Card{.center = {0, 0, 6}}};
    Frame frame = frame_of_cards(cards, 8);
    frame.materials[1].alpha_mode = AlphaMode::mask;
    EXPECT_THAT(back_to_front_draws(frame), ElementsAre(0));
}

TEST(ObjectOrder, SortsParticlesByCenterMinusDepthOffset) {
    Frame frame = frame_of_cards({}, 8);
    frame.emitters.push_back(
        {.name = "smoke",
         .particles = {
             {.center = {0, 0, 3}}, {.center = {0, 0, 5}, .depth_offset = 2.5f}, {.center = {0, 0, 4}}, {.center = {9, 0, 3}}}});
    EXPECT_THAT(back_to_front_particles(frame, frame.emitters[0]), ElementsAre(2, 0, 3, 1));
}

TEST(ObjectOrder, AnOffsetThatIsNotFiniteCountsAsNone) {
    Frame frame = frame_of_cards({}, 8);
    Emitter& smoke = frame.emitters.emplace_back();
    for (const float z : {3.f, 5.f, 4.f, 7.f, 6.f}) smoke.particles.push_back({.center = {0, 0, z}});
    smoke.particles[1].depth_offset = std::numeric_limits<float>::quiet_NaN();
    smoke.particles[2].depth_offset = std::numeric_limits<float>::infinity();
    EXPECT_THAT(back_to_front_particles(frame, smoke), ElementsAre(3, 4, 1, 2, 0));
}

TEST(ObjectOrder, MeasuresDepthAlongTheViewAndNotAsDistance) {
    const std::array cards{Card{.center = {50, 0, 2}}, Card{.center = {0, 0, 3}}};
    EXPECT_THAT(back_to_front_draws(frame_of_cards(cards, 8)), ElementsAre(1, 0));
}

TEST(AlphaBlend, IsExactForCardsThatDoNotCross) {
    const std::array cards{Card{.center = {0, 0, 2}, .color = {1, 1, 1, .5}}, Card{.center = {0, 0, 4}, .color = {0, 0, 0, .5}}};
    const Frame frame = frame_of_cards(cards, 8);
    for (const glm::dvec4& texel : blended(frame, 1).texels) EXPECT_DOUBLE_EQ(texel.x, .75);
}

TEST(AlphaBlend, ShowsTheWrongCardInFrontOnOneSideOfACrossing) {
    // Two cards crossing like an X: left one is in front, right the other; the later one is blended over both sides.
    const std::array cards{Card{.center = {0, 0, 3}, .half = 2, .color = {1, 1, 1, .5}, .tilt = .4},
                           Card{.center = {0, 0, 3}, .half = 2, .color = {0, 0, 0, .5}, .tilt = -.4}};
    const Frame frame = frame_of_cards(cards, 16);
    const ReferenceImage got = blended(frame, 0), wanted = exact(frame, 0);
    const double left = got.at(5, 8).x - wanted.at(5, 8).x, right = got.at(10, 8).x - wanted.at(10, 8).x;
    EXPECT_DOUBLE_EQ(got.at(5, 8).x, .25);
    EXPECT_DOUBLE_EQ(got.at(10, 8).x, .25);
    EXPECT_NEAR(std::abs(left) + std::abs(right), .25, 1e-12) << "one side is right, the other shows .25 for .5";
}

TEST(AlphaBlend, PaintsASmallPaneOverALargeOneThatReachesInFrontOfIt) {
    // The large pane's center is nearer, but where the small one stands the large pane lies behind it.
    const std::array cards{Card{.center = {0, 0, 3}, .half = 3, .color = {1, 1, 1, .5}, .tilt = -.7},
                           Card{.center = {.8, 0, 3.2}, .half = .2f, .color = {0, 0, 0, .5}}};
    const Frame frame = frame_of_cards(cards, 32);
    const ReferenceImage got = blended(frame, 0), wanted = exact(frame, 0);
    double worst = 0;
    for (std::size_t i = 0; i < got.texels.size(); ++i) worst = std::max(worst, std::abs(got.texels[i].x - wanted.texels[i].x));
    EXPECT_NEAR(worst, .25, 1e-12);
}

TEST(AlphaBlend, BlendsParticlesOfAnEmitterFarToNear) {
    Frame frame = frame_of_cards({}, 8);
    frame.emitters.push_back({.name = "smoke",
                              .particles = {{.center = {0, 0, 2}, .size = 9, .color = glm::vec3(1), .alpha = .5f},
                                            {.center = {0, 0, 4}, .size = 9, .color = glm::vec3(0), .alpha = .5f}}});
    for (const glm::dvec4& texel : blended(frame, 1).texels) EXPECT_DOUBLE_EQ(texel.x, .75);
}

}  // namespace
}  // namespace strata
