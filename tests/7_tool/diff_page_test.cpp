// strata diff -o page.html: what the file holds, and what it does in a browser.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/images/image_io.h"
#include "tests/7_tool/browser.h"
#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(DiffPage, HoldsWhatDiffersFirstAndItsPictures) {
    ASSERT_EQ(strata("record three_panes -o a.strata --size 64x36").code, 0);
    EXPECT_EQ(strata("diff a.strata --use transparency/weighted -o page.html").code, 1);
    const std::string text = file_text(page());
    EXPECT_THAT(text, Not(HasSubstr("{{")));
    EXPECT_FALSE(asks_a_network(text));
    EXPECT_THAT(text, HasSubstr("<h1>Over tolerance: transparency: color differs first</h1>"));
    EXPECT_THAT(text, HasSubstr("<h2>2 images differ</h2>"));
    EXPECT_THAT(text, HasSubstr("<dt>B</dt><dd>a.strata, transparency/weighted, capture "));
    EXPECT_EQ(count(text, "<article data-name="), 2u);
    EXPECT_EQ(count(text, "data-key=\"flip\""), 2u);
    EXPECT_LT(text.find("data-name=\"transparency: color\""), text.find("data-name=\"combine at film: display\""));
    EXPECT_FALSE(std::filesystem::exists(folder() / "page.html/")) << "a file, not a folder of pictures";
    if (!Browser::is_there()) return;
    EXPECT_THAT(Browser(page()).complaints(), testing::IsEmpty());
}

TEST(DiffPage, OfTheSameSaysSo) {
    ASSERT_EQ(strata("record three_panes -o a.strata --size 16x9").code, 0);
    EXPECT_EQ(strata("diff a.strata a.strata -o page.html").code, 0);
    EXPECT_THAT(file_text(page()), AllOf(HasSubstr("<h1>The same, bit for bit</h1>"), HasSubstr("<h2>Nothing differs</h2>"),
                                         Not(HasSubstr("<article"))));
}

/// Texels of a picture that is larger than the page's are averaged, but no single one that differs is lost.
TEST(DiffPage, ShowsTheOneTexelThatDiffersOfALargeImage) {
    HostImage a{.shape = {.extent = {1300, 20, 1}, .format = Format::rgba8_unorm},
                .texels = std::vector<std::byte>(std::size_t(4) * 1300 * 20, std::byte{255})};
    must(write_png(folder() / "a.png", a));
    a.texels[4 * (1300 * 7 + 1101)] = std::byte{0};
    must(write_png(folder() / "b.png", a));
    EXPECT_EQ(strata("diff a.png b.png --images display -o page.html").code, 1) << "the one image of a file is always compared";
    const std::string text = file_text(page());
    EXPECT_THAT(text, HasSubstr("<h1>Over tolerance: image differs first</h1>"));
    EXPECT_THAT(text, HasSubstr("1300 x 20, shown at 1/3"));
    EXPECT_THAT(text, HasSubstr("data-size=\"434 7\""));
    if (!Browser::is_there()) GTEST_SKIP() << "no chromium-headless-shell";
    Browser browser(page());
    const json lit = browser.value(R"((async () => {
        const image = document.querySelector('.whole [data-key=difference] img');
        await image.decode();
        const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight), context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        const data = context.getImageData(0, 0, canvas.width, canvas.height).data, lit = [];
        for (let i = 0; i < data.length; i += 4)
            if (data[i] + data[i + 1] + data[i + 2] > 0) lit.push([i / 4 % canvas.width, Math.floor(i / 4 / canvas.width)]);
        return lit;
    })())");
    EXPECT_EQ(lit, json::parse("[[367, 2]]"));
}

