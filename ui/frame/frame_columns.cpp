#include "ui/frame/frame_columns.h"

#include <algorithm>
#include <array>

#include "passes/graph/describe.h"
#include "replay/plural.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

struct BesideRow {
    std::string_view name;
    std::array<const char*, 2> heads;
    std::array<float, 2> widths;  ///< 0: there is no such column
};
// In the order of Beside.
constexpr std::array<BesideRow, 3> beside_rows{
    {{"Time", {"ms", "##none"}, {88, 0}}, {"Memory", {"made", "alive"}, {58, 58}}, {"Work", {"work", "waits"}, {82, 36}}}};

void text_at_right(Widgets& widgets, std::string_view label, const std::string& text, const ImVec4* color = nullptr) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (room > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    widgets.text(label, text, color);
}

std::string size_or_nothing(std::uint64_t bytes) { return bytes > 0 ? size_text(bytes) : "\xe2\x80\x93"; }

struct TimeLook {
    Stage stage;
    float alpha;  ///< of the bar
};

void draw_time(Widgets& widgets, const ShownFrame& frame, std::string_view label, const Spread& ms, const TimeLook& look) {
    const std::optional<Spread>& frame_ms = frame.times->run.frame_ms;
    const double share = ms.median / std::max({ms.median, frame_ms ? frame_ms->median : 0, 1e-9});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x * static_cast<float>(share));
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y}, {at.x + width, at.y + ImGui::GetTextLineHeight()},
                                              packed(color_of_stage(static_cast<std::size_t>(look.stage)), look.alpha), 2);
    text_at_right(widgets, fmt::format("{} ms", label), time_text(ms), frame.is_stale ? &palette().dim : nullptr);
    widgets.help(fmt::format("{:.1f} % of the frame{}", 100 * share, frame.is_stale ? "\nmeasured before the last change" : ""));
}

}  // namespace

void FrameColumns::draw_choice(Widgets& widgets) {
    std::array<std::string_view, beside_rows.size()> names;
    std::ranges::transform(beside_rows, names.begin(), &BesideRow::name);
    constexpr float width = 92;
    ImGui::SameLine(std::max(0.0f, ImGui::GetWindowContentRegionMax().x - width));
    ImGui::SetNextItemWidth(width);
    if (const auto chosen = widgets.combo("beside", names, static_cast<std::size_t>(beside_)))
        beside_ = static_cast<Beside>(*chosen);
    widgets.help(
        "what stands beside each step: its time; the memory it is the first to use, and all that is alive when it runs; "
        "what it does, and how many barriers it waits for");
}

void FrameColumns::set_up(const ShownFrame& frame) const {
    const BesideRow& row = beside_rows[static_cast<std::size_t>(beside_)];
    const bool is_known = beside_ != Beside::time || frame.times;
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_shown = is_known && row.widths[i] > 0;
        ImGui::TableSetupColumn(row.heads[i], ImGuiTableColumnFlags_WidthFixed | (is_shown ? 0 : ImGuiTableColumnFlags_Disabled),
                                std::max(1.0f, row.widths[i]));
    }
}

void FrameColumns::draw_pass(Widgets& widgets, const ShownFrame& frame, const FramePass& pass, int column) const {
    ImGui::TableSetColumnIndex(column);
    if (beside_ == Beside::time) {
        if (pass.ms) draw_time(widgets, frame, text_of(pass.scope), *pass.ms, {pass.scope.stage, .4f});
        return;
    }
    const bool is_memory = beside_ == Beside::memory;
    text_at_right(widgets, fmt::format("{} {}", text_of(pass.scope), is_memory ? "made" : "work"),
                  is_memory ? size_or_nothing(pass.made_bytes) : plural(pass.end - pass.first, "step"));
    widgets.help(is_memory ? "images and buffers that its steps are the first to use" : plural(pass.draws, "draw"));
    ImGui::TableSetColumnIndex(column + 1);
    text_at_right(widgets, fmt::format("{} {}", text_of(pass.scope), is_memory ? "alive" : "waits"),
                  is_memory ? size_or_nothing(pass.alive_bytes) : fmt::format("{}", pass.barriers));
    widgets.help(is_memory ? "the most that is alive at one of its steps" : plural(pass.barriers, "barrier"));
}

void FrameColumns::draw_step(Widgets& widgets, const ShownFrame& frame, std::string_view label, std::size_t step,
                             int column) const {
    const PlanRow& row = frame.replay.steps[step];
    ImGui::TableSetColumnIndex(column);
    if (beside_ == Beside::time) {
        if (const auto timed = frame.rows.timed[step])
            draw_time(widgets, frame, label, *frame.times->run.steps[*timed].ms, {row.scope.stage, .2f});
        return;
    }
    const bool is_memory = beside_ == Beside::memory;
    text_at_right(widgets, fmt::format("{} {}", label, is_memory ? "made" : "work"),
                  is_memory ? size_or_nothing(row.made_bytes) : row.short_work, &palette().dim);
    ImGui::TableSetColumnIndex(column + 1);
    text_at_right(widgets, fmt::format("{} {}", label, is_memory ? "alive" : "waits"),
                  is_memory ? size_or_nothing(row.alive_bytes) : fmt::format("{}", row.barriers), &palette().dim);
}

}  // namespace strata::ui
