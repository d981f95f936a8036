// An image against another in numbers that can be checked by hand.
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/reference/difference.h"
#include "replay/difference/compare_images.h"
#include "replay/expectations/expectation_check.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// A row of texels.
template <typename T>
HostImage image(Format format, const std::vector<T>& channels) {
    const auto width = static_cast<std::uint32_t>(channels.size() * sizeof(T) / row(format).bytes);
    HostImage made{{.extent = {width, 1, 1}, .format = format}, {}};
    const auto bytes = std::as_bytes(std::span(channels));
    made.texels.assign(bytes.begin(), bytes.end());
    return made;
}

HostImage reals(const std::vector<float>& values) { return image(Format::r32f, values); }

ImageComparison compared(const HostImage& a, const HostImage& b, const ErrorLimits& limits = {}, std::string name = "x") {
    const auto made = compare_images(std::move(name), a, b, limits);
    EXPECT_TRUE(made);
    return *made;
}

TEST(ImageError, IsRmseAndRelativeToTheFirst) {
    const ImageError error = image_error(reals({3, 4, 0, 0}), reals({3, 4, 0, 2}), {});
    EXPECT_DOUBLE_EQ(error.rmse, 1);                // sqrt(4 / 4)
    EXPECT_DOUBLE_EQ(error.relative_rmse, 2. / 5);  // sqrt(4 / 25)
    EXPECT_FALSE(error.identical);
}

/// Alpha is 1 in every picture of a frame: averaging it in would make the error smaller by sqrt(3/4).
TEST(ImageError, OfLightIsThatOfAReportAndOfAnExpectation) {
    const HostImage wanted = image<float>(Format::rgba32f, {.5f, .25f, 2, 1, 0, 1, 3, 1}),
                    got = image<float>(Format::rgba32f, {.5f, .5f, 1, 1, .125f, 1, 3.5f, 1});
    const Difference reported = difference(in_double(got), in_double(wanted));
    EXPECT_DOUBLE_EQ(reported.rmse, std::sqrt((.0625 + 1 + .015625 + .25) / 6));
    EXPECT_DOUBLE_EQ(reported.relative, std::sqrt((.0625 + 1 + .015625 + .25) / (.25 + .0625 + 4 + 1 + 9)));
    for (const char* name : {"color", "display", "a file's own name"}) {
        const ImageError error = image_error(wanted, got, {}, name);
        EXPECT_EQ(error.rmse, reported.rmse) << name;
        EXPECT_EQ(error.relative_rmse, reported.relative) << name;
        EXPECT_EQ(deviation_of(name, got, wanted).rmse, reported.relative) << name;
    }
}

TEST(ImageError, JudgesAlphaWhereItIsCoverageOrANumber) {
    const HostImage a = image<float>(Format::rgba32f, {1, 1, 1, 1}), b = image<float>(Format::rgba32f, {1, 1, 1, .5f});
    for (const char* name : {"emission", "surface_color", "a file's own name"})
        EXPECT_EQ(image_error(a, b, {}, name).rmse, .25) << name;  // sqrt(.25 / 4)
    const ImageError of_light = image_error(a, b, {}, "color");
    EXPECT_EQ(of_light.rmse, 0);
    EXPECT_EQ(of_light.over_limit, 1u) << "no difference passes a limit unseen";
    EXPECT_EQ(of_light.worst, .5);
}

TEST(ImageError, NamesTheWorstPixelItsChannelAndBothValues) {
    const std::vector<float> a{0, 0, 0, 0, 1, 2, 3, 4}, b{0, .1f, 0, 0, 1, 2, 8, 4};
    const ImageError error = image_error(image(Format::rgba32f, a), image(Format::rgba32f, b), {});
    EXPECT_EQ(error.worst, 5);
    EXPECT_EQ(error.worst_pixel.x, 1u);
    EXPECT_EQ(error.worst_pixel.channel, 2u);
    EXPECT_EQ(error.worst_pixel.a, 3);
    EXPECT_EQ(error.worst_pixel.b, 8);
}

TEST(ImageError, CountsNanAndInfAndForgivesThemWhereBothAgree) {
    const float nan = std::nanf(""), inf = HUGE_VALF;
    const ImageError agreeing = image_error(reals({nan, inf, 1}), reals({nan, inf, 2}), {});
    EXPECT_EQ(agreeing.in_a.nan, 1u);
    EXPECT_EQ(agreeing.in_b.inf, 1u);
    EXPECT_EQ(agreeing.disagreeing, 0u);
    EXPECT_EQ(agreeing.worst, 1);
    const ImageError apart = image_error(reals({nan, inf, 1}), reals({1, -inf, 1}), {});
    EXPECT_EQ(apart.disagreeing, 2u);
}

TEST(ImageError, DepthDiffersByTheFloatsBetween) {
    const float a = .3f, b = std::nextafter(std::nextafter(a, 1.f), 1.f);
    EXPECT_EQ(image_error(image<float>(Format::d32f, {a}), image<float>(Format::d32f, {b}), {}).worst, 2);
    EXPECT_EQ(image_error(image<float>(Format::d32f, {0.f}), image<float>(Format::d32f, {-0.f}), {}).worst, 0);
    const float least = std::nextafter(0.f, 1.f);
    EXPECT_EQ(image_error(image<float>(Format::d32f, {least}), image<float>(Format::d32f, {-least}), {}).worst, 2);
}

