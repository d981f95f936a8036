#include "ui/window/imgui_layer_target.h"

namespace strata::ui {

vk::Rect2D rect_of(const Region& region) {
    return {{region.left, region.top},
            {static_cast<std::uint32_t>(region.right - region.left), static_cast<std::uint32_t>(region.bottom - region.top)}};
}

void LayerTarget::resize(vk::Extent2D extent) {
    if (extent == image_.extent) return;
    image_ = device_->image(extent, format, vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
    layout_ = vk::ImageLayout::eUndefined;
}

void LayerTarget::render(const std::vector<Region>& regions,
                         const std::function<void(const vk::raii::CommandBuffer&, const Region&)>& record) {
    auto commands = device_->begin_commands();
    move_to(commands, *image_.image, layout_, vk::ImageLayout::eColorAttachmentOptimal);
    const vk::RenderingAttachmentInfo attachment(*image_.view, vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
                                                 vk::AttachmentLoadOp::eLoad, vk::AttachmentStoreOp::eStore);
    commands.beginRendering(vk::RenderingInfo({}, {{0, 0}, image_.extent}, 1, 0, attachment));
    for (const Region& region : regions) {
        commands.clearAttachments(vk::ClearAttachment(vk::ImageAspectFlagBits::eColor, 0), vk::ClearRect(rect_of(region), 0, 1));
        record(commands, region);
    }
    commands.endRendering();
    layout_ = vk::ImageLayout::eTransferSrcOptimal;
    move_to(commands, *image_.image, vk::ImageLayout::eColorAttachmentOptimal, layout_);
    device_->submit_and_wait(commands);
    ++revision_;
}

Picture LayerTarget::read_back() const {
    const auto [width, height] = image_.extent;
    const LayerBuffer staging = device_->buffer(std::uint64_t{4} * width * height, vk::BufferUsageFlagBits::eTransferDst);
    auto commands = device_->begin_commands();
    commands.copyImageToBuffer(*image_.image, vk::ImageLayout::eTransferSrcOptimal, *staging.buffer,
                               vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {width, height, 1}));
    device_->submit_and_wait(commands);
    Picture picture{.width = width, .height = height};
    picture.rgb.reserve(std::size_t{3} * width * height);
    for (std::size_t i = 0; i < std::size_t{4} * width * height; i += 4)
        for (const std::size_t channel : {2u, 1u, 0u}) picture.rgb.push_back(staging.mapped[i + channel]);
    return picture;
}

}  // namespace strata::ui
