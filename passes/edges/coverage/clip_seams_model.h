// Where a device may cut a triangle into pieces: clipping to the view leaves a polygon, which is drawn as triangles. lavapipe
// clips at the picture's border, without a guard band.
#pragma once

#include <cstdint>
#include <set>
#include <tuple>

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::edges {

/// Pixel x, y, draw, triangle.
using ClipSeams = std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>>;

/// Pixels on a line between two corners of what the view leaves of an opaque triangle that it cuts: whichever way the polygon is
/// divided, its seams are among these lines.
ClipSeams clip_seams(const Frame&);

}  // namespace strata::edges
