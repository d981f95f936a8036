// A deep OpenEXR image of any program becomes a frame whose transparent fragments are the image's samples: every sample is one
// small triangle that faces the eye at its depth and covers the middle of its own pixel and no other pixel's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/import/deep_window.h"
#include "capture_format/result.h"

namespace strata {

struct DeepOptions {
    /// Which part of the file, by name or by number from 0; empty: its first deep one.
    std::string part;
    /// Pixels that become the frame, as OpenEXR counts them; nothing: the display window.
    std::optional<DeepWindow> window;
    /// Samples that are read at most (scan lines and tiles outside of the window are not); each takes 96 bytes of capture.
    std::uint64_t most_samples = std::uint64_t{1} << 24;
    /// Bytes that the samples may take until they are recorded; 0: half of the machine's memory.
    std::uint64_t memory_budget = 0;
};

/// What an image was made of and what became of it. Counted in samples unless the name says pixels.
struct DeepCensus {
    std::uint64_t samples = 0;              ///< in the file
    std::uint64_t fragments = 0;            ///< in the frame; three per sample with chromatic alpha
    std::uint64_t pixels = 0, deepest = 0;  ///< pixels with fragments, and the most fragments of one
    std::uint64_t unsorted_pixels = 0;      ///< depths not ascending in the file
    std::uint64_t ties = 0;                 ///< at the depth of the one before: the earlier in the file counts as nearer
    std::uint64_t volumes = 0;              ///< ZBack beyond Z
    std::uint64_t split_pixels = 0;         ///< where volumes overlapped something and were cut
    std::uint64_t cuts = 0;                 ///< at most, that this took
    std::uint64_t depth_not_a_number = 0, depth_not_in_front = 0;  ///< left out
    std::uint64_t depth_too_near = 0;                              ///< put at nearest_depth
    std::uint64_t depth_infinite = 0;                              ///< put behind all others
    std::uint64_t bad_color = 0;                                   ///< a color or alpha that is no number became 0
    std::uint64_t bad_alpha = 0;                                   ///< below 0 or above 1, clamped
    std::uint64_t without_alpha = 0;                               ///< light without coverage: kept
    std::uint64_t faint = 0;    ///< too faint for any technique to draw (alpha and color below 1e-5)
    std::uint64_t outside = 0;  ///< read, but outside of the window: left out
};

struct ImportedDeep {
    Frame frame;  ///< one view of the window with one sample, no opaque surface, no light, black background
    DeepCensus census;
    /// Radiance of the samples over black, at thumbnail_extent(): each value is the mean of its pixels.
    std::vector<glm::dvec3> preview;
    std::vector<std::string> warnings;  ///< what was missing, ignored or changed, as sentences with counts
};

/// Depths are kept to the bit where they are finite and between 1e-15 and 1e15; colors and alphas to the bit where they are
/// within what the census counts. Fails for files that are not deep, are damaged, or claim more than they can hold or than
/// the options allow; nothing is allocated on a file's word.
Result<ImportedDeep> import_deep(const std::filesystem::path&, const DeepOptions&);
/// The same for a file in memory; `name` is for the sentences.
Result<ImportedDeep> import_deep(std::span<const std::byte> file, std::string_view name, const DeepOptions&);

}  // namespace strata
