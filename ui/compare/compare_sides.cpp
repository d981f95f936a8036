#include "ui/compare/compare_sides.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/ranges.h>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/choice_text.h"
#include "ui/picture/outputs.h"
#include "ui/widgets/param_widget.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

constexpr std::array<std::string_view, 7> source_names = {
    "this replay", "as recorded", "kept replay", "other technique", "expectation", "truth", "image file",
};

/// What another technique or setting begins with: what the model has of it, else what was recorded, else the fallbacks.
Settings first_settings(const Model& model, const Technique& technique) {
    for (const Choices* choices : {&model.choices(), &model.recorded()})
        if (const Choice& known = choices->at(technique.stage); known.technique == &technique) return known.settings;
    return Settings(technique.params);
}

void take(const Model& model, ChosenSide& side, const Technique& technique) {
    side.technique = &technique;
    side.settings = first_settings(model, technique);
}

/// The last stage of the frame that can be done in several ways, done in another.
const Technique& first_variant(const Model& model, const Replay* replay) {
    for (auto choice = model.choices().rbegin(); choice != model.choices().rend(); ++choice) {
        const auto known = techniques_of(choice->first);
        if (known.size() < 2) continue;
        if (replay && std::ranges::find(replay->skipped, choice->first, &SkippedStage::stage) != replay->skipped.end()) continue;
        return known[0] == choice->second.technique ? *known[1] : *known[0];
    }
    return *model.choices().begin()->second.technique;
}

void draw_settings(Widgets& widgets, ChosenSide& side) {
    for (const Param& param : side.technique->params) {
        const auto scope = widgets.in(param.name);
        ImGui::AlignTextToFramePadding();
        widgets.text("name", param.name);
        ImGui::SameLine(150);
        ImGui::SetNextItemWidth(200);
        const auto set = draw_value(widgets, param, side.settings.get(param.name));
        if (!set) continue;
        const auto done = side.settings.set(param.name, *set);
        static_cast<void>(done);  // the widget may offer a rounder number than the range has
    }
}

void draw_file(Widgets& widgets, ChosenSide& side) {
    ImGui::SetNextItemWidth(-1);
    if (const auto path = widgets.input("file", side.file, "picture.exr or picture.png, then Enter")) side.file = *path;
}

}  // namespace

std::string_view name(Source source) { return source_names[static_cast<std::size_t>(source)]; }

void CompareSides::draw(Model& model, Widgets& widgets, std::shared_ptr<const Replay> replay) {
    replay_ = std::move(replay);
    if (!model.image.step) image_ = model.image.name;
    draw_side(model, widgets, a_);
    draw_side(model, widgets, b_);
    draw_subject(model, widgets);
}

void CompareSides::draw_side(const Model& model, Widgets& widgets, ChosenSide& side) {
    const auto scope = widgets.in(side.name);
    ImGui::AlignTextToFramePadding();
    widgets.text("name", side.name, &palette().accent);
    widgets.help(&side == &a_ ? "the reference" : "compared with A: differences are B - A, errors are relative to A");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(132);
    if (const auto chosen = widgets.combo("source", source_names, static_cast<std::size_t>(side.source)))
        side.source = static_cast<Source>(*chosen);
    if (side.source == Source::kept && !kept_) kept_ = model.request();
    ImGui::SameLine();
    if (side.source == Source::variant) draw_variant(model, widgets, side);
    else if (side.source == Source::file) draw_file(widgets, side);
    else widgets.text("about", about(side), &palette().dim);
}

void CompareSides::draw_variant(const Model& model, Widgets& widgets, ChosenSide& side) const {
    if (!side.technique) take(model, side, first_variant(model, replay_.get()));
    std::vector<std::string_view> stage_names, technique_names;
    std::vector<Stage> stages_of_frame;
    for (const auto& [stage, choice] : model.choices()) {
        stages_of_frame.push_back(stage);
        stage_names.push_back(strata::name(stage));
    }
    const auto at = std::ranges::find(stages_of_frame, side.technique->stage) - stages_of_frame.begin();
    ImGui::SetNextItemWidth(116);
    if (const auto chosen = widgets.combo("stage", stage_names, static_cast<std::size_t>(at)))
        take(model, side, *model.choices().at(stages_of_frame[*chosen]).technique);
    const std::vector<const Technique*> known = techniques_of(side.technique->stage);
    for (const Technique* each : known) technique_names.push_back(each->name.substr(each->name.find('/') + 1));
    const auto current = std::ranges::find(known, side.technique) - known.begin();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(150);
    if (const auto chosen = widgets.combo("technique", technique_names, static_cast<std::size_t>(current)))
        take(model, side, *known[*chosen]);
    widgets.help(about(side));
    ImGui::SameLine();
    ImGui::BeginDisabled(side.technique->params.empty());
    if (widgets.button("settings", "Settings")) ImGui::OpenPopup("of the variant");
    ImGui::EndDisabled();
    if (!ImGui::BeginPopup("of the variant")) return;
    draw_settings(widgets, side);
    ImGui::EndPopup();
}

