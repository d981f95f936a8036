#include "capture_format/import/gltf_textures.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>

#include <stb_image.h>

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

/// The two formats of glTF. stb reads others, too, with decoders that a hostile file should not reach.
bool is_png_or_jpeg(std::span<const std::byte> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return text.starts_with("\x89PNG\r\n\x1a\n") || text.starts_with("\xff\xd8\xff");
}

}  // namespace

Result<Texture> TextureImport::decode(int index, std::uint64_t bytes_per_texel) {
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
    if (const auto room = budget_.take(texels, bytes_per_texel, fmt::format("image {}", index)); !room) return room.error();
    const auto load = [&] { return stbi_load_from_memory(encoded, size, &width, &height, &channels, STBI_rgb_alpha); };
    std::unique_ptr<stbi_uc, void (*)(void*)> pixels(load(), stbi_image_free);
    Texture texture;
    texture.texels.resize(4 * texels);
    // stb does not say of every allocation that it failed: there was room for the texels, so the image is tried again.
    if (!pixels) pixels.reset(load());
    if (!pixels)
        return fail(Fault::bad_input, "import.gltf.image_damaged", "image {image} is damaged: {reason}", index,
                    stb_problem("it ends early"));
    texture.name = image.name.empty() ? image.uri : image.name;
    texture.width = static_cast<std::uint32_t>(width);
    texture.height = static_cast<std::uint32_t>(height);
    std::memcpy(texture.texels.data(), pixels.get(), texture.texels.size());
    return texture;
}

AddressMode TextureImport::address_mode(const TextureSource& texture) {
    if (texture.sampler < 0 || static_cast<std::size_t>(texture.sampler) >= document_.samplers.size()) return AddressMode::repeat;
    const Sampler& sampler = document_.samplers[static_cast<std::size_t>(texture.sampler)];
    if (sampler.mag_filter == nearest_filter) {
        warnings_.push_back("a sampler asks for nearest filtering; all textures are filtered trilinearly");
    }
    const auto along = [](std::uint64_t wrap) {
        return wrap == clamp_to_edge ? AddressMode::clamp : wrap == mirrored_repeat ? AddressMode::mirror : AddressMode::repeat;
    };
    std::uint32_t mode = 0;
    while (address_u(AddressMode{mode}) != along(sampler.wrap_s) || address_v(AddressMode{mode}) != along(sampler.wrap_t)) ++mode;
    return AddressMode{mode};
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
    const AddressMode address = address_mode(source);
    const BlobHash content = source.image >= 0 ? blob_hash(document_.images[image].content.bytes) : BlobHash();
    if (const auto same = converted_.find({content, address, encoding, alpha}); same != converted_.end()) return same->second;
    auto decoded = decode(source.image, recorded_bytes_per_texel);
    if (!decoded) return decoded.error();
    decoded->format = encoding == Encoding::srgb ? TextureFormat::rgba8_srgb : TextureFormat::rgba8_unorm;
    decoded->address = address;
    if (alpha == AlphaUse::ignored) {
        for (std::size_t i = 3; i < decoded->texels.size(); i += 4) decoded->texels[i] = std::byte{255};
    }
    textures_.push_back(with_mips(*std::move(decoded)));
    const auto made = static_cast<std::uint32_t>(textures_.size() - 1);
    converted_.emplace(Use(content, address, encoding, alpha), made);
    return made;
}

const Texture* TextureImport::data(int index) {
    if (index < 0) return nullptr;
    const auto [known, fresh] = data_.try_emplace(index);
    if (fresh) {
        const TextureSource& source = document_.textures[static_cast<std::size_t>(index)];
        auto decoded = decode(source.image, decoded_bytes_per_texel);
        if (!decoded) {
            leave_out(index, decoded.error());
        } else {
            decoded->address = address_mode(source);
            known->second = *std::move(decoded);
        }
    }
    return known->second ? &*known->second : nullptr;
}

}  // namespace strata::gltf
