// How far a long command is, for whoever waits for it.
#pragma once

#include <chrono>
#include <functional>

#include "replay/session/session.h"

namespace strata {

using Clock = std::function<std::chrono::steady_clock::time_point()>;

/// Shows progress on standard error: on a terminal as one line that rewrites itself, else (a log, a pipe) as a line every 10 s.
Progress progress_line(Clock = std::chrono::steady_clock::now);

/// "frame 3 of 60" of a loop over frames, before the frame of that index.
void show_frame(const Progress&, std::size_t index, std::size_t count);

}  // namespace strata
