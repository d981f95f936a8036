#include "ui/widgets/widgets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <imgui_stdlib.h>

namespace strata::ui {
namespace {

constexpr float seconds_to_help = .4f;
// A hand that presses moves so many pixels.
constexpr float hand = 4;
constexpr ImU32 veil = IM_COL32(14, 15, 18, 158);

std::string id_of(std::string_view label, std::string_view face) {
    return face.empty() ? std::string(label) : fmt::format("{}###{}", face, label);
}

std::string hidden(std::string_view label) { return fmt::format("##{}", label); }

std::string as_text(double value, const SliderRange& range) {
    std::array<char, 64> text{};
    // The format is one of the program's own.
    if (range.whole) return fmt::format("{}", static_cast<long long>(value));
    std::snprintf(text.data(), text.size(), range.format, value);
    return text.data();
}

}  // namespace

std::string_view name(WidgetKind kind) {
    constexpr std::array<std::string_view, 12> names = {"button",     "checkbox", "combo", "choice", "slider", "input",
                                                        "selectable", "tree",     "tab",   "text",   "canvas", "point"};
    return names[static_cast<std::size_t>(kind)];
}

void Widgets::begin_frame() {
    last_ = std::exchange(records_, {});
    words_on_veils_.clear();
    path_.clear();
    if (!rest_.seen) rest_ = {};
    rest_.seen = false;
    const ImVec2 at = ImGui::GetIO().MousePos;
    if (ImGui::IsAnyMouseDown()) pressed_at_ = at;
    else if (pressed_at_ && std::hypot(at.x - pressed_at_->x, at.y - pressed_at_->y) > hand) pressed_at_.reset();
}

const WidgetRecord* Widgets::find(std::string_view path) const {
    const auto found = std::ranges::find(last_, path, &WidgetRecord::path);
    return found == last_.end() ? nullptr : &*found;
}

std::vector<std::string> Widgets::conflicts() const {
    std::map<std::string_view, int> counts;
    std::vector<std::string> twice;
    for (const WidgetRecord& record : last_)
        if (++counts[record.path] == 2) twice.push_back(record.path);
    return twice;
}

Widgets::Scope::Scope(Widgets& widgets, std::string_view name) : widgets_(&widgets), length_(widgets.path_.size()) {
    widgets.path_ += fmt::format("{}{}", widgets.path_.empty() ? "" : "/", name);
    ImGui::PushID(name.data(), name.data() + name.size());
}

Widgets::Scope::~Scope() {
    ImGui::PopID();
    widgets_->path_.resize(length_);
}

Widgets::Updating::Updating(Widgets& widgets, std::string word, Veil veil)
    : widgets_(&widgets),
      word_(std::move(word)),
      is_drawn_(!word_.empty() && veil == Veil::drawn && !widgets.is_veiled_),
      first_(widgets.records_.size()),
      from_(ImGui::GetCursorScreenPos()) {
    if (is_drawn_) widgets.is_veiled_ = true;
}

/// A child of its own, because it has to lie over the children (lists, tables) that were drawn before it.
Widgets::Updating::~Updating() {
    if (word_.empty()) return;
    for (std::size_t i = first_; i < widgets_->records_.size(); ++i) widgets_->records_[i].updating = word_;
    if (!is_drawn_) return;
    widgets_->is_veiled_ = false;
    const ImVec2 after = ImGui::GetCursorScreenPos(), window = ImGui::GetWindowPos();
    const float top = std::max(from_.y, window.y), bottom = std::min(after.y, window.y + ImGui::GetWindowHeight());
    const ImVec2 size(window.x + ImGui::GetWindowContentRegionMax().x - from_.x, bottom - top);
    if (size.x < 4 || size.y < 4) return;
    widgets_->words_on_veils_.push_back(word_);
    ImGui::SetCursorScreenPos({from_.x, top});
    ImGui::PushStyleColor(ImGuiCol_ChildBg, veil);
    ImGui::BeginChild(fmt::format("##updating {}", first_label(first_)).c_str(), size, false,
                      ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings);
    const ImVec2 text = ImGui::CalcTextSize(word_.c_str());
    const ImVec2 at(std::max(from_.x + 6, from_.x + (size.x - text.x) / 2), top + (size.y - text.y) / 2);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x - 6, at.y - 2}, {at.x + text.x + 6, at.y + text.y + 2}, IM_COL32(20, 22, 27, 235), 4);
    list.AddText(at, IM_COL32(240, 190, 90, 255), word_.c_str());
    ImGui::EndChild();
    ImGui::PopStyleColor();
    ImGui::SetCursorScreenPos(after);
}

/// Names a veil by what lies first under it.
std::string Widgets::Updating::first_label(std::size_t first) const {
    return first < widgets_->records_.size() ? widgets_->records_[first].path : widgets_->path_;
}

void Widgets::record(std::string_view label, WidgetKind kind, std::string value) {
    WidgetRecord made{
        .path = fmt::format("{}{}{}", path_, path_.empty() ? "" : "/", label), .kind = kind, .value = std::move(value)};
    made.from = ImGui::GetItemRectMin();
    made.to = ImGui::GetItemRectMax();
    const ImVec2 middle((made.from.x + made.to.x) / 2, (made.from.y + made.to.y) / 2);
    made.visible = ImGui::IsRectVisible(middle, middle);
    made.enabled = (ImGui::GetStyle().Alpha >= .999f);
    if (made.path == revealed_) {
        ImGui::SetScrollHereY();
        revealed_.clear();
    }
    records_.push_back(std::move(made));
}

bool Widgets::button(std::string_view label, std::string_view face) {
    const bool pressed = ImGui::Button(id_of(label, face).c_str());
    record(label, WidgetKind::button, std::string(face.empty() ? label : face));
    return pressed;
}

