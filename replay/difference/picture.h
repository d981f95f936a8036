// Pictures with titles, scales and legends: of one image, and of a difference (A, B, what lies between them, and FLIP's map, with
// a frame around the worst pixel).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "replay/difference/canvas.h"
#include "replay/difference/compare_images.h"

namespace strata {

/// What is written over the panels.
struct PictureTitles {
    std::string title, a, b;
};

Result<void> write_png(const std::filesystem::path&, const Canvas&);

/// What a debug view shows from black to white.
struct ViewScale {
    double low = 0, high = 1;
    std::string unit;
};

/// One image under a title, with its scale and what its values lie between, or that all are one. Without a scale the range is
/// that of the values. Samples of light are averaged; of anything else the first layer is shown. Small images are enlarged.
Canvas image_picture(std::string_view name, const HostImage&, const std::string& title, const std::optional<ViewScale>&);

/// Samples of light are averaged; of anything else the layer of the worst pixel is shown. Small images are enlarged.
Canvas difference_picture(const ImageComparison&, const HostImage& a, const HostImage& b, const PictureTitles&);

}  // namespace strata
