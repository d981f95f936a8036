#include "replay/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <stb/stb_image_write.h>
#include <xxhash.h>

namespace strata {
namespace {

/// One layer of one image with its channels as the file stores them.
struct LayerPart {
    std::string name;
    std::uint32_t width = 0, height = 0;
    Imf::PixelType type = Imf::HALF;
    std::vector<std::string> channels;  ///< in the order of the texel's channels
    std::vector<std::byte> texels;      ///< interleaved, channel_bytes each
    std::size_t channel_bytes = 2;
};

Imf::PixelType pixel_type(Format format) {
    const FormatRow& f = row(format);
    if (f.kind == FormatKind::integer) return Imf::UINT;
    if (f.bytes == f.channels * 2 && f.kind == FormatKind::real && format != Format::r16_unorm && format != Format::rgba16_unorm)
        return Imf::HALF;
    return Imf::FLOAT;
}

std::vector<std::string> channel_names(const HostImage& image) {
    if (row(image.shape.format).kind == FormatKind::depth) return {"Z"};
    static const std::vector<std::string> names = {"R", "G", "B", "A"};
    const std::uint32_t count = row(image.shape.format).channels;
    if (count == 1) return {"Y"};
    return {names.begin(), names.begin() + count};
}

/// Half and 32-bit formats go over unchanged; small and packed ones are widened to float or uint.
LayerPart layer_part(const ExrPart& part, std::uint32_t layer) {
    const HostImage& image = *part.image;
    const FormatRow& format = row(image.shape.format);
    LayerPart out{.name = image.shape.layers > 1 ? fmt::format("{}.layer{}", part.name, layer) : part.name,
                  .width = image.shape.extent.width,
                  .height = image.shape.extent.height,
                  .type = pixel_type(image.shape.format),
                  .channels = channel_names(image)};
    out.channel_bytes = out.type == Imf::HALF ? 2 : 4;
    const std::size_t count = std::size_t(out.width) * out.height, texel_bytes = out.channels.size() * out.channel_bytes;
    out.texels.resize(count * texel_bytes);
    if (texel_bytes == format.bytes && format.bytes == format.channels * out.channel_bytes &&
        image.shape.format != Format::r11g11b10f) {
        std::memcpy(out.texels.data(), image.texels.data() + layer * out.texels.size(), out.texels.size());
        return out;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec4 value =
            texel(image, static_cast<std::uint32_t>(i % out.width), static_cast<std::uint32_t>(i / out.width), layer);
        for (std::size_t c = 0; c < out.channels.size(); ++c) {
            std::byte* at = out.texels.data() + i * texel_bytes + c * 4;
            const double channel = value[static_cast<glm::length_t>(c)];
            if (out.type == Imf::UINT) {
                const auto word = static_cast<std::uint32_t>(channel);
                std::memcpy(at, &word, 4);
            } else {
                const auto real = static_cast<float>(channel);
                std::memcpy(at, &real, 4);
            }
        }
    }
    return out;
}

Imf::Header header_of(const LayerPart& part, const Metadata& metadata) {
    Imf::Header header(static_cast<int>(part.width), static_cast<int>(part.height));
    header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& channel : part.channels) header.channels().insert(channel, Imf::Channel(part.type));
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    return header;
}

double srgb(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

}  // namespace

Result<void> write_exr(const std::filesystem::path& path, std::span<const ExrPart> images, const Metadata& metadata) {
    std::vector<LayerPart> parts;
    for (const ExrPart& image : images)
        for (std::uint32_t layer = 0; layer < image.image->shape.layers; ++layer) parts.push_back(layer_part(image, layer));
    std::vector<Imf::Header> headers;
    for (const LayerPart& part : parts) headers.push_back(header_of(part, metadata));
    try {
        Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
        for (std::size_t i = 0; i < parts.size(); ++i) {
            LayerPart& part = parts[i];
            const std::size_t x_stride = part.channels.size() * part.channel_bytes;
            Imf::FrameBuffer buffer;
            for (std::size_t c = 0; c < part.channels.size(); ++c)
                buffer.insert(part.channels[c],
                              Imf::Slice(part.type, reinterpret_cast<char*>(part.texels.data()) + c * part.channel_bytes,
                                         x_stride, x_stride * part.width));
            Imf::OutputPart output(file, static_cast<int>(i));
            output.setFrameBuffer(buffer);
            output.writePixels(static_cast<int>(part.height));
        }
    } catch (const std::exception& problem) {
        return fail(Fault::bad_input, "cannot write {}: {}", path.string(), problem.what());
    }
    return {};
}

Result<void> write_png(const std::filesystem::path& path, const HostImage& image) {
    const auto width = image.shape.extent.width, height = image.shape.extent.height;
    std::vector<std::uint8_t> rgb;
    rgb.reserve(std::size_t(width) * height * 3);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const glm::dvec4 color = texel(image, x, y);
            for (int c = 0; c < 3; ++c) {
                const double channel = std::isfinite(color[c]) ? std::clamp(color[c], 0.0, 1.0) : 0;
                rgb.push_back(static_cast<std::uint8_t>(std::lround(srgb(channel) * 255)));
            }
        }
    if (!stbi_write_png(path.c_str(), static_cast<int>(width), static_cast<int>(height), 3, rgb.data(),
                        static_cast<int>(width) * 3))
        return fail(Fault::bad_input, "cannot write {}", path.string());
    return {};
}

std::string hash_of(const HostImage& image) {
    const std::uint32_t shape[] = {image.shape.extent.width, image.shape.extent.height, image.shape.layers,
                                   static_cast<std::uint32_t>(image.shape.format)};
    const XXH128_hash_t hash = XXH3_128bits_withSeed(image.texels.data(), image.texels.size(), XXH3_64bits(shape, sizeof shape));
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace strata
