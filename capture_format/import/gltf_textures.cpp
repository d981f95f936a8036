#include "capture_format/import/gltf_textures.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>

#include <stb_image.h>

#include "capture_format/codec/texture_bytes.h"
#include "capture_format/codec/texture_mips.h"
#include "capture_format/import/stb_problem.h"
#include "capture_format/inspection.h"

namespace strata::gltf {
namespace {

/// A texel and its share of the mips take 4 + 4 / 3 bytes. They are there four times while a frame is recorded: kept for the next
/// frame, in the frame, in the recorder's blobs, compressed (or on the device that makes the thumbnail). While an image is
/// decoded its texels are there four times and its mips in floats, which is less. Four textures of 4096 x 4096 took 24 bytes per
/// texel.
constexpr std::uint64_t recorded_bytes_per_texel = 24;
/// While an image is decoded for the import alone: as it is stored, with four channels, the texture's own.
constexpr std::uint64_t decoded_bytes_per_texel = 12;
/// Texels each way that frames keep of a texture that was taken.
constexpr std::uint32_t kept_extent = 256;

/// The two formats of glTF. stb reads others, too, with decoders that a hostile file should not reach.
bool is_png_or_jpeg(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("\x89PNG\r\n\x1a\n") || text.starts_with("\xff\xd8\xff");
}

/// Size of an rgba8 texture with all its mips.
std::uint64_t bytes_with_mips(std::uint32_t width, std::uint32_t height) {
    const auto mips = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
    return texture_bytes({.name = {}, .width = width, .height = height, .mips = mips, .texels = {}});
}

/// The mips of at most kept_extent texels each way.
Texture without_finest_mips(const Texture& texture) {
    std::uint32_t mip = 0;
    std::size_t first = 0;
    while (std::max(texture.width, texture.height) >> mip > kept_extent) {
        first += std::size_t{4} * std::max(1u, texture.width >> mip) * std::max(1u, texture.height >> mip);
        ++mip;
    }
    return {.name = texture.name,
            .format = texture.format,
            .width = std::max(1u, texture.width >> mip),
            .height = std::max(1u, texture.height >> mip),
            .mips = texture.mips - mip,
            .address = texture.address,
            .magnify = texture.magnify,
            .minify = texture.minify,
            .between_mips = texture.between_mips,
            .texels = {texture.texels.begin() + static_cast<std::ptrdiff_t>(first), texture.texels.end()}};
}

}  // namespace

struct TextureImport::Room {
    MemoryBudget& budget;
    std::uint64_t bytes_per_texel = 0, texels = 0;
    ~Room() { budget.give_back(bytes_per_texel * texels); }
    /// The texels stay.
    void keep() { texels = 0; }
};

Result<Texture> TextureImport::decode(int index, Room& room) {
    if (const auto known = broken_.find(index); known != broken_.end()) return known->second;
    auto decoded = decode_once(index, room);
    if (!decoded) broken_.emplace(index, decoded.error());
    return decoded;
}

Result<Texture> TextureImport::decode_once(int index, Room& room) {
    if (index < 0) return fail(Fault::bad_input, "import.gltf.no_image", "the texture has no PNG or JPEG image");
    const Image& image = document_.images[static_cast<std::size_t>(index)];
    if (image.content.fault) return within(*image.content.fault, "image {image}", index);
    const auto* encoded = reinterpret_cast<const stbi_uc*>(image.content.bytes.data());
    const auto size = static_cast<int>(std::min<std::size_t>(image.content.bytes.size(), 0x7fffffff));
    int width = 0, height = 0, channels = 0;
    const bool is_known = is_png_or_jpeg(image.content.bytes);
    if (!is_known || stbi_info_from_memory(encoded, size, &width, &height, &channels) == 0) {
        if (is_known) static_cast<void>(stb_problem(""));  // throws without memory
        return fail(Fault::bad_input, "import.gltf.image_format", "image {image} '{name:.80}' is neither PNG nor JPEG", index,
                    image.name + image.uri);
    }
    // before it is decompressed: a few bytes can ask for gigabytes
    if (static_cast<std::uint32_t>(std::max(width, height)) > largest_extent) {
        return fail(Fault::bad_input, "import.gltf.image_size",
                    "image {image} has {width} x {height} texels; the limit is {most} per edge", index, width, height,
                    largest_extent);
    }
    const auto texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    const std::uint64_t bytes = bytes_with_mips(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    if (bytes > largest_blobs_section) {
        return fail(
            Fault::bad_input, "import.gltf.image_bytes",
            "image {image} '{name:.80}' has {width} x {height} texels, with mips {bytes} bytes; a capture holds at most {most} "
            "bytes for a texture",
            index, image.name.empty() ? image.uri : image.name, width, height, bytes, largest_blobs_section);
    }
    if (const auto taken = budget_.take(texels, room.bytes_per_texel, fmt::format("image {}", index)); !taken)
        return taken.error();
    room.texels = texels;
    const auto load = [&] { return stbi_load_from_memory(encoded, size, &width, &height, &channels, STBI_rgb_alpha); };
    forget_stb_problem();
    std::unique_ptr<stbi_uc, void (*)(void*)> pixels(load(), stbi_image_free);
    Texture texture;
    texture.texels.resize(4 * texels);
    // stb gives no reason for some failed allocations: there was room for the texels, so such an image is tried again.
    if (!pixels && !stb_gave_a_reason()) pixels.reset(load());
    if (!pixels)
        return fail(Fault::bad_input, "import.gltf.image_damaged", "image {image} is damaged: {reason}", index,
                    stb_gave_a_reason() ? stb_problem("") : "it ends early");
    texture.name = image.name.empty() ? image.uri : image.name;
    texture.width = static_cast<std::uint32_t>(width);
    texture.height = static_cast<std::uint32_t>(height);
    std::memcpy(texture.texels.data(), pixels.get(), texture.texels.size());
    return texture;
}

Sampling TextureImport::sampling(const TextureSource& texture) const {
    if (texture.sampler < 0 || static_cast<std::size_t>(texture.sampler) >= document_.samplers.size()) return {};
    const Sampler& sampler = document_.samplers[static_cast<std::size_t>(texture.sampler)];
    const auto along = [](std::uint64_t wrap) {
        return wrap == clamp_to_edge ? AddressMode::clamp : wrap == mirrored_repeat ? AddressMode::mirror : AddressMode::repeat;
    };
    std::uint32_t mode = 0;
    while (address_u(AddressMode{mode}) != along(sampler.wrap_s) || address_v(AddressMode{mode}) != along(sampler.wrap_t)) ++mode;
    const std::uint64_t least = sampler.min_filter;
    const bool has_mips = least >= nearest_mipmap_nearest;
    const bool mixes_mips = least == nearest_mipmap_linear || least == linear_mipmap_linear;
    const bool is_nearest = least == nearest_filter || least == nearest_mipmap_nearest || least == nearest_mipmap_linear;
    return {.address = AddressMode{mode},
            .magnify = sampler.mag_filter == nearest_filter ? TexelFilter::nearest : TexelFilter::linear,
            .minify = is_nearest ? TexelFilter::nearest : TexelFilter::linear,
            .between_mips = mixes_mips ? MipFilter::linear
                            : has_mips ? MipFilter::nearest
                                       : MipFilter::none};
}

std::uint32_t TextureImport::add(int index, Encoding encoding, AlphaUse alpha) {
    if (index < 0) return no_index;
    const auto [known, fresh] = known_.try_emplace({index, encoding, alpha}, no_index);
    if (!fresh) return known->second;
    const auto made = convert(document_.textures[static_cast<std::size_t>(index)], encoding, alpha);
    if (made) return known->second = *made;
    leave_out(index, made.error());
    return no_index;
}

void TextureImport::leave_out(int index, const Error& why) {
    if (why.fault == Fault::device_lacks && !problem_) problem_ = why;
    warnings_.push_back(fmt::format("texture {} is left out: {}", index, why.sentence));
}

Result<std::uint32_t> TextureImport::convert(const TextureSource& source, Encoding encoding, AlphaUse alpha) {
    const auto image = static_cast<std::size_t>(source.image);
    const Sampling used = sampling(source);
    const BlobHash content = source.image >= 0 ? blob_hash(document_.images[image].content.bytes) : BlobHash();
    if (const auto same = converted_.find({content, used, encoding, alpha}); same != converted_.end()) return same->second;
    Room room{budget_, recorded_bytes_per_texel};
    auto decoded = decode(source.image, room);
    if (!decoded) return decoded.error();
    decoded->format = encoding == Encoding::srgb ? TextureFormat::rgba8_srgb : TextureFormat::rgba8_unorm;
    decoded->address = used.address;
    decoded->magnify = used.magnify;
    decoded->minify = used.minify;
    decoded->between_mips = used.between_mips;
    if (alpha == AlphaUse::ignored) {
        for (std::size_t i = 3; i < decoded->texels.size(); i += 4) decoded->texels[i] = std::byte{255};
    }
    if (const auto kept = keep(with_mips(*std::move(decoded))); !kept) return kept.error();
    if (!take_) room.keep();
    const auto made = static_cast<std::uint32_t>(textures_.size() - 1);
    converted_.emplace(Use(content, used, encoding, alpha), made);
    return made;
}

Result<void> TextureImport::keep(Texture texture) {
    if (!take_) {
        textures_.push_back(std::move(texture));
        return {};
    }
    textures_.push_back(without_finest_mips(texture));
    const Texture& kept = textures_.back();
    const auto room = budget_.take(kept.texels.size() / 4, recorded_bytes_per_texel, "the textures of the thumbnail");
    if (!room) return room;
    const auto taken = take_(std::move(texture));
    if (!taken && !problem_) problem_ = taken.error();
    return taken;
}

void TextureImport::read(int index, Encoding encoding, const std::function<void(const Texture&)>& visit) {
    if (index < 0) return;
    const TextureSource& source = document_.textures[static_cast<std::size_t>(index)];
    Room room{budget_, decoded_bytes_per_texel};
    auto decoded = decode(source.image, room);
    if (!decoded) return leave_out(index, decoded.error());
    decoded->format = encoding == Encoding::srgb ? TextureFormat::rgba8_srgb : TextureFormat::rgba8_unorm;
    decoded->address = sampling(source).address;
    visit(*decoded);
}

}  // namespace strata::gltf
