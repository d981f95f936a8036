// From the recorded world to view space in double: what the device is given is made camera-relative by these.
#pragma once

#include <glm/glm.hpp>

namespace strata {

struct View;  // capture_format/view.h

inline glm::dvec3 in_view_space(const View& view, const glm::dvec3& world) { return view.to_view * (world - view.origin); }

/// Where the ray from the eye through a point of the image goes; z = 1.
inline glm::dvec3 ray_through(const View& view, double px, double py) {
    const glm::dmat4 m = view.projection;
    const double x = 2 * px / view.width - 1 - double(view.jitter.x), y = 2 * py / view.height - 1 - double(view.jitter.y);
    return {(x - m[2][0]) / m[0][0], (y - m[2][1]) / m[1][1], 1};
}

}  // namespace strata
