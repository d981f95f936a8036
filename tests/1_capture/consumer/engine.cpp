// The loop's body.
#include "consumer/engine.h"

#include <chrono>
#include <cmath>

namespace consumer {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

}  // namespace

double step_after(std::uint64_t frame, Pace pace) {
    return pace == Pace::even ? 1. / 60 : 1. / 60 + std::sin(12.7 * static_cast<double>(frame)) / 600;
}

strata::Result<void> Engine::frame(Recording* recording) {
    const Clock::time_point start = Clock::now();
    if (frame_ > 0) crowd_.step(step_after(frame_ - 1, pace_));
    const std::vector<std::uint32_t> screen = screen_at(frame_);
    const std::vector<Placement> placements = placements_of(crowd_);
    if (drawing_ == Drawing::rasterized) rasterizer_.render(crowd_, placements, screen);
    const Clock::time_point rendered = Clock::now();
    const strata::Result<void> recorded =
        recording ? recording->frame(crowd_, placements, frame_, screen) : strata::Result<void>();
    recording_ms.push_back(milliseconds(Clock::now() - rendered));
    frame_ms.push_back(milliseconds(Clock::now() - start));
    ++frame_;
    return recorded;
}

}  // namespace consumer
