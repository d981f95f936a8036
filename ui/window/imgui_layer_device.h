// The Vulkan device the inspector draws itself with: its own, so that a replay that loses its device leaves the window alone.
#pragma once

#include <functional>
#include <span>

#include <vulkan/vulkan_raii.hpp>

#include "replay/gpu/instance.h"

namespace strata::ui {

/// What has a window makes its surface once there is an instance; what has none leaves `make` empty.
struct SurfaceSource {
    std::vector<const char*> extensions;
    std::function<vk::SurfaceKHR(vk::Instance)> make;
};

struct LayerBuffer {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Buffer buffer = nullptr;
    std::byte* mapped = nullptr;
    std::uint64_t bytes = 0;
};

struct LayerImage {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Image image = nullptr;
    vk::raii::ImageView view = nullptr;
    vk::Extent2D extent;
};

class LayerDevice {
public:
    static Result<std::unique_ptr<LayerDevice>> open(Validation, const SurfaceSource& = {});

    const vk::raii::Device& handle() const { return device_; }
    const vk::raii::PhysicalDevice& physical() const { return physical_; }
    const vk::raii::Queue& queue() const { return queue_; }
    vk::SurfaceKHR surface() const { return *surface_; }
    std::vector<std::string> take_messages() { return instance_.take_messages(); }

    /// Memory that the host sees.
    LayerBuffer buffer(std::uint64_t bytes, vk::BufferUsageFlags) const;
    LayerImage image(vk::Extent2D, vk::Format, vk::ImageUsageFlags) const;

    vk::raii::CommandBuffer begin_commands() const;
    void submit_and_wait(vk::raii::CommandBuffer&) const;

private:
    LayerDevice(Instance, vk::raii::SurfaceKHR, vk::raii::PhysicalDevice, std::uint32_t family);
    vk::raii::DeviceMemory allocate(const vk::MemoryRequirements&, vk::MemoryPropertyFlags) const;

    Instance instance_;
    vk::raii::SurfaceKHR surface_;
    vk::raii::PhysicalDevice physical_;
    vk::raii::Device device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool commands_;
};

/// A barrier of everything before against everything after: a frame of the inspector has three.
void move_to(const vk::raii::CommandBuffer&, vk::Image, vk::ImageLayout from, vk::ImageLayout to);

}  // namespace strata::ui
