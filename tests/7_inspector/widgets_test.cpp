// What widgets say: help where the mouse rests.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

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

}  // namespace
}  // namespace strata::ui
