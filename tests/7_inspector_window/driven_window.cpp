#include "tests/7_inspector_window/driven_window.h"

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/images/image_io.h"
#include "tests/7_tool/process.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using Clock = std::chrono::steady_clock;

// A report on a busy machine.
constexpr std::chrono::minutes patience(5);
// A key that is not answered for so long was lost.
constexpr std::chrono::seconds answer_time(10);

Seen seen_in(const std::filesystem::path& stem) {
    std::ifstream file(stem.string() + ".json");
    const auto json = nlohmann::json::parse(file);
    Seen seen{.title = json["title"],
              .command = json["command"],
              .settled = json["settled"],
              .frames_per_second = json["frames_per_second"],
              .slowest_frame_ms = json["slowest_frame_ms"],
              .widgets = {},
              .picture = must(read_png(stem.string() + ".png"))};
    for (const auto& each : json["widgets"])
        seen.widgets.push_back({.path = each["path"],
                                .kind = each["kind"],
                                .value = each["value"],
                                .from_x = each["from"][0],
                                .from_y = each["from"][1],
                                .to_x = each["to"][0],
                                .to_y = each["to"][1],
                                .enabled = each["enabled"],
                                .visible = each["visible"]});
    return seen;
}

}  // namespace

Box SeenWidget::box() const {
    return {static_cast<int>(std::lround(from_x)), static_cast<int>(std::lround(from_y)), static_cast<int>(std::lround(to_x)),
            static_cast<int>(std::lround(to_y))};
}

bool Seen::has(std::string_view path) const { return std::ranges::find(widgets, path, &SeenWidget::path) != widgets.end(); }

const SeenWidget& Seen::at(std::string_view path) const {
    const auto found = std::ranges::find(widgets, path, &SeenWidget::path);
    if (found == widgets.end()) throw std::runtime_error(fmt::format("there is no widget '{}'", path));
    return *found;
}

std::string Seen::tree() const {
    std::string text = fmt::format("{}{}\n{}\n", title, settled ? "" : ", not settled", command);
    for (const SeenWidget& each : widgets)
        text += fmt::format("{} {}{}{}: {}\n", each.kind, each.path, each.enabled ? "" : ", disabled",
                            each.visible ? "" : ", out of sight", each.value);
    return text;
}

DrivenWindow::DrivenWindow(const Screen& screen, const std::string& arguments)
    : screen_(&screen), folder_(folder()), process_(start(STRATA_BINARY_DIR "/strata", "inspect " + arguments, "inspector.txt")) {
    screen.hand("search --sync --onlyvisible --name Strata");
}

DrivenWindow::~DrivenWindow() {
    if (process_ == 0) return;
    kill(process_, SIGKILL);
    code_of(process_);
}

/// Whether Shift+F12 was answered.
bool DrivenWindow::save() const {
    const std::filesystem::path stem = folder_ / "strata_window";
    for (const char* extension : {".png", ".json"}) std::filesystem::remove(stem.string() + extension);
    key("shift+F12");
    for (const auto end = Clock::now() + answer_time; Clock::now() < end;) {
        if (std::filesystem::exists(stem.string() + ".json")) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
}

/// Settled twice: the first time it may not know yet what it was just told.
Seen DrivenWindow::look() {
    const auto end = Clock::now() + patience;
    for (int settled = 0; settled < 2;) {
        if (Clock::now() > end) throw std::runtime_error("the window does not settle");
        if (!save()) continue;
        seen_ = seen_in(folder_ / "strata_window");
        settled = seen_.settled ? settled + 1 : 0;
        if (!seen_.settled) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return seen_;
}

Seen DrivenWindow::look_until(const std::function<bool(const Seen&)>& is_there) {
    const auto end = Clock::now() + patience;
    while (!is_there(look()) && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return seen_;
}

SeenWidget DrivenWindow::reach(const std::string& path) {
    for (int turn = 0; turn < 40; ++turn) {
        const SeenWidget widget = look().at(path);
        if (widget.visible) return widget;
        const auto height = static_cast<float>(seen_.picture.shape.extent.height);
        const bool is_below = widget.from_y > height / 2;
        screen_->hand(fmt::format("mousemove {} {} click {}", widget.box().middle_x(), height / 2, is_below ? 5 : 4));
    }
    throw std::runtime_error(fmt::format("'{}' stays out of sight", path));
}

void DrivenWindow::click_at(double x, double y) const {
    screen_->hand(fmt::format("mousemove {:.0f} {:.0f} sleep 0.05 click 1", std::floor(x), std::floor(y)));
}

void DrivenWindow::click(const std::string& path) {
    const SeenWidget widget = reach(path);
    if (!widget.enabled) throw std::runtime_error(fmt::format("'{}' is disabled", path));
    click_at((double{widget.from_x} + double{widget.to_x}) / 2, (double{widget.from_y} + double{widget.to_y}) / 2);
}

void DrivenWindow::choose(const std::string& path, const std::string& item) {
    click(path);
    click(fmt::format("{}/{}", path, item));
}

void DrivenWindow::drag(double from_x, double from_y, double to_x, double to_y) const {
    screen_->hand(
        fmt::format("mousemove {:.0f} {:.0f} sleep 0.1 mousedown 1 sleep 0.1 mousemove {:.0f} {:.0f} sleep 0.1 "
                    "mousemove {:.0f} {:.0f} sleep 0.1 mouseup 1",
                    from_x, from_y, (from_x + to_x) / 2, (from_y + to_y) / 2, to_x, to_y));
}

void DrivenWindow::key(const std::string& name) const { screen_->hand("key " + name); }

void DrivenWindow::rest_mouse() {
    for (const SeenWidget& each : seen_.widgets)
        if (each.kind == "canvas" && each.path.ends_with("/picture"))
            return screen_->hand(fmt::format("mousemove {} {}", each.box().right - 4, each.box().bottom - 4));
}

int DrivenWindow::close() {
    key("ctrl+q");
    return code_of(std::exchange(process_, 0));
}

}  // namespace strata
