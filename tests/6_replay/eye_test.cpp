// The eye goes anywhere, and everything of the frame is as if it had been recorded from there.
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"
#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

View random_view(std::mt19937& random) {
    std::uniform_real_distribution<> number(-1, 1);
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    const glm::dvec3 ahead = glm::normalize(vector()), right = glm::normalize(glm::cross(vector(), ahead));
    View view;
    view.origin = 100.0 * vector();
    // The view's axes are left-handed, the world's right-handed.
    view.to_view = glm::transpose(glm::dmat3(right, glm::cross(right, ahead), ahead));
    return view;
}

void expect_same(const View& a, const View& b) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(a.origin[i], b.origin[i], 1e-12 * 100);
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(a.to_view[i][j], b.to_view[i][j], 1e-7);
    }
}

TEST(EyeMove, LeadsFromAnyViewToAnyOther) {
    std::mt19937 random(7);
    for (int i = 0; i < 200; ++i) {
        const View from = random_view(random), to = random_view(random);
        expect_same(moved(from, move_between(from, to)), to);
    }
}

TEST(EyeMove, LeadsStraightUpAndDownToo) {
    std::mt19937 random(8);
    const View from = random_view(random);
    for (const double tilt : {pi / 2, -pi / 2})
        for (const double pan : {0.0, 1.0, -3.0}) {
            const View to = moved(from, {.truck = 2, .pan = pan, .tilt = tilt, .roll = .5});
            expect_same(moved(from, move_between(from, to)), to);
        }
}

TEST(EyeMove, IsWrittenAsTextAndReadBackExactly) {
    const EyeMove move{.dolly = .1, .pedestal = -3e-17, .pan = 1 / 3.0, .roll = 1e9};
    EXPECT_EQ(must(eye_move_of(text(move))), move);
    EXPECT_EQ(text(EyeMove{}), "");
    EXPECT_EQ(must(eye_move_of("")), EyeMove{});
    EXPECT_EQ(text({.dolly = 1, .pan = -.5}), "dolly=1,pan=-0.5");
    EXPECT_THAT(eye_move_of("pam=1"), FailsWith("eye.unknown_axis", Field("axis", "pam"), Field("suggestion", HasSubstr("pan"))));
    for (const char* wrong : {"pan", "pan=", "pan=1x", "pan=nan", "pan=inf", "pan=1,,", "=1"})
        EXPECT_FALSE(eye_move_of(wrong)) << wrong;
}

/// Unlit cards two meters from the eye, which looks along -z: red ahead, green to the right, blue above, white behind.
Frame cards_around() {
    scenario::FrameBuilder builder(0, {.width = 64, .height = 36, .samples = 1, .frames = 1});
    builder.look({.eye = {0, 0, 0}, .target = {0, 0, -1}, .swing = 0});
    const std::uint32_t ball = builder.add(scenario::sphere(.5f, 16));
    const auto put = [&](glm::vec3 color, glm::dvec3 position) {
        builder.draw(ball, builder.add(scenario::unlit("card", glm::vec4(color, 1))), {.position = position});
    };
    put({1, 0, 0}, {0, 0, -2});
    put({0, 1, 0}, {2, 0, 0});
    put({0, 0, 1}, {0, 2, 0});
    put({1, 1, 1}, {0, 0, 2});
    return std::move(builder.frame);
}

glm::dvec4 middle_texel(Session& session, const EyeMove& eye) {
    const auto run = must(session.run({.variant = {.eye = eye}, .outputs = {"color"}}));
    return glm::round(1e3 * texel(run.images.at("color"), 32, 18)) / 1e3;  // half floats may round towards 0
}

