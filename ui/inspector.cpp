#include "ui/inspector.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"
#include "passes/scene/scene_facts.h"
#include "replay/error_text.h"
#include "replay/plural.h"
#include "ui/frame/frame_rows.h"
#include "ui/widget_tree.h"
#include "ui/widgets/keys_list.h"
#include "ui/window/keys.h"

namespace strata::ui {
namespace {

constexpr float splitter_width = 5, least_region = 80;
constexpr double refusal_seconds = 10;

/// The keys that are no panel's.
struct OwnKey {
    std::string_view chord, help;
};
constexpr OwnKey own_keys[] = {
    {"f1", "these keys"},
    {"ctrl+z", "undo"},
    {"ctrl+y", "redo"},
    {"pageup", "the frame before"},
    {"pagedown", "the next frame"},
    {"ctrl+g", "go to a pixel"},
    {"r", "compile changed shaders and use them"},
    {"home", "back to the recorded eye"},
    {"shift+f12", "save the whole window as PNG and its widgets as JSON"},
    {"ctrl+q", "close the window"},
};

/// What a line of the status has room for; the log has it all.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

bool is_down(std::string_view chord, WhileHeld held = WhileHeld::once) { return is_pressed(*chord_of(chord), held); }

}  // namespace

Inspector::Inspector(ImguiLayer& layer, Model model, Replayer::Open open, Layout layout)
    : layer_(&layer),
      model_(std::move(model)),
      layout_(std::move(layout)),
      replayer_(std::make_unique<Replayer>(std::move(open))),
      host_(std::make_unique<WorkQueue>()) {
    for (const PanelRow& row : panels()) panels_.push_back({&row, row.make()});
    layer_->begin();
    last_outputs_ = model_.request().outputs;
    wish_for_the_picture();
}

Inspector::~Inspector() = default;

Services Inspector::services() { return {widgets_, *replayer_, *host_, *layer_, log_, layout_.settings, seconds_}; }

void Inspector::say(LogLine::Kind kind, std::string text) { log_.push_back({kind, seconds_, std::move(text)}); }

void Inspector::say_what_was_opened(const CaptureFacts& facts) {
    say(LogLine::Kind::said,
        fmt::format("opened {} with {} on {} ({} {})", model_.capture.filename().string(), plural(facts.frames, "frame"),
                    facts.device.name, facts.device.driver, facts.device.driver_version));
    for (const std::string& sentence : facts.left_out) say(LogLine::Kind::warned, sentence);
}

void Inspector::refuse(const Error& error) {
    say(LogLine::Kind::failed, error.sentence);
    refusal_ = error.sentence;
    refusal_ends_ = seconds_ + refusal_seconds;
}

void Inspector::take_results() {
    const bool was_open = replayer_->facts() != nullptr;
    replayer_->take_results();
    if (const CaptureFacts* facts = replayer_->facts(); facts && !was_open) say_what_was_opened(*facts);
    const Error* error = replayer_->open_error() ? replayer_->open_error() : replayer_->error("A");
    const std::string sentence = error ? error->sentence : "";
    if (!sentence.empty() && sentence != last_error_) say(LogLine::Kind::failed, sentence);
    last_error_ = sentence;
    last_id_ = error ? id_text(*error) : "";
    Services all = services();
    shader_reload_.take_result(model_, all);
    save_window_.take_results(all);
    const auto replay = replayer_->shown("A");
    if (!replay || replay == last_replay_) return;
    say_what_was_replayed(*replay);
    last_replay_ = replay;
    model_.know(replay->frame);
}

/// Nothing where it only has other images than the replay before and so says the same of the last change.
void Inspector::say_what_was_replayed(const Replay& replay) {
    const bool is_change = !last_replay_ || last_replay_->change != replay.change;
    const std::string executed = executed_text(frame_rows(replay, nullptr));
    if (!is_change && executed == last_executed_) return;
    last_executed_ = executed;
    if (is_change)
        for (const std::string& note : replay.run.notes) say(LogLine::Kind::warned, note);
    say(LogLine::Kind::said,
        fmt::format("replayed frame {} in {:.1f} ms: {}", replay.request.variant.frame, replay.ms, executed));
}

void Inspector::wish_for_the_picture() {
    Request request = model_.request();
    request.outputs = last_outputs_;  // which images are wanted is known once every panel was drawn
    replayer_->show("A", request);
}

void Inspector::frame() {
    const auto passed = static_cast<double>(ImGui::GetIO().DeltaTime);
    seconds_ += passed;
    if (was_busy_) frame_rate_.add(passed);
    take_results();
    model_.begin_frame();
    widgets_.begin_frame();
    layer_->begin_frame();
    ImGui::NewFrame();
    press_keys();
    draw();
    if (!ImGui::IsAnyItemActive()) model_.settle();
    ImGui::Render();
    last_outputs_ = model_.request().outputs;
    replayer_->show("A", model_.request());
    was_busy_ = !is_settled();
    if (std::exchange(saves_window_, false)) save_window();
}

void Inspector::save_window() {
    if (const auto drawn = render(); drawn) save_window_.start(*host_, layer_->read_back(), widget_tree(*this));
    else say(LogLine::Kind::failed, drawn.error().sentence);
}

bool Inspector::is_settled() const {
    if (replayer_->open_error()) return true;
    const bool shows = replayer_->is_current("A") && replayer_->shown("A") == last_replay_;
    const bool busy = std::ranges::any_of(panels_, [](const Shown& shown) { return shown.panel->is_busy(); });
    return shows && !busy && !shader_reload_.is_busy() && replayer_->is_idle() && host_->is_idle();
}

std::string Inspector::title() const {
    const CaptureFacts* facts = replayer_->facts();
    return fmt::format("{}, frame {} \xe2\x80\x93 Strata on {}", model_.capture.filename().string(), model_.edits().variant.frame,
                       facts ? facts->device.name : "...");
}

void Inspector::press_keys() {
    if (is_down("f1")) keys_are_shown_ = !keys_are_shown_;
    if (keys_are_shown_ && is_down("escape")) keys_are_shown_ = false;
    if (is_down("ctrl+z", WhileHeld::repeats)) model_.undo();
    if (is_down("ctrl+y", WhileHeld::repeats)) model_.redo();
    const std::size_t frame = model_.edits().variant.frame, count = replayer_->facts() ? replayer_->facts()->frames : 1;
    if (is_down("pageup", WhileHeld::repeats) && frame > 0) model_.select_frame(frame - 1);
    if (is_down("pagedown", WhileHeld::repeats) && frame + 1 < count) model_.select_frame(frame + 1);
    if (is_down("ctrl+g")) go_to_pixel_.open();
    if (is_down("shift+f12")) saves_window_ = true;
    if (is_down("ctrl+q")) is_closing_ = true;
    // With the right button held they fly (ui/picture/camera.h).
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Right)) press_panel_keys();
}

