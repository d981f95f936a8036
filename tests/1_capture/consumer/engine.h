// The consumer's frame: move, render, record; and how long that took.
#pragma once

#include <cstdint>
#include <vector>

#include "consumer/crowd.h"
#include "consumer/rasterizer.h"
#include "consumer/recording.h"

namespace consumer {

/// Games step by fixed times or by the time that has passed, which is never twice the same.
enum class Pace { even, uneven };
enum class Drawing { rasterized, none };

/// Seconds from one frame to the next.
double step_after(std::uint64_t frame, Pace);

class Engine {
public:
    Engine(Motion motion, Pace pace, Drawing drawing) : crowd_(2000, motion), pace_(pace), drawing_(drawing) {}
    /// One frame, recorded when there is a recording.
    strata::Result<void> frame(Recording*);

    const Crowd& crowd() const { return crowd_; }
    const std::vector<std::uint32_t>& picture() const { return rasterizer_.color(); }
    std::vector<double> frame_ms, recording_ms;  ///< of every frame; recording is part of the frame

private:
    Crowd crowd_;
    Pace pace_;
    Drawing drawing_;
    Rasterizer rasterizer_;
    std::uint64_t frame_ = 0;
};

}  // namespace consumer