std::string CompareSides::about(const ChosenSide& side) const {
    if (side.source == Source::replay) return "as set in Techniques";
    if (side.source == Source::recorded) return "the choices of the capture";
    if (side.source == Source::variant && side.technique)
        return fmt::format("{} {}", side.technique->name, fmt::join(side.settings.lines(), " "));
    if (side.source != Source::kept || !kept_) return side.picture.picture().about;
    if (kept_->choices == ChoiceChanges()) return "the choices of the capture";
    return fmt::format("{} {}", fmt::join(use_texts(kept_->choices), " "), fmt::join(set_texts(kept_->choices), " "));
}

void CompareSides::draw_subject(Model& model, Widgets& widgets) {
    const std::vector<std::string> outputs = outputs_of(model);
    const std::vector<std::string_view> items(outputs.begin(), outputs.end());
    ImGui::SetNextItemWidth(160);
    const auto current = static_cast<std::size_t>(std::ranges::find(outputs, image_) - outputs.begin());
    if (const auto chosen = widgets.combo("image", items, current)) {
        model.image = {.name = outputs[*chosen]};
        image_ = outputs[*chosen];
    }
    ImGui::SameLine();
    draw_after(model, widgets);
    ImGui::SameLine();
    if (widgets.button("fit", "Fit")) model.view = {};
    widgets.help("F, or double click");
    ImGui::SameLine();
    if (widgets.button("swap", "\xe2\x87\x84")) {
        std::swap(a_, b_);
        std::swap(a_.name, b_.name);
    }
    widgets.help("swaps A and B");
    ImGui::SameLine();
    if (widgets.button("keep", "Keep as A")) {
        kept_ = model.request();
        a_.source = Source::kept;
    }
    widgets.help("keep the present choices as A; B follows later changes");
    draw_layer(model, widgets);
}

void CompareSides::draw_after(const Model& model, Widgets& widgets) {
    std::vector<std::string_view> items = {"end of frame"};
    std::vector<std::optional<Stage>> places = {std::nullopt};
    for (const StageInfo& stage : stages()) {
        if (std::ranges::find(stage.outputs, image_) == stage.outputs.end() || !model.choices().contains(stage.stage)) continue;
        items.push_back(stage.name);
        places.emplace_back(stage.stage);
    }
    if (std::ranges::find(places, after_) == places.end()) after_.reset();
    const auto current = std::ranges::find(places, subject().after) - places.begin();
    ImGui::SetNextItemWidth(116);
    if (const auto chosen = widgets.combo("after", items, static_cast<std::size_t>(current))) after_ = places[*chosen];
    widgets.help("the image at the end of the frame, or after a stage; truths exist for stages only");
}

void CompareSides::draw_layer(Model& model, Widgets& widgets) const {
    const auto& image = a_.picture.picture().image;
    const std::uint32_t layers = image ? image->shape.layers * image->shape.extent.depth : 1;
    if (layers < 2) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1);
    const SliderRange range{.high = layers - 1.0, .whole = true};
    if (const auto layer = widgets.slider("layer", model.image.layer, range))
        model.image.layer = static_cast<std::uint32_t>(*layer);
    widgets.help("sample, slice or map: pictures show one layer, the numbers are of all");
}

Subject CompareSides::subject() const {
    Subject made{image_, after_};
    const bool has_truth = a_.source == Source::truth || b_.source == Source::truth;
    if (has_truth && !made.after && replay_) made.after = stage_of_truth(image_, replay_->skipped);
    return made;
}

Request CompareSides::request_of(const ChosenSide& side, const Model& model) const {
    Request request = model.request();
    if (side.source == Source::kept && kept_) request = *kept_;
    if (side.source == Source::recorded || side.source == Source::expectation) request = Request();
    if (side.source == Source::variant && side.technique) request = variant_of(request, *side.technique, side.settings);
    request.variant.frame = model.edits().variant.frame;
    request.outputs = {image_};
    return request;
}

/// A truth is that of the replay on the other side, where there is one.
SideWish CompareSides::wish_of(const ChosenSide& side, const ChosenSide& other, const Model& model) const {
    const bool other_is_replay = other.source != Source::truth && other.source != Source::file;
    const ChosenSide& made_by = side.source == Source::truth && other_is_replay ? other : side;
    return {.source = side.source,
            .subject = subject(),
            .request = request_of(made_by, model),
            .file = side.source == Source::file ? side.file : ""};
}

void CompareSides::update(const Model& model, Services& services) {
    SideWish a = wish_of(a_, b_, model), b = wish_of(b_, a_, model);
    for (SideWish* wish : {&a, &b})
        if (wish->source != Source::file) wish->shaders = services.replayer.shaders();
    a_.picture.show(a, services);
    b_.picture.show(b, services);
    for (ChosenSide* side : {&a_, &b_})
        side->shown.show(side->picture.picture().image, model.image.layer, services.host, services.layer);
    const auto is_shown = [](const ChosenSide& side, const SideWish& wish) {
        return side.picture.is_of(wish) && (!side.picture.picture().image || side.shown.is_current());
    };
    is_of_choice_ = is_shown(a_, a) && is_shown(b_, b);
}

bool CompareSides::is_busy() const {
    return a_.picture.is_busy() || b_.picture.is_busy() || a_.shown.is_busy() || b_.shown.is_busy();
}

std::string CompareSides::trouble() const {
    for (const ChosenSide* side : {&a_, &b_})
        if (!side->picture.message().empty()) return fmt::format("{}: {}", side->name, side->picture.message());
    return {};
}

}  // namespace strata::ui
