#include "ui/model.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/reader.h"
#include "passes/scene/scene_facts.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/choice_text.h"
#include "replay/shell_word.h"

namespace strata::ui {
namespace {

Settings base_of(const Choice& choice, const Choice& recorded) {
    return choice.technique == recorded.technique ? recorded.settings : Settings(choice.technique->params);
}

}  // namespace

Model::Model(std::filesystem::path path, DeviceChoice choice, const Request& first)
    : capture(std::move(path)), device(std::move(choice)), edits_{first.variant, first.choices} {}

void Model::know(const FrameFacts& facts) {
    if (facts_ && facts_->index == facts.index) return;
    facts_ = facts;
    // A recorded choice that is not understood fails the replay, which says so; the panels show the stages' defaults.
    auto recorded = choose(facts_->bare);
    if (!recorded) {
        facts_->bare.recorded_with.clear();
        recorded = choose(facts_->bare);
    }
    recorded_ = *std::move(recorded);
    apply_edits();
}

/// Edits may name what this frame's choices do not have: a key of a technique that another frame was recorded with. Those go.
void Model::apply_edits() {
    if (!facts_ || facts_->index != edits_.variant.frame) return;  // another frame's facts are on their way
    ChoiceChanges kept{edits_.choices.techniques, {}};
    choices_ = *choose(facts_->bare, kept);
    for (const SettingChange& change : edits_.choices.settings) {
        kept.settings.push_back(change);
        if (auto more = choose(facts_->bare, kept)) choices_ = *std::move(more);
        else kept.settings.pop_back();
    }
    edits_ = with(choices_);
}

/// The choices as the fewest changes that make them.
Edits Model::with(const Choices& choices) const {
    Edits edits = edits_;
    edits.choices = {};
    for (const auto& [stage, choice] : choices) {
        const Choice& recorded = recorded_.at(stage);
        if (choice.technique != recorded.technique) edits.choices.use(*choice.technique);
        const Settings base = base_of(choice, recorded);
        for (const Param& param : choice.technique->params)
            if (const double value = choice.settings.get(param.name); value != base.get(param.name))
                edits.choices.settings.push_back({choice.technique, std::string(param.name), value});
    }
    return edits;
}

double Model::base_value(Stage stage, std::string_view param) const {
    return base_of(choices_.at(stage), recorded_.at(stage)).get(param);
}

bool Model::is_changed(Stage stage, std::string_view param) const {
    return choices_.at(stage).settings.get(param) != base_value(stage, param);
}

void Model::change(Edits edits, std::string what) {
    if (edits == edits_) return;
    if (what.empty() || what != editing_) past_.push_back(edits_);
    editing_ = std::move(what);
    future_.clear();
    edits_ = std::move(edits);
    apply_edits();
}

void Model::use(const Technique& technique) {
    Choices choices = choices_;
    Choice& choice = choices.at(technique.stage);
    if (choice.technique == &technique) return;
    const Choice& recorded = recorded_.at(technique.stage);
    choice = &technique == recorded.technique ? recorded : Choice{&technique, Settings(technique.params)};
    change(with(choices), {});
}

void Model::set(Stage stage, std::string_view param, double value) {
    Choices choices = choices_;
    if (!choices.at(stage).settings.set(param, value)) return;  // the widget offers a rounder number than the range has
    change(with(choices), fmt::format("{}:{}", name(stage), param));
}

void Model::reset(Stage stage) {
    Choices choices = choices_;
    choices.at(stage) = recorded_.at(stage);
    change(with(choices), {});
}

void Model::reset(Stage stage, std::string_view param) {
    set(stage, param, base_value(stage, param));
    settle();
}

void Model::reset_all() { change({.variant = {.frame = edits_.variant.frame}}, {}); }

void Model::force(std::vector<Feature> features) {
    Edits edits = edits_;
    edits.variant.force = std::move(features);
    change(std::move(edits), {});
}

void Model::select_frame(std::size_t frame) {
    Edits edits = edits_;
    edits.variant.frame = frame;
    change(std::move(edits), "frame");
}

void Model::set_samples(std::uint32_t samples) {
    Edits edits = edits_;
    edits.variant.samples = samples;
    change(std::move(edits), {});
}

void Model::look_from(const EyeMove& eye) {
    Edits edits = edits_;
    edits.variant.eye = eye;
    change(std::move(edits), "eye");
}

void Model::apply(const ChoiceChanges& changes) {
    const auto made = choose(Frame(), changes);
    if (!made) return;
    Choices choices = choices_;
    for (const Technique* technique : changes.techniques)
        if (technique) choices.at(technique->stage) = made->at(technique->stage);
    change(with(choices), {});
}

void Model::undo() {
    if (past_.empty()) return;
    future_.push_back(std::exchange(edits_, std::move(past_.back())));
    past_.pop_back();
    settle();
    apply_edits();
}

void Model::redo() {
    if (future_.empty()) return;
    past_.push_back(std::exchange(edits_, std::move(future_.back())));
    future_.pop_back();
    settle();
    apply_edits();
}

Request Model::request() const {
    return {.variant = edits_.variant, .choices = edits_.choices, .outputs = {wanted_.begin(), wanted_.end()}};
}

std::string Model::command_line() const {
    std::string line = replay_command(capture.string(), edits_.variant, edits_.choices);
    if (uses_shaders) line += fmt::format(" --shaders {}", as_shell_word(shaders.string()));
    if (!device.gpu.empty()) line += fmt::format(" --gpu {}", as_shell_word(device.gpu));
    if (!image.step && !image.made && image.name != "display")
        line += fmt::format(" --outputs {},display", as_shell_word(image.name));
    return line;
}

}  // namespace strata::ui