TEST(DiffPage, DoesInABrowserWhatItsControlsSay) {
    if (!Browser::is_there()) GTEST_SKIP() << "no chromium-headless-shell";
    ASSERT_EQ(strata("record three_panes -o a.strata --size 64x36").code, 0);
    EXPECT_EQ(strata("diff a.strata --use transparency/weighted -o page.html").code, 1);
    Browser browser(page());
    const auto text_of = [&](const std::string& which) {
        return browser.value("document.querySelector('" + which + "').textContent").get<std::string>();
    };
    const auto is = [&](const std::string& expression) { return browser.value(expression).get<bool>(); };
    const auto click = [&](const std::string& which) { browser.value("document.querySelector('" + which + "').click()"); };

    EXPECT_TRUE(is("viewer.hidden"));
    click(".whole [data-key=difference]");
    EXPECT_FALSE(is("viewer.hidden"));
    EXPECT_EQ(text_of("#name"), "transparency: color");
    EXPECT_THAT(text_of("#scale"), HasSubstr("0 is black, "));
    EXPECT_EQ(text_of("#modes [aria-pressed=true]"), "difference");
    EXPECT_TRUE(is("document.querySelector('#modes [data-mode=alpha]').hidden"));
    EXPECT_EQ(browser.value("picture.offsetWidth % 64"), 0) << "whole multiples of texels";
    browser.press('f');
    EXPECT_EQ(text_of("#modes [aria-pressed=true]"), "A");
    EXPECT_TRUE(is("document.querySelector('#picture img') === null")) << "A alone";
    browser.press('f');
    EXPECT_EQ(text_of("#modes [aria-pressed=true]"), "B");
    browser.press('j');
    EXPECT_EQ(text_of("#name"), "combine at film: display");
    browser.press('5');
    EXPECT_EQ(text_of("#modes [aria-pressed=true]"), "FLIP");
    EXPECT_TRUE(is("document.querySelector('#divider').hidden"));
    browser.press('1');
    EXPECT_EQ(text_of("#modes [aria-pressed=true]"), "divider");
    EXPECT_EQ(browser.value("document.querySelector('#picture img').style.clipPath"), "inset(0px 0px 0px 50%)");
    browser.value("divider.value = 20; divider.oninput()");
    EXPECT_EQ(browser.value("document.querySelector('#picture img').style.clipPath"), "inset(0px 0px 0px 20%)");
    browser.press('k');
    EXPECT_EQ(text_of("#name"), "transparency: color");
    click("#close");
    EXPECT_TRUE(is("viewer.hidden"));

    const std::string all = text_of("#count");
    click("#differing");
    EXPECT_THAT(text_of("#count"), testing::StartsWith("2 of "));
    click("#differing");
    EXPECT_EQ(text_of("#count"), all);
    browser.value("filter.value = 'gbuffer'; filter.oninput()");
    EXPECT_NE(text_of("#count"), all);
    const json before = browser.value("getComputedStyle(document.body).backgroundColor");
    click("#theme");
    EXPECT_NE(browser.value("getComputedStyle(document.body).backgroundColor"), before);
    click("#keys-button");
    EXPECT_TRUE(is("document.querySelector('#keys').open"));
    EXPECT_THAT(browser.complaints(), testing::IsEmpty());
}

TEST(DiffPage, LeavesOutPicturesThatWouldMakeItTooLarge) {
    HostImage noise{.shape = {.extent = {600, 600, 1}, .format = Format::rgba8_unorm},
                    .texels = std::vector<std::byte>(std::size_t(4) * 600 * 600, std::byte{255})};
    std::uint32_t state = 1;
    NamedImages a, b;
    for (const char* name : {"one", "three", "two"}) {
        for (std::byte& value : noise.texels) value = std::byte((state = state * 1664525 + 1013904223) >> 24);
        a[name] = noise;
        for (std::byte& value : noise.texels) value = std::byte((state = state * 1664525 + 1013904223) >> 24);
        b[name] = noise;
    }
    must(write_exr(folder() / "a.exr", a, {}));
    must(write_exr(folder() / "b.exr", b, {}));
    EXPECT_EQ(strata("diff a.exr b.exr -o page.html").code, 1);
    const std::string text = file_text(page());
    EXPECT_LT(text.size(), 5'000'000u);
    EXPECT_THAT(text, HasSubstr("no picture: the page would be too large; -o FOLDER writes them all"));
}

