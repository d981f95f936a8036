// What the techniques in use know of the pinned pixel and of its tile.
#include <algorithm>

#include "passes/technique.h"
#include "ui/pixel/pixel_inside.h"
#include "ui/pixel/pixel_part.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr std::size_t most_rows = 128;  // of a table; the rest is counted

bool has_tiles(const Technique* technique) {
    return std::ranges::any_of(technique->tables, [](const DebugTable& table) { return table.tile > 0; });
}

/// Those of the frame that have views, in its order.
std::vector<const Technique*> with_views(const Model& model, const Replay& replay) {
    std::vector<const Technique*> techniques;
    for (const auto& [stage, choice] : model.choices()) {
        const bool is_left_out = std::ranges::find(replay.skipped, stage, &SkippedStage::stage) != replay.skipped.end();
        if (!is_left_out && !choice.technique->views.empty()) techniques.push_back(choice.technique);
    }
    return techniques;
}

class InsidePart final : public PixelPart {
public:
    void draw(Model& model, Services& services, const Replay& replay) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("inside");
        const std::vector<const Technique*> techniques = with_views(model, replay);
        if (techniques.empty()) {
            widgets.text("state", "no technique of this frame has views", &palette().dim);
            return;
        }
        const Technique* technique = choose_of(techniques, widgets);
        const InsideQuestion asked{with_display_alone(replay.request), glm::uvec2(*model.pin), technique};
        asked_.ask(services.replayer, asked, inside_of);
        draw_state_of(widgets, asked_);
        const PixelInside* inside = asked_.answer();
        if (!inside || asked_.answered()->technique != technique) return;
        const auto updating = widgets.updating(updating_word(asked_, asked, model, services));
        ImGui::BeginChild("numbers", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
        draw_values(widgets, *inside);
        for (const InsideRows& rows : inside->tables) draw_rows(widgets, *inside, rows);
        ImGui::EndChild();
    }
    void withdraw() override { asked_.withdraw(); }
    bool is_busy() const override { return asked_.progress() != nullptr; }

private:
    /// The one a person chose while it is in use; else one that works in tiles; else the first.
    const Technique* choose_of(const std::vector<const Technique*>& techniques, Widgets& widgets) {
        auto current = std::ranges::find(techniques, chosen_);
        if (current == techniques.end()) current = std::ranges::find_if(techniques, has_tiles);
        if (current == techniques.end()) current = techniques.begin();
        std::vector<std::string_view> names;
        for (const Technique* technique : techniques) names.push_back(technique->name);
        ImGui::SetNextItemWidth(-1);
        if (const auto set = widgets.combo("technique", names, static_cast<std::size_t>(current - techniques.begin())))
            return chosen_ = techniques[*set];
        return *current;
    }

    static void draw_values(Widgets& widgets, const PixelInside& inside) {
        const auto scope = widgets.in("views");
        if (!ImGui::BeginTable("views", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX))
            return;
        for (const InsideValue& value : inside.values) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextColored(palette().dim, "%s", std::string(value.view).c_str());
            ImGui::TableNextColumn();
            widgets.text(value.view, text_of(value));
            widgets.help(value.help);
        }
        ImGui::EndTable();
    }

    static void draw_rows(Widgets& widgets, const PixelInside& inside, const InsideRows& rows) {
        const DebugTable& table = *rows.table;
        const auto scope = widgets.in(table.name);
        ImGui::Dummy({0, 4});
        widgets.text("about", fmt::format("{}: {}", table.name, rows.why), &palette().accent);
        widgets.help(table.help);
        if (!rows.none.empty()) widgets.text("none", rows.none, &palette().dim);
        if (rows.rows.empty()) return;
        const std::string id(table.name);
        const auto columns = static_cast<int>(table.columns.size());
        if (!ImGui::BeginTable(id.c_str(), columns,
                               ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX))
            return;
        for (const TableColumn& column : table.columns) ImGui::TableSetupColumn(std::string(column.name).c_str());
        ImGui::TableHeadersRow();
        for (std::size_t i = 0; i < std::min(rows.rows.size(), most_rows); ++i) {
            const auto row_scope = widgets.in(fmt::format("{}", i));
            ImGui::TableNextRow();
            for (std::size_t c = 0; c < table.columns.size(); ++c) {
                ImGui::TableNextColumn();
                widgets.text(table.columns[c].name, text_of(inside, table.columns[c], rows.rows[i][c]));
            }
        }
        ImGui::EndTable();
        if (rows.rows.size() > most_rows)
            widgets.text("more", fmt::format("and {} more rows", rows.rows.size() - most_rows), &palette().dim);
    }

    LiveQuery<InsideQuestion, PixelInside> asked_;
    const Technique* chosen_ = nullptr;
};

}  // namespace

std::unique_ptr<PixelPart> pixel_inside_part() { return std::make_unique<InsidePart>(); }

}  // namespace strata::ui