void Inspector::press_panel_keys() {
    if (is_down("r")) shader_reload_.start(model_, *replayer_);
    if (is_down("home")) model_.look_from({});
    Services all = services();
    for (Shown& shown : panels_)
        for (const PanelKey& key : shown.panel->keys())
            if (is_down(key.chord, key.held)) key.pressed(*shown.panel, model_, all);
}

void Inspector::draw() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    ImGui::Begin("inspector", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar(2);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
    const float bar = ImGui::GetFrameHeight() + 10;
    const float status = ImGui::GetFrameHeight();
    draw_top_bar();
    ImGui::SetCursorPos({0, bar});
    draw_regions({size.x, std::max(100.0f, size.y - bar - status)});
    ImGui::SetCursorPos({8, size.y - status + 2});
    draw_status();
    ImGui::PopStyleVar();
    ImGui::End();
    if (keys_are_shown_) draw_keys();
    const glm::uvec2 extent = last_replay_ ? glm::uvec2(last_replay_->run.width, last_replay_->run.height) : glm::uvec2(0);
    go_to_pixel_.draw(model_, widgets_, extent);
}

void Inspector::draw_top_bar() {
    const auto scope = widgets_.in("top");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {8, 4});
    ImGui::SetCursorPos({10, 5});
    ImGui::AlignTextToFramePadding();
    widgets_.text("capture", model_.capture.filename().string(), &palette().accent);
    ImGui::SameLine(0, 16);
    draw_frame_choice();
    ImGui::SameLine(0, 16);
    ImGui::BeginDisabled(!model_.can_undo());
    if (widgets_.button("undo", "\xe2\x86\xb6 Undo")) model_.undo();
    ImGui::EndDisabled();
    widgets_.help("Ctrl+Z");
    ImGui::SameLine();
    ImGui::BeginDisabled(!model_.can_redo());
    if (widgets_.button("redo", "\xe2\x86\xb7 Redo")) model_.redo();
    ImGui::EndDisabled();
    widgets_.help("Ctrl+Y");
    ImGui::SameLine(0, 16);
    draw_activity();
    ImGui::SameLine(0, 16);
    shader_reload_.draw(widgets_);
    const CaptureFacts* facts = replayer_->facts();
    const std::string device = facts ? facts->device.name : "opening";
    const float right = ImGui::CalcTextSize(device.c_str()).x + ImGui::CalcTextSize("Keys").x + 48;
    ImGui::SameLine(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowWidth() - right));
    widgets_.text("device", device, &palette().dim);
    ImGui::SameLine();
    if (widgets_.button("keys", "Keys")) keys_are_shown_ = !keys_are_shown_;
    widgets_.help("F1");
    ImGui::PopStyleVar();
}

void Inspector::draw_frame_choice() {
    const std::size_t count = replayer_->facts() ? replayer_->facts()->frames : 1;
    const std::string range_text = count < 2 ? "frame 0" : fmt::format("frame (0 to {})", count - 1);
    widgets_.text("frame text", range_text, &palette().dim);
    if (count < 2) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(140);
    const SliderRange range{.high = static_cast<double>(count - 1), .whole = true};
    if (const auto frame = widgets_.slider("frame", static_cast<double>(model_.edits().variant.frame), range))
        model_.select_frame(static_cast<std::size_t>(*frame));
}

