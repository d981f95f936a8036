// How the charts of a plan are drawn: see plan_chart.h.
#include <algorithm>
#include <cmath>

#include <imgui_internal.h>

#include "passes/graph/describe.h"
#include "ui/plan/plan_chart.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

ImVec4 color_of(const PlanStep& step) { return color_of_stage(static_cast<std::size_t>(step.scope.stage)); }

/// What is drawn in the cells ends at their edges.
class Inside {
public:
    Inside(ImDrawList& list, ImVec2 from, ImVec2 to) : list_(list) { list.PushClipRect(from, to, true); }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    ~Inside() { list_.PopClipRect(); }

private:
    ImDrawList& list_;
};

constexpr float cosine = .5f, sine = .8660254f;  // 60 degrees
constexpr float below_names = 8, least_names = 60, most_names = 132;

/// Text that rises to the right, glyph by glyph: a draw list's own text lies flat. `at` is where its baseline begins.
void add_slanted(ImDrawList& list, ImVec2 at, std::string_view text, ImU32 color) {
    const ImFont& font = *ImGui::GetFont();
    const float scale = ImGui::GetFontSize() / font.FontSize;
    float pen = 0;
    for (const char* next = text.data(); next < text.data() + text.size();) {
        unsigned code = 0;
        next += ImTextCharFromUtf8(&code, next, text.data() + text.size());
        const ImFontGlyph* glyph = font.FindGlyph(static_cast<ImWchar>(code));
        if (!glyph) continue;
        const auto corner = [&](float x, float y) {
            const float along = pen + x * scale, down = (y - font.Ascent) * scale;
            return ImVec2(at.x + along * cosine + down * sine, at.y - along * sine + down * cosine);
        };
        if (glyph->Visible) {
            list.PrimReserve(6, 4);
            list.PrimQuadUV(corner(glyph->X0, glyph->Y0), corner(glyph->X1, glyph->Y0), corner(glyph->X1, glyph->Y1),
                            corner(glyph->X0, glyph->Y1), {glyph->U0, glyph->V0}, {glyph->U1, glyph->V0}, {glyph->U1, glyph->V1},
                            {glyph->U0, glyph->V1}, color);
        }
        pen += glyph->AdvanceX * scale;
    }
}

/// As much of a text as there is room for, with an ellipsis for the rest.
std::string shortened(std::string text, float width) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
    while (text.size() > 1 && ImGui::CalcTextSize(fmt::format("{}\xe2\x80\xa6", text).c_str()).x > width) text.pop_back();
    return fmt::format("{}\xe2\x80\xa6", text);
}

/// Rows and columns that are marked, behind everything.
void draw_bands(ImDrawList& list, const PlanChart& chart, const PlanMarks& marks) {
    const auto column = [&](std::size_t step, float alpha) {
        list.AddRectFilled({chart.x_of(double(step)), chart.cells.y - 6}, {chart.x_of(double(step) + 1), chart.to.y},
                           packed(palette().accent, alpha));
    };
    if (marks.step) column(*marks.step, .18f);
    if (marks.step_under) column(*marks.step_under, .08f);
    const auto row = [&](std::size_t index, float alpha) {
        list.AddRectFilled({chart.from.x, chart.y_of(index)}, {chart.to.x, chart.y_of(index) + PlanChart::row},
                           packed(palette().accent, alpha));
    };
    if (marks.row) row(*marks.row, .18f);
    if (marks.row_under) row(*marks.row_under, .06f);
}

void draw_row_name(ImDrawList& list, const PlanChart& chart, std::size_t index, const std::string& text, const ImVec4& color) {
    const float y = chart.y_of(index) + (PlanChart::row - ImGui::GetTextLineHeight()) / 2;
    list.AddText({chart.from.x + 6, y}, packed(color), shortened(text, PlanChart::names - 16).c_str());
}

bool is_in_sight(const PlanChart& chart, std::size_t index) {
    return chart.y_of(index) + PlanChart::row > chart.cells.y && chart.y_of(index) < chart.to.y;
}

