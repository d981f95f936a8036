// Facts of positions out of half-float depth and out of the wrong place in a pixel, as numbers of docs/algorithms/deferred.md 9.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/view.h"
#include "passes/gbuffer/layout_model.h"

namespace strata::gbuffer {
namespace {

/// 67.5 degrees up and down, 1080p: the frame of the chapter's numbers.
Frame chapter_frame() {
    Frame frame;
    frame.view = look_at({.vertical_fov = 67.5 * std::numbers::pi / 180, .width = 1920, .height = 1080});
    return frame;
}

/// The farthest that a position in the corner of the picture is along its ray, of depths around z.
double worst_along(double z) {
    const double ray = glm::length(pixel_ray(chapter_frame(), 0.5, 0.5));
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const double here = z * (1 + 1e-6 * i);
        worst = std::max(worst, std::abs(half_depth(here, .1) - here) * ray);
    }
    return worst;
}

/// H2: 60 degrees off the light's direction doubles what a receiver moves through its light's depth.
TEST(GBufferPositions, OfHalfFloatDepthMoveAReceiverThroughItsShadow) {
    EXPECT_NEAR(worst_along(20) / .5, .026, .001);
    EXPECT_NEAR(worst_along(100) / .5, .106, .001);
}

/// H1: the sky's depth is the largest half float and never infinite.
TEST(GBufferPositions, OfHalfFloatDepthEndAtTheLastHalf) {
    EXPECT_NEAR(worst_along(1000) / glm::length(pixel_ray(chapter_frame(), 0.5, 0.5)), .25, .001);
    EXPECT_EQ(half_depth(1e9, .1), 65504);
}

/// H20: with sample shading gl_FragCoord is the sample's place. A depth of the pixel's center read there is .054 m beside its
/// place at 100 m, for the farthest of 8 samples; for the farthest of the 4 that Strata draws .046 m.
TEST(GBufferPositions, ReadAtTheWrongPlaceOfThePixelAreBesideTheSurface) {
    const Frame frame = chapter_frame();
    const auto beside = [&](double pixels) {
        return 100 * glm::length(pixel_ray(frame, 960.5 + pixels, 540.5) - pixel_ray(frame, 960.5, 540.5));
    };
    EXPECT_NEAR(beside(.4375), .054, .0005);
    EXPECT_NEAR(beside(.375), .0464, .0005);
}

}  // namespace
}  // namespace strata::gbuffer
