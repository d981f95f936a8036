// The little of Vulkan that the peer needs: a device, a queue, buffers and images with memory of their own.
#pragma once

#include <cstdint>
#include <span>

#include <vulkan/vulkan_raii.hpp>

namespace strata::peer {

struct Device {
    vk::raii::Context context;
    vk::raii::Instance instance;
    vk::raii::PhysicalDevice physical;
    std::uint32_t family;  ///< of the queue, which draws and computes
    vk::raii::Device logical;
    vk::raii::Queue queue;
    vk::raii::CommandPool pool;

    Device();
    vk::raii::CommandBuffer begin() const;
    void submit(const vk::raii::CommandBuffer&) const;  ///< ends the commands and waits for them
    vk::raii::DeviceMemory memory(const vk::MemoryRequirements&, vk::MemoryPropertyFlags) const;
};

struct Buffer {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer handle = nullptr;

    Buffer(const Device&, vk::DeviceSize bytes, vk::BufferUsageFlags, vk::MemoryPropertyFlags);
    /// On the device, with these bytes in it.
    static Buffer of(const Device&, std::span<const std::byte>, vk::BufferUsageFlags);
};

struct Image {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Image handle = nullptr;
    vk::raii::ImageView view = nullptr;
    vk::ImageAspectFlags aspect;

    Image(const Device&, vk::Extent2D, vk::Format, vk::ImageUsageFlags);
};

/// Every use of memory waits for every use before.
void wait_for_all(const vk::raii::CommandBuffer&);

}  // namespace strata::peer
