// Which pixels of a picture show one draw: for an outline, and for finding what hides it. No device: the draw is rasterized in
// double, and held against the depth that the frame's opaque surfaces left.
#pragma once

#include <cstdint>
#include <vector>

namespace strata {

struct Frame;           // capture_format/frame.h
struct ReferenceImage;  // passes/reference/image.h

enum class Cover : std::uint8_t {
    none,    ///< the draw is not there
    hidden,  ///< it is, behind an opaque surface
    shown,   ///< at a sample of the pixel at least
};

/// Row by row from the top. Draws as in RasterPoint: emitters after the frame's draws. Depth as "depth_layers"; null: nothing is
/// opaque. What a texture
/// cuts out of a masked draw is hidden, as nothing of it is there.
std::vector<Cover> draw_cover(const Frame&, std::uint32_t draw, const ReferenceImage* depth);

}  // namespace strata
