// What is written about a comparison: JUnit's XML, JSON, and pictures.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/clean_text.h"
#include "replay/difference/comparison.h"
#include "replay/difference/picture.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// Why a text is no well-formed XML, or nothing. Knows what JUnit needs: declarations, elements, attributes, five entities.
std::string not_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    if (clean_text(xml) != xml) return "a control character or no UTF-8";
    for (std::size_t at = 0; at < xml.size(); ++at) {
        if (xml[at] == '&') {
            const std::string entity = xml.substr(at, xml.find(';', at) + 1 - at);
            if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;" && entity != "&#10;")
                return "bad entity " + entity;
        }
        if (xml[at] != '<') continue;
        const std::size_t end = xml.find('>', at);
        if (end == xml.npos) return "an open tag";
        const std::string tag = xml.substr(at + 1, end - at - 1);
        if (std::ranges::count(tag, '"') % 2 || tag.find('<') != tag.npos) return "a broken tag " + tag;
        const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag.starts_with('?')) continue;
        if (tag.starts_with('/')) {
            if (open.empty() || "/" + open.back() != tag) return tag + " closes nothing";
            open.pop_back();
        } else if (!tag.ends_with('/')) {
            open.push_back(name);
        }
    }
    return open.empty() ? "" : open.back() + " is not closed";
}

HostImage image(const std::vector<float>& rgba, std::uint32_t width) {
    HostImage made{{.extent = {width, static_cast<std::uint32_t>(rgba.size()) / 4 / width, 1}, .format = Format::rgba32f}, {}};
    const auto bytes = std::as_bytes(std::span(rgba));
    made.texels.assign(bytes.begin(), bytes.end());
    return made;
}

/// Two by two pixels, one of them NaN in B.
Comparison broken() {
    std::vector<float> values(16, .5f);
    const HostImage a = image(values, 2);
    values[4] = std::nanf("");
    ImageComparison made = *compare_images("color", a, image(values, 2), {});
    const FrameComparison frame{.frame = 3,
                                .passes = {{"combine <at> film", "x \"1\"", "y & z", {made}}},
                                .divergence = {"combine <at> film", "color", "step '1' \x01"},
                                .verdict = Verdict::over};
    return {.a = {.name = "a&b\xff\n.strata"}, .b = {.name = "b"}, .frames = {frame}, .rerun = "strata diff 'a&b.strata' <x>"};
}

TEST(Junit, IsWellFormedWhateverNamesHold) {
    EXPECT_EQ(not_well_formed("<a b=\"&amp;\"><c/></a>"), "");
    for (const char* bad : {"<a>", "<a></b>", "<a b=\"></a>", "<a>&nbsp;</a>", "<a>\x01</a>", "<a>\xff</a>"})
        EXPECT_NE(not_well_formed(bad), "") << bad;
    EXPECT_EQ(not_well_formed(as_junit(broken(), {{"f0003.combine_<at>_film.color", "out/<1>.png"}})), "");
}

TEST(Junit, HasACasePerPassAndImageWithItsFailureItsFilesAndTheCommand) {
    const std::string xml = as_junit(broken(), {{"f0003.combine_<at>_film.color", "out/1.png"}});
    EXPECT_THAT(xml, HasSubstr("tests=\"1\" failures=\"1\""));
    EXPECT_THAT(xml, HasSubstr("<testsuite name=\"a&amp;b\xef\xbf\xbd&#10;.strata frame 3\"")) << "a line's end stays one";
    EXPECT_THAT(xml, HasSubstr("<failure type=\"over tolerance\" message=\"percent of pixels over 0"));
    EXPECT_THAT(xml, HasSubstr("out/1.png"));
    EXPECT_THAT(xml, HasSubstr("strata diff 'a&amp;b.strata' &lt;x&gt;"));
}

TEST(ComparisonJson, SaysWhatJsonHasNoNumberFor) {
    const auto json = nlohmann::json::parse(as_json(broken()));
    const auto& image = json["frames"][0]["passes"][0]["images"][0];
    EXPECT_EQ(json["schema"], "strata.diff");
    EXPECT_EQ(image["error"]["worst_pixel"]["b"], "nan");
    EXPECT_EQ(image["error"]["worst_pixel"]["x"], 1);
    EXPECT_EQ(image["error"]["worst"], "inf");
    EXPECT_EQ(image["comparisons"][0]["threshold"], 0);
    EXPECT_TRUE(image["flip"].contains("mean"));
}

