// Only what changed is drawn anew, and the window is what it were if all of it was.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/window/changed_regions.h"

namespace strata::ui {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

struct Box {
    float left = 0, top = 0;
    ImTextureID texture = nullptr;
};

/// Squares of 20 pixels in a frame of 400 x 300.
std::vector<Region> changed(ChangedRegions& regions, const std::vector<Box>& boxes, const ChangedRegions::LookOf& look_of) {
    const ImVec2 size = std::exchange(ImGui::GetIO().DisplaySize, ImVec2(400, 300));
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const Box& box : boxes) list.AddImage(box.texture, {box.left, box.top}, {box.left + 20, box.top + 20});
    ImGui::Render();
    const auto found = regions.next(*ImGui::GetDrawData(), look_of);
    ImGui::GetIO().DisplaySize = size;
    return found;
}

std::vector<Region> changed(ChangedRegions& regions, const std::vector<Box>& boxes) {
    return changed(regions, boxes, [](ImTextureID id) { return reinterpret_cast<std::uintptr_t>(id); });
}

bool covers(const std::vector<Region>& regions, const Box& box) {
    const Region wanted{int(box.left), int(box.top), int(box.left) + 20, int(box.top) + 20};
    return std::ranges::any_of(regions, [&](const Region& each) { return intersection(each, wanted) == wanted; });
}

TEST(ChangedRegions, AreTheWholeFrameAtFirstAndNoneWhereNothingChanged) {
    Desk::clean();
    ChangedRegions regions;
    EXPECT_THAT(changed(regions, {{10, 10}}), testing::ElementsAre(Region{0, 0, 400, 300}));
    EXPECT_THAT(changed(regions, {{10, 10}}), IsEmpty());
    regions.forget();
    EXPECT_THAT(changed(regions, {{10, 10}}), SizeIs(1));
}

TEST(ChangedRegions, AreWhereSomethingWasAndWhereItIs) {
    Desk::clean();
    ChangedRegions regions;
    changed(regions, {{10, 10}, {100, 10}, {300, 200}});
    const auto moved = changed(regions, {{10, 10}, {200, 100}, {300, 200}});
    EXPECT_THAT(moved, SizeIs(2));
    EXPECT_TRUE(covers(moved, {100, 10}) && covers(moved, {200, 100}));
    EXPECT_FALSE(covers(moved, {10, 10}) || covers(moved, {300, 200}));
    const auto gone = changed(regions, {{10, 10}, {300, 200}});
    EXPECT_THAT(gone, SizeIs(1));
    EXPECT_TRUE(covers(gone, {200, 100}));
}

TEST(ChangedRegions, AreWhereTheOrderChangedThoughEachIsWhereItWas) {
    Desk::clean();
    ChangedRegions regions;
    changed(regions, {{10, 10}, {15, 15}, {200, 200}});
    const auto swapped = changed(regions, {{15, 15}, {10, 10}, {200, 200}});
    EXPECT_TRUE(covers(swapped, {10, 10}) && covers(swapped, {15, 15}));
    EXPECT_FALSE(covers(swapped, {200, 200}));
}

TEST(ChangedRegions, AreWhereATextureLooksAnotherWay) {
    Desk::clean();
    ChangedRegions regions;
    const auto texture = reinterpret_cast<ImTextureID>(1);
    std::uint64_t look = 1;
    const auto look_of = [&](ImTextureID id) { return id == texture ? look : 0; };
    changed(regions, {{10, 10, texture}, {200, 200}}, look_of);
    look = 2;
    const auto other = changed(regions, {{10, 10, texture}, {200, 200}}, look_of);
    EXPECT_TRUE(covers(other, {10, 10}));
    EXPECT_FALSE(covers(other, {200, 200}));
}

TEST(ChangedRegions, AreFewHoweverMuchChanged) {
    Desk::clean();
    ChangedRegions regions;
    std::vector<Box> before, now;
    for (int i = 0; i < 30; ++i) {
        before.push_back({static_cast<float>(i % 6) * 64, static_cast<float>(i / 6) * 60});
        now.push_back({before.back().left + 5, before.back().top});
    }
    changed(regions, before);
    const auto found = changed(regions, now);
    EXPECT_LE(found.size(), 8u);
    for (const auto& boxes : {before, now})
        for (const Box& box : boxes) EXPECT_TRUE(covers(found, box)) << box.left << " " << box.top;
}

TEST(ChangedRegions, DrawnAnewMakeTheWindowThatIsDrawnWhole) {
    Desk& desk = Desk::clean();
    const auto expect_whole = [&](const char* after) {
        const Picture drawn = must(desk.player->picture());
        desk.layer->forget_drawn();
        must(desk.inspector->render());
        EXPECT_TRUE(drawn.rgb == desk.layer->read_back().rgb) << after;
    };
    expect_whole("opening");
    must(desk.player->move("Image/picture", .5f, .5f));
    expect_whole("the pointer on the picture");
    must(desk.player->click("Image/picture"));
    expect_whole("a pinned pixel");
    must(desk.player->click("Image/100 %"));
    expect_whole("another zoom");
    must(desk.player->key("f1"));
    expect_whole("the list of keys");
    must(desk.player->key("f1"));
    expect_whole("no list of keys");
    desk.model().select_frame(frame_of("explosion"));
    must(desk.player->frames(1));
    expect_whole("a replay begun");
    must(desk.player->wait());
    expect_whole("another frame");
    must(desk.player->click("tabs/Compare"));
    expect_whole("another panel");
    must(desk.player->click("tabs/Image"));
    expect_whole("the panel before");
}

}  // namespace
}  // namespace strata::ui
