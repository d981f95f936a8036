// The small payloads of a capture: the thumbnail's picture and the limits of its texts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "capture_format/frame/texture.h"
#include "capture_format/result.h"

namespace strata {

/// Newest grammar of a thumbnail's payload; programs that do not know it leave the thumbnail out.
inline constexpr std::uint32_t picture_version = 2;
/// Versions of the other payloads: UTF-8 text.
inline constexpr std::uint32_t notes_version = 1, expect_version = 1;
/// Expect sections of this version hold the images that texts after them name, in the grammar of blobs sections.
inline constexpr std::uint32_t expect_images_version = 2;
/// What a reader is willing to copy.
inline constexpr std::size_t longest_notes = std::size_t{1} << 20, longest_expectation = std::size_t{1} << 26;

/// Texels of a picture, each way.
inline constexpr std::uint32_t largest_picture_edge = 1024;

/// A thumbnail's extent, at most 160 texels wide. A texel stands for `pixels` x `pixels` of the frame; what is left over at the
/// right and at the bottom is not shown.
struct ThumbnailExtent {
    std::uint32_t width = 0, height = 0, pixels = 1;
};
ThumbnailExtent thumbnail_extent(std::uint32_t frame_width, std::uint32_t frame_height);

/// Fails unless the picture is RGBA8 with one mip and up to largest_picture_edge texels each way.
Result<std::vector<std::byte>> encode_picture(const Texture&);
/// `version` is 1 to picture_version.
Result<Texture> decode_picture(std::span<const std::byte>, std::uint32_t version);

}  // namespace strata
