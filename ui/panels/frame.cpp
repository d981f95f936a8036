// The frame: a timeline of what was measured; stages in order, their passes and steps, what each took, holds and does; what was
// left out and why.
#include <algorithm>

#include "passes/frame_images.h"
#include "passes/stages.h"
#include "replay/plural.h"
#include "ui/frame/frame_columns.h"
#include "ui/frame/timeline.h"
#include "ui/panel.h"
#include "ui/picture/eye_lag.h"
#include "ui/widgets/find_text.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

// Repeats of a timing: enough for a median that one interrupted repeat does not move.
constexpr std::size_t repeats = 3;

constexpr const char* executed_sign = "\xe2\x97\x8f";
constexpr const char* kept_sign = "\xe2\x97\x8b";

class FramePanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Frame");
        const auto replay = services.replayer.shown("A");
        take_times(services);
        measure_after_change(model, services, replay.get());
        draw_controls(model, services, replay.get());
        if (!replay) return;
        // Those of another frame of the capture say nothing here.
        const FrameTimes* times = times_ && times_->request.variant.frame == replay->request.variant.frame ? &*times_ : nullptr;
        const ShownFrame frame{*replay, times, is_stale(*replay), frame_rows(*replay, times)};
        // It stands for the latest replay, and while the eye moves there is always a later one on its way.
        const bool is_of_label = !services.replayer.awaits_shaders() &&
                                 differs_by_the_eye_alone(replay->made_of(), services.replayer.made_of(model.request()));
        const auto updating = widgets.updating(updating_word(is_of_label, services.replayer, "frame"));
        draw_head(widgets, frame);
        if (times && timeline_.ms > 0) draw_measured(model, widgets, frame);
        ImGui::BeginChild("tree");
        // While something is looked for every pass is open; afterwards they are again as they were.
        ImGui::PushID(find_.empty() ? "all" : "found");
        draw_table(model, widgets, frame);
        ImGui::PopID();
        draw_left_out(widgets, *replay);
        ImGui::EndChild();
        step_seen_ = model.step;
        open_all_.reset();
        open_selected_.reset();
    }

    bool is_busy() const override { return timing_ && !timing_->result(); }

    std::span<const PanelKey> keys() const override {
        static constexpr PanelKey table[] = {
            {"ctrl+f", "find a step; Enter goes to the next one that is found",
             [](Panel& self, Model&, Services&) { static_cast<FramePanel&>(self).focus_find_ = true; }},
            {"t", "measure times",
             [](Panel& self, Model& model, Services& services) { static_cast<FramePanel&>(self).measure(model, services); }},
            {"ctrl+up", "the step before", go<-1>, WhileHeld::repeats},
            {"ctrl+down", "the next step, of those that are found", go<1>, WhileHeld::repeats},
            {"ctrl+left", "collapse what the step is in", open<false>},
            {"ctrl+right", "expand it", open<true>},
        };
        return table;
    }

