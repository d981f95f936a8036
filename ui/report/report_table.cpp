#include "ui/report/report_table.h"

#include <algorithm>

#include "replay/report/variants.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr float least_height = 120;
constexpr const char *star = "\xe2\x98\x85", *dot = "\xe2\x97\x8f", *up = " \xe2\x96\xb2", *down = " \xe2\x96\xbc";

void draw_remarks(Widgets& widgets, const Report& report) {
    const std::vector<ReportRemark> remarks = remarks_of(report);
    if (remarks.empty()) return;
    const Widgets::TreeRow tree = widgets.tree("not supported or in doubt", false, ImGuiTreeNodeFlags_DefaultOpen);
    if (!tree.open) return;
    ImGui::PushTextWrapPos(0);
    for (std::size_t i = 0; i < remarks.size(); ++i)
        widgets.text(fmt::format("{}", i), fmt::format("{} {}", remarks[i].what, remarks[i].why),
                     remarks[i].is_doubt ? &palette().warning : &palette().dim);
    ImGui::PopTextWrapPos();
    widgets.tree_end();
}

}  // namespace

std::optional<std::size_t> ReportTable::draw(Widgets& widgets, const Study& study, const Marks& marks) {
    const auto scope = widgets.in("table");
    draw_remarks(widgets, study.report);
    Columns columns;
    for (const ReportColumn& column : study.columns)
        if (!column.is_detail || &column == &marks.axes.error || &column == &marks.axes.cost) columns.push_back(&column);
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollX |
                                      ImGuiTableFlags_ScrollY | ImGuiTableFlags_BordersInnerV;
    under_.reset();
    std::optional<std::size_t> clicked;
    const ImVec2 size(0, std::max(ImGui::GetContentRegionAvail().y, least_height));
    if (!ImGui::BeginTable("rows", static_cast<int>(2 + columns.size()), flags, size)) return clicked;
    ImGui::TableSetupScrollFreeze(2, 1);
    draw_heads(widgets, columns, marks.axes);
    const std::vector<bool> front = front_of(study.report, marks.axes.error, marks.axes.cost);
    const auto sorted_by = std::ranges::find(study.columns, sorted_by_, &ReportColumn::label);
    for (const std::size_t row : sorted_rows(sorted_by == study.columns.end() ? marks.axes.error : *sorted_by, order_)) {
        if (!study.report.rows[row].accuracy.not_supported.empty()) continue;
        ImGui::TableNextRow();
        if (row == marks.in_plot) ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg1, packed(palette().accent, .25f));
        if (draw_row(widgets, study, row, {front[row], row == marks.now, columns})) clicked = row;
    }
    ImGui::EndTable();
    return clicked;
}

void ReportTable::draw_heads(Widgets& widgets, const Columns& columns, const ReportAxes& axes) {
    const auto scope = widgets.in("heads");
    // No row of headers by its flag: a column would not be as wide as its own head.
    ImGui::TableNextRow();
    ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, ImGui::GetColorU32(ImGuiCol_TableHeaderBg));
    ImGui::TableNextColumn();
    widgets.text("front", star, &palette().warning);
    widgets.help("nothing is both more accurate and cheaper, by the two axes");
    ImGui::TableNextColumn();
    ImGui::TextDisabled("technique and settings");
    const std::string label = sorted_by_.empty() ? axes.error.label : sorted_by_;
    for (const ReportColumn* column : columns) {
        ImGui::TableNextColumn();
        const bool sorts = column->label == label;
        const char* arrow = !sorts ? "" : order_ == SortOrder::ascending ? up : down;
        const bool clicked = widgets.selectable(column->head, false, fmt::format("{}{}", column->head, arrow));
        widgets.help(fmt::format("{}; click sorts", column->tooltip.empty() ? column->label : column->tooltip));
        if (!clicked) continue;
        order_ = sorts && order_ == SortOrder::ascending ? SortOrder::descending : SortOrder::ascending;
        sorted_by_ = column->label;
    }
}

bool ReportTable::draw_row(Widgets& widgets, const Study& study, std::size_t row, const RowLook& look) {
    const Measurement& measured = study.report.rows[row];
    const std::string name = short_label(measured);
    const auto scope = widgets.in(name);
    ImGui::TableNextColumn();
    widgets.text("front", look.on_front ? star : measured.has_other_truth ? "t" : " ", &palette().warning);
    if (measured.has_other_truth) widgets.help(fmt::format("t: {}", other_truth_note));
    ImGui::TableNextColumn();
    ImGui::TextColored(color_of_technique(measured.technique), "%s", dot);
    ImGui::SameLine();
    const bool clicked = widgets.selectable("apply", look.is_now, name);
    if (ImGui::IsItemHovered()) under_ = row;
    widgets.help(look.is_now ? "shown now" : "click applies it");
    for (const ReportColumn* column : look.columns) {
        ImGui::TableNextColumn();
        const std::string text = cell_text(*column, row);
        const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
        if (free > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
        widgets.text(column->head, text, look.on_front ? &palette().text : &palette().dim);
        const auto missing = study.missing.find(column->label);
        if (missing != study.missing.end()) widgets.help(missing->second[row]);
    }
    return clicked;
}

}  // namespace strata::ui