TEST(DifferencePicture, ShowsBothAndMarksWhatIsNoNumber) {
    std::vector<float> values(4 * 16 * 9, .25f);
    const HostImage a = image(values, 16);
    values[4 * (5 * 16 + 12)] = std::nanf("");
    const HostImage b = image(values, 16);
    const Canvas canvas = difference_picture(*compare_images("display", a, b, {}), a, b, {"title", "left", "right"});
    const auto count = [&](Rgb color) { return std::ranges::count(canvas.pixels(), color); };
    EXPECT_GE(canvas.width(), 2 * 480);             // two panels wide, enlarged to be seen
    EXPECT_GE(count({137, 137, 137}), 2 * 16 * 9);  // .25 in sRGB
    EXPECT_GE(count({255, 0, 255}), 2 * 30 * 30);   // in B and in the difference, 30 times enlarged
}

/// View depth is the alpha of `surface_normal`: a difference there is framed, and was black in every panel.
TEST(DifferencePicture, ShowsWhereAlphaDiffers) {
    std::vector<float> values(4 * 16 * 9, .25f);
    const HostImage a = image(values, 16);
    values[4 * (5 * 16 + 12) + 3] = .5f;
    const HostImage b = image(values, 16);
    const Canvas canvas = difference_picture(*compare_images("surface_normal", a, b, {}), a, b, {"title", "left", "right"});
    const Canvas same = difference_picture(*compare_images("surface_normal", a, a, {}), a, a, {"title", "left", "right"});
    EXPECT_GT(canvas.height(), same.height()) << "a panel more, below the others";
    EXPECT_GE(std::ranges::count(canvas.pixels(), Rgb(255, 89, 0)), 20 * 20) << "more in B, 30 times enlarged, less its frame";
}

HostImage even(std::uint32_t width, std::uint32_t height, float value) {
    return image(std::vector<float>(std::size_t{4} * width * height, value), width);
}

/// Left column and first row of the image that the picture shows, below a title of one line.
constexpr int image_left = 12, image_top = 2 * 12 + 2 * Canvas::line;

Rgb at(const Canvas& canvas, int x, int y) {
    return canvas.pixels()[static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width()) + static_cast<std::size_t>(x)];
}

/// One of 17 x 241 pixels was enlarged to a picture 7000 pixels high.
TEST(ImagePicture, OfANarrowImageIsNoTowerAndHasRoomForItsText) {
    const HostImage narrow = even(17, 241, .25f), flat = even(3000, 2, .25f);
    const Canvas high = image_picture("a:b", narrow, "title", {.low = 0}), wide = image_picture("a:b", flat, "title", {.low = 0});
    EXPECT_LT(high.height(), 1300);
    EXPECT_GT(high.height(), 241 * 4) << "enlarged nevertheless";
    EXPECT_GE(high.width(), 480);
    EXPECT_EQ(wide.width(), 3000 + 2 * image_left);
    const Canvas both = difference_picture(*compare_images("a", narrow, even(17, 241, .5f), {}), narrow, even(17, 241, .5f), {});
    EXPECT_LT(both.height(), 1400);
    EXPECT_GE(both.width(), 2 * 480);
}

/// Of the three numbers of one pixel the second was white.
TEST(ImagePicture, OfOnePixelIsNotClipped) {
    const Canvas canvas = image_picture("color", image({.25f, .1f, .05f, 1}, 1), "title", {});
    EXPECT_EQ(at(canvas, image_left + 9, image_top + 9), Rgb(255, 170, 124)) << "1, .4 and .2 in sRGB";
}

/// White was everything from the bar's end on, and the bar did not say so.
TEST(ImagePicture, SaysThatTheScaleEndsBelowTheLargestValue) {
    std::vector<float> values(4 * 40 * 30, .5f);
    const Canvas none = image_picture("color", image(values, 40), "title", {});
    std::fill_n(values.begin(), 4, 8.f);
    const Canvas one = image_picture("color", image(values, 40), "title", {});
    const int label = image_top + 30 * 12 + 6 + 12 + 4;
    const auto letters = [&](const Canvas& canvas) {
        long count = 0;
        for (int y = label; y < label + Canvas::line - 6; ++y)
            for (int x = canvas.width() / 2; x < canvas.width(); ++x) count += at(canvas, x, y) != at(canvas, 0, 0) ? 1 : 0;
        return count;
    };
    ASSERT_EQ(at(one, image_left + 100, image_top + 100), at(none, image_left + 100, image_top + 100)) << "one scale";
    EXPECT_GT(letters(none), 0);
    EXPECT_GT(letters(one), letters(none)) << ">= 0.5";
}

