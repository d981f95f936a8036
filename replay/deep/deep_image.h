// The transparent fragments of a frame as a deep image that any program composites: one sample, sorted by depth, in floats.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "capture_format/frame.h"
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

/// Samples of pixel i (row by row) are begin[i] to begin[i + 1], nearest first.
struct DeepImage {
    std::uint32_t width = 0, height = 0;
    std::vector<std::size_t> begin;
    /// A channel with its name in the file and a value per sample.
    struct Channel {
        std::string_view name;
        std::vector<float> values;
    };
    std::vector<Channel> channels;
};

/// Radiance p + e premultiplied in R, G, B; 1 - t in A; view depth in metres in Z. Of equal depths the nearer (submitted later)
/// comes first. `sample` is below lists.samples(). Fails (usage) where transmittance is refused, naming how many fragments and
/// the draw that has most of them; `frame` is the one the lists are of.
Result<DeepImage> deep_image(const FragmentLists& lists, std::uint32_t sample, Transmittance, const Frame& frame);

/// Deep scan lines, ZIPS. Equal images and metadata give equal files.
Result<std::string> deep_exr(const DeepImage&, const Metadata&);

}  // namespace strata
