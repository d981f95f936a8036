// How smoothly the window moves while something is computed.
#pragma once

#include <deque>
#include <string>

namespace strata::ui {

/// Over the last two seconds in which something was computed: a window that rests draws hardly ever, which says nothing.
class FrameRate {
public:
    /// A frame that came so long after the one before.
    void add(double seconds);
    /// 0 where nothing was computed yet.
    double per_second() const;
    double slowest_ms() const;

private:
    std::deque<double> seconds_;
    double sum_ = 0;
};

/// "58 frames a second while something is computed, the slowest took 22 ms"; empty where nothing was.
std::string text(const FrameRate&);

}  // namespace strata::ui
