// How far a picture is behind an eye that moves. While somebody flies, every picture is of an eye of some milliseconds ago: a
// veil over each of them would flicker.
#pragma once

#include <deque>
#include <optional>

#include "ui/replayer/replayer.h"

namespace strata::ui {

/// Or by nothing.
bool differs_by_the_eye_alone(MadeOf, const MadeOf&);

class EyeLag {
public:
    /// Once per frame of the window: what is asked for, what the picture was made of, and the window's time in seconds.
    void note(const MadeOf& asked, const MadeOf& shown, double seconds);
    /// Whether the picture differs from what is asked for by the eye alone, and was asked for a moment ago.
    bool is_small() const { return is_small_; }

private:
    struct Passed {
        EyeMove eye;
        double until = 0;  ///< seconds at which another eye was asked for
    };
    bool is_late(const EyeMove& shown, double seconds);

    std::optional<MadeOf> asked_;
    std::deque<Passed> passed_;
    bool is_small_ = true;
};

}  // namespace strata::ui
