// Where the eye looks from instead of from its recorded place: any place, any direction. What flies or orbits moves a View and
// says it as an EyeMove.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "capture_format/result.h"
#include "capture_format/view.h"

namespace strata {

/// Against the recorded view: meters along its axes, then turns, each about the eye's own axes as the ones before it left them.
struct EyeMove {
    double dolly = 0;     ///< ahead
    double truck = 0;     ///< to the right
    double pedestal = 0;  ///< up
    double pan = 0;       ///< radians to the right
    double tilt = 0;      ///< radians up
    double roll = 0;      ///< radians, the eye's top to the right
    friend bool operator==(const EyeMove&, const EyeMove&) = default;
};

/// A member of EyeMove by its name.
struct EyeAxis {
    std::string_view name;
    double EyeMove::*member;
};
std::span<const EyeAxis> eye_axes();

/// The view from there. Nothing of it changes, bit by bit, where nothing moves.
View moved(const View& recorded, const EyeMove&);
/// What moves one view to the place and the direction of another. Its tilt is at most a right angle up or down; there it pans and
/// does not roll.
EyeMove move_between(const View& recorded, const View& wanted);
/// The view turned around a point `distance` meters ahead of it, which stays where it is on the screen: to the right around the
/// world's axis `up`, and up around the view's own x.
struct Orbit {
    double distance = 1;
    glm::dvec3 up{0, 1, 0};
    double right = 0, over = 0;  ///< radians that the eye goes
};
View orbited(const View&, const Orbit&);

/// "dolly=1.5,pan=0.2": what is not 0, exactly; empty for none.
std::string text(const EyeMove&);
/// Fails for what text() would not write.
Result<EyeMove> eye_move_of(std::string_view text);

}  // namespace strata
