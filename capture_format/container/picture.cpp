// The grammar of a thumbnail section's payload:
//
//   picture = width:u32  height:u32  texel{width * height}                                            in version 1
//   picture = width:u32  height:u32  zstd frame of the texels, rearranged as texel_filter says        in version 2
//   texel   = r:u8  g:u8  b:u8  a:u8                          sRGB, rows top to bottom
#include "capture_format/container/picture.h"

#include <algorithm>
#include <cstring>

#include "capture_format/container/blob_filter.h"
#include "capture_format/container/compression.h"

namespace strata {
namespace {

constexpr std::size_t texel_bytes = 4;
/// Differences to the texel on the left. They are packed channel by channel.
constexpr BlobFilter texel_filter{.step = texel_bytes, .stride = texel_bytes};

bool fits(std::uint32_t width, std::uint32_t height) {
    return width >= 1 && height >= 1 && width <= largest_picture_edge && height <= largest_picture_edge;
}

/// The texels of a payload; empty where it does not hold `count` bytes of them.
std::vector<std::byte> unpacked(std::span<const std::byte> payload, std::size_t count, std::uint32_t version) {
    if (version == 1) return payload.size() == count ? std::vector(payload.begin(), payload.end()) : std::vector<std::byte>();
    std::vector<std::byte> rearranged(count), texels(count);
    const bool whole = decompress(payload, rearranged) && undo_filter(rearranged, texel_filter, texels);
    return whole ? texels : std::vector<std::byte>();
}

constexpr std::uint32_t thumbnail_width = 160;  // at the most

}  // namespace

ThumbnailExtent thumbnail_extent(std::uint32_t frame_width, std::uint32_t frame_height) {
    const auto parts = [](std::uint32_t whole, std::uint32_t most) { return (whole + most - 1) / most; };
    const std::uint32_t pixels = std::max({1u, parts(frame_width, thumbnail_width), parts(frame_height, largest_picture_edge)});
    return {std::max(1u, frame_width / pixels), std::max(1u, frame_height / pixels), pixels};
}

Result<std::vector<std::byte>> encode_picture(const Texture& picture) {
    const bool rgba8 = picture.format == TextureFormat::rgba8_unorm || picture.format == TextureFormat::rgba8_srgb;
    if (!rgba8 || picture.mips != 1 || !fits(picture.width, picture.height) ||
        picture.texels.size() != texel_bytes * picture.width * picture.height) {
        return fail(Fault::usage, "record.thumbnail", "a thumbnail must be RGBA8 with one mip and 1 to {most} texels each way",
                    largest_picture_edge);
    }
    const std::vector<std::byte> filtered = rearranged(picture.texels, texel_filter);
    const std::uint32_t extent[] = {picture.width, picture.height};
    std::vector<std::byte> payload(sizeof extent);
    std::memcpy(payload.data(), extent, sizeof extent);
    Compression().append(payload, filtered);
    return payload;
}

Result<Texture> decode_picture(std::span<const std::byte> payload, std::uint32_t version) {
    std::uint32_t extent[2] = {};
    if (payload.size() >= sizeof extent) std::memcpy(extent, payload.data(), sizeof extent);
    Texture picture;
    picture.name = "thumbnail";
    picture.format = TextureFormat::rgba8_srgb;
    picture.width = extent[0];
    picture.height = extent[1];
    if (fits(extent[0], extent[1]))
        picture.texels = unpacked(payload.subspan(sizeof extent), texel_bytes * extent[0] * extent[1], version);
    if (picture.texels.empty())
        return fail(Fault::bad_input, "capture.thumbnail", "the thumbnail is not a picture of 1 to {most} texels each way",
                    largest_picture_edge);
    return picture;
}

}  // namespace strata
