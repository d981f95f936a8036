#include "replay/images/host_image.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>

namespace strata {
namespace {

template <typename T>
T read(const std::byte* from, std::uint32_t channel) {
    T value;
    std::memcpy(&value, from + channel * sizeof(T), sizeof value);
    return value;
}

/// 2^exponent, a normal double. ldexp() takes ten times as long, and pictures have millions of these.
double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52); }

/// Small floats: `exponent` bits biased by 15, then `mantissa` bits, no sign. Halves, 11 and 10 bit floats are all of this kind.
double small_float(std::uint32_t bits, std::uint32_t mantissa_bits) {
    const std::uint32_t exponent = bits >> mantissa_bits, mantissa = bits & ((1u << mantissa_bits) - 1);
    const double fraction = mantissa * power_of_two(-static_cast<int>(mantissa_bits));
    if (exponent == 31) return mantissa ? std::nan("") : HUGE_VAL;
    return exponent == 0 ? fraction * power_of_two(-14) : (1 + fraction) * power_of_two(static_cast<int>(exponent) - 15);
}

double half(std::uint16_t bits) { return (bits & 0x8000u ? -1.0 : 1.0) * small_float(bits & 0x7fffu, 10); }

glm::dvec4 packed_floats(std::uint32_t bits) {
    return {small_float(bits & 0x7ffu, 6), small_float(bits >> 11 & 0x7ffu, 6), small_float(bits >> 22, 5), 1};
}

double channel_of(Format format, const std::byte* from, std::uint32_t channel) {
    switch (format) {
        case Format::r8_unorm:
        case Format::rgba8_unorm:
            return read<std::uint8_t>(from, channel) / 255.0;
        case Format::r16_unorm:
        case Format::rgba16_unorm:
            return read<std::uint16_t>(from, channel) / 65535.0;
        case Format::r16f:
        case Format::rg16f:
        case Format::rgba16f:
            return half(read<std::uint16_t>(from, channel));
        case Format::r32f:
        case Format::rg32f:
        case Format::rgba32f:
        case Format::d32f:
            return double{read<float>(from, channel)};
        case Format::r8ui:
            return read<std::uint8_t>(from, channel);
        case Format::r32ui:
        case Format::rg32ui:
        case Format::rgba32ui:
            return read<std::uint32_t>(from, channel);
        case Format::r11g11b10f:
            break;
    }
    return packed_floats(read<std::uint32_t>(from, 0))[static_cast<glm::length_t>(channel)];
}

}  // namespace

glm::dvec4 texel(const HostImage& image, std::uint32_t x, std::uint32_t y, std::uint32_t layer) {
    const Extent& extent = image.shape.extent;
    const FormatRow& format = row(image.shape.format);
    // A volume's slices follow each other as layers do.
    const std::size_t index = (std::size_t{layer} * extent.height + y) * extent.width + x;
    assert(x < extent.width && y < extent.height && (index + 1) * format.bytes <= image.texels.size());
    const std::byte* from = image.texels.data() + index * format.bytes;
    glm::dvec4 value(0, 0, 0, 1);
    for (std::uint32_t i = 0; i < format.channels; ++i) value[static_cast<glm::length_t>(i)] = channel_of(format.format, from, i);
    return value;
}

ReferenceImage in_double(const HostImage& image) {
    const Extent& extent = image.shape.extent;
    ReferenceImage result(extent.width, extent.height, image.shape.layers * extent.depth);
    result.channels = row(image.shape.format).channels;
    for (std::uint32_t layer = 0; layer < result.layers; ++layer)
        for (std::uint32_t y = 0; y < extent.height; ++y)
            for (std::uint32_t x = 0; x < extent.width; ++x) result.at(x, y, layer) = texel(image, x, y, layer);
    return result;
}

}  // namespace strata