TEST(Eye, SeesWhatIsWhereItLooks) {
    const auto session = must(Session::open({cards_around()}, {.validation = true}));
    const glm::dvec4 red(1, 0, 0, 1), green(0, 1, 0, 1), blue(0, 0, 1, 1), white(1);
    EXPECT_EQ(middle_texel(*session, {}), red);
    EXPECT_EQ(middle_texel(*session, {.pan = pi / 2}), green);
    EXPECT_EQ(middle_texel(*session, {.tilt = pi / 2}), blue);
    EXPECT_EQ(middle_texel(*session, {.pan = pi}), white);
    EXPECT_EQ(middle_texel(*session, {.pan = -pi / 2, .tilt = pi / 2, .roll = .3}), blue);
    EXPECT_EQ(middle_texel(*session, {.dolly = -2, .truck = 2}), green);              // back and to the right
    EXPECT_EQ(middle_texel(*session, {.dolly = 4, .pedestal = .1, .pan = pi}), red);  // from behind
}

TEST(Eye, LeftWhereItWasKeepsEverythingThatIsKnown) {
    const auto session = scenario_session("glass_and_smoke");
    const auto first = must(session->run({}));
    const auto second = must(session->run({.variant = {.eye = {.dolly = 0, .roll = 0}}}));
    EXPECT_GT(second.passes_from_memo, 0u);
    EXPECT_EQ(hash_of(first.images.at("display")), hash_of(second.images.at("display")));
    // Away and back, which is another frame in between.
    must(session->run({.variant = {.eye = {.roll = .2}}}));
    EXPECT_GT(must(session->run({})).passes_from_memo, 0u);
}

TEST(Eye, SeesWhatAFrameRecordedFromThereShows) {
    const EyeMove eye{.dolly = .4, .truck = -.7, .pedestal = .3, .pan = .25, .tilt = -.1, .roll = .05};
    for (const char* scenario : {"sun_and_boxes", "glass_and_smoke"}) {  // shadows and culling; every kind of light and layer
        Frame frame = scenario_frames(scenario).front();
        const auto session = must(Session::open({frame}, {.validation = true}));
        const auto recorded = must(session->run({}));  // so that the memo holds what must not be used
        const auto from_there = must(session->run({.variant = {.eye = eye}}));
        frame.view = moved(frame.view, eye);
        const Request plain;
        const auto made = must(session->run(frame, std::span(&plain, 1))).front();
        EXPECT_EQ(hash_of(from_there.images.at("display")), hash_of(made.images.at("display"))) << scenario;
        EXPECT_NE(hash_of(from_there.images.at("display")), hash_of(recorded.images.at("display"))) << scenario;
    }
}

TEST(Eye, OrbitsAroundAPointThatStaysInTheMiddleAndComesBack) {
    const Frame frame = cards_around();
    const auto session = must(Session::open({frame}, {.validation = true}));
    const auto start = must(session->run({})).images.at("display");
    View view = frame.view;
    for (int i = 0; i < 8; ++i) {
        view = orbited(view, {.distance = 2, .right = pi / 4});
        const glm::dvec3 target = view.to_view * (glm::dvec3(0, 0, -2) - view.origin);
        EXPECT_NEAR(glm::distance(target, glm::dvec3(0, 0, 2)), 0, 1e-12);
        EXPECT_EQ(middle_texel(*session, move_between(frame.view, view)), glm::dvec4(1, 0, 0, 1)) << i;
        if (i != 1) continue;
        EXPECT_NEAR(glm::distance(view.origin, glm::dvec3(2, 0, -2)), 0, 1e-12) << "to the right";
    }
    const auto back = must(session->run({.variant = {.eye = move_between(frame.view, view)}})).images.at("display");
    EXPECT_EQ(hash_of(back), hash_of(start));
    const View over = orbited(frame.view, {.distance = 2, .over = pi / 4});
    EXPECT_NEAR(glm::distance(over.origin, glm::dvec3(0, std::sqrt(2.0), std::sqrt(2.0) - 2)), 0, 1e-12);
}

TEST(Eye, ThatIsNowhereIsASentence) {
    const auto session = scenario_session("three_panes");
    EXPECT_THAT(session->run({.variant = {.eye = {.tilt = std::nan("")}}}), FailsWith("eye.not_a_number", Field("axis", "tilt")));
}

}  // namespace
}  // namespace strata
