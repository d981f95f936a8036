// What widgets say: help where the mouse rests, in letters that the font has.
#include <algorithm>
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui_internal.h>

#include "tests/7_inspector/desk.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

using testing::IsEmpty;

constexpr int long_enough = 30;  // frames: half a second

bool shows_help(Desk& desk) {
    return std::ranges::any_of(desk.inspector->widgets().records(),
                               [](const WidgetRecord& record) { return record.path == "help"; });
}

TEST(Help, ComesWhereTheMouseRestsAndGoesWithIt) {
    Desk& desk = Desk::clean();
    must(desk.player->move("Image/fit", .5f, .5f));
    EXPECT_FALSE(shows_help(desk)) << "at once";
    must(desk.player->frames(long_enough));
    EXPECT_EQ(desk.said("help"), "F, or double click");
    must(desk.player->move("Image/fit", .4f, .5f));
    EXPECT_TRUE(shows_help(desk)) << "it stays while the mouse moves on the widget";
    must(desk.player->move("Image/100 %", .5f, .5f));
    EXPECT_FALSE(shows_help(desk));
    must(desk.player->frames(long_enough));
    EXPECT_EQ(desk.said("help"), "a pixel per texel");
}

TEST(Help, OfWhatWasPressedComesAgainAfterTheMouseLeftIt) {
    Desk& desk = Desk::clean();
    must(desk.player->click("Image/fit"));
    must(desk.player->frames(long_enough));
    EXPECT_FALSE(shows_help(desk));
    must(desk.player->move("Image/fit", .1f, .5f));
    must(desk.player->frames(long_enough));
    EXPECT_FALSE(shows_help(desk)) << "it was not left";
    must(desk.player->move("Image/100 %", .5f, .5f));
    must(desk.player->move("Image/fit", .5f, .5f));
    must(desk.player->frames(long_enough));
    EXPECT_TRUE(shows_help(desk));
}

TEST(Help, OfWhatAppearsBelowAClosingListStaysAway) {
    Desk& desk = Desk::clean();
    must(desk.player->choose("Image/channels", "Luminance"));
    must(desk.player->frames(long_enough));
    EXPECT_FALSE(shows_help(desk));
}

/// The code points of a text that the font has not.
std::vector<unsigned> missing_glyphs(std::string_view text) {
    std::vector<unsigned> missing;
    for (const char* at = text.data(); at < text.data() + text.size();) {
        unsigned code = 0;
        at += ImTextCharFromUtf8(&code, at, text.data() + text.size());
        if (code >= ' ' && !ImGui::GetFont()->FindGlyphNoFallback(static_cast<ImWchar>(code))) missing.push_back(code);
    }
    return missing;
}

TEST(Font, HasEveryGlyphThatPanelsShow) {
    Desk& desk = Desk::clean();
    desk.model().select_frame(frame_of("glass_and_smoke"));
    desk.model().pin = glm::ivec2(40, 30);
    must(desk.player->key("f1"));
    for (const PanelRow& row : panels()) {
        must(desk.player->click(fmt::format("tabs/{}", row.name)));
        must(desk.player->wait());
        for (const WidgetRecord& record : desk.inspector->widgets().records())
            EXPECT_THAT(missing_glyphs(record.value), IsEmpty()) << record.path << ": " << record.value;
    }
    must(desk.player->key("f1"));
}

TEST(Font, HasEveryGlyphThatTheCodeNames) {
    Desk::clean();
    const std::regex escaped(R"((\\x[0-9a-f]{2})+)");
    std::size_t glyphs = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(STRATA_SOURCE_DIR "/ui")) {
        if (entry.path().extension() != ".cpp") continue;
        const std::string text = file_text(entry.path());
        for (std::sregex_iterator at(text.begin(), text.end(), escaped), end; at != end; ++at, ++glyphs) {
            std::string bytes;
            for (std::size_t i = 2; i < at->str().size(); i += 4)
                bytes += static_cast<char>(std::stoi(at->str().substr(i, 2), nullptr, 16));
            EXPECT_THAT(missing_glyphs(bytes), IsEmpty()) << entry.path().filename() << " " << at->str();
        }
    }
    EXPECT_GT(glyphs, 20u);
}

}  // namespace
}  // namespace strata::ui
