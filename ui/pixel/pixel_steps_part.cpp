// The pixel after every step of the plan. A row selects its step, and with it what it wrote.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "passes/frame_images.h"
#include "ui/pixel/pixel_fragments.h"
#include "ui/pixel/pixel_history.h"
#include "ui/pixel/pixel_part.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

// Of an image with more (visibility has one per light and sample) the rest is counted.
constexpr std::uint32_t most_layers = 8;

bool contains(std::string_view text, std::string_view wanted) {
    const auto same = [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); };
    return !std::ranges::search(text, wanted, same).empty() || wanted.empty();
}

bool is_light(const PixelValue& value) {
    const FrameImageRow* known = find_frame_image(value.image);
    return known && (known->content == Content::radiance || known->content == Content::display);
}

bool has_no_number(const PixelValue& value) {
    const FormatRow& format = row(value.format);
    for (std::uint32_t c = 0; c < format.channels; ++c)
        if (!std::isfinite(value.value[static_cast<int>(c)])) return true;
    return false;
}

class StepsPart final : public PixelPart {
public:
    void draw(Model& model, Services& services, const Replay& replay) override {
        Widgets& widgets = services.widgets;
        const auto scope = widgets.in("steps");
        const PixelQuestion asked{replay.request, glm::uvec2(*model.pin)};
        asked_.ask(services.replayer, asked,
                   [](Session& session, Progress& progress, const PixelQuestion& question) -> Result<std::vector<PixelStep>> {
                       if (!progress.at(0, "the frame, step by step")) return fail(Fault::stopped, "session.stopped", "stopped");
                       return session.pixel_steps(question.request, question.pixel).and_then([&](auto& steps) {
                           return history_of(steps);
                       });
                   });
        draw_filter(widgets);
        draw_state_of(widgets, asked_);
        const auto updating = widgets.updating(updating_word(asked_, asked, model, services));
        if (const auto* steps = asked_.answer()) draw_steps(model, widgets, replay, *steps);
    }
    void withdraw() override { asked_.withdraw(); }
    bool is_busy() const override { return asked_.progress() != nullptr; }

private:
    void draw_filter(Widgets& widgets) {
        if (const auto set = widgets.checkbox("changes", changes_)) changes_ = *set;
        widgets.help("only what a step changed");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-1);
        if (auto text = widgets.input("find", find_, "find an image or a step")) find_ = *std::move(text);
    }

    bool is_shown(const PixelStep& step, const PixelValue& value) const {
        if (changes_ && value.change == Change::same) return false;
        return contains(value.image, find_) || contains(step.name, find_) || contains(text_of(step.scope), find_);
    }

    void draw_steps(Model& model, Widgets& widgets, const Replay& replay, const std::vector<PixelStep>& steps) const {
        constexpr ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                          ImGuiTableFlags_NoPadOuterX | ImGuiTableFlags_Resizable;
        if (!ImGui::BeginTable("values", 2, flags)) return;
        ImGui::TableSetupColumn("step, image", ImGuiTableColumnFlags_WidthFixed, 140);
        ImGui::TableSetupColumn("value");
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableHeadersRow();
        for (const PixelStep& step : steps)
            if (std::ranges::any_of(step.values, [&](const PixelValue& value) { return is_shown(step, value); }))
                draw_step(model, widgets, replay, step);
        ImGui::EndTable();
    }

    void draw_step(Model& model, Widgets& widgets, const Replay& replay, const PixelStep& step) const {
        // While the answer is of the replay before, its places in the plan may be others.
        const PlanRow* planned = step.step < replay.steps.size() ? &replay.steps[step.step] : nullptr;
        if (planned && (planned->name != step.name || planned->scope != step.scope)) planned = nullptr;
        ImGui::TableNextRow(0, ImGui::GetFrameHeight());
        ImGui::TableSetBgColor(ImGuiTableBgTarget_RowBg0, packed({1, 1, 1, .045f}));
        ImGui::TableNextColumn();
        const std::string label = fmt::format("{} {}", step.step, step.name.substr(step.name.rfind('/') + 1));
        const ImVec4 color = planned ? color_of_stage(static_cast<std::size_t>(planned->scope.stage)) : palette().dim;
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        const bool clicked = widgets.selectable(label, model.step == step.step);
        ImGui::PopStyleColor();
        widgets.help(fmt::format("{}\n{}\na click selects the step", text_of(step.scope), step.name));
        if (clicked && planned) {
            model.step = step.step;
            model.image = {.name = step.values.front().image, .step = step.step};
        }
        const auto scope = widgets.in(label);
        ImGui::TableNextColumn();
        widgets.text("pass", text_of(step.scope), &palette().dim);
        for (const PixelValue& value : step.values)
            if (is_shown(step, value) && value.layer < most_layers) draw_value(widgets, value, replay.frame.bare.view);
    }

    static void draw_value(Widgets& widgets, const PixelValue& value, const View& view) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::Indent(10);
        const std::string label = value.layers > 1 ? fmt::format("{} [{}]", value.image, value.layer) : value.image;
        const ImVec4& faint = value.change == Change::same ? palette().dim : palette().text;
        ImGui::TextColored(faint, "%s", label.c_str());
        ImGui::Unindent(10);
        ImGui::TableNextColumn();
        if (is_light(value)) draw_swatch(glm::dvec3(value.value));
        const ImVec4& color = has_no_number(value) ? palette().bad : value.change == Change::changed ? palette().accent : faint;
        std::string text = text_of(value, double{view.near});
        if (value.layer + 1 == most_layers && value.layers > most_layers)
            text += fmt::format("   and {} more layers", value.layers - most_layers);
        widgets.text(label, text, &color);
        constexpr const char* changes[] = {"written for the first time", "changed by this step", "as it was before this step"};
        widgets.help(fmt::format("{} {}: {}", value.image, row(value.format).name, changes[static_cast<int>(value.change)]));
    }

    LiveQuery<PixelQuestion, std::vector<PixelStep>> asked_;
    std::string find_;
    bool changes_ = false;
};

}  // namespace

std::unique_ptr<PixelPart> pixel_steps_part() { return std::make_unique<StepsPart>(); }

}  // namespace strata::ui
