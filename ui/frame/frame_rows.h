// The frame as rows, before anything is drawn: passes with their steps, what each took, holds and does, what was kept of earlier
// replays.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/replayer/replayer.h"

namespace strata::ui {

/// What was measured, and of what.
struct FrameTimes {
    Request request;
    Run run;
    std::uint64_t shaders = 0;  ///< see Replayer::shaders()
};

/// Consecutive steps of one scope.
struct FramePass {
    Scope scope;
    std::size_t first = 0, end = 0;  ///< steps of the plan
    bool is_executed = false;        ///< in the latest replay; else what it made was kept from an earlier one
    std::optional<Spread> ms;        ///< of the sum of its steps, repeat by repeat
    std::size_t barriers = 0, draws = 0;
    std::uint64_t made_bytes = 0, alive_bytes = 0;  ///< of all its steps; the most at one of them
};

struct FrameRows {
    std::vector<FramePass> passes;
    std::vector<std::optional<std::size_t>> timed;  ///< of each step of the plan: its place among those measured
    std::size_t executed() const;                   ///< passes, without what makes views
    /// The plan's step that was measured as the one in that place.
    std::optional<std::size_t> step_timed_as(std::size_t place) const;
};

/// Times are those of equal steps of an equal pass, wherever it stands now; null: nothing was measured.
FrameRows frame_rows(const Replay&, const FrameTimes*);

/// The sum of steps [first, end), each repeat by itself: what a busy machine did to one repeat is not counted twice.
std::optional<Spread> spread_of_sum(const std::vector<StepRecord>&, std::size_t first, std::size_t end);

/// "12.34 ±0.12", the deviation only where there is one.
std::string time_text(const Spread&);
/// "shadows/pcf", and of a pass at another stage than its own "shadows/pcf at occlusion".
std::string face_of(const Scope&);
/// "sampled.comp" of "lighting/tiled/sampled.comp".
std::string short_name(std::string_view step);
/// "2 of 8 passes run, 6 reused".
std::string executed_text(const FrameRows&);

/// The next of the steps that count, or the one before; the first or last where none is selected; nothing beyond the ends.
std::optional<std::size_t> step_beside(const std::vector<std::size_t>& steps, std::optional<std::size_t> selected, int direction);

}  // namespace strata::ui