/// A factor: black where it is 1, which the bar marks.
TEST(ImagePicture, ShowsWhereAFactorIsOne) {
    std::vector<float> values(4 * 40 * 30, 1.f);
    std::fill_n(values.begin(), 4, 2.5f);
    std::fill_n(values.begin() + 4, 4, .5f);
    const Canvas canvas = image_picture("a:b", image(values, 40), "title", {.low = 0, .unit = "x", .middle = 1});
    EXPECT_EQ(at(canvas, image_left + 5, image_top + 5), Rgb(255, 89, 0));
    EXPECT_EQ(at(canvas, image_left + 17, image_top + 5), Rgb(0, 38, 85)) << "a third of the largest distance";
    EXPECT_EQ(at(canvas, image_left + 100, image_top + 5), Rgb(0, 0, 0));
    // The bar runs from 0, below which no factor is, to 2.5: 1 lies at .4 of it.
    const int bar = image_top + 30 * 12 + 6;
    EXPECT_EQ(at(canvas, image_left + 191, bar + 14), Rgb(235, 235, 235)) << "the tick";
    EXPECT_EQ(at(canvas, image_left + 185, bar + 14), at(canvas, 0, 0));
}

TEST(ImagePicture, SaysWhatMixedColorsAre) {
    const ImageLegend legend{.low = 0, .channels = {{{255, 0, 0}, "across x"}, {{0, 255, 0}, "across y"}}};
    const Canvas apart = image_picture("a:b", image({1, 0, 0, 1, 0, 1, 0, 1}, 2), "title", legend),
                 mixed = image_picture("a:b", image({1, 0, 0, 1, 1, 1, 0, 1}, 2), "title", legend);
    EXPECT_EQ(mixed.height(), apart.height() + Canvas::line);
}

/// Of red to 199 and green to 14 only red was to be seen.
TEST(ImagePicture, SaysWhatEachChannelLiesBetween) {
    const auto with = [](float green) {
        const ImageLegend legend{.low = 0, .channels = {{{0, 255, 0}, "culled"}}};
        return image_picture("a:b", image({199, 0, 0, 1, 0, green, 0, 1}, 2), "title", legend);
    };
    const Canvas few = with(14), one_more = with(15);
    // The line beside the swatch, below the scale and the line of values.
    const int top = 2 * 12 + 2 * Canvas::line + 240 + 12 + 10 + 2 * Canvas::line;
    bool differs = false;
    for (int y = top; y < few.height(); ++y)
        for (int x = 0; x < few.width(); ++x) differs |= at(few, x, y) != at(one_more, x, y);
    EXPECT_TRUE(differs);
}

/// One pixel of 1200 lies beyond the 99.5 % that the gain is made for.
TEST(DifferencePicture, SaysThatTheScaleEndsBelowTheLargestDifference) {
    const HostImage a = even(40, 30, .25f);
    std::vector<float> values(4 * 40 * 30, .5f);
    const auto picture_of_b = [&] {
        const HostImage b = image(values, 40);
        return difference_picture(*compare_images("color", a, b, {}), a, b, {"title", "left", "right"});
    };
    const Canvas none = picture_of_b();
    std::fill_n(values.begin(), 3, 8.f);
    const Canvas one = picture_of_b();
    const auto faint = [](const Canvas& canvas) { return std::ranges::count(canvas.pixels(), Rgb(150, 150, 155)); };
    EXPECT_GT(faint(one), faint(none)) << ">= 0.25";
}

TEST(DifferencePicture, WritesLetters) {
    Canvas canvas(200, 40, {0, 0, 0});
    const int width = canvas.text("FLIP 0.25", {4, 4, 190, 0}, {255, 255, 255});
    EXPECT_GT(std::ranges::count(canvas.pixels(), Rgb(255, 255, 255)), 100);
    EXPECT_LE(canvas.text("FLIP 0.25", {4, 4, width / 2, 0}, {255, 255, 255}), width / 2);  // cut off, not drawn over
}

}  // namespace
}  // namespace strata
