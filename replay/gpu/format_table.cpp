#include "replay/gpu/format_table.h"

#include <algorithm>
#include <iterator>

#include "passes/graph/step.h"

namespace strata {
namespace {

enum class FormatUse : std::uint32_t { drawn, blended, depth };

struct DeviceFormatRow {
    Format format;
    vk::Format device;
    FormatUse use;
};

constexpr DeviceFormatRow device_format_rows[] = {
    {Format::r8_unorm, vk::Format::eR8Unorm, FormatUse::blended},
    {Format::rgba8_unorm, vk::Format::eR8G8B8A8Unorm, FormatUse::blended},
    {Format::r16_unorm, vk::Format::eR16Unorm, FormatUse::blended},
    {Format::rgba16_unorm, vk::Format::eR16G16B16A16Unorm, FormatUse::blended},
    {Format::r16f, vk::Format::eR16Sfloat, FormatUse::blended},
    {Format::rg16f, vk::Format::eR16G16Sfloat, FormatUse::blended},
    {Format::rgba16f, vk::Format::eR16G16B16A16Sfloat, FormatUse::blended},
    {Format::r11g11b10f, vk::Format::eB10G11R11UfloatPack32, FormatUse::blended},
    {Format::r32f, vk::Format::eR32Sfloat, FormatUse::blended},
    {Format::rg32f, vk::Format::eR32G32Sfloat, FormatUse::blended},
    {Format::rgba32f, vk::Format::eR32G32B32A32Sfloat, FormatUse::blended},
    {Format::r8ui, vk::Format::eR8Uint, FormatUse::drawn},
    {Format::r32ui, vk::Format::eR32Uint, FormatUse::drawn},
    {Format::rg32ui, vk::Format::eR32G32Uint, FormatUse::drawn},
    {Format::rgba32ui, vk::Format::eR32G32B32A32Uint, FormatUse::drawn},
    {Format::d32f, vk::Format::eD32Sfloat, FormatUse::depth},
};
static_assert(std::size(device_format_rows) == std::size(format_rows));
static_assert(std::ranges::is_sorted(device_format_rows, {}, &DeviceFormatRow::format));

const DeviceFormatRow& device_row(Format format) { return device_format_rows[static_cast<std::uint32_t>(format)]; }

}  // namespace

vk::Format device_format(Format format) { return device_row(format).device; }

vk::ImageAspectFlags aspect_of(Format format) {
    return device_row(format).use == FormatUse::depth ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor;
}

vk::FormatFeatureFlags needed_features(Format format) {
    using Bit = vk::FormatFeatureFlagBits;
    const vk::FormatFeatureFlags any = Bit::eSampledImage | Bit::eTransferSrc | Bit::eTransferDst;
    switch (device_row(format).use) {
        case FormatUse::depth:
            return any | Bit::eDepthStencilAttachment;
        case FormatUse::drawn:
            return any | Bit::eStorageImage | Bit::eColorAttachment;
        case FormatUse::blended:
            return any | Bit::eStorageImage | Bit::eColorAttachment | Bit::eColorAttachmentBlend;
    }
    return any;
}

vk::ImageUsageFlags image_usage(const Shape& shape) {
    using Bit = vk::ImageUsageFlagBits;
    const vk::ImageUsageFlags any = Bit::eSampled | Bit::eTransferSrc | Bit::eTransferDst;
    if (device_row(shape.format).use == FormatUse::depth) return any | Bit::eDepthStencilAttachment;
    return shape.samples > 1 ? any | Bit::eColorAttachment : any | Bit::eColorAttachment | Bit::eStorage;
}

}  // namespace strata
