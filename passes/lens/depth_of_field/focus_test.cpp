// Facts of depth of field (docs/algorithms/deferred.md 8.7, T-PP-4).
#include <cmath>

#include <gtest/gtest.h>

#include "passes/lens/depth_of_field/focus_model.h"
#include "passes/lens/depth_of_field/truth.h"
#include "passes/lens/depth_of_field/xray_model.h"
#include "tests/support/one_pixel.h"

namespace strata::lens {
namespace {

constexpr std::uint32_t size = 48;
constexpr double near_plane = .1;

Frame focused(double distance, double aperture) {
    Frame frame = one_pixel(1);
    frame.view.width = frame.view.height = size;
    frame.lens = {.focus_distance = float(distance), .aperture = float(aperture)};
    return frame;
}

LensParams with(std::uint32_t form) { return {.focus = form, .focus_taps = focus_taps_256, .focus_reach = .25f}; }

/// The left half of the picture at one depth and color, the right half at another.
ImageSet halves(glm::dvec2 depths, glm::dvec2 colors) {
    ImageSet before{{"color", ReferenceImage(size, size)}, {"depth_layers", ReferenceImage(size, size)}};
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const bool is_right = x >= size / 2;
            before["color"].at(x, y) = glm::dvec4(glm::dvec3(is_right ? colors.y : colors.x), 1);
            before["depth_layers"].at(x, y).x = near_plane / (is_right ? depths.y : depths.x);
        }
    return before;
}

ReferenceImage seen(const Frame& frame, const ImageSet& before, std::uint32_t form = focus_gather) {
    return focus_model({frame, before}, before.at("color"), with(form));
}

TEST(DepthOfField, BlurIsThatOfAThinLens) {
    const Frame frame = focused(2, .1);
    const double pixels = std::abs(double(frame.view.projection[1][1])) * size / 2;
    EXPECT_NEAR(blur_radius(frame, 2), 0, 1e-12);
    // Similar triangles: a lens 5 cm up sees a point at 4 m shifted by 5 cm (4 - 2) / 4 in the plane at 2 m.
    EXPECT_NEAR(blur_radius(frame, 4), .05 * (4. - 2) / 4 / 2 * pixels, 1e-6);
    EXPECT_NEAR(blur_radius(frame, HUGE_VAL), .05 / 2 * pixels, 1e-6);
    EXPECT_NEAR(blur_radius(frame, 1), -.05 / 2 * pixels, 1e-6) << "half the distance: as much as infinity, turned over";
}

TEST(DepthOfField, KeepsABlurredPictureOfOneColor) {
    for (const std::uint32_t form : {focus_gather, focus_xray}) {
        const Frame frame = focused(2, .4);
        for (const glm::dvec4& texel : seen(frame, halves({1, 30}, {.4, .4}), form).texels) EXPECT_NEAR(texel.x, .4, 1e-12);
    }
    for (const glm::dvec4& texel :
         seen_through_lens({focused(2, .4), halves({1, 30}, {.4, .4})}, halves({1, 30}, {.4, .4}).at("color")).texels)
        EXPECT_NEAR(texel.x, .4, 1e-12);
}

TEST(DepthOfField, KeepsTheBitsOfWhatIsInFocus) {
    const ImageSet before = halves({1.4, 1.4}, {.1, 7.3});
    for (const std::uint32_t form : {focus_gather, focus_xray})
        EXPECT_EQ(seen(focused(1.4f, .3), before, form).texels, before.at("color").texels) << form;
}

TEST(DepthOfField, SharpForegroundDoesNotLeakIntoWhatIsBehind) {
    const ReferenceImage result = seen(focused(2, .4), halves({2, 50}, {100, 1}));
    for (std::uint32_t x = 0; x < size; ++x) EXPECT_EQ(result.at(x, 20).x, x < size / 2 ? 100 : 1) << x;
}

TEST(DepthOfField, BlurredForegroundCoversWhatIsInFocusByHalfAtItsBorder) {
    const Frame frame = focused(2, .3);
    const ImageSet before = halves({1, 2}, {1, 0});
    const ReferenceImage result = seen(frame, before), truth = seen_through_lens({frame, before}, before.at("color"));
    EXPECT_NEAR(result.at(size / 2, 20).x, .5, .15);
    EXPECT_NEAR(result.at(size / 2 - 1, 20).x, .5, .15);
    for (std::uint32_t x = 4; x < size - 4; ++x) EXPECT_NEAR(result.at(x, 20).x, truth.at(x, 20).x, .13) << x;
}

TEST(DepthOfField, FactorsOfXrayAreThoseOfTheChapter) {
    for (const glm::dvec2 row :
         {glm::dvec2(0, .279103), glm::dvec2(.3, .172303), glm::dvec2(1.4, 0), glm::dvec2(30, .002283), glm::dvec2(100, .027132),
          glm::dvec2(600, 1), glm::dvec2(2000, 1), glm::dvec2(HUGE_VAL, .002283)})
        EXPECT_NEAR(xray_blur(row.x, 1.4), row.y, 1e-6) << "at " << row.x << " m";
}

TEST(DepthOfField, OnePixelThatIsNoNumberStaysAlone) {
    for (const std::uint32_t form : {focus_gather, focus_xray}) {
        ImageSet before = halves({.5, 700}, {1, 2});
        before["color"].at(30, 20) = glm::dvec4(NAN);
        const ReferenceImage result = seen(focused(2, .3), before, form);
        for (std::size_t i = 0; i < result.texels.size(); ++i) EXPECT_TRUE(std::isfinite(result.texels[i].x)) << i;
    }
}

TEST(DepthOfField, AFocusBeforeTheNearPlaneIsTheNearPlane) { EXPECT_NEAR(blur_radius(focused(0, .1), near_plane), 0, 1e-6); }

}  // namespace
}  // namespace strata::lens
