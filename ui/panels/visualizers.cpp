// A gallery of every view of every technique in use; beside the one that is selected its legend, its parameters and the numbers
// that belong to it.
#include <algorithm>

#include "passes/stages.h"
#include "passes/technique.h"
#include "ui/panel.h"
#include "ui/picture/look_bytes.h"
#include "ui/picture/view_readouts.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr float thumbnail_gap = 6, least_thumbnail = 110;

/// The views of a technique in use, as of a request.
struct Group {
    const Technique* technique;
    MadeOf of;     ///< of the job
    MadeOf shown;  ///< of the views
    JobOf<TechniqueViews> job;
    std::shared_ptr<const TechniqueViews> views;
    std::string error;
    std::map<std::string, TextureId> textures;

    bool is_known() const { return views || !error.empty(); }
    /// What it would have given is of settings that are no more.
    void stop() {
        job->progress.cancel();
        job.reset();
        of = {};
    }
};

class VisualizersPanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        const auto scope = services.widgets.in("Visualizers");
        const auto replay = services.replayer.shown("A");
        if (!model.is_known() || !replay) {
            services.widgets.text("state", "nothing replayed yet", &palette().dim);
            return;
        }
        take_groups(model, services);
        readouts_.take_results(model);
        update(services, *replay);
        if (!model.image.made) chosen_ = model.image.name;
        drawn_at_ = ImGui::GetFrameCount();
        const ViewChoice chosen = choice_of(model);
        const float height = ImGui::GetContentRegionAvail().y;
        ImGui::BeginChild("gallery", {0, chosen.view ? height * .46f : 0});
        if (groups_.empty()) services.widgets.text("state", "no technique in use has debug views", &palette().dim);
        const auto is_skipped = [&](const Group& group) {
            return std::ranges::count(replay->skipped, group.technique->stage, &SkippedStage::stage) > 0;
        };
        for (const bool without_pictures : {false, true})
            for (Group& group : groups_)
                if (is_skipped(group) == without_pictures) draw_group(model, services, *replay, group);
        ImGui::EndChild();
        if (!chosen.view) return;
        ImGui::Separator();
        ImGui::BeginChild("readouts");
        { readouts_.draw(model, services, chosen); }
        ImGui::EndChild();
    }

    bool is_busy() const override {
        // What is finished waits to be taken only while the panel is in front.
        const bool takes = drawn_at_ == ImGui::GetFrameCount();
        const auto waits = [&](const Group& group) { return group.job && (takes || !group.job->result()); };
        return (takes && readouts_.is_busy()) || std::ranges::any_of(groups_, waits);
    }

    std::span<const PanelKey> keys() const override;

    /// The nth view, from 0, of the technique that is looked at.
    void show(Model& model, std::size_t number) const {
        const Technique* technique = focus_of(model);
        if (technique && number < technique->views.size()) select(model, *technique, technique->views[number]);
    }