TEST(DiffLimits, OfARegionIgnoredPixelsAndImagesAreOptions) {
    ASSERT_EQ(strata("record three_panes -o a.strata --size 64x36").code, 0);
    const std::string verb = "-v diff a.strata --use transparency/weighted ";
    const Finished one = strata(verb + "--images display --json");
    EXPECT_THAT(one, Refuses(1, "diff.over_tolerance", "image=display"));
    const json frame = json::parse(one.out)["frames"][0];
    std::size_t images = 0;
    for (const json& pass : frame["passes"]) images += pass.contains("images") ? pass["images"].size() : 0;
    EXPECT_EQ(images, 1u);
    const json error = frame["passes"].back()["images"][0]["error"];
    EXPECT_GT(error["worst_region"]["density"], 0);
    EXPECT_LE(error["worst_region"]["x"].get<int>() + error["worst_region"]["width"].get<int>(), 64);
    EXPECT_EQ(strata(verb + "--images display --limit .001 --percent 90").code, 0);
    EXPECT_THAT(strata(verb + "--images display --limit .001 --percent 90 --region 20"), Refuses(1, "diff.over_tolerance"));
    EXPECT_EQ(strata(verb + "--region 20").code, 2) << "needs --limit";
    EXPECT_EQ(strata(verb + "--flip-limit .1 --percent 2").code, 2) << "FLIP alone decides";
    EXPECT_THAT(strata(verb + "--images display --ignore 64,0,9x9"), Refuses(2, "diff.ignores_nothing"));
    const std::string box =
        fmt::format("{},{},{}x{}", error["worst_region"]["x"].get<int>(), error["worst_region"]["y"].get<int>(),
                    error["worst_region"]["width"].get<int>(), error["worst_region"]["height"].get<int>());
    const json ignored = json::parse(strata(verb + "--images display --json --ignore " + box).out);
    const json less = ignored["frames"][0]["passes"].back()["images"][0]["error"];
    EXPECT_LT(less["pixels_over_limit"], error["pixels_over_limit"]);
    EXPECT_EQ(less["pixels_ignored"], error["worst_region"]["width"].get<int>() * error["worst_region"]["height"].get<int>());
    EXPECT_THAT(strata(verb + "--images display,missing"), Refuses(2, "diff.no_such_image", "image=missing"));
    for (const char* wrong : {"1,2,3", "1,2,3x", "1,2,0x4", "-1,2,3x4", "1,2,3x4,", "a"})
        EXPECT_THAT(strata(verb + "--ignore " + wrong), Refuses(2, "options.malformed")) << wrong;
    EXPECT_THAT(strata(verb + "--images display --ignore 0,0,64x36"), Refuses(2, "diff.all_ignored"));
    HostImage mask{.shape = {.extent = {64, 36, 1}, .format = Format::rgba8_unorm},
                   .texels = std::vector<std::byte>(std::size_t(4) * 64 * 36, std::byte{255})};
    std::fill_n(mask.texels.begin(), 4 * 3, std::byte{0});
    must(write_png(folder() / "mask.png", mask));
    const json masked = json::parse(strata(verb + "--images display --ignore mask.png --json").out);
    EXPECT_EQ(masked["frames"][0]["passes"].back()["images"][0]["error"]["pixels_ignored"], 64 * 36 - 3);
    EXPECT_EQ(masked["limits"]["ignored_by_mask"], 64 * 36 - 3);
    mask.shape.extent = {36, 64, 1};
    must(write_png(folder() / "turned.png", mask));
    EXPECT_THAT(strata(verb + "--images display --ignore turned.png"), Refuses(2, "diff.mask_size", "mask_width=36"));
    EXPECT_THAT(strata(verb + "--ignore mask.png --ignore turned.png"), Refuses(2, "diff.masks_differ", "file=turned.png"));
}

}  // namespace
}  // namespace strata
