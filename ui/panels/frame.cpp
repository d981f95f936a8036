// The frame as a tree: stages in order, their acts and steps, what each took, what was left out and why.
#include <algorithm>

#include "replay/counted.h"
#include "ui/find_text.h"
#include "ui/panel.h"
#include "ui/theme.h"

namespace strata::ui {
namespace {

// Repeats of a timing: enough for a median that one interrupted repeat does not move.
constexpr std::size_t repeats = 3;

struct Times {
    Request request;
    Run run;
};

std::string milliseconds(const Spread& spread) {
    return spread.mad > 0 ? fmt::format("{:.2f} \xc2\xb1 {:.2f}", spread.median, spread.mad)
                          : fmt::format("{:.2f}", spread.median);
}

/// A row of a plan in the open: the steps from first to end of one act.
struct Act {
    std::string_view scope;
    Stage stage;
    std::size_t first = 0, end = 0;
};

std::vector<Act> acts_of(const std::vector<PlanRow>& steps) {
    std::vector<Act> acts;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (acts.empty() || acts.back().scope != steps[i].scope) acts.push_back({steps[i].scope, steps[i].stage, i, i});
        acts.back().end = i + 1;
    }
    return acts;
}

/// "shadows/pcf", and where it acts when that is not at its own stage: "shadows/pcf at occlusion".
std::string face_of(const Act& act) {
    const std::size_t colon = act.scope.find(": ");
    if (colon == std::string_view::npos) return std::string(act.scope);
    const std::string_view at = act.scope.substr(0, colon), technique = act.scope.substr(colon + 2);
    return at == name(act.stage) ? std::string(technique) : fmt::format("{} at {}", technique, at);
}

bool was_executed(const Run& run, std::string_view scope) {
    return std::ranges::find(run.steps, scope, &StepRecord::scope) != run.steps.end();
}

class FramePanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        const auto scope = services.widgets.in("Frame");
        const auto replay = services.replayer.shown("A");
        take_times(services);
        measure_after_change(model, services, replay.get());
        draw_head(model, services, replay.get());
        if (!replay) return;
        ImGui::BeginChild("tree");
        constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX;
        if (ImGui::BeginTable("steps", 2, flags)) {
            ImGui::TableSetupColumn("step", ImGuiTableColumnFlags_WidthStretch);
            ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, time_width);
            draw_tree(model, services.widgets, *replay);
            ImGui::EndTable();
        }
        draw_left_out(services.widgets, *replay);
        ImGui::EndChild();
    }

    bool is_busy() const override { return timing_ && !timing_->result(); }

    std::span<const PanelKey> keys() const override {
        static constexpr PanelKey table[] = {
            {"ctrl+f", "find a step", [](Panel& self, Model&, Services&) { static_cast<FramePanel&>(self).focus_find_ = true; }},
            {"t", "measure times",
             [](Panel& self, Model& model, Services& services) { static_cast<FramePanel&>(self).measure(model, services); }},
        };
        return table;
    }

