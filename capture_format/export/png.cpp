// Every row is filtered by "up", as what it adds to the one above it: choosing the best filter row by row, as other writers do,
// takes longer than the packing.
#include "capture_format/export/png.h"

#include <cassert>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/core.h>
#include <libdeflate.h>

namespace strata {
namespace {

/// Of zlib's 1 to 12 the level from which on a picture of 640 x 360 takes more than a few milliseconds.
constexpr int compression_level = 4;

std::string big_endian(std::size_t number) {
    return {static_cast<char>(number >> 24), static_cast<char>(number >> 16), static_cast<char>(number >> 8),
            static_cast<char>(number)};
}

/// Length, name, content, checksum (PNG specification, 5.3).
std::string chunk(std::string_view name, std::string_view content) {
    const std::string named = fmt::format("{}{}", name, content);
    return big_endian(content.size()) + named + big_endian(libdeflate_crc32(0, named.data(), named.size()));
}

std::string filtered(std::size_t row_bytes, std::span<const std::byte> texels) {
    std::string rows;
    rows.reserve(texels.size() + texels.size() / row_bytes);
    for (std::size_t at = 0; at < texels.size(); ++at) {
        if (at % row_bytes == 0) rows += '\2';
        const std::byte above = at < row_bytes ? std::byte{0} : texels[at - row_bytes];
        rows += static_cast<char>(std::to_integer<int>(texels[at]) - std::to_integer<int>(above));
    }
    return rows;
}

std::string packed(std::string_view rows) {
    const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
        libdeflate_alloc_compressor(compression_level), libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::string stream(libdeflate_zlib_compress_bound(compressor.get(), rows.size()), '\0');
    const std::size_t size = libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), stream.data(), stream.size());
    if (size == 0) throw std::logic_error("libdeflate wants more room than it asked for");
    stream.resize(size);
    return stream;
}

}  // namespace

std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                                  std::span<const std::byte> texels) {
    const std::size_t row_bytes = std::size_t{width} * channels;
    assert((channels == 3 || channels == 4) && texels.size() == row_bytes * height);
    const char color_type = channels == 3 ? '\2' : '\6';
    // Eight bits a channel; no other way of packing, filtering or interlacing has a number.
    const std::string header = big_endian(width) + big_endian(height) + '\x8' + color_type + std::string(3, '\0');
    const std::string file =
        "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", packed(filtered(row_bytes, texels))) + chunk("IEND", "");
    const auto bytes = std::as_bytes(std::span(file));
    return {bytes.begin(), bytes.end()};
}

}  // namespace strata
