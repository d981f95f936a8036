// A script plays a session by synthetic input, and says where it went wrong.
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "replay/images/image_io.h"
#include "tests/7_inspector/desk.h"
#include "tests/7_tool/process.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Result<void> play_lines(Desk& desk, const std::string& text) {
    return play(*desk.player, must(parse_script(text, "script")), "script", folder());
}

Result<void> played(const std::string& text) { return play_lines(Desk::clean(), text); }

TEST(Script, WordsMayBeInQuotesAndCommentsEndALine) {
    const auto lines = must(parse_script("click a\n\n  # nothing\nchoose 'a b' \"it's\"  # more\n", "script"));
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[1].number, 4u);
    EXPECT_THAT(lines[1].words, ElementsAre("choose", "a b", "it's"));
}

TEST(Script, ErrorsHaveFileAndLine) {
    const Field file("file", "script"), first("line", 1), second("line", 2);
    EXPECT_THAT(parse_script("wait\nclick 'a\n", "script"), FailsWith("script.open_quote", file, second));
    EXPECT_THAT(played("wait\nclik Image/fit\n"), FailsWith("script.unknown_command", file, second, Field("command", "clik"),
                                                            Field("suggestion", "; did you mean click?")));
    EXPECT_THAT(played("click Image/fits"), FailsWith("script.unknown_widget", file, first, Field("widget", "Image/fits"),
                                                      Field("suggestion", "; did you mean Image/fit?")));
    EXPECT_THAT(played("drag Image/exposure"),
                FailsWith("script.argument_count", Field("given", 1), Field("usage", "drag PATH VALUE")));
    EXPECT_THAT(played("drag Image/exposure 9x"), FailsWith("script.not_a_number", Field("word", "9x")));
    EXPECT_THAT(played("drag Image/exposure 99"),
                FailsWith("script.out_of_range", Field("low", -12), Field("high", 12), Field("value", 99)));
    EXPECT_THAT(played("drag Image/fit 1"), FailsWith("script.not_a_slider"));
    EXPECT_THAT(played("click 'Techniques/reset all'"), FailsWith("script.disabled", Field("widget", "Techniques/reset all")));
    EXPECT_THAT(played("expect Image/channels red"),
                FailsWith("script.unexpected_text", Field("text", "RGB"), Field("expected", "red")));
    EXPECT_THAT(played("key hyper+x"), FailsWith("script.unknown_key", Field("key", "hyper+x")));
}

TEST(Script, AWholeSessionPlays) {
    Desk& desk = Desk::clean();
    must(play_lines(desk,
                    "choose Techniques/transparency/technique weighted\n"
                    "wait\n"
                    "expect Techniques/transparency/technique weighted\n"
                    "type Techniques/transparency/scale/value 55\n"
                    "wait\n"
                    "expect Techniques/transparency/scale/value 55\n"
                    "expect status/command 'transparency/weighted:scale=55'\n"
                    "drag Image/exposure 2\n"
                    "pin 3 4\n"
                    "wait\n"
                    "expect Image/pinned '3 4:'\n"
                    "shot a.png\n"
                    "tree a.json\n"
                    "key ctrl+z\n"
                    "wait\n"
                    "expect Techniques/transparency/scale/value 1\n"));
    EXPECT_NEAR(desk.model().looks.at("display").exposure, 2, .1) << "the nearest of its pixels";
    const HostImage shot = must(read_png(folder() / "a.png"));
    EXPECT_EQ(shot.shape.extent.width, 1280u);
    EXPECT_TRUE(std::filesystem::exists(folder() / "a.json"));
}

