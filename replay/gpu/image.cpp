#include "replay/gpu/image.h"

#include <algorithm>

#include "passes/stages.h"
#include "replay/gpu/format_table.h"
#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

vk::ImageCreateInfo image_info(const Shape& shape) {
    const bool is_volume = shape.extent.depth > 1;
    return vk::ImageCreateInfo()
        .setImageType(is_volume ? vk::ImageType::e3D : vk::ImageType::e2D)
        .setFormat(device_format(shape.format))
        .setExtent({shape.extent.width, shape.extent.height, shape.extent.depth})
        .setMipLevels(shape.mips)
        .setArrayLayers(shape.layers)
        .setSamples(static_cast<vk::SampleCountFlagBits>(shape.samples))
        .setTiling(vk::ImageTiling::eOptimal)
        .setUsage(image_usage(shape));
}

vk::ClearColorValue clear_color(const ClearValue& clear, FormatKind kind) {
    vk::ClearColorValue color;
    for (std::size_t i = 0; i < 4; ++i) {
        if (kind == FormatKind::integer) {
            color.uint32[i] = static_cast<std::uint32_t>(clear.value[i]);
        } else {
            color.float32[i] = static_cast<float>(clear.value[i]);
        }
    }
    return color;
}

}  // namespace

PartRange range_of(const Shape& shape, const Part& part) {
    return {.mip = part.mip.value_or(0),
            .mips = part.mip ? 1 : shape.mips,
            .layer = part.layer.value_or(0),
            .layers = part.layer ? 1 : shape.layers};
}

std::uint64_t device_bytes(const OpenedDevice& device, const Shape& shape) {
    const vk::ImageCreateInfo info = image_info(shape);
    const vk::DeviceImageMemoryRequirements wanted(&info);
    return device.handle().getImageMemoryRequirements(wanted).memoryRequirements.size;
}

DeviceImage::DeviceImage(OpenedDevice& device, const Shape& shape, std::string_view name)
    : device_(&device.handle()),
      shape_(shape),
      image_(device.handle(), image_info(shape)),
      memory_(device.memory().allocate(image_.getMemoryRequirements(), MemoryUse::images)),
      layouts_(std::size_t{shape.mips} * shape.layers, vk::ImageLayout::eUndefined) {
    image_.bindMemory(memory_.handle(), memory_.offset());
    device.label(*image_, name);
}

vk::ImageSubresourceRange DeviceImage::subresources(const PartRange& range) const {
    return {aspect_of(shape_.format), range.mip, range.mips, range.layer, range.layers};
}

vk::ImageView DeviceImage::view(vk::ImageViewType type, const PartRange& range) {
    const auto key = std::pair(type, range);
    auto found = views_.find(key);
    if (found == views_.end()) {
        const vk::ImageViewCreateInfo info({}, *image_, type, device_format(shape_.format), {}, subresources(range));
        found = views_.emplace(key, vk::raii::ImageView(*device_, info)).first;
    }
    return *found->second;
}

vk::ImageLayout DeviceImage::layout(const PartRange& range) const { return layouts_[index(range.mip, range.layer)]; }

void DeviceImage::set_layout(const PartRange& range, vk::ImageLayout layout) {
    for (std::uint32_t mip = range.mip; mip < range.mip + range.mips; ++mip)
        std::fill_n(layouts_.begin() + static_cast<std::ptrdiff_t>(index(mip, range.layer)), range.layers, layout);
}

std::vector<vk::ImageMemoryBarrier2> DeviceImage::transitions(const PartRange& range, vk::ImageLayout to,
                                                              Contents contents) const {
    constexpr auto everything = vk::PipelineStageFlagBits2::eAllCommands;
    constexpr auto any = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
    std::vector<vk::ImageMemoryBarrier2> found;
    const auto add = [&](const PartRange& part, vk::ImageLayout from) {
        found.push_back(vk::ImageMemoryBarrier2(everything, any, everything, any)
                            .setOldLayout(contents == Contents::discard ? vk::ImageLayout::eUndefined : from)
                            .setNewLayout(to)
                            .setSrcQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
                            .setDstQueueFamilyIndex(VK_QUEUE_FAMILY_IGNORED)
                            .setImage(*image_)
                            .setSubresourceRange(subresources(part)));
    };
    const auto is_same = [&](std::uint32_t mip, std::uint32_t layer) { return layouts_[index(mip, layer)] == layout(range); };
    bool is_uniform = true;
    for (std::uint32_t mip = range.mip; mip < range.mip + range.mips; ++mip)
        for (std::uint32_t layer = range.layer; layer < range.layer + range.layers; ++layer) is_uniform &= is_same(mip, layer);
    if (is_uniform || contents == Contents::discard) {
        add(range, layout(range));
        return found;
    }
    for (std::uint32_t mip = range.mip; mip < range.mip + range.mips; ++mip)
        for (std::uint32_t layer = range.layer; layer < range.layer + range.layers; ++layer)
            add({mip, 1, layer, 1}, layouts_[index(mip, layer)]);
    return found;
}

void DeviceImage::clear(const vk::raii::CommandBuffer& commands, const ClearValue& clear) const {
    const auto whole = subresources(range_of(shape_, {}));
    const FormatKind kind = row(shape_.format).kind;
    if (kind == FormatKind::depth) {
        const vk::ClearDepthStencilValue value(static_cast<float>(clear.value[0]), 0);
        commands.clearDepthStencilImage(*image_, layout({}), value, whole);
    } else {
        commands.clearColorImage(*image_, layout({}), clear_color(clear, kind), whole);
    }
}

void DeviceImage::make_zero(const vk::raii::CommandBuffer& commands) {
    const PartRange whole = range_of(shape_, {});
    const auto barriers = transitions(whole, vk::ImageLayout::eGeneral, Contents::discard);
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barriers));
    set_layout(whole, vk::ImageLayout::eGeneral);
    clear(commands, {});
}

}  // namespace strata