private:
    void measure(const Model& model, Services& services) {
        if (is_busy()) return;
        const Request request = model.request();
        tried_ = request;
        timing_ = services.replayer.start<Times>([request](Session& session, Progress& progress) -> Result<Times> {
            if (!progress.at(0, "measuring")) return fail(Fault::usage, "stopped");
            auto runs = session.time(std::span(&request, 1), repeats);
            if (!runs) return runs.error();
            return Times{request, std::move(runs->front())};
        });
    }

    void measure_after_change(const Model& model, Services& services, const Replay* replay) {
        const auto wanted = services.settings.find(always);
        if (wanted == services.settings.end() || !wanted->second || !replay || !services.replayer.is_current("A")) return;
        if (services.replayer.error("A") || (tried_ && *tried_ == replay->request)) return;
        measure(model, services);
    }

    void take_times(Services& services) {
        if (!timing_ || !timing_->result()) return;
        const Result<Times>& result = *timing_->result();
        if (result) times_ = *result;
        else services.log.push_back({LogLine::Kind::failed, services.seconds, result.error().sentence});
        timing_.reset();
    }

    void draw_head(const Model& model, Services& services, const Replay* replay) {
        Widgets& widgets = services.widgets;
        ImGui::BeginDisabled(is_busy() || !replay);
        if (widgets.button("measure", is_busy() ? "Measuring\xe2\x80\xa6" : "Measure")) measure(model, services);
        ImGui::EndDisabled();
        widgets.help("times every step: median and deviation of three runs that execute everything");
        ImGui::SameLine();
        if (const auto set = widgets.checkbox("always", services.settings[always])) services.settings[always] = *set;
        widgets.help("measures after every change");
        ImGui::SetNextItemWidth(-1);
        if (std::exchange(focus_find_, false)) ImGui::SetKeyboardFocusHere();
        if (auto text = widgets.input("find", find_, "find a step")) find_ = *std::move(text);
        if (times_ && times_->run.frame_ms) {
            const bool stale = !replay || times_->request != replay->request;
            widgets.value("frame",
                          fmt::format("{} ms{}", milliseconds(*times_->run.frame_ms), stale ? " (before the last change)" : ""));
        }
        ImGui::Dummy({0, 1});
    }

    /// A step's time, where the timed plan has the same step in its place.
    const Spread* time_of(const PlanRow& row, std::size_t index) const {
        if (!times_ || index >= times_->run.steps.size()) return nullptr;
        const StepRecord& step = times_->run.steps[index];
        return step.scope == row.scope && step.name == row.name && step.ms ? &*step.ms : nullptr;
    }

    /// What an act takes, over a bar of its share; before any timing, whether it was made or kept.
    void draw_act_time(Widgets& widgets, const Replay& replay, const Act& act) const {
        ImGui::TableNextColumn();
        double ms = 0;
        for (std::size_t i = act.first; i < act.end; ++i)
            if (const Spread* spread = time_of(replay.steps[i], i)) ms += spread->median;
        if (!times_ || ms <= 0) {
            widgets.text(fmt::format("{} made", act.scope), was_executed(replay.run, act.scope) ? "made" : "kept",
                         &palette().dim);
            widgets.help("made in the latest replay, or kept from an earlier one");
            return;
        }
        const float share = static_cast<float>(std::min(1.0, ms / std::max(ms, times_->run.frame_ms->median)));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const ImVec4 color = color_of_stage(static_cast<std::size_t>(act.stage));
        ImGui::GetWindowDrawList()->AddRectFilled(
            {at.x, at.y}, {at.x + std::max(1.0f, time_width * share), at.y + ImGui::GetTextLineHeight()}, packed(color, .35f), 2);
        widgets.text(fmt::format("{} ms", act.scope), fmt::format("{:.2f} ms", ms));
        widgets.help(fmt::format("{:.1f} % of the frame", 100.0 * static_cast<double>(share)));
    }

    static void draw_step_time(Widgets& widgets, std::string_view label, const Spread* spread) {
        ImGui::TableNextColumn();
        if (spread) widgets.text(fmt::format("{} ms", label), milliseconds(*spread), &palette().dim);
    }

    bool matches(const PlanRow& row) const {
        return is_found_in(row.name, find_) ||
               std::ranges::any_of(row.images, [&](const std::string& image) { return is_found_in(image, find_); });
    }

    void draw_tree(Model& model, Widgets& widgets, const Replay& replay) {
        for (const Act& act : acts_of(replay.steps)) {
            const auto in_act = std::span(replay.steps).subspan(act.first, act.end - act.first);
            if (std::ranges::none_of(in_act, [&](const PlanRow& row) { return matches(row); })) continue;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            if (!find_.empty()) ImGui::SetNextItemOpen(true);
            const ImVec4 color = color_of_stage(static_cast<std::size_t>(act.stage));
            ImGui::PushStyleColor(ImGuiCol_Text, color);
            const Widgets::TreeRow row = widgets.tree(act.scope, false, 0, face_of(act));
            ImGui::PopStyleColor();
            widgets.help(fmt::format("{}\n{}", act.scope, counted(act.end - act.first, "step")));
            if (row.clicked) select(model, replay, act.end - 1);
            draw_act_time(widgets, replay, act);
            if (!row.open) continue;
            for (std::size_t i = act.first; i < act.end; ++i)
                if (matches(replay.steps[i])) draw_step(model, widgets, replay, i);
            widgets.tree_end();
        }
    }

    void draw_step(Model& model, Widgets& widgets, const Replay& replay, std::size_t index) {
        const PlanRow& row = replay.steps[index];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const std::string label = fmt::format("{} {}", index, row.name.substr(row.name.rfind('/') + 1));
        if (widgets.selectable(label, model.step == index)) select(model, replay, index);
        std::string help = row.name;
        for (const std::string& image : row.images) help += fmt::format("\nwrites {}", image);
        help += fmt::format("\n{} before it", counted(row.barriers, "barrier"));
        widgets.help(help);
        draw_step_time(widgets, label, time_of(row, index));
    }

    /// Selecting a step selects what it writes everywhere.
    static void select(Model& model, const Replay& replay, std::size_t index) {
        model.step = index;
        if (!replay.steps[index].images.empty()) model.image = {.name = replay.steps[index].images.front(), .step = index};
    }

    static void draw_left_out(Widgets& widgets, const Replay& replay) {
        ImGui::Dummy({0, 6});
        const std::size_t count = replay.skipped.size() + replay.culled.size();
        if (count == 0) return;
        const Widgets::TreeRow row = widgets.tree("left out", false, ImGuiTreeNodeFlags_DefaultOpen);
        if (!row.open) return;
        ImGui::PushTextWrapPos(0);
        for (const SkippedStage& skipped : replay.skipped) {
            ImGui::TextUnformatted(std::string(name(skipped.stage)).c_str());
            widgets.text(name(skipped.stage), skipped.reason, &palette().dim);
        }
        for (std::size_t i = 0; i < replay.culled.size(); ++i) {
            const CulledStep& culled = replay.culled[i];
            ImGui::TextUnformatted(culled.name.c_str());
            widgets.text(fmt::format("{} {}", i, culled.name), culled.reason, &palette().dim);
        }
        ImGui::PopTextWrapPos();
        widgets.tree_end();
    }

    static constexpr float time_width = 84;  // "12.34 ± 0.12"
    static constexpr const char* always = "measure after every change";

    JobOf<Times> timing_;
    std::optional<Times> times_;
    std::optional<Request> tried_;  ///< what was measured last, with success or without
    std::string find_;
    bool focus_find_ = false;
};

}  // namespace

std::unique_ptr<Panel> frame_panel() { return std::make_unique<FramePanel>(); }

}  // namespace strata::ui
