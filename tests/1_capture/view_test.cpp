// What look_at() promises: where points of the world lie in the image, in worlds of either hand.
#include <cmath>

#include <gmock/gmock.h>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "capture_format/view.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

/// Normalized device coordinates: x to the right, y downwards, z is the reversed depth.
glm::dvec3 seen(const View& view, const glm::dvec3& world) {
    const glm::dvec4 clip = glm::dmat4(view.projection) * glm::dvec4(view.to_view * (world - view.origin), 1);
    return glm::dvec3(clip) / clip.w;
}

void expect_near(const glm::dvec3& got, const glm::dvec3& wanted) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-6) << "coordinate " << i;
}

/// 90 degrees high, twice as wide: 2 m away the image is 4 m high and 8 m wide.
constexpr double right_angle = 1.5707963267948966;
View straight(Handedness handedness, double z) {
    return look_at({.eye = {0, 0, z},
                    .target = {0, 0, 0},
                    .vertical_fov = right_angle,
                    .near = .5,
                    .width = 200,
                    .height = 100,
                    .handedness = handedness});
}

TEST(LookAt, InARightHandedWorldPlusXIsRightOfAnEyeThatLooksAlongMinusZ) {
    const View view = straight(Handedness::right, 2);
    expect_near(seen(view, {0, 0, 0}), {0, 0, .25});
    expect_near(seen(view, {4, 0, 0}), {1, 0, .25});
    expect_near(seen(view, {0, 2, 0}), {0, -1, .25});
    EXPECT_NEAR(glm::determinant(view.to_view), -1, 1e-12);
}

TEST(LookAt, InALeftHandedWorldPlusXIsRightOfAnEyeThatLooksAlongPlusZ) {
    const View view = straight(Handedness::left, -2);
    expect_near(seen(view, {0, 0, 0}), {0, 0, .25});
    expect_near(seen(view, {4, 0, 0}), {1, 0, .25});
    expect_near(seen(view, {0, 2, 0}), {0, -1, .25});
    EXPECT_NEAR(glm::determinant(view.to_view), 1, 1e-12);
}

TEST(LookAt, DepthIsReversedAndEndsNowhere) {
    const View view = straight(Handedness::right, 2);
    EXPECT_NEAR(seen(view, {0, 0, 1.5}).z, 1, 1e-6) << "at the near plane";
    EXPECT_NEAR(seen(view, {0, 0, -1e9}).z, 0, 1e-8) << "far away";
    EXPECT_EQ((view.to_view * (glm::dvec3(0, 0, -5) - view.origin)).z, 7) << "view depth in meters";
}

TEST(LookAt, UpDecidesWhatIsAbove) {
    const View rolled = look_at({.eye = {0, 0, 2}, .target = {0, 0, 0}, .up = {-3, 0, 0}, .vertical_fov = right_angle});
    EXPECT_NEAR(seen(rolled, {-2, 0, 0}).y, -1, 1e-6);
    EXPECT_GT(seen(rolled, {0, 1, 0}).x, 0);
}

TEST(LookAt, AnEyeMayLookAlongUp) {
    const View down = look_at({.eye = {0, 5, 0}, .target = {0, 0, 0}});
    EXPECT_LT(seen(down, {0, 0, -1}).y, 0) << "-z is above";
    EXPECT_GT(seen(down, {1, 0, 0}).x, 0);
    const View level = look_at({.eye = {0, 0, 5}, .target = {0, 0, 0}, .up = {0, 0, 1}});
    EXPECT_LT(seen(level, {0, 1, 0}).y, 0) << "+y is above";
}

TEST(LookAt, MakesViewsThatTheRecorderTakesUnlessTheEyeIsTheTarget) {
    Frame frame = triangle_frame();
    for (const Handedness handedness : {Handedness::right, Handedness::left}) {
        frame.view = look_at({.eye = {1e6, 2, -3}, .target = {1e6 + 1, 7, 4}, .handedness = handedness});
        EXPECT_TRUE(check_frame(frame));
    }
    frame.view = look_at({.eye = {1, 2, 3}, .target = {1, 2, 3}});
    const auto refused = check_frame(frame);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused, FailsWith("frame.not_rotation"));
}

}  // namespace
}  // namespace strata
