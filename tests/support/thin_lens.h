// A thin lens by its definition: pictures of the scene itself from points of its disc. What lies in the plane in focus falls on
// the same pixel of each.
#pragma once

#include <vector>

#include "capture_format/frame.h"
#include "passes/reference/image.h"

namespace strata {

/// Offsets within the unit disc, evenly over its area, none at its middle.
std::vector<glm::dvec2> lens_places(std::uint32_t count);

/// The frame from a point of its lens, which is a pinhole there: the eye moves by the offset times half the aperture, and the
/// picture is sheared against that.
Frame seen_from(const Frame&, const glm::dvec2& place);

/// Radiance of unlit surfaces, one sample, rasterized in double; near / z in the second image.
struct UnlitPicture {
    ReferenceImage color, depth_layers;
};
UnlitPicture unlit_picture(const Frame&);

/// The mean of unlit pictures from so many places.
ReferenceImage traced_through_lens(const Frame&, std::uint32_t places);

}  // namespace strata
