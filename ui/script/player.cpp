// The hands of a script: see script.h.
#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "capture_format/container/whole_file.h"
#include "capture_format/nearest_name.h"
#include "replay/images/image_io.h"
#include "replay/standard_streams.h"
#include "ui/script/script.h"
#include "ui/widget_tree.h"
#include "ui/window/keys.h"

namespace strata::ui {
namespace {

constexpr float frame_seconds = 1.0f / 60;
// A frame of an image of a million samples takes a minute on a CPU driver, a truth in doubles several.
constexpr std::chrono::minutes patience(20);
// A slider has at most so many pixels: halving as often finds the one.
constexpr int halvings = 14;

void let_go(ImGuiIO& io) {
    io.KeyCtrl = io.KeyShift = io.KeyAlt = false;
    std::ranges::fill(io.KeysDown, false);
    std::ranges::fill(io.MouseDown, false);
    io.MouseWheel = 0;
}

}  // namespace

Player::Player(Inspector& inspector, ImguiLayer& layer, ImVec2 size) : inspector_(&inspector), layer_(&layer) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = size;
    io.DeltaTime = frame_seconds;
    io.MousePos = {-1000, -1000};
}

/// Nobody looks at most of a script's frames, and on a CPU driver a drawn one takes from the replay what it is waited for: only
/// shot() and picture() draw.
Result<void> Player::frames(int count) {
    for (int i = 0; i < count; ++i) {
        ImGui::GetIO().DeltaTime = frame_seconds;
        inspector_->frame();
        ImGui::GetIO().MouseWheel = 0;
    }
    return {};
}

Result<Picture> Player::picture() {
    if (const auto drawn = inspector_->render(); !drawn) return drawn.error();
    return layer_->read_back();
}