private:
    static void select(Model& model, const Technique& technique, const DebugView& view) {
        model.image = {.name = output_name(technique, view.name)};
        model.step.reset();
    }

    /// A group per technique in use that has views, in the order of the frame; what is known of one stays.
    void take_groups(const Model& model, Services& services) {
        std::vector<Group> now;
        for (const auto& [stage, choice] : model.choices()) {
            if (choice.technique->views.empty()) continue;
            const auto known = std::ranges::find(groups_, choice.technique, &Group::technique);
            now.push_back(known == groups_.end() ? Group{.technique = choice.technique} : std::move(*known));
            if (known != groups_.end()) known->textures.clear();
        }
        for (const Group& gone : groups_) {
            if (gone.job) gone.job->progress.cancel();
            for (const auto& [name, texture] : gone.textures) services.layer.release(texture);
        }
        groups_ = std::move(now);
    }

    /// One technique at a time, once the picture is there that people wait for; the one that is looked at first.
    void update(Services& services, const Replay& replay) {
        const MadeOf now = replay.made_of();
        bool is_running = false;
        for (Group& group : groups_) {
            take_result(services, group);
            if (group.job && group.of != now) group.stop();
            is_running |= group.job != nullptr;
        }
        if (is_running || !services.replayer.is_current("A")) return;
        const auto stale =
            std::ranges::find_if(groups_, [&](const Group& group) { return group.of != now || !group.is_known(); });
        if (stale == groups_.end()) return;
        stale->of = now;
        stale->error.clear();
        stale->job = services.replayer.start<TechniqueViews>(
            [now, technique = stale->technique](Session& session, ui::Progress& progress) -> Result<TechniqueViews> {
                if (!progress.at(0, std::string(technique->name))) return fail(Fault::stopped, "session.stopped", "stopped");
                return views_of(session, now.request, *technique);
            });
    }

    static void take_result(Services& services, Group& group) {
        if (!group.job || !group.job->result()) return;
        const Result<TechniqueViews>& result = *group.job->result();
        if (result) {
            group.views = std::make_shared<TechniqueViews>(*result);
            group.shown = group.of;
            for (const auto& [name, texels] : group.views->thumbnails)
                group.textures[name] = services.layer.upload(group.textures[name], texels);
        } else {
            group.error = result.error().sentence;
        }
        group.job.reset();
    }

    const Technique* focus_of(const Model& model) const {
        if (const Technique* chosen = choice_of(model).technique) return chosen;
        if (!model.is_known()) return nullptr;
        for (const auto& [stage, choice] : model.choices())
            if (!choice.technique->views.empty()) return choice.technique;
        return nullptr;
    }

    ViewChoice choice_of(const Model& model) const {
        if (model.image.step || !model.is_known()) return {};
        const std::string& shown = model.image.made ? chosen_ : model.image.name;
        for (const auto& [stage, choice] : model.choices())
            for (const DebugView& view : choice.technique->views) {
                if (shown != output_name(*choice.technique, view.name)) continue;
                const auto group = std::ranges::find(groups_, choice.technique, &Group::technique);
                if (group == groups_.end()) return {choice.technique, &view};
                return {choice.technique, &view, group->views, group->shown};
            }
        return {};
    }

    void draw_group(Model& model, Services& services, const Replay& replay, Group& group) {
        Widgets& widgets = services.widgets;
        const Technique& technique = *group.technique;
        const auto scope = widgets.in(technique.name);
        const ImVec4 color = color_of_stage(static_cast<std::size_t>(technique.stage));
        widgets.text("title", fmt::format("{}: {}", name(technique.stage), technique.title), &color);
        widgets.help(fmt::format("{}\n{}", technique.name, technique.summary));
        if (group.job) {
            ImGui::SameLine();
            widgets.text("state", "drawing", &palette().warning);
        }
        const auto skipped = std::ranges::find(replay.skipped, technique.stage, &SkippedStage::stage);
        ImGui::PushTextWrapPos(0);
        if (skipped != replay.skipped.end()) widgets.text("left out", skipped->reason, &palette().dim);
        else if (!group.error.empty()) widgets.text("error", group.error, &palette().bad);
        ImGui::PopTextWrapPos();
        const bool is_of_label = !group.views || services.replayer.is_of(group.shown, model.request());
        const auto updating = widgets.updating(updating_word(is_of_label, services.replayer, technique.name));
        if (skipped == replay.skipped.end()) draw_thumbnails(model, services, replay, group);
        ImGui::Dummy({0, 4});
    }

    void draw_thumbnails(Model& model, Services& services, const Replay& replay, const Group& group) const {
        const float room = ImGui::GetContentRegionAvail().x;
        const int columns = std::max(1, static_cast<int>((room + thumbnail_gap) / (least_thumbnail + thumbnail_gap)));
        const float width = (room - thumbnail_gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
        const float aspect = static_cast<float>(replay.run.height) / static_cast<float>(std::max(1u, replay.run.width));
        const bool has_digits = focus_of(model) == group.technique;
        for (std::size_t i = 0; i < group.technique->views.size(); ++i) {
            if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0, thumbnail_gap);
            const DebugView& view = group.technique->views[i];
            const std::string digit = has_digits && i < 9 ? fmt::format("{} ", i + 1) : "";
            services.widgets.canvas(view.name, {width, width * aspect + ImGui::GetTextLineHeight() + 4}, legend_text(view));
            draw_face(services, group, view, digit);
            if (ImGui::IsItemDeactivated() && ImGui::IsItemHovered()) select(model, *group.technique, view);
            if (model.image.name == output_name(*group.technique, view.name))
                ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), packed(palette().accent), 3,
                                                    0, 2);
            services.widgets.help(fmt::format("{}\n{}", view.help, legend_text(view)));
        }
    }

    /// Over the last widget: the picture, and below it the digit that shows it and its name.
    static void draw_face(const Services& services, const Group& group, const DebugView& view, const std::string& digit) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
        const float caption = to.y - ImGui::GetTextLineHeight() - 2;
        list.AddRectFilled(from, to, packed(palette().line, ImGui::IsItemHovered() ? 1 : .5f), 3);
        if (const auto texture = group.textures.find(std::string(view.name)); texture != group.textures.end())
            list.AddImage(services.layer.shown(texture->second, look_of(view)), {from.x + 1, from.y + 1},
                          {to.x - 1, caption - 1});
        list.PushClipRect(from, to, true);
        const std::string label(view.name);
        list.AddText({from.x + 4, caption}, packed(palette().accent), digit.c_str());
        list.AddText({from.x + 4 + ImGui::CalcTextSize(digit.c_str()).x, caption}, packed(palette().text), label.c_str());
        list.PopClipRect();
    }

    std::vector<Group> groups_;
    std::string chosen_;  ///< the output that was shown before a picture made of it
    int drawn_at_ = -1;   ///< number of the frame
    ViewReadouts readouts_;
};

template <std::size_t number>
void show_view(Panel& panel, Model& model, Services&) {
    static_cast<VisualizersPanel&>(panel).show(model, number - 1);
}

std::span<const PanelKey> VisualizersPanel::keys() const {
    static constexpr std::string_view view_help = "that view of the technique that is looked at";
    static constexpr PanelKey table[] = {
        {"1", view_help, show_view<1>}, {"2", view_help, show_view<2>}, {"3", view_help, show_view<3>},
        {"4", view_help, show_view<4>}, {"5", view_help, show_view<5>}, {"6", view_help, show_view<6>},
        {"7", view_help, show_view<7>}, {"8", view_help, show_view<8>}, {"9", view_help, show_view<9>},
    };
    return table;
}

}  // namespace

std::unique_ptr<Panel> visualizers_panel() { return std::make_unique<VisualizersPanel>(); }

}  // namespace strata::ui
