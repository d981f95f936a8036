// Progress of a long command on standard error.
#pragma once

#include <chrono>
#include <functional>

#include "replay/session/session.h"

namespace strata {

struct ProgressTiming {
    std::function<std::chrono::steady_clock::time_point()> clock = std::chrono::steady_clock::now;
    std::chrono::milliseconds between_lines{10'000};  ///< on a pipe or in a log
    std::chrono::milliseconds beat{1'000};            ///< how often the clock is read while no progress is reported
};

/// Shows progress on standard error: on a terminal as one line that is rewritten, on a pipe or in a log as a line every 10 s. A
/// thread repeats the last report with the elapsed time while one step takes long. The line is cleared when the last copy of
/// the returned function is destroyed.
Progress progress_line(ProgressTiming = {});

/// Reports "frame 3 of 60" before the frame with that index is processed.
void show_frame(const Progress&, std::size_t index, std::size_t count);

}  // namespace strata
