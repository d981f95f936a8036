#include "replay/gpu/readback.h"

#include <cassert>

#include "replay/gpu/opened_device.h"

namespace strata {

std::size_t Readback::add(const vk::raii::CommandBuffer& commands, const DeviceImage& image, const Region& region) {
    const Shape& shape = region.shape;
    assert(shape.samples == 1 && shape.mips == 1);
    Copy& copy =
        copies_.emplace_back(DeviceBuffer(*device_, strata::bytes(shape), "readback", MemoryUse::readback), strata::bytes(shape));
    const vk::ImageSubresourceLayers layers(image.subresources({}).aspectMask, 0, 0, shape.layers);
    const vk::Offset3D first(static_cast<std::int32_t>(region.first.x), static_cast<std::int32_t>(region.first.y), 0);
    const vk::Extent3D extent(shape.extent.width, shape.extent.height, shape.extent.depth);
    commands.copyImageToBuffer(image.handle(), image.layout({}), copy.staging.handle(),
                               vk::BufferImageCopy(0, 0, 0, layers, first, extent));
    return copies_.size() - 1;
}

std::size_t Readback::add(const vk::raii::CommandBuffer& commands, const DeviceBuffer& buffer, std::uint64_t bytes) {
    Copy& copy = copies_.emplace_back(DeviceBuffer(*device_, bytes, "readback", MemoryUse::readback), bytes);
    if (bytes > 0) commands.copyBuffer(buffer.handle(), copy.staging.handle(), vk::BufferCopy(0, 0, bytes));
    return copies_.size() - 1;
}

void Readback::finish(const vk::raii::CommandBuffer& commands) const {
    const vk::MemoryBarrier2 to_host(vk::PipelineStageFlagBits2::eAllTransfer, vk::AccessFlagBits2::eTransferWrite,
                                     vk::PipelineStageFlagBits2::eHost, vk::AccessFlagBits2::eHostRead);
    commands.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(to_host));
}

std::vector<std::byte> Readback::take(std::size_t ticket) const {
    const Copy& copy = copies_[ticket];
    return {copy.staging.mapped(), copy.staging.mapped() + copy.bytes};
}

}  // namespace strata
