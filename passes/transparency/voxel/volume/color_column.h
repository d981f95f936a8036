// One column of words of three channels, red lowest (docs/algorithms/transparency.md 6.4, RGB 10:10:10), and its merging with
// what is gray (6.6).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "passes/transparency/voxel/volume/column.h"

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::transparency {

/// Whether three channels share words: a word of its own for each slice and channel has no need to.
bool packs_colors(const VoxelParams&, std::uint32_t channels);

/// Codes of 8 bits, of one channel.
ColumnFormat color_format(const VoxelParams&);

/// From the codes of what is gray to those of colors, in color_scale_one.
std::uint32_t color_scale(const ColumnFormat& gray);

/// source_gray: the draw lets the same of every channel through, as emitters do.
std::uint32_t source_of(const Frame&, std::uint32_t submission);

class ColorColumn {
public:
    explicit ColorColumn(ColumnFormat format) : format_(format), words_(format.slices, 0) {}

    /// What a field cannot hold is carried into the next channel, from 1024 on.
    void add(std::uint32_t slice, glm::uvec3 codes);

    /// Of a slice as it is stored, before integration.
    glm::uvec3 fields(std::uint32_t slice) const;
    /// The nearest slice in which each channel is known to have exceeded 255; no_overflow.
    glm::uvec3 overflow() const { return overflow_; }
    /// Inclusive sums up to each slice, at most 255, of this and of what is gray.
    std::vector<glm::uvec3> integral(const Column& gray) const;

private:
    ColumnFormat format_;
    std::vector<std::uint32_t> words_;
    glm::uvec3 overflow_{no_overflow};
};

}  // namespace strata::transparency
