#include "ui/window/window_swapchain.h"

#include <algorithm>

#include "passes/stages.h"

namespace strata::ui {
namespace {

/// Bytes as they are: the layer has the curve of sRGB in them already.
vk::SurfaceFormatKHR format_of(LayerDevice& device) {
    const auto formats = device.physical().getSurfaceFormatsKHR(device.surface());
    const auto plain = [](const vk::SurfaceFormatKHR& format) {
        return format.format == vk::Format::eB8G8R8A8Unorm || format.format == vk::Format::eR8G8B8A8Unorm;
    };
    const auto copied = std::ranges::find(formats, LayerTarget::format, &vk::SurfaceFormatKHR::format);
    const auto found = copied != formats.end() ? copied : std::ranges::find_if(formats, plain);
    if (found == formats.end()) throw vk::InitializationFailedError("the window takes no image of 8 bits a channel");
    return *found;
}

}  // namespace

Swapchain::Swapchain(LayerDevice& device)
    : device_(&device), format_(format_of(device)), acquired_(device.handle(), vk::FenceCreateInfo()) {}

void Swapchain::make(vk::Extent2D extent) {
    const auto able = device_->physical().getSurfaceCapabilitiesKHR(device_->surface());
    if (able.currentExtent.width != UINT32_MAX) extent = able.currentExtent;
    std::uint32_t count = able.minImageCount + 1;
    if (able.maxImageCount > 0) count = std::min(count, able.maxImageCount);
    vk::SwapchainCreateInfoKHR info({}, device_->surface(), count, format_.format, format_.colorSpace, extent, 1,
                                    vk::ImageUsageFlagBits::eTransferDst);
    info.setPresentMode(vk::PresentModeKHR::eFifo).setPreTransform(able.currentTransform).setOldSwapchain(*swapchain_);
    swapchain_ = vk::raii::SwapchainKHR(device_->handle(), info);
    images_.clear();
    for (const VkImage image : swapchain_.getImages()) images_.emplace_back(image);
    extent_ = extent;
}

void Swapchain::copy(const LayerTarget& target, std::uint32_t index) {
    auto commands = device_->begin_commands();
    move_to(commands, images_[index], vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    const vk::ImageSubresourceLayers color(vk::ImageAspectFlagBits::eColor, 0, 0, 1);
    const vk::Extent3D extent(std::min(extent_.width, target.extent().width), std::min(extent_.height, target.extent().height),
                              1);
    const vk::Offset3D end(static_cast<std::int32_t>(extent.width), static_cast<std::int32_t>(extent.height), 1);
    const auto from = vk::ImageLayout::eTransferSrcOptimal, to = vk::ImageLayout::eTransferDstOptimal;
    if (format_.format == LayerTarget::format)
        commands.copyImage(target.image(), from, images_[index], to, vk::ImageCopy(color, {}, color, {}, extent));
    else  // the window's channels are in another order
        commands.blitImage(target.image(), from, images_[index], to,
                           vk::ImageBlit(color, {vk::Offset3D(), end}, color, {vk::Offset3D(), end}), vk::Filter::eNearest);
    move_to(commands, images_[index], vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::ePresentSrcKHR);
    device_->submit_and_wait(commands);
}

bool Swapchain::show(const LayerTarget& target, vk::Extent2D extent) {
    try {
        if (!*swapchain_ || extent != extent_) make(extent);
        const auto [acquired, index] = swapchain_.acquireNextImage(UINT64_MAX, {}, *acquired_);
        if (device_->handle().waitForFences(*acquired_, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess) return false;
        device_->handle().resetFences(*acquired_);
        copy(target, index);
        const auto presented = device_->queue().presentKHR(vk::PresentInfoKHR({}, *swapchain_, index));
        if (acquired != vk::Result::eSuboptimalKHR && presented != vk::Result::eSuboptimalKHR) return true;
    } catch (const vk::OutOfDateKHRError&) {}
    make(extent);
    return false;
}

}  // namespace strata::ui
