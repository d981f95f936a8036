// A buffer on the device, and one the host sees.
#pragma once

#include <cstdint>
#include <string_view>

#include "replay/gpu/memory.h"

namespace strata {

class OpenedDevice;

/// What a buffer of so many bytes takes of the device, without making it.
std::uint64_t device_bytes(const OpenedDevice&, std::uint64_t bytes, MemoryUse);

/// Storage, index, indirect and copies: whatever a plan may want of it.
class DeviceBuffer {
public:
    DeviceBuffer(OpenedDevice&, std::uint64_t bytes, std::string_view name, MemoryUse = MemoryUse::buffers);

    vk::Buffer handle() const { return *buffer_; }
    std::uint64_t bytes() const { return bytes_; }
    std::uint64_t bytes_held() const { return memory_.bytes(); }
    std::byte* mapped() const { return memory_.mapped(); }

private:
    std::uint64_t bytes_;
    vk::raii::Buffer buffer_;
    Memory memory_;  // after the buffer: given back first, which nobody notices once the queue is idle
};

}  // namespace strata
