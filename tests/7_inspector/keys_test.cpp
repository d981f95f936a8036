// What keys do beside the panels' own: save, go to a pixel, reload shaders, fly and come back.
#include <cmath>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/container/whole_file.h"
#include "passes/frame_images.h"
#include "replay/images/image_io.h"
#include "tests/7_inspector/desk.h"
#include "tests/7_tool/process.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"
#include "tests/support/shader_folder.h"
#include "ui/picture/camera.h"
#include "ui/picture/go_to_pixel.h"
#include "ui/picture/look_bytes.h"
#include "ui/picture/save_shown.h"
#include "ui/window/keys.h"

namespace strata::ui {
namespace {

using testing::HasSubstr;

/// The test's folder is the current one until it goes.
class InFolder {
public:
    InFolder() : before_(std::filesystem::current_path()) { std::filesystem::current_path(folder()); }
    InFolder(const InFolder&) = delete;
    ~InFolder() { std::filesystem::current_path(before_); }

private:
    std::filesystem::path before_;
};

std::string shown_hash(Desk& desk) { return hash_of(desk.replay()->run.images.at("display")); }

nlohmann::json json_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    return nlohmann::json::parse(file);
}

TEST(Keys, F12SavesWhatIsShownWithWhereItComesFrom) {
    Desk& desk = Desk::clean();
    const InFolder here;
    for (int i = 0; i < 2; ++i) {
        must(desk.player->key("f12"));
        must(desk.player->wait());
    }
    const HostImage& shown = desk.replay()->run.images.at("display");
    const std::string stem = stem_of("scenarios.strata", 0, "display");
    EXPECT_EQ(must(read_exr(stem + ".exr")).begin()->second.texels, shown.texels);
    must(write_png("expected.png", shown));
    EXPECT_EQ(must(read_png(stem + ".png")).texels, must(read_png("expected.png")).texels) << "as strata replay writes it";
    const auto json = json_of(stem + ".json");
    EXPECT_EQ(json["strata.command"], desk.model().command_line());
    EXPECT_EQ(json["strata.hash.display"], hash_of(shown));
    EXPECT_EQ(json["strata.device"], desk.inspector->replayer().facts()->device.name);
    EXPECT_TRUE(std::filesystem::exists(stem + "_2.exr")) << "nothing is written over";
    EXPECT_THAT(desk.inspector->log().back().text, HasSubstr(stem + "_2.exr"));
}

TEST(Keys, ShiftF12SavesTheWholeWindowAndItsWidgets) {
    Desk& desk = Desk::clean();
    const InFolder here;
    for (int i = 0; i < 2; ++i) {
        must(desk.player->key("shift+f12"));
        must(desk.player->wait());
    }
    must(desk.player->shot("shot.png"));
    must(desk.player->tree("tree.json"));
    EXPECT_EQ(must(read_png("strata_window.png")).texels, must(read_png("shot.png")).texels);
    const auto json = json_of("strata_window.json");
    EXPECT_EQ(json["widgets"], json_of("tree.json")["widgets"]);
    EXPECT_EQ(json["settled"], true);
    EXPECT_EQ(json["command"], desk.model().command_line());
    EXPECT_EQ(json["title"], desk.inspector->title());
    EXPECT_TRUE(std::filesystem::exists("strata_window_2.json")) << "nothing is written over";
    EXPECT_FALSE(std::filesystem::exists(stem_of("scenarios.strata", 0, "display") + ".exr")) << "F12 is another key";
    EXPECT_THAT(desk.inspector->log().back().text, HasSubstr("strata_window_2.png and .json"));
}

std::size_t files_after_a_second_of(Desk& desk, const std::string& chord) {
    const Chord held = *chord_of(chord);
    ImGuiIO& io = ImGui::GetIO();
    io.KeyShift = held.shift;
    io.KeysDown[held.key] = true;
    for (int i = 0; i < 60; ++i) {
        must(desk.player->frames(1));
        // A save that is done makes room for the next.
        while (!desk.inspector->is_settled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    io.KeyShift = io.KeysDown[held.key] = false;
    must(desk.player->wait());
    const std::filesystem::directory_iterator files(".");
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(Keys, AKeyThatWritesFilesDoesNotRepeat) {
    Desk& desk = Desk::clean();
    const InFolder here;
    EXPECT_EQ(files_after_a_second_of(desk, "f12"), 3u) << "EXR, PNG and JSON of one picture";
    EXPECT_EQ(files_after_a_second_of(desk, "shift+f12"), 3u + 2u) << "PNG and JSON of one window";
}

TEST(Keys, AKeyThatMovesRepeats) {
    Desk& desk = Desk::clean();
    desk.model().pin = glm::ivec2(10, 10);
    const int right = chord_of("right")->key;
    ImGui::GetIO().KeysDown[right] = true;
    must(desk.player->frames(60));
    ImGui::GetIO().KeysDown[right] = false;
    must(desk.player->wait());
    EXPECT_GT(desk.model().pin->x, 15);
}

TEST(Keys, ShiftF12IntoAFolderThatIsGoneSaysSo) {
    Desk& desk = Desk::clean();
    const InFolder here;
    std::filesystem::create_directory("gone");
    std::filesystem::current_path("gone");
    std::filesystem::remove(folder() / "gone");
    must(desk.player->key("shift+f12"));
    must(desk.player->wait());
    EXPECT_EQ(desk.inspector->log().back().kind, LogLine::Kind::failed);
    EXPECT_THAT(desk.inspector->log().back().text, HasSubstr("strata_window.png"));
}

TEST(Keys, CtrlQAsksToCloseTheWindow) {
    Desk& desk = Desk::clean();
    EXPECT_FALSE(desk.inspector->is_closing());
    must(desk.player->key("q"));
    EXPECT_FALSE(desk.inspector->is_closing());
    must(desk.player->key("ctrl+q"));
    EXPECT_TRUE(desk.inspector->is_closing());
}

TEST(FrameRate, IsThatOfTheLastTwoSecondsInWhichSomethingWasComputed) {
    FrameRate rate;
    EXPECT_EQ(text(rate), "");
    for (int i = 0; i < 10; ++i) rate.add(.5);
    EXPECT_EQ(text(rate), "2 frames a second while something is computed, the slowest took 500 ms");
    for (int i = 0; i < 110; ++i) rate.add(.02);
    rate.add(.04);
    EXPECT_NEAR(rate.per_second(), 50, 1);
    EXPECT_NEAR(rate.slowest_ms(), 40, 1e-9);
}

TEST(Keys, F12IntoAFolderThatIsGoneSaysSo) {
    Desk& desk = Desk::clean();
    const ShownImage shown{"display", desk.replay()->image(desk.replay(), "display"), 0, {}, {}};
    EXPECT_THAT(save(folder() / "nowhere", "a", shown), FailsWith("file.cannot_write", Field("file", HasSubstr("nowhere"))));
}

TEST(Keys, CtrlGPinsAPixelThatIsThere) {
    Desk& desk = Desk::clean();
    must(desk.player->key("ctrl+g"));
    must(desk.player->type("go to/pixel", "12 7"));
    EXPECT_EQ(desk.model().pin, glm::ivec2(12, 7));
    EXPECT_EQ(desk.model().view.center_x, 12.5);
    must(desk.player->key("ctrl+g"));
    must(desk.player->type("go to/pixel", "9999 7"));
    EXPECT_THAT(desk.said("go to/refused"), HasSubstr("below 96 and 54"));
    EXPECT_EQ(desk.model().pin, glm::ivec2(12, 7));
    desk.expect_no_conflicts();
    must(desk.player->key("escape"));
    EXPECT_THROW(desk.said("go to/pixel"), std::runtime_error);
}

TEST(Keys, PixelsAreReadAsPeopleWriteThem) {
    for (const char* text : {"12 34", "12,34", " 12 x 34 ", "12, 34"}) EXPECT_EQ(pixel_of(text), glm::ivec2(12, 34)) << text;
    for (const char* text : {"", "12", "12 34 56", "a b", "12.5 3"}) EXPECT_EQ(pixel_of(text), std::nullopt) << text;
}

TEST(Keys, RCompilesChangedShadersAndABrokenOneLeavesTheLastGoodOne) {
    Desk& desk = Desk::clean();
    const ShaderFolder shaders;
    const std::string source = "passes/combine/hi_lo/film.comp", before = shown_hash(desk);
    desk.model().shaders = shaders.path();
    shaders.change(source, "sum / float(samples)", "sum * 0.5 / float(samples)");
    must(desk.player->key("r"));
    must(desk.player->wait());
    const std::string dark = shown_hash(desk);
    EXPECT_NE(dark, before);
    EXPECT_EQ(desk.said("top/shaders"), "changed shaders");
    EXPECT_THAT(desk.model().command_line(), HasSubstr("--shaders"));
    shaders.change(source, "void main", "void  main(; void main");
    must(desk.player->key("r"));
    must(desk.player->wait());
    EXPECT_THAT(desk.said("top/shaders"), HasSubstr("shader error"));
    EXPECT_THAT(desk.inspector->log().back().text, HasSubstr("film.comp:"));
    EXPECT_EQ(shown_hash(desk), dark);
    shaders.restore(source);
    must(desk.player->key("r"));
    must(desk.player->wait());
    EXPECT_EQ(shown_hash(desk), before);
    EXPECT_FALSE(desk.model().uses_shaders);
    desk.model().shaders = ".";
}

TEST(Keys, WithTheRightButtonHeldWFliesAndHomeReturns) {
    Desk& desk = Desk::clean();
    const std::string before = shown_hash(desk);
    must(desk.player->move("Image/picture", .5f, .5f));
    ImGuiIO& io = ImGui::GetIO();
    io.MouseDown[ImGuiMouseButton_Right] = true;
    must(desk.player->frames(2));
    io.KeysDown[chord_of("w")->key] = true;
    io.MousePos.x += 40;
    must(desk.player->frames(30));
    io.KeysDown[chord_of("w")->key] = io.MouseDown[ImGuiMouseButton_Right] = false;
    must(desk.player->wait());
    EXPECT_NEAR(std::hypot(desk.model().edits().variant.eye.dolly, desk.model().edits().variant.eye.truck), 1, .1)
        << "2 m/s for half a second";
    EXPECT_GT(desk.model().edits().variant.eye.pan, .1);
    EXPECT_THAT(desk.said("Image/eye"), HasSubstr("expected results are not compared"));
    EXPECT_THAT(desk.model().command_line(), HasSubstr("--eye"));
    EXPECT_NE(shown_hash(desk), before);
    must(desk.player->key("ctrl+z"));
    EXPECT_EQ(desk.model().edits().variant.eye, EyeMove{}) << "a flight is one step of undo";
    must(desk.player->key("ctrl+y"));
    must(desk.player->key("home"));
    must(desk.player->wait());
    EXPECT_EQ(shown_hash(desk), before);
}

TEST(Camera, LooksAroundWithTheHorizonLevel) {
    View view;
    view.to_view = moved(view, {.tilt = -.5}).to_view;
    const View turned = flown(view, {.turn_right = 1});
    EXPECT_NEAR(turned.origin.x + turned.origin.y + turned.origin.z, 0, 1e-12);
    const glm::dvec3 right = glm::transpose(turned.to_view)[0], ahead = glm::transpose(turned.to_view)[2];
    EXPECT_NEAR(right.y, 0, 1e-12);
    EXPECT_NEAR(ahead.y, glm::transpose(view.to_view)[2].y, 1e-12);
    EXPECT_NEAR(std::atan2(ahead.x, ahead.z), 1, 1e-9) << "to the right";
    const View up = flown(view, {.turn_up = .2});
    EXPECT_GT(glm::transpose(up.to_view)[2].y, glm::transpose(view.to_view)[2].y);
    for (const double by : {-9.0, 9.0}) {
        const View steep = flown(view, {.turn_up = by});
        EXPECT_GT(std::abs(glm::transpose(steep.to_view)[2].y), .999);
        EXPECT_GT(glm::transpose(steep.to_view)[1].y, 0) << "its top stays up";
    }
}

TEST(Camera, WhatTheMouseMovedBeforeThePressIsNoPull) {
    Desk& desk = Desk::clean();
    must(desk.player->move("tabs/Image", .5f, .5f));
    ImGuiIO& io = ImGui::GetIO();
    const WidgetRecord picture = desk.widget("Image/picture");
    io.MousePos = {(picture.from.x + picture.to.x) / 2, (picture.from.y + picture.to.y) / 2};
    io.MouseDown[ImGuiMouseButton_Right] = true;
    must(desk.player->frames(3));
    EXPECT_EQ(desk.model().edits().variant.eye, EyeMove{});
    io.MouseDown[ImGuiMouseButton_Right] = false;
    must(desk.player->wait());
}

TEST(LookBytes, MarkWhatIsNoNumberAndGoFromBlackToWhite) {
    const Look look{.black = 10, .white = 20, .channels = Channels::red, .curve = Curve::raw};
    EXPECT_EQ(shown_bytes(look, {10, 0, 0, 1})[1], std::byte{0});
    EXPECT_EQ(shown_bytes(look, {15, 0, 0, 1})[1], std::byte{128});
    EXPECT_EQ(shown_bytes(look, {25, 0, 0, 1})[2], std::byte{255});
    EXPECT_EQ(shown_bytes(look, {NAN, 0, 0, 1}), (std::array{std::byte{255}, std::byte{0}, std::byte{255}}));
    EXPECT_EQ(shown_bytes(look, {INFINITY, 0, 0, 1}), (std::array{std::byte{255}, std::byte{153}, std::byte{0}}));
}

}  // namespace
}  // namespace strata::ui
