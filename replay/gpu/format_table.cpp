#include "replay/gpu/format_table.h"

#include <algorithm>
#include <iterator>

namespace strata {
namespace {

enum class Use : std::uint32_t { drawn, blended, depth };

struct DeviceFormatRow {
    Format format;
    vk::Format device;
    Use use;
};

constexpr DeviceFormatRow rows[] = {
    {Format::r8_unorm, vk::Format::eR8Unorm, Use::blended},
    {Format::rgba8_unorm, vk::Format::eR8G8B8A8Unorm, Use::blended},
    {Format::r16_unorm, vk::Format::eR16Unorm, Use::blended},
    {Format::rgba16_unorm, vk::Format::eR16G16B16A16Unorm, Use::blended},
    {Format::r16f, vk::Format::eR16Sfloat, Use::blended},
    {Format::rg16f, vk::Format::eR16G16Sfloat, Use::blended},
    {Format::rgba16f, vk::Format::eR16G16B16A16Sfloat, Use::blended},
    {Format::r11g11b10f, vk::Format::eB10G11R11UfloatPack32, Use::blended},
    {Format::r32f, vk::Format::eR32Sfloat, Use::blended},
    {Format::rg32f, vk::Format::eR32G32Sfloat, Use::blended},
    {Format::rgba32f, vk::Format::eR32G32B32A32Sfloat, Use::blended},
    {Format::r8ui, vk::Format::eR8Uint, Use::drawn},
    {Format::r32ui, vk::Format::eR32Uint, Use::drawn},
    {Format::rg32ui, vk::Format::eR32G32Uint, Use::drawn},
    {Format::rgba32ui, vk::Format::eR32G32B32A32Uint, Use::drawn},
    {Format::d32f, vk::Format::eD32Sfloat, Use::depth},
};
static_assert(std::size(rows) == std::size(format_rows));
static_assert(std::ranges::is_sorted(rows, {}, &DeviceFormatRow::format));

const DeviceFormatRow& device_row(Format format) { return rows[static_cast<std::uint32_t>(format)]; }

}  // namespace

vk::Format device_format(Format format) { return device_row(format).device; }

vk::ImageAspectFlags aspect_of(Format format) {
    return device_row(format).use == Use::depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::FormatFeatureFlags needed_features(Format format) {
    using Bit = vk::FormatFeatureFlagBits;
    const vk::FormatFeatureFlags any = Bit::eSampledImage | Bit::eTransferSrc | Bit::eTransferDst;
    switch (device_row(format).use) {
        case Use::depth:
            return any | Bit::eDepthStencilAttachment;
        case Use::drawn:
            return any | Bit::eStorageImage | Bit::eColorAttachment;
        case Use::blended:
            return any | Bit::eStorageImage | Bit::eColorAttachment | Bit::eColorAttachmentBlend;
    }
    return any;
}

vk::ImageUsageFlags image_usage(const Shape& shape) {
    using Bit = vk::ImageUsageFlagBits;
    const vk::ImageUsageFlags any = Bit::eSampled | Bit::eTransferSrc | Bit::eTransferDst;
    if (device_row(shape.format).use == Use::depth) return any | Bit::eDepthStencilAttachment;
    return shape.samples > 1 ? any | Bit::eColorAttachment : any | Bit::eColorAttachment | Bit::eStorage;
}

}  // namespace strata
