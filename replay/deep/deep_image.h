// The transparent fragments of a frame as a deep image that any program composites: one sample, sorted by depth, in floats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "passes/reference/fragments.h"
#include "replay/images/image_io.h"

namespace strata {

/// What becomes of fragments that let red, green and blue through differently. A plain deep image has one alpha.
enum class Transmittance {
    refused,   ///< an error that says where they are
    mean,      ///< alpha is one less the mean of the channels: wrong colors behind them, by choice
    channels,  ///< besides that alpha, AR, AG and AB: exact for programs that read them, as `import --deep` does
};

/// A row of pixels as a file holds it.
struct DeepLine {
    std::vector<std::uint32_t> ends;  ///< of each pixel's samples, nearest first
    std::vector<float> values;        ///< all samples of the first channel, then of the next
};

struct DeepImage {
    std::uint32_t width = 0;
    std::vector<std::string_view> channels;  ///< by name, in the alphabet's order, which is that of a file
    std::vector<DeepLine> lines;
    std::vector<glm::dvec3> blend;  ///< exact_blend() of every pixel's fragments over black, row by row

    std::uint64_t samples() const;
};

/// Radiance p + e premultiplied in R, G, B; 1 - t in A; view depth in meters in Z. Of equal depths the nearer (submitted later)
/// comes first. `sample` is below the view's. Fails (usage) where transmittance is refused, naming how many fragments and
/// the draw that has most of them; `frame` is the one the rows are of.
Result<DeepImage> deep_image(const FragmentRows&, std::uint32_t sample, Transmittance, const Frame& frame);

/// Deep scan lines, ZIPS. Equal images and metadata give equal files.
Result<std::string> deep_exr(const DeepImage&, const Metadata&);

}  // namespace strata
