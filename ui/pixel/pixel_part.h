// The parts of the panel Pixel: each a tab of it, each with a question of its own, asked while it is in front.
#pragma once

#include <memory>

#include "ui/panel.h"
#include "ui/replayer/live_query.h"

namespace strata::ui {

class PixelPart {
public:
    virtual ~PixelPart() = default;
    /// The replay is what is shown, the pixel is pinned.
    virtual void draw(Model&, Services&, const Replay&) = 0;
    /// Lets the session go: something else is wanted first.
    virtual void withdraw() = 0;
    virtual bool is_busy() const = 0;
};

std::unique_ptr<PixelPart> pixel_steps_part();
std::unique_ptr<PixelPart> pixel_fragments_part();
std::unique_ptr<PixelPart> pixel_probe_part();
std::unique_ptr<PixelPart> pixel_inside_part();

/// How far an answer is, or why there is none, and what was pressed beside it.
enum class StatePress { none, stop, again };
StatePress draw_state(Widgets&, const Progress*, const std::string& error);

template <typename Question, typename Answer>
void draw_state_of(Widgets& widgets, LiveQuery<Question, Answer>& asked) {
    const StatePress pressed = draw_state(widgets, asked.progress(), asked.error());
    if (pressed == StatePress::stop) asked.stop();
    if (pressed == StatePress::again) asked.again();
}

/// The word over an answer that is not the present question's.
template <typename Question, typename Answer>
std::string updating_word(const LiveQuery<Question, Answer>& asked, const Question& question, const Model& model,
                          const Services& services) {
    return updating_word(asked.is_answered(services.replayer, question) && services.replayer.is_of("A", model.request()),
                         services.replayer, fmt::format("pixel {} {}", model.pin->x, model.pin->y));
}

/// Light as a square of its color, as bright as the display shows it; the cursor stays on the line.
void draw_swatch(glm::dvec3 light);
/// The request without what other panels look at: what does not hang on it is not asked again because of them.
Request with_display_alone(const Request&);

}  // namespace strata::ui
