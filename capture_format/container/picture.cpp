// The grammar of a thumbnail section's payload:
//
//   picture = width:u32  height:u32  texel{width * height}
//   texel   = r:u8  g:u8  b:u8  a:u8                          sRGB, rows top to bottom
#include "capture_format/container/picture.h"

#include <algorithm>
#include <cstring>

namespace strata {
namespace {

bool fits(std::uint32_t width, std::uint32_t height, std::size_t texel_bytes) {
    return width >= 1 && height >= 1 && width <= largest_picture_edge && height <= largest_picture_edge &&
           texel_bytes == std::size_t{4} * width * height;
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
    if (!rgba8 || picture.mips != 1 || !fits(picture.width, picture.height, picture.texels.size())) {
        return fail(Fault::usage, "a thumbnail is RGBA8 with one mip and 1 to {} texels each way", largest_picture_edge);
    }
    const std::uint32_t extent[] = {picture.width, picture.height};
    const auto head = std::as_bytes(std::span(extent));
    std::vector<std::byte> payload(head.begin(), head.end());
    payload.insert(payload.end(), picture.texels.begin(), picture.texels.end());
    return payload;
}

Result<Texture> decode_picture(std::span<const std::byte> payload) {
    std::uint32_t extent[2] = {};
    if (payload.size() >= sizeof(extent)) std::memcpy(extent, payload.data(), sizeof(extent));
    if (payload.size() < sizeof(extent) || !fits(extent[0], extent[1], payload.size() - sizeof(extent))) {
        return fail(Fault::bad_input, "it is no picture of 1 to {} texels each way", largest_picture_edge);
    }
    const std::span<const std::byte> texels = payload.subspan(sizeof(extent));
    Texture picture;
    picture.name = "thumbnail";
    picture.format = TextureFormat::rgba8_srgb;
    picture.width = extent[0];
    picture.height = extent[1];
    picture.texels.assign(texels.begin(), texels.end());
    return picture;
}

}  // namespace strata
