// What the image view shows: the very bytes of a headless replay, the values under the mouse, and what is no number.
#include <bit>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/picture/picture_view.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;

/// An image of floats, channel by channel.
HostImage image_of(std::uint32_t width, std::uint32_t height, Format format, const std::vector<float>& values) {
    HostImage image{{.extent = {width, height, 1}, .format = format}, {}};
    const auto bytes = std::as_bytes(std::span(values));
    image.texels.assign(bytes.begin(), bytes.end());
    return image;
}

/// The pixel of the window as three bytes.
std::array<int, 3> pixel(const Picture& picture, int x, int y) {
    const std::size_t at = 3 * (static_cast<std::size_t>(y) * picture.width + static_cast<std::size_t>(x));
    return {int(picture.rgb[at]), int(picture.rgb[at + 1]), int(picture.rgb[at + 2])};
}

/// Where the first texel of the picture lies on the screen at a pixel per texel.
glm::ivec2 corner_of(const WidgetRecord& canvas, std::uint32_t width, std::uint32_t height) {
    const Texels texels{width, height, {}};
    const ImVec2 size(canvas.to.x - canvas.from.x, canvas.to.y - canvas.from.y);
    const Placement placement = place({1, width / 2.0, height / 2.0}, canvas.from, size, texels);
    return {static_cast<int>(placement.corner.x), static_cast<int>(placement.corner.y)};
}

/// An image of ones (nothing is occluded) was black.
TEST(DefaultLook, OfOneValueEverywhereIsWhiteAboveZeroAndBlackAtIt) {
    const auto look = [](float value) {
        const auto image = std::make_shared<HostImage>(image_of(2, 1, Format::r32f, {value, value}));
        return default_look("occlusion", look_at(image, 0));
    };
    EXPECT_EQ(look(1).black, 0);
    EXPECT_EQ(look(1).white, 1);
    EXPECT_EQ(look(.25f).white, .25f);
    EXPECT_EQ(look(0).black, 0);
    EXPECT_EQ(look(0).white, 1);
    EXPECT_EQ(look(-2).black, -2);
    EXPECT_GT(look(-2).white, -2);
}

TEST(ImageView, ShowsTheBytesThatAHeadlessReplayOfTheCommandWrites) {
    Desk& desk = Desk::clean();
    auto session = must(Session::open(small_scenarios(), {.validation = true}));
    for (const std::string_view scenario : {"three_panes", "explosion", "agents_hq"}) {
        SCOPED_TRACE(scenario);
        desk.model().select_frame(frame_of(scenario));
        must(desk.player->wait());
        must(desk.player->click("Image/100 %"));
        must(desk.player->wait());
        const HostImage display = must(session->run(desk.model().request())).images.at("display");
        const Extent extent = display.shape.extent;
        const glm::ivec2 corner = corner_of(desk.widget("Image/picture"), extent.width, extent.height);
        const Picture shown = must(desk.player->picture());
        std::size_t lit = 0;
        for (std::uint32_t y = 0; y < extent.height; ++y)
            for (std::uint32_t x = 0; x < extent.width; ++x) {
                const glm::dvec4 light = texel(display, x, y);
                const std::array<int, 3> wanted = {int(display_byte(light.x)), int(display_byte(light.y)),
                                                   int(display_byte(light.z))};
                lit += wanted[0] + wanted[1] + wanted[2] > 0;
                ASSERT_EQ(pixel(shown, corner.x + static_cast<int>(x), corner.y + static_cast<int>(y)), wanted) << x << " " << y;
            }
        EXPECT_GT(lit, 500u) << "the picture is black: nothing was compared";
    }
}

/// One row of texels, drawn by itself.
Picture drawn(ImguiLayer& layer, const Texels& texels, const Look& look) {
    ImGuiIO& io = ImGui::GetIO();
    const ImVec2 size =
        std::exchange(io.DisplaySize, ImVec2(static_cast<float>(texels.width), static_cast<float>(texels.height)));
    const TextureId texture = layer.upload(0, texels);
    ImGui::NewFrame();
    ImGui::GetBackgroundDrawList()->AddImage(layer.shown(texture, look), {0, 0}, io.DisplaySize);
    ImGui::Render();
    must(layer.draw(*ImGui::GetDrawData()));
    io.DisplaySize = size;
    layer.release(texture);
    return layer.read_back();
}

Texels row_of(const std::vector<float>& values) {
    Texels texels{static_cast<std::uint32_t>(values.size()), 1, {}};
    for (const float value : values) texels.rgba.insert(texels.rgba.end(), {value, value, value, 1});
    return texels;
}

TEST(ImageView, EveryByteOfTheDisplayCurveBeginsAtTheSameFloatAsInAPng) {
    std::vector<float> values;
    for (int byte = 0; byte < 255; ++byte) {
        // The float at which the next byte begins, and the one below it.
        float below = 0, above = 1;
        while (std::nextafter(below, 2.0f) < above) {
            const float middle = below + (above - below) / 2;
            (int(display_byte(double{middle})) > byte ? above : below) = middle;
        }
        values.insert(values.end(), {below, above});
    }
    const Picture picture = drawn(*Desk::clean().layer, row_of(values), {});
    for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(pixel(picture, static_cast<int>(i), 0)[0], int(display_byte(double{values[i]}))) << values[i];
}