/// What a step does to a resource: filled where it writes, a ring where it reads, both where it updates.
void draw_touch(ImDrawList& list, ImVec2 middle, const PlanTouch& touch, const ImVec4& color) {
    const float half = 5;
    const ImVec2 from(middle.x - half, middle.y - half), to(middle.x + half, middle.y + half);
    list.AddRectFilled(from, to, packed(touch.writes ? color : ImGui::GetStyle().Colors[ImGuiCol_ChildBg]), touch.writes ? 2 : 5);
    if (touch.writes && touch.reads) list.AddCircleFilled(middle, 2.2f, packed(ImGui::GetStyle().Colors[ImGuiCol_ChildBg]));
    if (!touch.writes) list.AddCircle(middle, half - 1, packed(color), 0, 2);
}

void draw_resource(ImDrawList& list, const PlanChart& chart, const PlanPicture& picture, const PlanResource& resource,
                   std::size_t index) {
    const float y = chart.y_of(index) + PlanChart::row / 2;
    const auto x_of = [&](std::size_t step) { return chart.x_of(double(step) + .5); };
    std::optional<std::size_t> writer;
    float x = x_of(resource.first());
    for (const PlanTouch& touch : resource.touches) {
        const ImVec4 color = writer ? color_of(picture.steps[*writer]) : palette().dim;
        // What flows to a step has the color of who made it.
        list.AddLine({x, y}, {x_of(touch.step), y}, packed(color, writer ? .75f : .3f), writer ? 2.0f : 1.0f);
        x = x_of(touch.step);
        if (touch.writes) writer = touch.step;
    }
    if (resource.is_kept) {
        const float end = chart.x_of(double(chart.columns)) + 3;
        const ImVec4 color = writer ? color_of(picture.steps[*writer]) : palette().dim;
        list.AddLine({x, y}, {end, y}, packed(color, .75f), 2);
        list.AddTriangleFilled({end, y - 5}, {end + 8, y}, {end, y + 5}, packed(color));
    }
    writer.reset();
    for (const PlanTouch& touch : resource.touches) {
        if (touch.writes) writer = touch.step;
        draw_touch(list, {x_of(touch.step), y}, touch, writer ? color_of(picture.steps[*writer]) : palette().dim);
    }
}

/// How much is alive at each step, with the most as a line and a number.
void draw_alive(ImDrawList& list, const PlanChart& chart, const PlanPicture& picture) {
    const float bottom = chart.cells.y - 6, height = alive_height - 26;
    const std::uint64_t peak = std::max<std::uint64_t>(picture.over_time.peak, 1);
    list.AddText({chart.from.x + 6, bottom - ImGui::GetTextLineHeight()}, packed(palette().dim), "alive");
    const Inside inside(list, {chart.cells.x, chart.from.y}, chart.to);
    for (std::size_t i = 0; i < picture.over_time.alive.size(); ++i) {
        const float share = static_cast<float>(static_cast<double>(picture.over_time.alive[i]) / static_cast<double>(peak));
        const bool is_peak = picture.over_time.alive[i] == picture.over_time.peak;
        list.AddRectFilled({chart.x_of(double(i)) + 1, bottom - share * height}, {chart.x_of(double(i) + 1), bottom},
                           packed(is_peak ? palette().warning : color_of(picture.steps[i]), is_peak ? .9f : .55f));
    }
    list.AddLine({chart.cells.x, bottom - height}, {chart.to.x, bottom - height}, packed(palette().warning, .4f));
    const std::string most = fmt::format("{} at most", size_text(picture.over_time.peak));
    list.AddText({chart.to.x - ImGui::CalcTextSize(most.c_str()).x - 6, bottom - height - ImGui::GetTextLineHeight() - 1},
                 packed(palette().warning), most.c_str());
}

