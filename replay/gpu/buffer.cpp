#include "replay/gpu/buffer.h"

#include <algorithm>

#include "passes/stages.h"
#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

// Clears write whole words, and empty buffers do not exist.
std::uint64_t whole_words(std::uint64_t bytes) { return std::max<std::uint64_t>(16, (bytes + 3) / 4 * 4); }

vk::BufferUsageFlags usage_for(MemoryUse use) {
    using Bit = vk::BufferUsageFlagBits;
    if (use == MemoryUse::upload) return Bit::eTransferSrc;
    if (use == MemoryUse::readback) return Bit::eTransferDst;
    return Bit::eStorageBuffer | Bit::eUniformBuffer | Bit::eIndexBuffer | Bit::eIndirectBuffer | Bit::eTransferSrc |
           Bit::eTransferDst;
}

}  // namespace

std::uint64_t device_bytes(const OpenedDevice& device, std::uint64_t bytes, MemoryUse use) {
    const vk::BufferCreateInfo info({}, whole_words(bytes), usage_for(use));
    const vk::DeviceBufferMemoryRequirements wanted(&info);
    return device.handle().getBufferMemoryRequirements(wanted).memoryRequirements.size;
}

DeviceBuffer::DeviceBuffer(OpenedDevice& device, std::uint64_t bytes, std::string_view name, MemoryUse use)
    : bytes_(whole_words(bytes)),
      buffer_(device.handle(), vk::BufferCreateInfo({}, bytes_, usage_for(use))),
      memory_(device.memory().allocate(buffer_.getMemoryRequirements(), use)) {
    buffer_.bindMemory(memory_.handle(), memory_.offset());
    device.label(*buffer_, name);
}

}  // namespace strata
