// A picture of a difference: A, B, what lies between them, and FLIP's map, with legends and a frame around the worst pixel.
#pragma once

#include "replay/difference/canvas.h"
#include "replay/difference/compare_images.h"

namespace strata {

/// What is written over the panels.
struct PictureTitles {
    std::string title, a, b;
};

/// Samples of light are averaged; of anything else the layer of the worst pixel is shown. Small images are enlarged.
Canvas difference_picture(const ImageComparison&, const HostImage& a, const HostImage& b, const PictureTitles&);

}  // namespace strata