void draw_owner(ImDrawList& list, const PlanChart& chart, const PlanPicture& picture, const PlanResource& resource,
                std::size_t index) {
    const double end = std::min(static_cast<double>(resource.last) + 1, static_cast<double>(chart.columns));
    const ImVec2 from(chart.x_of(double(resource.first())) + 1, chart.y_of(index) + 2),
        to(chart.x_of(end) - 1, chart.y_of(index) + PlanChart::row - 2);
    const ImVec4 color = color_of(picture.steps[resource.first()]);
    list.AddRectFilled(from, to, packed(color, .38f), 3);
    list.AddRect(from, to, packed(color, .9f), 3);
    if (resource.is_kept)
        list.AddTriangleFilled({to.x + 3, from.y + 2}, {to.x + 10, (from.y + to.y) / 2}, {to.x + 3, to.y - 2}, packed(color));
    const float begin = std::max(from.x, chart.cells.x);
    if (to.x - begin < 30) return;
    list.AddText({begin + 4, chart.y_of(index) + (PlanChart::row - ImGui::GetTextLineHeight()) / 2}, packed(palette().text),
                 shortened(resource.name, to.x - begin - 8).c_str());
}

/// Of a name, flat, in a header of that height.
float room_for_name(float height) { return (height - below_names - ImGui::GetFontSize() * cosine) / sine; }

}  // namespace

float names_height(const std::vector<PlanStep>& steps) {
    float longest = 0;
    for (const PlanStep& step : steps) longest = std::max(longest, ImGui::CalcTextSize(step.short_name().c_str()).x);
    const float height = std::ceil(longest * sine + ImGui::GetFontSize() * cosine + below_names) + 1;
    return std::clamp(height, least_names, most_names);
}

void draw_steps(const PlanChart& chart, const PlanPicture& picture, const PlanMarks& marks) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Inside inside(list, {chart.cells.x - 8, chart.from.y}, {chart.to.x, chart.cells.y});
    const float strip = chart.cells.y - 5, foot = chart.foot - below_names, room = room_for_name(chart.foot - chart.from.y);
    for (std::size_t i = 0; i < picture.steps.size(); ++i) {
        const float x = chart.x_of(double(i));
        const ImVec4 color = color_of(picture.steps[i]);
        list.AddRectFilled({std::max(x, chart.cells.x), strip}, {std::max(x + chart.column, chart.cells.x), strip + 4},
                           packed(color));
        if (x + chart.column / 2 < chart.cells.x || x > chart.to.x) continue;
        const bool marked = marks.step == i || marks.step_under == i;
        add_slanted(list, {x + chart.column / 2 + 4, foot}, shortened(picture.steps[i].short_name(), room),
                    packed(marked ? palette().text : color, marked ? 1 : .85f));
    }
}

void draw_resources(const PlanChart& chart, const PlanPicture& picture, const std::vector<std::size_t>& rows,
                    const PlanMarks& marks) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Inside inside(list, {chart.from.x, chart.cells.y}, chart.to);
    draw_bands(list, chart, marks);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!is_in_sight(chart, i)) continue;
        const PlanResource& resource = picture.resources[rows[i]];
        const bool is_touched = !marks.step || resource.touch(*marks.step);
        draw_row_name(list, chart, i, resource.name, is_touched ? palette().text : palette().dim);
        const Inside cells(list, chart.cells, chart.to);
        draw_resource(list, chart, picture, resource, i);
    }
}

void draw_memory(const PlanChart& chart, const PlanPicture& picture, const PlanMarks& marks) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_alive(list, chart, picture);
    const Inside inside(list, {chart.from.x, chart.cells.y}, chart.to);
    draw_bands(list, chart, marks);
    for (std::size_t i = 0; i < picture.memory.size(); ++i) {
        if (!is_in_sight(chart, i)) continue;
        const PlanMemory& memory = picture.memory[i];
        const std::size_t owners = memory.resources.size();
        const std::string shared = owners > 1 ? fmt::format("  \xc3\x97{}", owners) : "";
        draw_row_name(list, chart, i, size_text(memory.bytes) + shared, owners > 1 ? palette().good : palette().text);
        const Inside cells(list, chart.cells, chart.to);
        for (const std::size_t resource : memory.resources) draw_owner(list, chart, picture, picture.resources[resource], i);
    }
}

}  // namespace strata::ui
