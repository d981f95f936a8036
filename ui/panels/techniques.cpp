// How each stage is done: its technique, a widget per parameter, what was recorded and the way back to it.
#include <algorithm>

#include "passes/registry.h"
#include "passes/scene/scene_facts.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "ui/panel.h"
#include "ui/widgets/param_widget.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

/// "transparency/weighted" without the stage it stands under.
std::string_view short_name(const Technique& technique) { return technique.name.substr(technique.name.find('/') + 1); }

std::string value_text(const Param& param, double value) {
    if (!param.choices.empty()) return std::string(param.choices[static_cast<std::size_t>(value)]);
    return param.scalar == Scalar::integer ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value);
}

class TechniquesPanel final : public Panel {
public:
    void draw(Model& model, Services& services) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("Techniques");
        if (!model.is_known()) {
            widgets.text("state", "the capture is being opened", &palette().dim);
            return;
        }
        draw_head(model, widgets, services);
        // Recorded choices are those of a frame that was read.
        const bool is_of_label = model.facts().index == model.edits().variant.frame;
        const auto updating = widgets.updating(updating_word(is_of_label, services.replayer, "techniques"));
        ImGui::BeginChild("stages");
        const auto replay = services.replayer.shown("A");
        for (const StageInfo& stage : stages())
            if (model.choices().contains(stage.stage)) draw_stage(model, widgets, stage, replay.get());
        draw_forced(model, widgets);
        ImGui::EndChild();
    }

private:
    static void draw_head(Model& model, Widgets& widgets, Services& services) {
        if (widgets.button("copy command", "Copy command")) {
            ImGui::SetClipboardText(model.command_line().c_str());
            services.log.push_back({LogLine::Kind::said, services.seconds, fmt::format("copied: {}", model.command_line())});
        }
        widgets.help(model.command_line());
        ImGui::SameLine();
        ImGui::BeginDisabled(model.edits() == Edits{.variant = {.frame = model.edits().variant.frame}});
        if (widgets.button("reset all", "\xe2\x86\xba All as recorded")) model.reset_all();
        ImGui::EndDisabled();
        ImGui::Dummy({0, 1});
    }

    void draw_stage(Model& model, Widgets& widgets, const StageInfo& stage, const Replay* replay) const {
        const auto scope = widgets.in(stage.name);
        const SkippedStage* skipped = nullptr;
        if (replay)
            for (const SkippedStage& each : replay->skipped)
                if (each.stage == stage.stage) skipped = &each;
        ImGui::AlignTextToFramePadding();
        const ImVec4 color = skipped ? palette().dim : color_of_stage(static_cast<std::size_t>(stage.stage));
        widgets.text("stage", stage.name, &color);
        widgets.help(stage.purpose);
        ImGui::SameLine(label_width);
        draw_technique(model, widgets, stage);
        if (skipped) {
            ImGui::PushTextWrapPos(0);
            widgets.text("left out", skipped->reason, &palette().dim);
            ImGui::PopTextWrapPos();
        } else {
            // Looked up after what may have chosen another one.
            for (const Param& param : model.choices().at(stage.stage).technique->params) {
                if (!param.group.empty()) widgets.text(fmt::format("group {}", param.group), param.group, &palette().dim);
                draw_param(model, widgets, stage.stage, param);
            }
        }
        ImGui::Dummy({0, 2});
        ImGui::Separator();
    }

    static void draw_technique(Model& model, Widgets& widgets, const StageInfo& stage) {
        const Technique& technique = *model.choices().at(stage.stage).technique;
        const Technique& recorded = *model.recorded().at(stage.stage).technique;
        const std::vector<const Technique*> known = techniques_of(stage.stage);
        std::vector<std::string_view> items;
        for (const Technique* each : known) items.push_back(short_name(*each));
        const auto current = static_cast<std::size_t>(std::ranges::find(known, &technique) - known.begin());
        const std::string summary = fmt::format("{}\n{}\n{}", technique.title, technique.summary, technique.source);
        ImGui::SetNextItemWidth(-reset_width);
        const auto chosen = widgets.combo("technique", items, current);
        widgets.help(summary);
        if (&technique != &recorded) {
            ImGui::SameLine();
            const std::string_view was = short_name(recorded);
            const bool back = widgets.button("reset", "\xe2\x86\xba");
            widgets.help(fmt::format("recorded with {}", was));
            if (back) return model.reset(stage.stage);
        }
        if (chosen) model.use(*known[*chosen]);
    }

    static void draw_param(Model& model, Widgets& widgets, Stage stage, const Param& param) {
        const auto scope = widgets.in(param.name);
        const double value = model.choices().at(stage).settings.get(param.name);
        const bool changed = model.is_changed(stage, param.name);
        ImGui::AlignTextToFramePadding();
        ImGui::Indent(8);
        widgets.text("name", param.name, changed ? &palette().accent : &palette().text);
        ImGui::Unindent(8);
        widgets.help(param.help);
        ImGui::SameLine(label_width);
        ImGui::SetNextItemWidth(-reset_width);
        const std::optional<double> set = draw_value(widgets, param, value);
        if (set) model.set(stage, param.name, *set);
        if (!changed) return;
        ImGui::SameLine();
        const double base = model.base_value(stage, param.name);
        if (widgets.button("reset", "\xe2\x86\xba")) model.reset(stage, param.name);
        widgets.help(fmt::format("back to {}", value_text(param, base)));
    }

    static void draw_forced(Model& model, Widgets& widgets) {
        const Widgets::TreeRow row = widgets.tree("features", false);
        if (!row.open) return;
        const std::vector<Feature>& forced = model.edits().variant.force;
        for (const Feature feature : all_features()) {
            const bool has = model.facts().features.has(feature);
            const bool is_forced = std::ranges::find(forced, feature) != forced.end();
            ImGui::BeginDisabled(has);
            const auto set = widgets.checkbox(name(feature), has || is_forced);
            ImGui::EndDisabled();
            widgets.help(has ? model.facts().features.reason(feature)
                             : "the frame lacks this feature; if it is turned on, its stages run anyway");
            if (!set) continue;
            std::vector<Feature> now = forced;
            if (*set) now.push_back(feature);
            else std::erase(now, feature);
            model.force(std::move(now));
            break;  // `forced` is gone
        }
        widgets.tree_end();
    }

    // The place of the arrow is kept free: a slider that became shorter would jump under the pointer that pulls it.
    static constexpr float label_width = 116, reset_width = 34;
};

}  // namespace

std::unique_ptr<Panel> techniques_panel() { return std::make_unique<TechniquesPanel>(); }

}  // namespace strata::ui
