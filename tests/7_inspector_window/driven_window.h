// The inspector in a real window, and who sits before it: sees by Shift+F12, uses mouse and keys.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/7_inspector_window/screen.h"

namespace strata {

/// Pixels from..to of the window; `to` is beyond.
struct Box {
    int left = 0, top = 0, right = 0, bottom = 0;
    bool contains(int x, int y) const { return x >= left && x < right && y >= top && y < bottom; }
    int middle_x() const { return (left + right) / 2; }
    int middle_y() const { return (top + bottom) / 2; }
};

struct SeenWidget {
    std::string path, kind, value;
    float from_x = 0, from_y = 0, to_x = 0, to_y = 0;
    bool enabled = false, visible = false;
    Box box() const;
};

/// The window at one moment.
struct Seen {
    std::string title, command;
    bool settled = false;
    double frames_per_second = 0, slowest_frame_ms = 0;
    std::vector<SeenWidget> widgets;
    HostImage picture;

    bool has(std::string_view path) const;
    /// Throws where there is none.
    const SeenWidget& at(std::string_view path) const;
    std::string said(std::string_view path) const { return at(path).value; }
    /// A line per widget.
    std::string tree() const;
};

class DrivenWindow {
public:
    /// `strata inspect` with these arguments, in the test's folder.
    DrivenWindow(const Screen&, const std::string& arguments);
    DrivenWindow(const DrivenWindow&) = delete;
    ~DrivenWindow();

    /// Once nothing is being computed.
    Seen look();
    /// Looks until something is seen that comes from outside the window, such as a dropped file: it can arrive long after the
    /// window has settled. Gives what was seen last.
    Seen look_until(const std::function<bool(const Seen&)>& is_there);
    /// What look() saw last.
    const Seen& seen() const { return seen_; }

    /// Scrolls to it.
    SeenWidget reach(const std::string& path);
    void click(const std::string& path);
    void click_at(double x, double y) const;
    void choose(const std::string& path, const std::string& item);
    /// With the button held, from one place to another.
    void drag(double from_x, double from_y, double to_x, double to_y) const;
    /// As xdotool names it: "ctrl+z".
    void key(const std::string& name) const;
    /// Where the mouse hides nothing.
    void rest_mouse();
    /// What is left to be known after Ctrl+Q: the exit code.
    int close();

private:
    bool save() const;

    const Screen* screen_;
    std::filesystem::path folder_;
    pid_t process_ = 0;
    Seen seen_;
};

}  // namespace strata
