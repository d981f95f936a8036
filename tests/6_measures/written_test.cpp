// What is written about a comparison: JUnit's XML, JSON, and pictures.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/difference/comparison.h"
#include "replay/difference/picture.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// Why a text is no well-formed XML, or nothing. Knows what JUnit needs: declarations, elements, attributes, five entities.
std::string not_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (std::size_t at = 0; at < xml.size(); ++at) {
        if (xml[at] == '&') {
            const std::string entity = xml.substr(at, xml.find(';', at) + 1 - at);
            if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;") return "bad entity " + entity;
        }
        if (static_cast<unsigned char>(xml[at]) < 0x20 && xml[at] != '\n' && xml[at] != '\t') return "a control character";
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
                                .acts = {{"combine <at> film", "x \"1\"", "y & z", {made}}},
                                .divergence = {"combine <at> film", "color", "step '1' \x01"},
                                .verdict = Verdict::over};
    return {.a = {.name = "a&b.strata"}, .b = {.name = "b"}, .frames = {frame}, .rerun = "strata diff 'a&b.strata' <x>"};
}

TEST(Junit, IsWellFormedWhateverNamesHold) {
    EXPECT_EQ(not_well_formed("<a b=\"&amp;\"><c/></a>"), "");
    for (const char* bad : {"<a>", "<a></b>", "<a b=\"></a>", "<a>&nbsp;</a>", "<a>\x01</a>"})
        EXPECT_NE(not_well_formed(bad), "") << bad;
    EXPECT_EQ(not_well_formed(as_junit(broken(), {{"f0003.combine_<at>_film.color", "out/<1>.png"}})), "");
}

TEST(Junit, HasACasePerActAndImageWithItsFailureItsFilesAndTheCommand) {
    const std::string xml = as_junit(broken(), {{"f0003.combine_<at>_film.color", "out/1.png"}});
    EXPECT_THAT(xml, HasSubstr("tests=\"1\" failures=\"1\""));
    EXPECT_THAT(xml, HasSubstr("<failure type=\"over tolerance\" message=\"percent of pixels over 0"));
    EXPECT_THAT(xml, HasSubstr("out/1.png"));
    EXPECT_THAT(xml, HasSubstr("strata diff 'a&amp;b.strata' &lt;x&gt;"));
}

TEST(ComparisonJson, SaysWhatJsonHasNoNumberFor) {
    const auto json = nlohmann::json::parse(as_json(broken()));
    const auto& image = json["frames"][0]["acts"][0]["images"][0];
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

TEST(DifferencePicture, WritesLetters) {
    Canvas canvas(200, 40, {0, 0, 0});
    const int width = canvas.text("FLIP 0.25", {4, 4, 190, 0}, {255, 255, 255});
    EXPECT_GT(std::ranges::count(canvas.pixels(), Rgb(255, 255, 255)), 100);
    EXPECT_LE(canvas.text("FLIP 0.25", {4, 4, width / 2, 0}, {255, 255, 255}), width / 2);  // cut off, not drawn over
}

}  // namespace
}  // namespace strata
