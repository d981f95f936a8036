// Where in an image the pixels that are over a limit stand closest together: a small defect of a large picture, which its mean
// does not show. No device.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace strata {

/// Pixels from x, y on.
struct PixelBox {
    std::uint32_t x = 0, y = 0, width = 0, height = 0;
    bool has(std::uint32_t at_x, std::uint32_t at_y) const {
        return at_x >= x && at_y >= y && at_x - x < width && at_y - y < height;
    }
    bool operator==(const PixelBox&) const = default;
};

/// Edge of the blocks whose density is judged, in pixels; they lie anywhere in the image.
inline constexpr std::uint32_t region_block = 16;

struct WorstRegion {
    PixelBox box;  ///< around the pixels over the limit of the densest block and of those beside it that are half as dense
    std::uint32_t layer = 0;
    double density = 0;        ///< share of the box that is over the limit
    double block_density = 0;  ///< the same of the densest block; a smaller image is one block
    std::uint64_t pixels = 0;  ///< over the limit in the box
};

/// The worst region of one layer, rows top to bottom; nothing where no pixel is over.
std::optional<WorstRegion> worst_region(const std::vector<bool>& is_over, std::uint32_t width, std::uint32_t height);

}  // namespace strata