TEST(ImageView, NaNIsMagentaAndInfinityOrangeWhateverTheLook) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const Channels channels : {Channels::color, Channels::red, Channels::luminance, Channels::false_color}) {
        const Picture picture = drawn(*Desk::clean().layer, row_of({.5f, nan, inf, -inf}), {.channels = channels});
        EXPECT_EQ(pixel(picture, 1, 0), (std::array{255, 0, 255}));
        EXPECT_EQ(pixel(picture, 2, 0), (std::array{255, 153, 0}));
        EXPECT_EQ(pixel(picture, 3, 0), (std::array{255, 153, 0}));
        EXPECT_NE(pixel(picture, 0, 0), pixel(picture, 1, 0));
    }
}

TEST(ImageView, BlackAndWhiteAreTheEndsOfTheRange) {
    const Picture picture = drawn(*Desk::clean().layer, row_of({-1, 2, 3, 4, 9}), {.black = 2, .white = 4, .curve = Curve::raw});
    EXPECT_EQ(pixel(picture, 0, 0)[0], 0);
    EXPECT_EQ(pixel(picture, 1, 0)[0], 0);
    EXPECT_NEAR(pixel(picture, 2, 0)[0], 127.5, .51);
    EXPECT_EQ(pixel(picture, 3, 0)[0], 255);
    EXPECT_EQ(pixel(picture, 4, 0)[0], 255);
}

TEST(Picture, CountsWhatIsNoNumberAndKeepsItOutOfTheRange) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const auto image = std::make_shared<HostImage>(image_of(4, 1, Format::r32f, {nan, inf, -2, 6}));
    const PictureInfo info = look_at(image, 0);
    EXPECT_EQ(info.nans, 1u);
    EXPECT_EQ(info.infinities, 1u);
    EXPECT_EQ(info.negatives, 1u);
    EXPECT_EQ(info.range.low, -2);
    EXPECT_EQ(info.range.high, 6);
    EXPECT_EQ(info.histogram[0].front(), 1u);
    EXPECT_EQ(info.histogram[0].back(), 1u);
}

TEST(Picture, TheBulkLeavesTheFireflyOut) {
    std::vector<float> values(4000, .5f);
    values[7] = 1e6f;
    values[9] = 0;
    const PictureInfo info = look_at(std::make_shared<HostImage>(image_of(100, 40, Format::r32f, values)), 0);
    EXPECT_EQ(info.bulk.high, .5);
    EXPECT_EQ(info.range.high, 1e6);
}

TEST(ImageView, TheStatusLineHasTheValueUnderTheMouseAndOfThePinThatArrowsMove) {
    Desk& desk = Desk::clean();
    must(desk.player->move("Image/picture", .5f, .5f));
    EXPECT_THAT(desk.said("Image/under"), HasSubstr(":"));
    desk.model().pin = {10, 20};
    must(desk.player->key("right"));
    must(desk.player->key("down"));
    EXPECT_EQ(desk.model().pin, glm::ivec2(11, 21));
    const HostImage& display = desk.replay()->run.images.at("display");
    EXPECT_THAT(desk.said("Image/pinned"), HasSubstr(fmt::format("11 21:  {:.5g}", texel(display, 11, 21).x)));
}

TEST(ImageView, TheWheelZoomsToThePointerAndADragPansWithIt) {
    Desk& desk = Desk::clean();
    must(desk.player->click("Image/100 %"));
    must(desk.player->move("Image/picture", .47f, .48f));
    const std::string under = desk.said("Image/under");
    must(desk.player->wheel(8));
    EXPECT_GT(desk.model().view.zoom, 4);
    EXPECT_EQ(desk.said("Image/under"), under);
    must(desk.player->pull(40, 30));
    EXPECT_EQ(desk.said("Image/under"), under) << "the texel that was grabbed stays under the hand";
}

TEST(ImageView, AViewOfATechniqueIsShownAsItsRowSays) {
    Desk& desk = Desk::clean();
    for (const auto& [at, choice] : desk.model().choices()) {
        if (choice.technique->views.empty()) continue;
        const DebugView& view = choice.technique->views.front();
        const auto& skipped = desk.replay()->skipped;
        if (std::ranges::find(skipped, at, &SkippedStage::stage) != skipped.end()) continue;
        const std::string output = fmt::format("{}:{}", choice.technique->name, view.name);
        must(desk.player->choose("Image/image", output));
        must(desk.player->wait());
        ASSERT_TRUE(desk.replay()->run.images.contains(output));
        EXPECT_EQ(desk.said("Image/range"), fmt::format("{:g} to {:g}", view.low, view.high));
        return;
    }
    FAIL() << "no technique of the frame has a view";
}

}  // namespace
}  // namespace strata::ui