TEST(ImageError, ShapesAreComparedFirstAndBothAreNamed) {
    const auto refused = compare_images("color", reals({1, 2}), reals({1, 2, 3}), {});
    ASSERT_THAT(refused, FailsWith("image.shapes_differ", Field("image", "color"), Field("a", HasSubstr("2 x 1")),
                                   Field("b", HasSubstr("3 x 1"))));
    EXPECT_EQ(refused.error().fault, Fault::usage);
    EXPECT_FALSE(compare_images("x", image<float>(Format::rg32f, {1, 2}), reals({1}), {}));
    EXPECT_FALSE(compare_images("x", image<std::uint32_t>(Format::r32ui, {1}), reals({1}), {}));
}

TEST(Verdict, OfEqualBitsIsSameAndOfAnythingElseOverUnlessAllowed) {
    EXPECT_EQ(compared(reals({1}), reals({1})).verdict, Verdict::same);
    EXPECT_EQ(compared(reals({1}), reals({1.0000001f})).verdict, Verdict::over);
    EXPECT_EQ(compared(reals({1}), reals({1.0000001f}), {.limit = 1e-6}).verdict, Verdict::within);
}

TEST(Verdict, FollowsTheThreeThresholdsOfIdiff) {
    const HostImage a = reals({0, 0, 0, 0}), b = reals({0, 0, 0, .5f});
    EXPECT_EQ(compared(a, b, {.limit = .1, .percent = 24}).verdict, Verdict::over);
    EXPECT_EQ(compared(a, b, {.limit = .1, .percent = 25}).verdict, Verdict::within);
    EXPECT_EQ(compared(a, b, {.limit = .1, .percent = 25, .hard_limit = .4}).verdict, Verdict::over);
    EXPECT_EQ(compared(a, b, {.limit = .1, .percent = 25, .hard_limit = .4}).judged.front().metric, "worst");
    EXPECT_EQ(compared(a, b, {.limit = 1, .warn_limit = .1}).verdict, Verdict::warning);
    EXPECT_EQ(compared(a, b, {.limit = 1, .warn_limit = .1, .warn_percent = 30}).verdict, Verdict::within);
}

TEST(Verdict, ANumberThatOnlyOneSideHasIsNeverAllowed) {
    const ErrorLimits generous{.limit = 1e9, .percent = 100};
    EXPECT_EQ(compared(reals({1}), reals({std::nanf("")}), generous).verdict, Verdict::over);
    EXPECT_EQ(compared(reals({HUGE_VALF}), reals({1}), generous).verdict, Verdict::over);
}

TEST(Verdict, DepthIsAllowedUlpsAndIdsNothing) {
    const float a = .3f, b = std::nextafter(a, 1.f);
    const HostImage near = image<float>(Format::r32f, {a}), far = image<float>(Format::r32f, {b});
    EXPECT_EQ(compared(near, far, {.limit = 1}, "depth_layers").verdict, Verdict::over);
    EXPECT_EQ(compared(near, far, {.ulps = 1}, "depth_layers").verdict, Verdict::within);
    EXPECT_FALSE(compared(near, far, {}, "depth_layers").flip);
    const auto id = [](std::uint32_t value) { return image<std::uint32_t>(Format::r32ui, {value}); };
    EXPECT_EQ(compared(id(7), id(8), {.limit = 9, .ulps = 9}).verdict, Verdict::over);
}

TEST(Verdict, FlipDecidesAloneWhereItHasALimitAndValuesHaveNone) {
    const HostImage a = image<float>(Format::rgba32f, {.5f, .5f, .5f, 1}),
                    b = image<float>(Format::rgba32f, {.5f, .5f, .501f, 1});
    EXPECT_EQ(compared(a, b, {.flip_mean = .1}, "color").verdict, Verdict::within);
    EXPECT_EQ(compared(a, b, {.flip_mean = 1e-6}, "color").verdict, Verdict::over);
    EXPECT_EQ(compared(a, b, {.limit = 0, .flip_mean = .1}, "color").verdict, Verdict::over);
}

TEST(Verdict, OfFlipAloneSeesAlphaWhereItIsCoverage) {
    const auto half = [](float alpha) { return image<float>(Format::rgba32f, {.5f, .5f, .5f, alpha}); };
    const ImageComparison apart = compared(half(.2f), half(.95f), {.flip_mean = .1}, "glass.exr");
    EXPECT_EQ(apart.verdict, Verdict::over);
    EXPECT_EQ(apart.judged.front().metric, "alpha mean");
    EXPECT_NEAR(apart.judged.front().value, .75, 1e-6);
    EXPECT_EQ(compared(half(.2f), half(.25f), {.flip_mean = .1}, "glass.exr").verdict, Verdict::within);
    EXPECT_EQ(compared(half(.2f), half(.95f), {.flip_mean = .1}, "color").verdict, Verdict::within) << "it covers nothing";
}

TEST(ImageError, OfNothingButNanIsNoNumber) {
    const float nan = std::nanf("");
    const HostImage broken = image<float>(Format::rgba32f, {nan, nan, nan, nan});
    const HostImage sound = image<float>(Format::rgba32f, {1, 1, 1, 1});
    for (const HostImage& other : {broken, sound}) {
        EXPECT_TRUE(std::isnan(image_error(broken, other, {}, "color").rmse));
        EXPECT_TRUE(std::isnan(image_error(broken, other, {}, "color").relative_rmse));
    }
    EXPECT_EQ(image_error(reals({nan, 3}), reals({nan, 1}), {}).rmse, 2) << "of the values that are numbers";
}

}  // namespace
}  // namespace strata