Result<void> Player::wait() {
    const auto begin = std::chrono::steady_clock::now();
    // Twice settled: what arrived in one frame may make a panel ask for more in the next.
    for (int settled = 0; settled < 3;) {
        if (const auto done = frames(1); !done) return done;
        settled = inspector_->is_settled() ? settled + 1 : 0;
        if (settled == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        if (std::chrono::steady_clock::now() - begin > patience)
            return fail(Fault::device_failed, "script.not_settled", "the inspector is still busy after {minutes} minutes",
                        patience.count());
    }
    return {};
}

/// Scrolls to the widget where it is out of sight.
Result<WidgetRecord> Player::reach(const std::string& path) {
    Widgets& widgets = inspector_->widgets();
    if (widgets.records().empty())
        if (const auto done = frames(2); !done) return done.error();
    for (int tries = 0; tries < 3; ++tries) {
        const auto& records = widgets.records();
        const auto found = std::ranges::find(records, path, &WidgetRecord::path);
        if (found == records.end()) break;
        if (found->visible) return *found;
        widgets.reveal(path);
        if (const auto done = frames(2); !done) return done.error();
    }
    std::vector<std::string_view> known;
    for (const WidgetRecord& record : widgets.records()) known.push_back(record.path);
    const bool is_there = std::ranges::find(known, path) != known.end();
    if (is_there) return fail(Fault::usage, "script.out_of_sight", "'{widget}' is out of sight", path);
    return fail(Fault::usage, "script.unknown_widget", "there is no widget '{widget}'{suggestion}", path,
                did_you_mean(path, known));
}

Result<void> Player::press_at(ImVec2 at) {
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = at;
    if (const auto done = frames(2); !done) return done;
    io.MouseDown[0] = true;
    if (const auto done = frames(1); !done) return done;
    io.MouseDown[0] = false;
    // Longer than a double click's two presses may be apart, so that two clicks are two clicks.
    return frames(1 + static_cast<int>(io.MouseDoubleClickTime / frame_seconds) + 1);
}

Result<void> Player::click(const std::string& path) {
    const auto widget = reach(path);
    if (!widget) return widget.error();
    if (!widget->enabled) return fail(Fault::usage, "script.disabled", "'{widget}' is disabled", path);
    // A tree's row is clicked on its name, and opened by its arrow.
    const bool is_row = widget->kind == WidgetKind::tree;
    const float x = is_row ? widget->from.x + 30 : (widget->from.x + widget->to.x) / 2;
    return press_at({x, (widget->from.y + widget->to.y) / 2});
}

Result<void> Player::choose(const std::string& path, const std::string& item) {
    if (const auto opened = click(path); !opened) return opened;
    return click(fmt::format("{}/{}", path, item));
}

Result<void> Player::drag(const std::string& path, double value) {
    const auto widget = reach(path);
    if (!widget) return widget.error();
    if (widget->kind != WidgetKind::slider) return fail(Fault::usage, "script.not_a_slider", "'{widget}' is not a slider", path);
    if (value < widget->low || value > widget->high)
        return fail(Fault::usage, "script.out_of_range", "'{widget}' goes from {low:g} to {high:g}, not to {value:g}", path,
                    widget->low, widget->high, value);
    ImGuiIO& io = ImGui::GetIO();
    const float y = (widget->from.y + widget->to.y) / 2;
    float low = widget->from.x, high = widget->to.x, nearest = low;
    double off = std::numeric_limits<double>::infinity();
    io.MousePos = {(low + high) / 2, y};
    if (const auto done = frames(2); !done) return done;
    io.MouseDown[0] = true;
    // By looking at what it says, as a hand does: its scale need not be known here.
    for (int i = 0; i < halvings; ++i) {
        io.MousePos.x = (low + high) / 2;
        if (const auto done = frames(2); !done) return done;
        const auto now = std::ranges::find(inspector_->widgets().records(), path, &WidgetRecord::path);
        if (now == inspector_->widgets().records().end())
            return fail(Fault::usage, "script.widget_gone", "'{widget}' is no longer shown", path);
        if (std::abs(now->number - value) < off) {
            off = std::abs(now->number - value);
            nearest = io.MousePos.x;
        }
        if (off == 0) break;
        (now->number < value ? low : high) = io.MousePos.x;
    }
    io.MousePos.x = nearest;
    if (const auto done = frames(2); !done) return done;
    io.MouseDown[0] = false;
    return frames(2);
}

Result<void> Player::pull(float x, float y) {
    ImGuiIO& io = ImGui::GetIO();
    const ImVec2 from = io.MousePos;
    io.MouseDown[0] = true;
    if (const auto done = frames(1); !done) return done;
    for (int i = 1; i <= 8; ++i) {
        io.MousePos = {from.x + x * static_cast<float>(i) / 8, from.y + y * static_cast<float>(i) / 8};
        if (const auto done = frames(1); !done) return done;
    }
    io.MouseDown[0] = false;
    return frames(2);
}

Result<void> Player::type(const std::string& path, const std::string& text) {
    const auto widget = reach(path);
    if (!widget) return widget.error();
    if (widget->kind != WidgetKind::slider && widget->kind != WidgetKind::input)
        return fail(Fault::usage, "script.takes_no_text", "'{widget}' takes no text", path);
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = widget->kind == WidgetKind::slider;
    if (const auto done = press_at({(widget->from.x + widget->to.x) / 2, (widget->from.y + widget->to.y) / 2}); !done)
        return done;
    io.KeyCtrl = false;
    if (const auto done = key("ctrl+a"); !done) return done;
    if (text.empty())
        if (const auto done = key("delete"); !done) return done;
    io.AddInputCharactersUTF8(text.c_str());
    if (const auto done = frames(2); !done) return done;
    return key("enter");
}

Result<void> Player::key(const std::string& name) {
    const auto chord = chord_of(name);
    if (!chord) return fail(Fault::usage, "script.unknown_key", "there is no key '{key}'", name);
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = chord->ctrl;
    io.KeyShift = chord->shift;
    io.KeyAlt = chord->alt;
    io.KeysDown[chord->key] = true;
    if (const auto done = frames(1); !done) return done;
    let_go(io);
    return frames(2);
}

Result<void> Player::move(const std::string& path, float x, float y) {
    const auto widget = reach(path);
    if (!widget) return widget.error();
    ImGui::GetIO().MousePos = {widget->from.x + x * (widget->to.x - widget->from.x),
                               widget->from.y + y * (widget->to.y - widget->from.y)};
    return frames(2);
}

Result<void> Player::wheel(float steps) {
    ImGui::GetIO().MouseWheel = steps;
    return frames(2);
}

Result<void> Player::expect(const std::string& path, const std::string& text) const {
    const auto& records = inspector_->widgets().records();
    const auto found = std::ranges::find(records, path, &WidgetRecord::path);
    if (found == records.end()) {
        std::vector<std::string_view> known;
        for (const WidgetRecord& record : records) known.push_back(record.path);
        return fail(Fault::over_tolerance, "script.expected_widget_missing", "there is no widget '{widget}'{suggestion}", path,
                    did_you_mean(path, known));
    }
    if (found->value.find(text) != std::string::npos) return {};
    return fail(Fault::over_tolerance, "script.unexpected_text", "'{widget}' shows '{text}', not '{expected}'", path,
                found->value, text);
}

Result<void> Player::shot(const std::filesystem::path& path) {
    return this->picture().and_then([&](auto& picture) {
        const auto written = write_png(path, Extent{picture.width, picture.height, 1}, picture.rgb);
        if (written) to_stderr("wrote {}\n", path.filename().string());
        return written;
    });
}

Result<void> Player::tree(const std::filesystem::path& path) const { return write_whole_file(path, widget_tree(*inspector_)); }

}  // namespace strata::ui