std::optional<bool> Widgets::checkbox(std::string_view label, bool value) {
    bool now = value;
    ImGui::Checkbox(std::string(label).c_str(), &now);
    record(label, WidgetKind::checkbox, now ? "on" : "off");
    return now == value ? std::nullopt : std::optional(now);
}

std::optional<std::size_t> Widgets::combo(std::string_view label, std::span<const std::string_view> items, std::size_t current) {
    std::optional<std::size_t> chosen;
    const std::string shown(current < items.size() ? items[current] : "");
    const bool open = ImGui::BeginCombo(hidden(label).c_str(), shown.c_str(), ImGuiComboFlags_HeightLarge);
    if (!open) {
        record(label, WidgetKind::combo, shown);
        return chosen;
    }
    record(label, WidgetKind::combo, shown);
    records_.back().open = true;
    {
        const Scope scope = in(label);
        for (std::size_t i = 0; i < items.size(); ++i) {
            if (ImGui::Selectable(std::string(items[i]).c_str(), i == current) && i != current) chosen = i;
            record(items[i], WidgetKind::choice, std::string(items[i]));
            if (i == current) ImGui::SetItemDefaultFocus();
        }
    }
    ImGui::EndCombo();
    return chosen;
}

std::optional<double> Widgets::slider(std::string_view label, double value, const SliderRange& range) {
    double now = value;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (range.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    ImGui::SliderScalar(hidden(label).c_str(), ImGuiDataType_Double, &now, &range.low, &range.high,
                        range.whole ? "%.0f" : range.format, flags);
    if (range.whole) now = std::round(now);
    record(label, WidgetKind::slider, as_text(now, range));
    records_.back().low = range.low;
    records_.back().high = range.high;
    records_.back().number = now;
    return now == value ? std::nullopt : std::optional(now);
}

std::optional<std::string> Widgets::input(std::string_view label, const std::string& value, const char* hint) {
    std::string now = value;
    const bool changed = ImGui::InputTextWithHint(hidden(label).c_str(), hint, &now);
    record(label, WidgetKind::input, now);
    return changed ? std::optional(now) : std::nullopt;
}

bool Widgets::selectable(std::string_view label, bool selected, std::string_view face) {
    const bool clicked = ImGui::Selectable(id_of(label, face).c_str(), selected);
    record(label, WidgetKind::selectable, std::string(face.empty() ? label : face));
    return clicked;
}

Widgets::TreeRow Widgets::tree(std::string_view label, bool selected, ImGuiTreeNodeFlags flags, std::string_view face) {
    flags |= ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_OpenOnDoubleClick | ImGuiTreeNodeFlags_SpanFullWidth;
    if (selected) flags |= ImGuiTreeNodeFlags_Selected;
    TreeRow row;
    row.open = ImGui::TreeNodeEx(id_of(label, face).c_str(), flags);
    row.clicked = ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen();
    record(label, WidgetKind::tree, std::string(face.empty() ? label : face));
    records_.back().open = row.open;
    if (!row.open || flags & ImGuiTreeNodeFlags_NoTreePushOnOpen) return row;
    tree_lengths_.push_back(path_.size());
    path_ += fmt::format("{}{}", path_.empty() ? "" : "/", label);
    return row;
}

void Widgets::tree_end() {
    ImGui::TreePop();
    path_.resize(tree_lengths_.back());
    tree_lengths_.pop_back();
}

void Widgets::value(std::string_view label, std::string_view shown) {
    ImGui::TextDisabled("%.*s", static_cast<int>(label.size()), label.data());
    ImGui::SameLine();
    text(label, shown);
}

void Widgets::text(std::string_view label, std::string_view shown, const ImVec4* color) {
    if (color) ImGui::PushStyleColor(ImGuiCol_Text, *color);
    ImGui::TextUnformatted(shown.data(), shown.data() + shown.size());
    if (color) ImGui::PopStyleColor();
    record(label, WidgetKind::text, std::string(shown));
}

void Widgets::canvas(std::string_view label, ImVec2 size, std::string_view shown) {
    ImGui::InvisibleButton(
        std::string(label).c_str(), size,
        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
    record(label, WidgetKind::canvas, std::string(shown));
}

void Widgets::point(std::string_view label, ImVec2 at, std::string_view shown) {
    record(label, WidgetKind::point, std::string(shown));
    records_.back().from = records_.back().to = at;
}

void Widgets::tab(std::string_view label, bool selected) { record(label, WidgetKind::tab, selected ? "selected" : ""); }

/// What comes under a mouse that is where it was pressed, as below a list that closes, counts as pressed. The parts of a canvas
/// have help of their own: it follows at once where another's is shown.
bool Widgets::is_rested_on(std::string_view help) {
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 from = ImGui::GetItemRectMin();
    const bool is_same = rest_.from.x == from.x && rest_.from.y == from.y;
    if (!is_same || rest_.help != help)
        rest_ = {from, std::string(help), is_same ? rest_.seconds : 0, pressed_at_.has_value(), true};
    rest_.seen = true;
    rest_.pressed |= ImGui::IsAnyMouseDown();
    const bool moves = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
    if (rest_.seconds < seconds_to_help) rest_.seconds = moves ? 0 : rest_.seconds + io.DeltaTime;
    return !rest_.pressed && rest_.seconds >= seconds_to_help;
}

void Widgets::help(std::string_view text) {
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || !is_rested_on(text)) return;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {9, 7});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    records_.push_back({.path = "help", .kind = WidgetKind::text, .value = std::string(text)});
    records_.back().from = ImGui::GetItemRectMin();
    records_.back().to = ImGui::GetItemRectMax();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

}  // namespace strata::ui
