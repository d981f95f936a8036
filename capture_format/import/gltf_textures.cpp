#include "capture_format/import/gltf_textures.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include <stb_image.h>

#include "capture_format/import/gltf_accessors.h"
#include "capture_format/inspection.h"
#include "capture_format/texture_mips.h"

namespace strata::gltf {
Result<Texture> TextureImport::decode(int index) const {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.images.size()) {
        return fail(Fault::bad_input, "image {} does not exist", index);
    }
    const tinygltf::Image& image = model_.images[static_cast<std::size_t>(index)];
    std::vector<unsigned char> encoded = image.image;
    if (image.bufferView >= 0) {
        auto viewed = read_view(model_, image.bufferView);
        if (!viewed) return viewed.error();
        encoded = *std::move(viewed);
    }
    int width = 0, height = 0, channels = 0;
    const auto size = static_cast<int>(std::min<std::size_t>(encoded.size(), 0x7fffffff));
    if (size == 0 || stbi_info_from_memory(encoded.data(), size, &width, &height, &channels) == 0) {
        return fail(Fault::bad_input, "image {} '{}' is neither PNG nor JPEG, or its file is missing", index,
                    image.name + image.uri);
    }
    // before it is decompressed: a few bytes can ask for gigabytes
    if (static_cast<std::uint32_t>(std::max(width, height)) > largest_extent) {
        return fail(Fault::bad_input, "image {} has {} x {} texels; at most {} per edge are read", index, width, height,
                    largest_extent);
    }
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(encoded.data(), size, &width, &height, &channels, STBI_rgb_alpha), stbi_image_free);
    if (!pixels) return fail(Fault::bad_input, "image {} is damaged: {}", index, stbi_failure_reason());
    Texture texture;
    texture.name = image.name.empty() ? image.uri : image.name;
    texture.width = static_cast<std::uint32_t>(width);
    texture.height = static_cast<std::uint32_t>(height);
    texture.texels.resize(std::size_t{4} * texture.width * texture.height);
    std::memcpy(texture.texels.data(), pixels.get(), texture.texels.size());
    return texture;
}

AddressMode TextureImport::address_mode(const tinygltf::Texture& texture) {
    if (texture.sampler < 0 || static_cast<std::size_t>(texture.sampler) >= model_.samplers.size()) return AddressMode::repeat;
    const tinygltf::Sampler& sampler = model_.samplers[static_cast<std::size_t>(texture.sampler)];
    if (sampler.wrapS != sampler.wrapT) warnings_.push_back("a sampler wraps its axes differently; both wrap as u does");
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) {
        warnings_.push_back("a sampler asks for nearest filtering; all textures are filtered trilinearly");
    }
    if (sampler.wrapS == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return AddressMode::clamp;
    return sampler.wrapS == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? AddressMode::mirror : AddressMode::repeat;
}

std::uint32_t TextureImport::add(int index, Encoding encoding, AlphaUse alpha) {
    if (index < 0) return no_index;
    const auto [known, fresh] = known_.try_emplace({index, encoding, alpha}, no_index);
    if (!fresh) return known->second;
    if (static_cast<std::size_t>(index) >= model_.textures.size()) {
        warnings_.push_back(fmt::format("texture {} does not exist", index));
        return no_index;
    }
    const tinygltf::Texture& source = model_.textures[static_cast<std::size_t>(index)];
    auto decoded = decode(source.source);
    if (!decoded) {
        warnings_.push_back(fmt::format("texture {} is left out: {}", index, decoded.error().sentence));
        return no_index;
    }
    decoded->format = encoding == Encoding::srgb ? TextureFormat::rgba8_srgb : TextureFormat::rgba8_unorm;
    decoded->address = address_mode(source);
    if (alpha == AlphaUse::ignored) {
        for (std::size_t i = 3; i < decoded->texels.size(); i += 4) decoded->texels[i] = std::byte{255};
    }
    known->second = static_cast<std::uint32_t>(textures_.size());
    textures_.push_back(with_mips(*std::move(decoded)));
    return known->second;
}

glm::vec4 TextureImport::mean(std::uint32_t index) const {
    return index == no_index ? glm::vec4(1) : mean_color(textures_[index]);
}

}  // namespace strata::gltf