TEST(Script, TheSameScriptMakesTheSamePicture) {
    ASSERT_EQ(strata("record three_panes -o panes.strata --size 96x54").code, 0);
    std::vector<std::string> hashes;
    for (const char* name : {"a", "b"}) {
        std::ofstream(folder() / "script.txt") << "choose Techniques/transparency/technique moments\nwait\n"
                                                  "move Image/picture .5 .5\nshot "
                                               << name << ".png\n";
        ASSERT_EQ(strata("inspect panes.strata --script script.txt").code, 0);
        hashes.push_back(hash_of(must(read_png(folder() / fmt::format("{}.png", name)))));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Script, TheProgramPlaysOneAndExitsByItsOutcome) {
    ASSERT_EQ(strata("record three_panes -o panes.strata --size 96x54").code, 0);
    std::ofstream(folder() / "good.txt") << "expect top/capture panes.strata\nshot shown.png\n";
    std::ofstream(folder() / "bad.txt") << "expect top/capture other.strata\n";
    const Finished good = strata("inspect panes.strata --script good.txt --size 900x600");
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_EQ(must(read_png(folder() / "shown.png")).shape.extent.width, 900u);
    const Finished bad = strata("-v inspect panes.strata --script bad.txt");
    EXPECT_THAT(bad, Refuses(1, "script.unexpected_text",
                             "widget=top/capture text=panes.strata expected=other.strata file=bad.txt line=1"));
    EXPECT_THAT(bad.err, HasSubstr("strata: bad.txt:1: ")) << "as compilers say where";
    EXPECT_EQ(strata("inspect panes.strata --script missing.txt").code, 3);
    EXPECT_EQ(strata("inspect missing.strata --script good.txt").code, 3);
}

TEST(Replayer, OfManyWishesTheLatestIsAnswered) {
    Replayer replayer([] { return Session::open(small_scenarios(), {}); });
    for (std::size_t frame = 0; frame < 5; ++frame) replayer.show("A", {.variant = {.frame = frame}});
    while (!replayer.is_idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    replayer.take_results();
    ASSERT_TRUE(replayer.shown("A"));
    EXPECT_EQ(replayer.shown("A")->request.variant.frame, 4u);
    EXPECT_TRUE(replayer.is_current("A"));
}

TEST(Replayer, APictureGoesBeforeTheNextStepOfALongJob) {
    Replayer replayer([] { return Session::open(small_scenarios(), {}); });
    replayer.show("A", {});
    while (!replayer.is_idle()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::atomic<bool> asked = false;
    const auto job = replayer.start<int>([&](Session&, Progress& progress) -> Result<int> {
        while (!asked) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        progress.at(.5, "half");
        return 1;
    });
    replayer.show("A", {.variant = {.frame = 1}});
    asked = true;
    while (!job->result()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    replayer.take_results();
    EXPECT_EQ(replayer.shown("A")->request.variant.frame, 1u);
    EXPECT_EQ(job->progress.doing(), "half");
}

TEST(Inspect, WhatNoWindowCouldShowEndsBeforeOneOpens) {
    ASSERT_EQ(strata("record three_panes -o panes.strata --size 96x54").code, 0);
    std::ofstream(folder() / "bad.strata") << "no capture";
    const auto code = [](const std::string& arguments) {
        return strata_after("unset DISPLAY WAYLAND_DISPLAY", "inspect " + arguments).code;
    };
    EXPECT_EQ(code("missing.strata"), 3);
    EXPECT_EQ(code("bad.strata"), 3);
    EXPECT_EQ(code("panes.strata --frame 7"), 2);
    EXPECT_EQ(code("panes.strata --use transparency/nothing"), 2);
    EXPECT_EQ(code("panes.strata --set nothing=1"), 2);
    EXPECT_EQ(code("panes.strata --gpu nosuch"), 2);
    EXPECT_EQ(code("panes.strata --shaders nosuchfolder"), 2);
    EXPECT_EQ(code("panes.strata --force badstage"), 2);
    EXPECT_EQ(code("panes.strata --without nosuch"), 2);
    EXPECT_EQ(code("panes.strata"), 4) << "no display";
}

TEST(Layout, OfAWindowThatWasTooSmallForAWhileIsWhatItWas) {
    Desk& desk = Desk::clean();
    const Layout before = desk.inspector->layout();
    ImGui::GetIO().DisplaySize = {300, 200};
    must(desk.player->frames(2));
    ImGui::GetIO().DisplaySize = {1280, 800};
    must(desk.player->frames(2));
    EXPECT_EQ(desk.inspector->layout(), before);
    Layout kept;
    remember_size(kept, 120, 90);
    EXPECT_EQ(kept, Layout());
    remember_size(kept, 900, 700);
    EXPECT_EQ(kept.width, 900);
}

TEST(Layout, ComesBackFromItsFileAndNonsenseIsTheDefaults) {
    const Layout layout{.left = 250, .width = 1000, .height = 700, .settings = {{"times", true}}};
    must(write_layout(folder() / "state" / "inspector.json", layout));
    EXPECT_EQ(read_layout(folder() / "state" / "inspector.json"), layout);
    std::ofstream(folder() / "bad.json") << "{\"left\": \"wide\", \"width\": -3";
    EXPECT_EQ(read_layout(folder() / "bad.json"), Layout());
    EXPECT_EQ(layout_file("/s", "/h"), std::filesystem::path("/s/strata/inspector.json"));
    EXPECT_EQ(layout_file(nullptr, "/h"), std::filesystem::path("/h/.local/state/strata/inspector.json"));
    EXPECT_EQ(layout_file("", nullptr), std::nullopt);
}

}  // namespace
}  // namespace strata::ui