void Inspector::draw_activity() {
    const bool current = replayer_->is_current("A") || replayer_->open_error();
    if (!current) {
        constexpr const char* phases[] = {"\xe2\x97\x90", "\xe2\x97\x93", "\xe2\x97\x91", "\xe2\x97\x92"};
        widgets_.text("activity", fmt::format("{} replaying", phases[static_cast<std::size_t>(seconds_ * 6) % 4]),
                      &palette().warning);
    } else if (const auto replay = replayer_->shown("A")) {
        widgets_.text("activity",
                      fmt::format("{} x {}, {}", replay->run.width, replay->run.height, plural(replay->run.samples, "sample")),
                      &palette().dim);
    } else {
        widgets_.text("activity", "", &palette().dim);
    }
    widgets_.help(text(frame_rate_));
}

void Inspector::draw_regions(ImVec2 size) {
    // What a person pulled stays known while the window is too small for it.
    const auto fitting = [](float wanted, float most) { return std::clamp(wanted, least_region, std::max(least_region, most)); };
    const float left = fitting(layout_.left, size.x / 2 - least_region),
                right = fitting(layout_.right, size.x / 2 - least_region);
    const float bottom = fitting(layout_.bottom, size.y * .7f);
    const float center = size.x - left - right - 2 * splitter_width;
    const float upper = size.y - bottom - splitter_width;
    const auto pull = [](float& kept, float shown, float by) {
        if (by != 0) kept = shown + by;
    };
    draw_region(Area::left, {left, size.y});
    ImGui::SameLine();
    pull(layout_.left, left, splitter("left edge", {splitter_width, size.y}, ImGuiMouseCursor_ResizeEW));
    ImGui::SameLine();
    ImGui::BeginGroup();
    draw_region(Area::center, {center, upper});
    pull(layout_.bottom, bottom, -splitter("bottom edge", {center, splitter_width}, ImGuiMouseCursor_ResizeNS));
    draw_region(Area::bottom, {center, bottom});
    ImGui::EndGroup();
    ImGui::SameLine();
    pull(layout_.right, right, -splitter("right edge", {splitter_width, size.y}, ImGuiMouseCursor_ResizeEW));
    ImGui::SameLine();
    draw_region(Area::right, {right, size.y});
}

float Inspector::splitter(std::string_view name, ImVec2 size, ImGuiMouseCursor cursor) {
    const auto scope = widgets_.in("layout");
    widgets_.canvas(name, size);
    const bool held = ImGui::IsItemActive();
    if (held || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(cursor);
        ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                                  packed(palette().accent, held ? .8f : .4f));
    }
    if (!held) return 0;
    return cursor == ImGuiMouseCursor_ResizeEW ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y;
}

void Inspector::draw_region(Area area, ImVec2 size) {
    constexpr const char* names[] = {"left", "center", "right", "bottom"};
    const char* name = names[static_cast<std::size_t>(area)];
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8, 6});
    ImGui::BeginChild(
        name, size, false,
        ImGuiWindowFlags_AlwaysUseWindowPadding | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {7, 5});
    if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll)) {
        for (Shown& shown : panels_) {
            if (shown.row->area != area) continue;
            const std::string label(shown.row->name);
            const bool selected = ImGui::BeginTabItem(label.c_str());
            {
                const auto scope = widgets_.in("tabs");
                widgets_.tab(label, selected);
            }
            widgets_.help(shown.row->help);
            if (!selected) continue;
            wish_for_the_picture();
            ImGui::BeginChild("panel");
            Services all = services();
            shown.panel->draw(model_, all);
            ImGui::EndChild();
            ImGui::EndTabItem();
        }
        ImGui::EndTabBar();
    }
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

void Inspector::draw_status() {
    const auto scope = widgets_.in("status");
    if (seconds_ < refusal_ends_) {
        widgets_.text("refused", first_line(refusal_), &palette().bad);
        return;
    }
    if (!last_error_.empty()) {
        const bool has_good = last_replay_ != nullptr;
        widgets_.text(
            "error",
            fmt::format("{}{}", first_line(last_error_), has_good ? "  (what is shown is the last replay that worked)" : ""),
            &palette().bad);
        widgets_.help(last_id_);
        return;
    }
    widgets_.text("command", model_.command_line(), &palette().dim);
    widgets_.help("replays exactly this without the inspector");
}

void Inspector::draw_keys() {
    std::vector<KeySection> sections = {{"Everywhere", {}}, mouse_gestures()};
    for (const OwnKey& key : own_keys) sections.front().rows.push_back({key.chord, key.help});
    for (const Shown& shown : panels_) {
        KeySection& section = sections.emplace_back(KeySection{shown.row->name, {}});
        for (const PanelKey& key : shown.panel->keys()) section.rows.push_back({key.chord, key.help});
    }
    draw_keys_list(widgets_, sections);
}

}  // namespace strata::ui
