// A small sub-allocator of device memory: blocks of 64 MiB per use and memory type, first fit; what is larger gets a block of
// its own, and so does everything under a budget, which is a hard one. Images and buffers never share a block, so
// bufferImageGranularity does not matter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

namespace strata {

enum class MemoryUse : std::uint32_t {
    images,
    buffers,  ///< on the device
    upload,
    readback,  ///< mapped and coherent; readback cached where there is such memory
};

/// Bytes of a pool: in use by images and buffers, and taken from the device for them.
struct PoolBytes {
    std::uint64_t in_use = 0, allocated = 0;
    std::uint64_t peak_in_use = 0, peak_allocated = 0;  ///< the most there ever were
};

class MemoryBlock;

/// A piece of a block; gives itself back.
class Memory {
public:
    Memory(MemoryBlock&, std::uint64_t offset, std::uint64_t bytes);
    Memory(Memory&&) noexcept;
    Memory& operator=(Memory&&) = delete;
    ~Memory();

    vk::DeviceMemory handle() const;
    std::uint64_t bytes() const { return bytes_; }
    std::uint64_t offset() const { return offset_; }
    /// Where the host sees it; only for upload and readback.
    std::byte* mapped() const;

private:
    MemoryBlock* block_;
    std::uint64_t offset_, bytes_;
};

class MemoryPool {
public:
    /// budget: the most to take from the device, in bytes; 0: as much as it gives.
    MemoryPool(const vk::raii::PhysicalDevice&, const vk::raii::Device&, std::uint64_t budget);
    ~MemoryPool();

    /// Throws vk::OutOfDeviceMemoryError, also where the budget is exceeded.
    Memory allocate(const vk::MemoryRequirements&, MemoryUse);
    const PoolBytes& bytes() const { return *bytes_; }
    /// Gives the device back what nothing lies in.
    void give_back_empty();

private:
    std::uint32_t type_for(std::uint32_t allowed, MemoryUse) const;

    const vk::raii::Device* device_;
    vk::PhysicalDeviceMemoryProperties properties_;
    std::uint64_t budget_;
    std::unique_ptr<PoolBytes> bytes_;  // its address is with the blocks
    std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

}  // namespace strata
