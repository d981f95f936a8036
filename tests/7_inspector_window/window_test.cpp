// A session in a real window, as a person has one: every step is done by mouse and keys, and looked at on the screen.
#include <cmath>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/images/image_io.h"
#include "tests/7_inspector_window/driven_window.h"
#include "tests/7_inspector_window/drop_file.h"
#include "tests/7_inspector_window/pictures.h"
#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"
#include "tests/support/shader_folder.h"

namespace strata {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr int width = 1280, height = 800, picture_width = 160, picture_height = 90;
// A cursor and a caret, not a region.
constexpr std::size_t most_pixels_beside_the_picture = 20;
constexpr const char* capture = "smoke_grenade";
constexpr const char* film = "passes/combine/hi_lo/film.comp";

/// The window, its screen, and what headless replays of the lines it gives make.
class Sitting {
public:
    Sitting();

    Screen screen{width, height};
    ShaderFolder shaders;
    std::unique_ptr<DrivenWindow> window;
    std::string recorded_command;
    std::string shown = capture;  ///< the stem of the capture that is open

    /// The line that *Copy command* puts into the clipboard.
    std::string copied_command();
    /// The folder of files that a replay of the line writes; each line is replayed once.
    std::filesystem::path replayed(const std::string& command);
    std::filesystem::path headless_file(const std::string& command, const char* extension) {
        return only_file(replayed(command), fmt::format(".{}", extension));
    }
    HostImage headless_picture(const std::string& command) { return must(read_png(headless_file(command, "png"))); }

