// A comparison as one file for a browser: what differs first, pictures of what differs, a table of all images. It asks nothing of
// a network.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "replay/difference/comparison.h"

namespace strata {

/// Longest edge of a picture in a page: a larger image is shown smaller, and the place of its worst pixel beside it as it is.
inline constexpr std::uint32_t page_picture_edge = 640;
/// Edge of that place.
inline constexpr std::uint32_t page_detail_edge = 48;

/// Pictures of the images that differ, as PNG; to be seen by a comparison while the images are there.
class PagePictures {
public:
    void add(std::size_t frame, const PassComparison&, const ImageComparison&, const HostImage& a, const HostImage& b);

    struct Panel {
        std::string key, title, scale;         ///< PlainPanel's
        std::vector<std::byte> whole, detail;  ///< B is transparent where it shows as A does; no detail of a small image
    };
    struct Shown {
        std::string case_name;                ///< case_name()
        std::uint32_t width = 0, height = 0;  ///< of the image
        std::uint32_t shrunk = 1;             ///< texels along an edge that are one pixel of `whole`
        std::vector<Panel> panels;
        std::size_t bytes = 0;
    };
    const Shown* find(const std::string& case_name) const;

private:
    std::vector<Shown> all_;
};

/// HTML. Where there are more pictures than page_picture_bytes, those of the first difference of each frame come first, then
/// those over tolerance.
std::string as_html(const Comparison&, const PagePictures&);

}  // namespace strata
