// Pictures with titles, scales and legends: of one image, and of a difference (A, B, what lies between them, and FLIP's map, with
// a frame around the worst pixel).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "replay/difference/canvas.h"
#include "replay/difference/compare_images.h"

namespace strata {

/// What is written over the panels.
struct PictureTitles {
    std::string title, a, b;
};

Result<void> write_png(const std::filesystem::path&, const Canvas&);

/// Where a scale of values begins and ends: where one value is everywhere so that it is white above 0, not black.
std::pair<double, double> scale_ends(double low, double high);

/// A color and what it stands for.
struct Swatch {
    Rgb color;
    std::string meaning;
};

/// What stands below an image. A scale ends where the values do.
struct ImageLegend {
    std::optional<double> low;  ///< of a debug view: where its scale begins, if no value is below
    std::string unit = {};
    std::vector<Swatch> channels = {};  ///< red, green and blue, of an image whose channels show different things
    std::vector<Swatch> colors = {};    ///< of an image that has no scale: those that are seen in it are listed
    std::string if_zero = {};           ///< the sentence where every value is 0
    std::string help = {};              ///< a sentence about the image, below all
    std::optional<double> middle = {};  ///< of one number around this one: red above, blue below, black where it is this
};

/// One image under a title, with its scale and what its values lie between, or that all are one. Samples of light are averaged;
/// of anything else the first layer is shown. Small images are enlarged.
Canvas image_picture(std::string_view name, const HostImage&, const std::string& title, const ImageLegend&);

/// The texels alone, one pixel each, in the colors of image_picture(), and what black and white stand for in words.
struct PlainPicture {
    Canvas canvas;
    std::string scale;
};
PlainPicture plain_picture(std::string_view name, const HostImage&, const ImageLegend&);

/// Samples of light are averaged; of anything else the layer of the worst pixel is shown. Small images are enlarged.
Canvas difference_picture(const ImageComparison&, const HostImage& a, const HostImage& b, const PictureTitles&);

/// The panels of difference_picture() alone, one pixel a texel.
struct PlainPanel {
    std::string key;    ///< "a", "b", "difference", "alpha", "flip"
    std::string title;  ///< "abs(B - A) x 8"
    std::string scale;  ///< "0 is black, 0.125 white"
    Canvas canvas;
};
std::vector<PlainPanel> plain_panels(const ImageComparison&, const HostImage& a, const HostImage& b);

}  // namespace strata