    /// Screen and Shift+F12 agree, and the picture at 1:1 is that of the headless replay, as far as neither pin nor anything
    /// else the caller names lies over it.
    void expect_picture(const std::string& path, const std::string& command, const LeftOut& left_out = {});
    /// The same of the Image tab and the copied command line.
    void expect_image();
    /// Where a texel of the picture at 1:1 is on the screen.
    std::pair<int, int> on_screen(const std::string& path, int x, int y) const;

private:
    std::map<std::string, std::filesystem::path> replayed_;
};

Sitting::Sitting() {
    const Finished recorded =
        strata(fmt::format("record {0} -o {0}.strata --size {1}x{2}", capture, picture_width, picture_height));
    if (recorded.code != 0) throw std::runtime_error(recorded.err);
    setenv("XDG_STATE_HOME", (folder() / "state").c_str(), 1);
    shaders.restore(film);
    window = std::make_unique<DrivenWindow>(
        screen, fmt::format("{}.strata --size {}x{} --shaders {}", capture, width, height, shaders.path().string()));
}

std::string Sitting::copied_command() {
    window->click("Techniques/copy command");
    window->look();
    return screen.clipboard();
}

std::filesystem::path Sitting::replayed(const std::string& command) {
    const auto [made, is_new] = replayed_.try_emplace(command, folder() / fmt::format("replayed_{}", replayed_.size()));
    if (!is_new) return made->second;
    constexpr std::string_view program = "strata ";
    EXPECT_THAT(command, StartsWith("strata replay "));
    const Finished done = strata(fmt::format("{} -o {}", command.substr(program.size()), made->second.string()));
    EXPECT_EQ(done.code, 0) << command << "\n" << done.err;
    return made->second;
}

std::pair<int, int> Sitting::on_screen(const std::string& path, int x, int y) const {
    const SeenWidget& canvas = window->seen().at(path);
    const auto corner = [](float from, float to, int texels) {
        return static_cast<int>(std::round(from + (to - from) / 2 - static_cast<float>(texels) / 2));
    };
    return {corner(canvas.from_x, canvas.to_x, picture_width) + x, corner(canvas.from_y, canvas.to_y, picture_height) + y};
}

void Sitting::expect_picture(const std::string& path, const std::string& command, const LeftOut& left_out) {
    const HostImage expected = headless_picture(command);
    window->rest_mouse();
    const Seen seen = window->look();
    const HostImage shot = screen.shot();
    const Box canvas = seen.at(path).box();
    const Differing inside = differing(shot, 0, 0, seen.picture, [&](int x, int y) { return !canvas.contains(x, y); });
    EXPECT_EQ(inside.pixels, 0u) << "of the canvas on the screen are not those of Shift+F12: " << inside.first;
    const Differing outside = differing(shot, 0, 0, seen.picture, [&](int x, int y) { return canvas.contains(x, y); });
    EXPECT_LE(outside.pixels, most_pixels_beside_the_picture) << "beside the canvas: " << outside.first;
    const auto [left, top] = on_screen(path, 0, 0);
    const Differing of_picture = differing(
        shot, left, top, expected, left_out ? left_out : [](int, int) { return false; });
    EXPECT_EQ(of_picture.pixels, 0u) << "of the picture are not those of " << command << ": " << of_picture.first;
}

void Sitting::expect_image() {
    const std::string command = copied_command();
    EXPECT_EQ(command, window->seen().command);
    int pin_x = 0, pin_y = 0;
    const bool is_pinned = window->seen().has("Image/pinned") &&
                           std::sscanf(window->seen().said("Image/pinned").c_str(), "pin %d %d:", &pin_x, &pin_y) == 2;
    const auto [x, y] = on_screen("Image/picture", pin_x, pin_y);
    // The frame around a pinned pixel, and its arms.
    const Box pin = is_pinned ? Box{x - 14, y - 14, x + 16, y + 16} : Box{};
    expect_picture("Image/picture", command, [&](int at_x, int at_y) { return pin.contains(at_x, at_y); });
}

// The steps, in order.

void opens_a_capture(Sitting& at) {
    const Seen seen = at.window->look();
    EXPECT_EQ(printed_by("xdotool search --onlyvisible --name Strata getwindowname"), seen.title + "\n");
    EXPECT_THAT(seen.title, StartsWith("smoke_grenade.strata, frame 0"));
    EXPECT_THAT(seen.title, HasSubstr(seen.said("top/device")));
    EXPECT_EQ(seen.said("top/activity"), "160 x 90, 1 sample");
    EXPECT_EQ(seen.said("tabs/Image"), "selected");
    EXPECT_EQ(seen.picture.shape.extent.width, static_cast<std::uint32_t>(width));
    EXPECT_EQ(seen.picture.shape.extent.height, static_cast<std::uint32_t>(height));
    const Box image = seen.at("Image/picture").box();
    EXPECT_LT(seen.at("tabs/Frame").box().right, image.left) << "the frame is at the left, techniques are at the right";
    EXPECT_GT(seen.at("tabs/Techniques").box().left, image.right);
    EXPECT_GT(seen.at("tabs/Counters").box().top, image.bottom);
    at.window->click("Image/100 %");
    at.recorded_command = at.copied_command();
    at.expect_image();
}

void changes_a_technique(Sitting& at) {
    EXPECT_FALSE(at.window->seen().at("top/undo").enabled);
    at.window->choose("Techniques/transparency/technique", "weighted");
    const Seen seen = at.window->look();
    EXPECT_EQ(seen.said("Techniques/transparency/technique"), "weighted");
    EXPECT_THAT(seen.command, HasSubstr("--use transparency/weighted"));
    EXPECT_TRUE(seen.at("top/undo").enabled);
    at.expect_image();
    EXPECT_NE(hash_of(at.headless_picture(at.copied_command())), hash_of(at.headless_picture(at.recorded_command)));
}

void drags_a_slider(Sitting& at) {
    constexpr const char* slider = "Techniques/transparency/scale/value";
    const SeenWidget before = at.window->reach(slider);
    const double y = before.box().middle_y();
    at.window->drag(before.box().middle_x(), y, before.box().left + .75 * (before.box().right - before.box().left), y);
    const Seen seen = at.window->look();
    EXPECT_NE(seen.said(slider), before.value);
    EXPECT_THAT(seen.command, HasSubstr("--set transparency/weighted:scale="));
    at.expect_image();
}

void pins_a_pixel(Sitting& at) {
    const auto [x, y] = at.on_screen("Image/picture", 100, 40);
    at.window->click_at(x, y);
    at.window->rest_mouse();
    EXPECT_THAT(at.window->look().said("Image/pinned"), StartsWith("pin 100 40:  "));
    at.expect_image();
}

/// A hand's breadth around the divider, and everything on one side of it.
LeftOut left_out_beside(int divider, bool keeps_left) {
    return [=](int x, int) { return keeps_left ? x > divider - 6 : x < divider + 6; };
}

void wipes_and_flips(Sitting& at) {
    constexpr const char* canvas = "Compare/picture";
    const std::string command = at.copied_command();
    // A click lets go of the pin, which would lie over both pictures.
    const auto [x, y] = at.on_screen("Image/picture", 100, 40);
    at.screen.hand(fmt::format("mousemove {} {} sleep 0.1 click 3", x, y));
    at.window->click("tabs/Compare");
    EXPECT_EQ(at.window->look().said(canvas), "A 50 %, then B");
    const SeenWidget& picture = at.window->seen().at(canvas);
    const Box box = picture.box();
    const auto divider_at = [&](double share) {
        return static_cast<int>(std::round(double{picture.from_x} + share * double{picture.to_x - picture.from_x}));
    };
    const int to = divider_at(.5) + 40;
    const double share = (to - double{picture.from_x}) / double{picture.to_x - picture.from_x};
    at.window->drag(divider_at(.5), box.top + 30, to, box.top + 30);
    EXPECT_EQ(at.window->look().said(canvas), fmt::format("A {:.0f} %, then B", share * 100));
    at.expect_picture(canvas, at.recorded_command, left_out_beside(to, /*keeps_left=*/true));
    at.expect_picture(canvas, command, left_out_beside(to, /*keeps_left=*/false));
    at.window->key("space");
    EXPECT_THAT(at.window->look().said(canvas), StartsWith("B  "));
    at.expect_picture(canvas, command);
    at.window->key("space");
    EXPECT_THAT(at.window->look().said(canvas), StartsWith("A  "));
    at.expect_picture(canvas, at.recorded_command);
}

void runs_a_report_and_applies_a_pareto_point(Sitting& at) {
    at.window->click("tabs/Accuracy and cost");
    at.window->choose("Accuracy and cost/stage", "culling");
    at.window->choose("Accuracy and cost/repeats", "1 repeat");
    at.window->click("Accuracy and cost/measure");
    const Seen seen = at.window->look();
    EXPECT_THAT(seen.said("Accuracy and cost/summary"), HasSubstr("of culling"));
    // It takes no time and errs in nothing.
    EXPECT_NE(seen.said("Accuracy and cost/table/none/front"), " ");
    EXPECT_THAT(seen.said("Accuracy and cost/plot/points/none/0"), HasSubstr("nothing is both more accurate and cheaper"));
    EXPECT_THAT(seen.command, Not(HasSubstr("culling")));
    at.window->click("Accuracy and cost/plot/points/none/0");
    EXPECT_THAT(at.window->look().command, HasSubstr("--use culling/none"));
    EXPECT_EQ(at.window->seen().said("Techniques/culling/technique"), "none");
    at.window->click("tabs/Image");
    at.expect_image();
}

void keeps_the_picture_where_a_shader_is_broken(Sitting& at) {
    const std::string command = at.copied_command();
    at.shaders.change(film, "void main", "void  main(; void main");
    at.window->key("r");
    EXPECT_THAT(at.window->look().said("top/shaders"), HasSubstr("shader error"));
    at.window->click("tabs/Log");
    at.window->look();
    EXPECT_THAT(at.window->seen().tree(), HasSubstr(fmt::format("film.comp:{}", line_of(at.shaders.text(film), "void  main"))));
    at.window->click("tabs/Counters");
    at.expect_picture("Image/picture", command);
    at.shaders.restore(film);
    at.window->key("r");
    EXPECT_FALSE(at.window->look().has("top/shaders"));
    at.expect_image();
}

void undoes(Sitting& at) {
    at.window->key("ctrl+z");
    EXPECT_THAT(at.window->look().command, Not(HasSubstr("culling")));
    at.expect_image();
    at.window->key("ctrl+z");
    EXPECT_THAT(at.window->look().command, Not(HasSubstr("--set"))) << "a drag is one step";
    at.expect_image();
}

void saves(Sitting& at) {
    const std::string command = at.copied_command();
    at.window->key("F12");
    at.window->look();
    const std::filesystem::path stem = folder() / "smoke_grenade_0_display";
    EXPECT_EQ(must(read_png(stem.string() + ".png")).texels, at.headless_picture(command).texels);
    EXPECT_EQ(must(read_exr(stem.string() + ".exr")).at("display").texels,
              must(read_exr(at.headless_file(command, "exr"))).at("display").texels);
    std::ifstream file(stem.string() + ".json");
    EXPECT_EQ(nlohmann::json::parse(file)["strata.command"], command);
    at.expect_image();
}

void takes_what_is_dropped(Sitting& at) {
    const std::filesystem::path notes = folder() / "notes.txt", other = folder() / "another capture.strata";
    std::ofstream(notes) << "no capture";
    const Seen before = at.window->look();
    const auto [x, y] = at.on_screen("Image/picture", 0, 0);
    drop_file(notes, "Strata", x, y);
    const auto is_refused = [](const Seen& seen) { return seen.has("status/refused"); };
    EXPECT_THAT(at.window->look_until(is_refused).said("status/refused"), HasSubstr("notes.txt"));
    EXPECT_EQ(at.window->seen().command, before.command) << "what was open stays";
    const Finished recorded =
        strata(fmt::format("record glass_and_smoke -o '{}' --size {}x{}", other.string(), picture_width, picture_height));
    ASSERT_EQ(recorded.code, 0) << recorded.err;
    drop_file(other, "Strata", x, y);
    const auto is_another = [](const Seen& seen) { return seen.title.starts_with("another capture.strata"); };
    EXPECT_THAT(at.window->look_until(is_another).title, StartsWith("another capture.strata, frame 0"));
    EXPECT_FALSE(at.window->seen().at("top/undo").enabled);
    at.shown = "another capture";
    at.window->click("Image/100 %");
    at.expect_image();
}

void closes(Sitting& at) {
    EXPECT_EQ(at.window->close(), 0);
    std::ifstream file(folder() / "state" / "strata" / "inspector.json");
    const auto layout = nlohmann::json::parse(file);
    EXPECT_EQ(layout["width"], width);
    EXPECT_EQ(layout["height"], height);
}

TEST(InspectorWindow, ShowsOnTheScreenWhatASessionOfMouseAndKeysDoes) {
    constexpr std::pair<const char*, void (*)(Sitting&)> steps[] = {
        {"opens a capture", opens_a_capture},
        {"changes a technique", changes_a_technique},
        {"drags a slider", drags_a_slider},
        {"pins a pixel", pins_a_pixel},
        {"wipes and flips", wipes_and_flips},
        {"runs a report and applies a Pareto point", runs_a_report_and_applies_a_pareto_point},
        {"keeps the picture where a shader is broken", keeps_the_picture_where_a_shader_is_broken},
        {"undoes", undoes},
        {"saves", saves},
        {"takes what is dropped", takes_what_is_dropped},
        {"closes", closes},
    };
    Sitting at;
    for (const auto& [name, step] : steps) {
        try {
            step(at);
        } catch (const std::exception& problem) {
            ADD_FAILURE() << problem.what();
        }
        const Seen& seen = at.window->seen();
        ASSERT_FALSE(HasFailure()) << name << "; the window said last:\n" << seen.tree();
        fmt::print("{}: {:.0f} frames a second while something was computed, the slowest took {:.0f} ms\n", name,
                   seen.frames_per_second, seen.slowest_frame_ms);
    }
}

/// Xlib would end the process with exit code 1, which is that of a comparison that failed.
TEST(InspectorWindow, SaysThatItsDisplayIsGone) {
    ASSERT_EQ(strata("record three_panes -o panes.strata --size 64x36").code, 0);
    pid_t inspector = 0;
    {
        const Screen screen(640, 480);
        inspector = start(STRATA_BINARY_DIR "/strata", "inspect panes.strata", "said.txt");
        screen.hand("search --sync --onlyvisible --name panes");
    }
    EXPECT_EQ(code_of(inspector), 5);
    EXPECT_THAT(file_text(folder() / "said.txt"), HasSubstr("the display is gone"));
}

}  // namespace
}  // namespace strata
