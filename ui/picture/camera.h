// Looking at a frame from elsewhere: what the mouse and the keys over the picture do to the eye.
#pragma once

#include "ui/panel.h"
#include "ui/picture/picture_view.h"

namespace strata::ui {

/// How the eye moves within a frame of the window, in its own view: meters, and radians of looking around.
struct Flight {
    double ahead = 0, right = 0, up = 0;
    double turn_right = 0, turn_up = 0;
    friend bool operator==(const Flight&, const Flight&) = default;
};
/// Looks around with the horizon level, up to straight up or down, then moves.
View flown(const View&, const Flight&);

/// The distance ahead of the eye of what a pixel shows, from the frame's depth (reversed, infinite); nothing where nothing is.
std::optional<double> distance_at(const HostImage& depth, const View&, glm::ivec2 pixel);

class Camera {
public:
    /// After the picture's widget, with its placement. Right button: look around, WASD and QE fly, Shift faster, the wheel sets
    /// the speed. Alt and left button: orbit around what is under the pointer.
    void move(Model&, const Services&, const Placement&);
    /// Whether the mouse is its, and no one else's.
    bool is_held() const { return hold_ != Hold::none; }

private:
    enum class Hold { none, fly, orbit };

    void begin(Model&, const Services&, const Placement&);
    Flight flight() const;

    Hold hold_ = Hold::none;
    double speed_ = 2;     ///< meters per second
    double distance_ = 5;  ///< meters to what is orbited
};

}  // namespace strata::ui