private:
    template <int direction>
    static void go(Panel& self, Model& model, Services& services) {
        if (const auto replay = services.replayer.shown("A")) static_cast<FramePanel&>(self).go_to(model, *replay, direction);
    }

    template <bool is_open>
    static void open(Panel& self, Model&, Services&) {
        static_cast<FramePanel&>(self).open_selected_ = is_open;
    }

    void go_to(Model& model, const Replay& replay, int direction) const {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < replay.steps.size(); ++i)
            if (matches(replay.steps[i])) found.push_back(i);
        if (const auto step = step_beside(found, model.step, direction)) select(model, replay, *step);
    }

    void measure(const Model& model, Services& services) {
        if (is_busy()) return;
        const Request request = model.request();
        tried_ = services.replayer.made_of(request);
        timing_ = services.replayer.start<FrameTimes>(
            [request, shaders = tried_->shaders](Session& session, Progress& progress) -> Result<FrameTimes> {
                if (!progress.at(0, "measuring")) return fail(Fault::stopped, "session.stopped", "stopped");
                return session.time(std::span(&request, 1), repeats).and_then([&](auto& runs) -> Result<FrameTimes> {
                    if (runs.front().frame_ms->repeats < repeats) return fail(Fault::stopped, "session.stopped", "stopped");
                    return FrameTimes{request, std::move(runs.front()), shaders};
                });
            });
    }

    void measure_after_change(const Model& model, Services& services, const Replay* replay) {
        const auto wanted = services.settings.find(always);
        if (wanted == services.settings.end() || !wanted->second || !replay || !services.replayer.is_current("A")) return;
        if (services.replayer.error("A") || (tried_ && *tried_ == replay->made_of())) return;
        measure(model, services);
    }

    void take_times(Services& services) {
        if (!timing_ || !timing_->result()) return;
        const Result<FrameTimes>& result = *timing_->result();
        if (result) {
            times_ = *result;
            timeline_ = timeline_of(*times_);
            seen_.reset();
        } else {
            services.log.push_back({LogLine::Kind::failed, services.seconds, result.error().sentence});
        }
        timing_.reset();
    }

    /// Whether what was measured is not what is shown any more; which of its images are brought back does not matter.
    bool is_stale(const Replay& replay) const {
        return times_ && MadeOf{without_outputs(times_->request), times_->shaders} != replay.made_of();
    }

    void draw_controls(Model& model, Services& services, const Replay* replay) {
        Widgets& widgets = services.widgets;
        ImGui::BeginDisabled(is_busy() || !replay);
        if (widgets.button("measure", is_busy() ? "Measuring\xe2\x80\xa6" : "Measure")) measure(model, services);
        ImGui::EndDisabled();
        widgets.help("times every step: median and deviation of three runs that execute everything");
        ImGui::SameLine();
        if (const auto set = widgets.checkbox("always", services.settings[always])) services.settings[always] = *set;
        widgets.help("measures after every change");
        columns_.draw_choice(widgets);
        draw_find(model, widgets, replay);
    }

    static void draw_head(Widgets& widgets, const ShownFrame& frame) {
        widgets.text("executed", executed_text(frame.rows), &palette().dim);
        widgets.help(
            fmt::format("{} executed by the latest replay\n{} kept from an earlier one: nothing that it depends on has "
                        "changed since",
                        executed_sign, kept_sign));
        if (!frame.times || !frame.times->run.frame_ms) return;
        widgets.value("frame", fmt::format("{} ms{}", time_text(*frame.times->run.frame_ms),
                                           frame.is_stale ? ", before the last change" : ""));
        widgets.help("the sum of all steps: median and deviation of three runs");
    }

    void draw_find(Model& model, Widgets& widgets, const Replay* replay) {
        constexpr const char *minus = "\xe2\x8a\x9f", *plus = "\xe2\x8a\x9e";
        const ImGuiStyle& style = ImGui::GetStyle();
        const float buttons =
            ImGui::CalcTextSize(minus).x + ImGui::CalcTextSize(plus).x + 2 * (2 * style.FramePadding.x + style.ItemSpacing.x);
        ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - buttons);
        if (std::exchange(focus_find_, false)) ImGui::SetKeyboardFocusHere();
        if (auto text = widgets.input("find", find_, "find a step")) {
            find_ = *std::move(text);
            step_seen_.reset();
        }
        const bool is_entered = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter));
        if (is_entered && replay && !find_.empty()) go_to(model, *replay, 1);
        ImGui::SameLine();
        if (widgets.button("collapse all", minus)) open_all_ = false;
        widgets.help("collapse all");
        ImGui::SameLine();
        if (widgets.button("expand all", plus)) open_all_ = true;
        widgets.help("expand all");
    }

    void draw_measured(Model& model, Widgets& widgets, const ShownFrame& frame) {
        TimelineMarks marks{.selected = {}, .is_stale = frame.is_stale};
        if (model.step && *model.step < frame.rows.timed.size()) marks.selected = frame.rows.timed[*model.step];
        const auto is_selected = [&](const TimelineBar& bar) { return marks.selected == bar.first; };
        const auto bar = std::ranges::find_if(timeline_.steps, is_selected);
        if (model.step != step_seen_ && seen_ && bar != timeline_.steps.end())
            seen_ = brought_into_sight(*seen_, timeline_.ms, *bar);
        const auto clicked = draw_timeline(widgets, timeline_, marks, seen_);
        if (!clicked) return;
        if (const auto step = frame.rows.step_timed_as(*clicked)) select(model, frame.replay, *step);
    }

    bool matches(const PlanRow& row) const {
        return is_found_in(row.name, find_) ||
               std::ranges::any_of(row.images, [&](const std::string& image) { return is_found_in(image, find_); });
    }

    void draw_table(Model& model, Widgets& widgets, const ShownFrame& frame) {
        constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoPadOuterX;
        if (!ImGui::BeginTable("steps", first_beside + FrameColumns::count, flags)) return;
        ImGui::TableSetupColumn("##executed", ImGuiTableColumnFlags_WidthFixed | ImGuiTableColumnFlags_IndentDisable, mark_width);
        ImGui::TableSetupColumn("step", ImGuiTableColumnFlags_WidthStretch | ImGuiTableColumnFlags_IndentEnable);
        columns_.set_up(frame);
        ImGui::TableHeadersRow();
        for (const FramePass& pass : frame.rows.passes) draw_pass(model, widgets, frame, pass);
        ImGui::EndTable();
    }

    void draw_pass(Model& model, Widgets& widgets, const ShownFrame& frame, const FramePass& pass) {
        const auto in_pass = std::span(frame.replay.steps).subspan(pass.first, pass.end - pass.first);
        if (std::ranges::none_of(in_pass, [&](const PlanRow& row) { return matches(row); })) return;
        ImGui::TableNextRow();
        draw_mark(widgets, pass);
        columns_.draw_pass(widgets, frame, pass, first_beside);
        ImGui::TableSetColumnIndex(1);
        const bool has_selected = model.step && pass.first <= *model.step && *model.step < pass.end;
        const bool comes_into_sight = has_selected && model.step != step_seen_;
        if (open_all_) ImGui::SetNextItemOpen(*open_all_);
        else if (has_selected && open_selected_) ImGui::SetNextItemOpen(*open_selected_);
        else if (comes_into_sight || !find_.empty()) ImGui::SetNextItemOpen(true);
        ImGui::PushStyleColor(ImGuiCol_Text, color_of_stage(static_cast<std::size_t>(pass.scope.stage)));
        const Widgets::TreeRow row = widgets.tree(text_of(pass.scope), false, 0, face_of(pass.scope));
        ImGui::PopStyleColor();
        widgets.help(fmt::format("{}\n{}, {}, {}", text_of(pass.scope), plural(pass.end - pass.first, "step"),
                                 plural(pass.draws, "draw"), plural(pass.barriers, "barrier")));
        if (row.open) {
            for (std::size_t i = pass.first; i < pass.end; ++i)
                if (matches(frame.replay.steps[i])) draw_step(model, widgets, frame, i);
            widgets.tree_end();
        }
        if (row.clicked) select_here(model, frame.replay, pass.end - 1);
    }

    static void draw_mark(Widgets& widgets, const FramePass& pass) {
        ImGui::TableSetColumnIndex(0);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float height = ImGui::GetTextLineHeight();
        widgets.canvas(fmt::format("{} is", text_of(pass.scope)), {mark_width, height}, pass.is_executed ? "executed" : "kept");
        widgets.help(pass.is_executed ? "executed in the latest replay" : "kept from an earlier replay");
        const ImVec2 middle(at.x + mark_width / 2, at.y + height / 2);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (pass.is_executed) list.AddCircleFilled(middle, 3.5f, packed(palette().good));
        else list.AddCircle(middle, 3.2f, packed(palette().dim), 0, 1.2f);
    }

    void draw_step(Model& model, Widgets& widgets, const ShownFrame& frame, std::size_t index) {
        const PlanRow& row = frame.replay.steps[index];
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(1);
        const std::string label = fmt::format("{} {}", index, short_name(row.name));
        const bool is_selected = model.step == index;
        const bool is_clicked = widgets.selectable(label, is_selected);
        if (is_selected && model.step != step_seen_ && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
        std::string help = fmt::format("{}\n{}", row.name, row.work);
        for (const std::string& image : row.images) help += fmt::format("\nwrites {}", image);
        help += fmt::format("\n{} before it", plural(row.barriers, "barrier"));
        widgets.help(help);
        columns_.draw_step(widgets, frame, label, index, first_beside);
        if (is_clicked) select_here(model, frame.replay, index);
    }

    /// Selecting a step selects what it writes everywhere.
    static void select(Model& model, const Replay& replay, std::size_t index) {
        model.step = index;
        if (!replay.steps[index].images.empty()) model.image = {.name = replay.steps[index].images.front(), .step = index};
    }

    /// A click in the tree itself: nothing there opens or scrolls.
    void select_here(Model& model, const Replay& replay, std::size_t index) {
        select(model, replay, index);
        step_seen_ = model.step;
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

    static constexpr float mark_width = 9;
    static constexpr int first_beside = 2;  ///< columns before it: mark, step
    static constexpr const char* always = "measure after every change";

    JobOf<FrameTimes> timing_;
    std::optional<FrameTimes> times_;
    Timeline timeline_;              ///< of them
    std::optional<AxisRange> seen_;  ///< of the timeline; none: all of it
    std::optional<MadeOf> tried_;    ///< what was measured last, with success or without
    FrameColumns columns_;
    std::string find_;
    bool focus_find_ = false;
    std::optional<std::size_t> step_seen_;          ///< the selection as of the frame before: a new one is brought into sight
    std::optional<bool> open_all_, open_selected_;  ///< what is done to the tree in the next frame
};

}  // namespace

std::unique_ptr<Panel> frame_panel() { return std::make_unique<FramePanel>(); }

}  // namespace strata::ui
