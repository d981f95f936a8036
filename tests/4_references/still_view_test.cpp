// The eye of light volumes stays where it is.
#include "passes/scene/still_view.h"

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light_volume.h"

namespace strata {
namespace {

Frame seen_from(const glm::dvec3& eye) {
    Frame frame;
    frame.view.origin = eye;
    frame.view.to_view = glm::dmat3({0, 0, -1}, {0, 1, 0}, {-1, 0, 0});  // mirrors, as a right-handed world does
    return frame;
}

TEST(StillView, IsInTheMiddleOfTheFirstLocalVolumeWhereverTheEyeIs) {
    for (const double x : {0., 3., 1e5}) {
        Frame frame = seen_from({x, 2, 1});
        frame.light_volumes = {{.kind = VolumeKind::cascaded_global},
                               {.kind = VolumeKind::fixed_local, .center = {5, 6, 7}},
                               {.kind = VolumeKind::fixed_local, .center = {50, 60, 70}}};
        const View still = still_view(frame);
        EXPECT_EQ(still.origin, glm::dvec3(5, 6, 7));
        EXPECT_EQ(still.to_view, glm::dmat3({1, 0, 0}, {0, 1, 0}, {0, 0, -1})) << "as left-handed as the eye's";
        frame.view.to_view = glm::dmat3(1);
        EXPECT_EQ(still_view(frame).to_view, glm::dmat3(1));
    }
}

TEST(StillView, OfCascadesStaysInBlocksOf256Cells) {
    const auto origin = [](const glm::dvec3& eye) {
        Frame frame = seen_from(eye);
        frame.light_volumes = {{.kind = VolumeKind::cascaded_global, .half_extent = {4, 4, 4}, .cells = {16, 16, 16}}};
        return still_view(frame).origin;
    };
    EXPECT_EQ(origin({0, 0, 0}), glm::dvec3(0)) << "cells of half a meter";
    EXPECT_EQ(origin({63.9, -.1, -64}), glm::dvec3(0));
    EXPECT_EQ(origin({64, -64.1, 192}), glm::dvec3(128, -128, 256));
}

TEST(StillView, IsTheEyeWhereThereIsNoVolume) {
    const Frame frame = seen_from({1, 2, 3});
    EXPECT_EQ(still_view(frame).origin, frame.view.origin);
    EXPECT_EQ(still_view(frame).to_view, frame.view.to_view);
}

}  // namespace
}  // namespace strata
