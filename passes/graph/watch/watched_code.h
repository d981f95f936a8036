// A shader that also marks what it reads and writes of some of its resources: a bit for each texel of an image and for each word
// of a buffer. Everything else that it does stays as it was.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/result.h"

namespace strata {

/// A resource of a shader, and which of its accesses are marked.
struct WatchedBinding {
    std::uint32_t set = 0, slot = 0;
    bool reads = false, writes = false;
    friend auto operator<=>(const WatchedBinding&, const WatchedBinding&) = default;
};

/// The place of the marks of one resource's reads or writes, as watched shaders read it. A texel has the number
/// ((layer * height + y) * width + x) * samples + sample; a word of a buffer its place.
struct MarkPlace {
    std::uint32_t first_word = 0;  ///< among all marks
    std::uint32_t units = 0;       ///< how many have bits; all beyond share the next one
    std::uint32_t width = 0, height = 0, samples = 1;
    std::uint32_t first_layer = 0;  ///< of the view that is bound
    std::uint32_t is_linear = 0;    ///< its sampler: reads four texels
    std::uint32_t padding = 0;
};

/// Descriptors of what a watched shader needs besides its own: a storage buffer of marks, and one of its MarkPlaces.
struct WatchSlots {
    std::uint32_t set = 0, marks = 0, places = 0;
    friend auto operator<=>(const WatchSlots&, const WatchSlots&) = default;
};

/// The uses of a shader that are marked. MarkPlaces follow each other as they do: of a binding that of its reads before that of
/// its writes, then those of attachments.
struct Watched {
    std::vector<WatchedBinding> bindings;
    /// Samples of each attachment that its fragments write.
    std::vector<std::uint32_t> attachments = {};
    WatchSlots slots;
    friend auto operator<=>(const Watched&, const Watched&) = default;
};

/// SPIR-V for SPIR-V. Reads through a sampler mark their footprint, an element of a block all of its words; a function that is
/// given one of several images marks all of them. A fragment shader that neither discards nor sets depth or coverage tests depth
/// first, as it may without marks. Fails where the shader reads a watched resource in a way that is not known.
Result<std::vector<std::uint32_t>> watched_code(std::span<const std::uint32_t> code, const Watched&);

}  // namespace strata
