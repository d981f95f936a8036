// Facts of depth of field (docs/algorithms/deferred.md 8.7, T-PP-4).
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/lens/depth_of_field/focus_model.h"
#include "passes/lens/depth_of_field/truth.h"
#include "passes/lens/depth_of_field/xray_model.h"
#include "passes/lens/lens.shared.h"
#include "passes/stage_input.h"
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

/// Light of one pixel at a depth before a black wall, and the mean squared distance of where the lens throws it.
struct Disc {
    double light = 0, squared_radius = 0;
};

template <typename SeeThrough>
Disc disc_of_pixel(double depth, double wall, SeeThrough see) {
    ImageSet before = halves({wall, wall}, {0, 0});
    before["depth_layers"].at(size / 2, size / 2).x = near_plane / depth;
    before["color"].at(size / 2, size / 2) = glm::dvec4(100, 100, 100, 1);
    const ReferenceImage picture = see(before);
    Disc disc;
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x) {
            const double light = picture.at(x, y).x;
            disc.light += light;
            disc.squared_radius += light * (std::pow(double(x) - size / 2., 2) + std::pow(double(y) - size / 2., 2));
        }
    disc.squared_radius /= disc.light;
    return disc;
}

/// By focal length: a lens of diameter A focused at s makes a disc of A F |z - s| / (z (s - F)) on a sensor at F s / (s - F).
TEST(DepthOfField, APointIsADiscOfItsRadiusAndOfItsLight) {
    constexpr double focal = .05, focus = 2, aperture = .8;
    for (const double depth : {1., 1.3, 5., 40.})
        for (const std::uint32_t height : {size / 2, size, 2 * size}) {  // of a picture of which this is a part
            Frame frame = focused(focus, aperture);
            frame.view.height = height;
            const double on_sensor = aperture * focal * std::abs(depth - focus) / (depth * (focus - focal));
            const double pixels = std::abs(double(frame.view.projection[1][1])) * height / 2 / (focal * focus / (focus - focal));
            const double radius = on_sensor * pixels / 2;
            ASSERT_LT(radius, size / 2.);
            // A uniform disc, and a pixel's width to where it falls.
            const double wanted = radius * radius / 2 + 1. / 6;
            for (const double wall : {depth, 1.1 * depth, 3 * depth}) {
                const Disc truth = disc_of_pixel(depth, wall, [&](const ImageSet& before) {
                    return seen_through_lens({frame, before}, before.at("color"));
                });
                EXPECT_NEAR(truth.light, 100, 1e-9) << depth << ' ' << height << ' ' << wall;
                EXPECT_NEAR(truth.squared_radius, wanted, .02 * wanted + .1) << depth << ' ' << height << ' ' << wall;
            }
        }
}

/// An L of this depth and color before a wall.
ImageSet corner(const glm::dvec2& depths, const glm::dvec2& colors) {
    ImageSet before = halves(glm::dvec2(depths.y), glm::dvec2(colors.y));
    for (std::uint32_t y = 10; y < 38; ++y)
        for (std::uint32_t x = 10; x < (y < 24 ? 38u : 18u); ++x) {
            before["color"].at(x, y) = glm::dvec4(glm::dvec3(colors.x), 1);
            before["depth_layers"].at(x, y).x = near_plane / depths.x;
        }
    return before;
}

TEST(DepthOfField, ALampInFocusDoesNotLeakIntoTheWallBehindItsCorner) {
    const Frame frame = focused(2, .8);
    const ImageSet before = corner({2, 30}, {40, .1});
    const ReferenceImage truth = seen_through_lens({frame, before}, before.at("color"));
    const ReferenceImage gathered = seen(frame, before);
    for (std::size_t i = 0; i < truth.texels.size(); ++i) {
        const double wanted = before.at("color").texels[i].x;
        EXPECT_NEAR(truth.texels[i].x, wanted, 1e-12) << i;
        EXPECT_NEAR(gathered.texels[i].x, wanted, 1e-12) << i;
    }
}

/// A bar through the plane in focus whose pixels move apart by up to .6 pixels each. A ray to its middle meets it within 8
/// pixels.
TEST(DepthOfField, ASlantedBarHasNoCracks) {
    const Frame frame = focused(2, .8);
    const double pixels = std::abs(double(frame.view.projection[1][1])) * size / 2;
    ImageSet before = halves({30, 30}, {.1, .1});
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 16; x < 33; ++x) {
            const double blur = .6 * (double(x) - 24);
            before["color"].at(x, y) = glm::dvec4(40, 40, 40, 1);
            before["depth_layers"].at(x, y).x = near_plane * (.5 - blur / (.4 * pixels));
        }
    const ReferenceImage truth = seen_through_lens({frame, before}, before.at("color"));
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 22; x < 27; ++x) EXPECT_NEAR(truth.at(x, y).x, 40, 1e-9) << x << ' ' << y;
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
        const ReferenceImage truth = seen_through_lens({focused(2, .3), before}, before.at("color"));
        for (std::size_t i = 0; i < result.texels.size(); ++i) {
            EXPECT_TRUE(std::isfinite(result.texels[i].x)) << i;
            EXPECT_TRUE(std::isfinite(truth.texels[i].x)) << i;
        }
    }
}

TEST(DepthOfField, AFocusBeforeTheNearPlaneIsTheNearPlane) { EXPECT_NEAR(blur_radius(focused(0, .1), near_plane), 0, 1e-6); }

}  // namespace
}  // namespace strata::lens
