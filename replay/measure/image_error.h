// How far an image is from another in numbers, and what a person allows. Values are compared by their difference, depth by the
// floats that lie between, integers by equality. rmse and relative rmse are those of a report (passes/error_sums.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "passes/frame_images.h"
#include "replay/images/host_image.h"
#include "replay/measure/flip.h"
#include "replay/measure/worst_region.h"

namespace strata {

/// Pixels that are not compared: of images in which a clock, a cursor or noise stands.
struct IgnoredPixels {
    std::vector<PixelBox> boxes;  ///< in every image that is compared
    std::vector<bool> mask;       ///< true: ignored; or none
    std::uint32_t mask_width = 0, mask_height = 0;

    bool is_empty() const { return boxes.empty() && mask.empty(); }
    bool has(std::uint32_t x, std::uint32_t y) const {
        for (const PixelBox& box : boxes)
            if (box.has(x, y)) return true;
        return !mask.empty() && mask[std::size_t(y) * mask_width + x];
    }
};

/// What is allowed. The defaults allow no difference at all.
struct ErrorLimits {
    static constexpr double none = std::numeric_limits<double>::infinity();
    // Of values, as `idiff` has them: a pixel counts by its worst channel.
    std::optional<double> limit = std::nullopt;      ///< a pixel may differ by so much; unset: 0, or FLIP alone decides
    double percent = 0;                              ///< of the pixels may differ by more
    double hard_limit = none;                        ///< no pixel may differ by more
    double warn_limit = none, warn_percent = 0;      ///< the same, for a warning
    std::uint32_t ulps = 0;                          ///< of depth: floats from one value to the other
    std::optional<double> flip_mean = std::nullopt;  ///< where there is FLIP
    std::optional<double> region = std::nullopt;     ///< percentage of the pixels of a block (worst_region.h) over the limit
    FlipOptions flip = {};
    IgnoredPixels ignored = {};
    std::vector<std::string> images = {};  ///< names of those that are compared; empty: all
    bool asks_for(std::string_view image) const { return images.empty() || std::ranges::count(images, image) > 0; }
};

/// The channel that differs most.
struct WorstPixel {
    std::uint32_t x = 0, y = 0, layer = 0, channel = 0;
    double a = 0, b = 0;
};

struct ImageError {
    enum class Kind { values, depth, integers } kind = Kind::values;
    bool identical = false;  ///< every bit: nothing else needs a look
    std::uint64_t pixels = 0, channels = 0;
    // ErrorSums over the judged_channels() with A as what is wanted. Values that disagree are left out and counted below, and so
    // are NaN on both sides. NaN where nothing is left.
    double rmse = 0;
    double reference = 0;  ///< root mean square of A
    double relative_rmse = 0;
    double worst = 0;  ///< difference of values; of depth: in ULPs; infinite where one is not a number or not finite
    WorstPixel worst_pixel;
    std::uint64_t over_limit = 0, over_warn_limit = 0;  ///< pixels
    std::optional<WorstRegion> region = std::nullopt;   ///< where those over the limit stand closest together
    std::uint64_t ignored = 0;                          ///< pixels, of `pixels`
    struct Count {
        std::uint64_t nan = 0, inf = 0;
    } in_a, in_b;
    std::optional<double> alpha_mean = std::nullopt;  ///< mean difference of alpha, where it is judged with colors
    std::uint64_t disagreeing = 0;  ///< values that are NaN or infinite in one and not the same in the other: never allowed
};

/// Whether two images can be compared at all: extent, place, layers, channels and kind of number. The
/// sentence has both shapes or places.
Result<void> check_comparable(const std::string& name, const HostImage& a, const HostImage& b);

/// What an image of this name holds; an image of a file that has no name of a frame image is display light in bytes, radiance in
/// three or four reals, depth in d32f.
Content content_of(std::string_view image, Format);

/// How many channels rmse is over. Light is judged by its colors; alpha counts where it is coverage: in `emission`, and in an
/// image of a file unless both sides are opaque throughout.
std::uint32_t judged_channels(std::string_view image, const HostImage& a, const HostImage& b);

/// Of images that check_comparable() lets through (asserted). The name says what they hold. Limits are on every channel.
ImageError image_error(const HostImage& a, const HostImage& b, const ErrorLimits&, std::string_view name = "");

/// "1920 x 1080, 4 layers, rgba16f".
std::string shape_text(const Shape&);

}  // namespace strata
