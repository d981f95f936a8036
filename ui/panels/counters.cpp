// What techniques counted, per pixel too, and what they counted before the last change or as recorded.
#include <algorithm>
#include <array>

#include "passes/technique.h"
#include "ui/frame/counter_rows.h"
#include "ui/panel.h"
#include "ui/widgets/find_text.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

enum class Against : std::size_t { last_change, recorded };

class CountersPanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Counters");
        const auto replay = services.replayer.shown("A");
        if (!replay) {
            widgets.text("state", "nothing replayed yet", &palette().dim);
            return;
        }
        take(*replay);
        draw_head(widgets);
        const CountedRun* before = before_of(model, services);
        draw_against(widgets, services, before);
        const auto rows = counter_rows(now_->counters, before ? std::span(before->counters) : std::span<const CounterRecord>());
        const auto updating =
            widgets.updating(updating_word(services.replayer.is_of("A", model.request()), services.replayer, "counters"));
        ImGui::BeginChild("counters");
        draw_table(widgets, rows);
        ImGui::EndChild();
    }

private:
    /// A replay that answers another request makes the one before it what is compared with.
    void take(const Replay& replay) {
        CountedRun counted = counted_run(replay.request, replay.run);
        if (now_ && now_->request != counted.request) last_ = std::move(now_);
        now_ = std::move(counted);
    }

    void draw_head(Widgets& widgets) {
        constexpr std::array<std::string_view, 2> kinds = {"before the last change", "as recorded"};
        ImGui::SetNextItemWidth(190);
        if (const auto chosen = widgets.combo("against", kinds, static_cast<std::size_t>(against_)))
            against_ = static_cast<Against>(*chosen);
        widgets.help("what the counters are compared with");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(150);
        if (auto text = widgets.input("find", find_, "find a counter")) find_ = *std::move(text);
        ImGui::SameLine();
        if (const auto set = widgets.checkbox("changed only", changed_only_)) changed_only_ = *set;
        ImGui::SameLine(0, 14);
    }

    const CountedRun* before_of(const Model& model, Services& services) {
        if (against_ == Against::last_change) return last_ ? &*last_ : nullptr;
        Request request = model.request();
        request.choices = {};
        request.variant.force.clear();
        request.variant.samples = 0;
        request.variant.eye = {};
        request.outputs = {"display"};
        services.replayer.show(place, request);
        const auto replay = services.replayer.shown(place);
        if (!replay || !services.replayer.is_of(place, request)) return nullptr;
        recorded_ = counted_run(replay->request, replay->run);
        return &*recorded_;
    }

    void draw_against(Widgets& widgets, const Services& services, const CountedRun* before) const {
        const Error* error = against_ == Against::recorded ? services.replayer.error(place) : nullptr;
        if (error) return widgets.text("before", error->sentence, &palette().bad);
        const std::string_view none =
            against_ == Against::last_change ? "nothing was changed yet" : "replaying as recorded\xe2\x80\xa6";
        if (!before) return draw_note(widgets, std::string(none));
        const std::string text = otherwise(*before, *now_);
        draw_note(widgets, text.empty() ? "the same settings" : fmt::format("then: {}", text));
    }

    /// Beside what is chosen where there is room, else below.
    static void draw_note(Widgets& widgets, const std::string& text) {
        if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x) ImGui::NewLine();
        ImGui::PushTextWrapPos(0);
        widgets.text("before", text, &palette().dim);
        ImGui::PopTextWrapPos();
    }

    bool matches(const CounterRow& row) const {
        if (changed_only_ && row.now == row.before) return false;
        return is_found_in(row.name, find_) || is_found_in(row.technique, find_);
    }

    void draw_table(Widgets& widgets, const std::vector<CounterRow>& rows) const {
        if (std::ranges::none_of(rows, [&](const CounterRow& row) { return matches(row); })) {
            const char* none = rows.empty() ? "no technique of this frame counts anything" : "no counter is like that";
            return widgets.text("none", none, &palette().dim);
        }
        constexpr ImGuiTableFlags flags =
            ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingStretchProp;
        if (!ImGui::BeginTable("values", 5, flags)) return;
        constexpr std::array<std::pair<const char*, float>, 5> columns = {
            {{"counter", 3}, {"now", 1.5f}, {"per pixel", 1.2f}, {"before", 1.5f}, {"change", 2}}};
        for (const auto& [label, weight] : columns) ImGui::TableSetupColumn(label, 0, weight);
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableHeadersRow();
        const std::string* technique = nullptr;
        for (const CounterRow& row : rows) {
            if (!matches(row)) continue;
            if (!technique || *technique != row.technique) draw_technique(row);
            technique = &row.technique;
            draw_row(widgets, row);
        }
        ImGui::EndTable();
    }

    static void draw_technique(const CounterRow& row) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::PushStyleColor(ImGuiCol_Text, color_of_stage(static_cast<std::size_t>(row.stage)));
        ImGui::TextUnformatted(row.technique.c_str());
        ImGui::PopStyleColor();
    }

    /// Numbers stand under each other, ends at ends.
    static void draw_number(Widgets& widgets, std::string_view label, const std::string& text, const ImVec4& color) {
        const float width = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x - 14;
        if (width > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + width);
        widgets.text(label, text, &color);
    }

    void draw_row(Widgets& widgets, const CounterRow& row) const {
        const auto of_technique = widgets.in(row.technique);
        const auto of_counter = widgets.in(row.name);
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::Indent(10);
        widgets.text("name", row.name, row.now ? &palette().text : &palette().dim);
        widgets.help(row.help);
        ImGui::Unindent(10);
        ImGui::TableNextColumn();
        const bool is_some = row.now && *row.now > 0;
        draw_number(widgets, "now", row.now ? grouped(*row.now) : "\xe2\x80\x93", is_some ? palette().text : palette().dim);
        ImGui::TableNextColumn();
        const double pixels = static_cast<double>(std::max<std::uint64_t>(now_->pixels, 1));
        draw_number(widgets, "per pixel", is_some ? fmt::format("{:.3g}", static_cast<double>(*row.now) / pixels) : "",
                    palette().dim);
        ImGui::TableNextColumn();
        draw_number(widgets, "before", row.before ? grouped(*row.before) : "", palette().dim);
        ImGui::TableNextColumn();
        draw_number(widgets, "change", change_text(row), palette().warning);
    }

    static constexpr const char* place = "recorded settings";

    std::optional<CountedRun> now_, last_, recorded_;
    Against against_ = Against::last_change;
    std::string find_;
    bool changed_only_ = false;
};

}  // namespace

std::unique_ptr<Panel> counters_panel() { return std::make_unique<CountersPanel>(); }

}  // namespace strata::ui
