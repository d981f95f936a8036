#include "ui/widgets/keys_list.h"

#include <algorithm>

#include <fmt/format.h>

#include "ui/window/keys.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr float gap = 14, margin = 24;  // between a key and its help; to the window's edges
constexpr float between_columns = 34, above_section = 6;

struct SectionRows {
    std::string_view name;
    std::vector<JoinedKeys> rows;
    float height = 0;
};

std::vector<SectionRows> measured(const std::vector<KeySection>& sections) {
    std::vector<SectionRows> all;
    for (const KeySection& section : sections) {
        if (section.rows.empty()) continue;
        SectionRows made{section.name, joined(section.rows)};
        made.height = static_cast<float>(made.rows.size() + 1) * ImGui::GetTextLineHeightWithSpacing() + above_section;
        all.push_back(std::move(made));
    }
    return all;
}

/// How many sections the first column has: all where they are not too high, else as many as make both columns most alike.
std::size_t sections_of_first_column(const std::vector<SectionRows>& sections, float most_height) {
    float total = 0, first = 0;
    for (const SectionRows& section : sections) total += section.height;
    if (total <= most_height) return sections.size();
    std::size_t count = 0;
    while (count < sections.size() && first + sections[count].height / 2 < total / 2) first += sections[count++].height;
    return count;
}

void draw_column(Widgets& widgets, std::span<const SectionRows> sections) {
    float keys_width = 0;
    for (const SectionRows& section : sections)
        for (const JoinedKeys& row : section.rows) keys_width = std::max(keys_width, ImGui::CalcTextSize(row.keys.c_str()).x);
    ImGui::BeginGroup();
    for (const SectionRows& section : sections) {
        if (&section != sections.data()) ImGui::Dummy({0, above_section - ImGui::GetStyle().ItemSpacing.y});
        ImGui::TextDisabled("%.*s", static_cast<int>(section.name.size()), section.name.data());
        for (const JoinedKeys& row : section.rows) {
            ImGui::TextColored(palette().accent, "%s", row.keys.c_str());
            ImGui::SameLine(keys_width + gap);
            widgets.text(row.first, row.help);
        }
    }
    ImGui::EndGroup();
}

}  // namespace

std::vector<JoinedKeys> joined(std::span<const KeyRow> rows) {
    std::vector<JoinedKeys> made;
    for (auto row = rows.begin(); row != rows.end();) {
        const auto end = std::find_if(row, rows.end(), [&](const KeyRow& other) { return other.help != row->help; });
        JoinedKeys keys{row->chord, row->help, for_people(row->chord)};
        if (end - row > 4) keys.keys += fmt::format(" \xe2\x80\xa6 {}", for_people((end - 1)->chord));
        else
            for (auto other = row + 1; other != end; ++other) keys.keys += fmt::format("  {}", for_people(other->chord));
        made.push_back(std::move(keys));
        row = end;
    }
    return made;
}

KeySection mouse_gestures() {
    return {"Mouse, over a picture",
            {
                {"click", "pins the pixel; right click unpins it"},
                {"wheel", "zooms at the pointer"},
                {"drag", "moves the picture; a double click shows all of it"},
                {"right drag", "looks around; W A S D Q E fly, Shift: faster, wheel: speed"},
                {"alt+drag", "orbits around what is under the pointer"},
                {"ctrl+click", "on a slider: a number can be typed"},
            }};
}

void draw_keys_list(Widgets& widgets, const std::vector<KeySection>& sections) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {.5f, .5f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {18, 14});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyle().Colors[ImGuiCol_PopupBg]);
    ImGui::Begin("keys", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    {
        const auto scope = widgets.in("keys");
        const std::vector<SectionRows> all = measured(sections);
        const std::size_t first = sections_of_first_column(all, size.y - 2 * margin);
        draw_column(widgets, std::span(all).first(first));
        if (first < all.size()) {
            ImGui::SameLine(0, between_columns);
            draw_column(widgets, std::span(all).subspan(first));
        }
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

}  // namespace strata::ui
