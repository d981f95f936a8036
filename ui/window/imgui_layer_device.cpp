#include "ui/window/imgui_layer_device.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace strata::ui {
namespace {

/// A queue family that draws, and presents where there is a surface.
std::optional<std::uint32_t> family_of(const vk::raii::PhysicalDevice& device, vk::SurfaceKHR surface) {
    const auto families = device.getQueueFamilyProperties();
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if (families[i].queueFlags & vk::QueueFlagBits::eGraphics && (!surface || device.getSurfaceSupportKHR(i, surface)))
            return i;
    return {};
}

bool can_draw(const vk::raii::PhysicalDevice& device, vk::SurfaceKHR surface) {
    if (device.getProperties().apiVersion < VK_API_VERSION_1_3 || !family_of(device, surface)) return false;
    const auto chain =
        device
            .getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features>();
    const auto& features = chain.get<vk::PhysicalDeviceVulkan13Features>();
    return features.dynamicRendering && features.synchronization2 &&
           chain.get<vk::PhysicalDeviceVulkan12Features>().scalarBlockLayout;
}

/// Lower is better: a window needs little, and what waits for a busy CPU stutters.
int rank(const vk::raii::PhysicalDevice& device) {
    constexpr std::array order = {vk::PhysicalDeviceType::eDiscreteGpu, vk::PhysicalDeviceType::eIntegratedGpu,
                                  vk::PhysicalDeviceType::eVirtualGpu, vk::PhysicalDeviceType::eOther};
    return static_cast<int>(std::ranges::find(order, device.getProperties().deviceType) - order.begin());
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family, vk::SurfaceKHR surface) {
    vk::StructureChain<vk::DeviceCreateInfo, vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features> chain;
    chain.get<vk::PhysicalDeviceVulkan12Features>().setScalarBlockLayout(VK_TRUE);
    chain.get<vk::PhysicalDeviceVulkan13Features>().setDynamicRendering(VK_TRUE).setSynchronization2(VK_TRUE);
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
    const std::array extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
    auto& info = chain.get<vk::DeviceCreateInfo>().setQueueCreateInfos(queue);
    if (surface) info.setPEnabledExtensionNames(extensions);
    return {physical, info};
}

}  // namespace

Result<std::unique_ptr<LayerDevice>> LayerDevice::open(Validation validation, const SurfaceSource& source) {
    auto instance = Instance::create(validation, source.extensions);
    if (!instance) return instance.error();
    try {
        vk::raii::SurfaceKHR surface = nullptr;
        if (source.make) surface = {instance->handle(), static_cast<VkSurfaceKHR>(source.make(*instance->handle()))};
        auto devices = instance->handle().enumeratePhysicalDevices();
        std::erase_if(devices, [&](const auto& device) { return !can_draw(device, *surface); });
        if (devices.empty())
            return fail(Fault::device_lacks, "window.no_device", "no device of this machine can draw the inspector's window");
        auto best = std::ranges::min_element(devices, {}, rank);
        const std::uint32_t family = *family_of(*best, *surface);
        return std::unique_ptr<LayerDevice>(new LayerDevice(*std::move(instance), std::move(surface), std::move(*best), family));
    } catch (const vk::SystemError& problem) {
        return fail(Fault::device_failed, "window.cannot_open_device",
                    "the device for the inspector's window cannot be opened: {reason}", problem.what());
    }
}

LayerDevice::LayerDevice(Instance instance, vk::raii::SurfaceKHR surface, vk::raii::PhysicalDevice physical, std::uint32_t family)
    : instance_(std::move(instance)),
      surface_(std::move(surface)),
      physical_(std::move(physical)),
      device_(make_device(physical_, family, *surface_)),
      queue_(device_, family, 0),
      commands_(device_, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, family)) {}

vk::raii::DeviceMemory LayerDevice::allocate(const vk::MemoryRequirements& needs, vk::MemoryPropertyFlags wanted) const {
    const auto properties = physical_.getMemoryProperties();
    for (std::uint32_t i = 0; i < properties.memoryTypeCount; ++i)
        if (needs.memoryTypeBits >> i & 1 && (properties.memoryTypes[i].propertyFlags & wanted) == wanted)
            return {device_, vk::MemoryAllocateInfo(needs.size, i)};
    throw vk::OutOfDeviceMemoryError("no memory of the kind that is wanted");
}

LayerBuffer LayerDevice::buffer(std::uint64_t bytes, vk::BufferUsageFlags usage) const {
    LayerBuffer made{.bytes = bytes};
    made.buffer = {device_, vk::BufferCreateInfo({}, bytes, usage)};
    made.memory = allocate(made.buffer.getMemoryRequirements(),
                           vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent);
    made.buffer.bindMemory(*made.memory, 0);
    made.mapped = static_cast<std::byte*>(made.memory.mapMemory(0, VK_WHOLE_SIZE));
    return made;
}

LayerImage LayerDevice::image(vk::Extent2D extent, vk::Format format, vk::ImageUsageFlags usage) const {
    LayerImage made{.extent = extent};
    made.image = {device_, vk::ImageCreateInfo({}, vk::ImageType::e2D, format, {extent.width, extent.height, 1}, 1, 1,
                                               vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage)};
    made.memory = allocate(made.image.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
    made.image.bindMemory(*made.memory, 0);
    made.view = {device_, vk::ImageViewCreateInfo({}, *made.image, vk::ImageViewType::e2D, format, {},
                                                  {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1})};
    return made;
}

vk::raii::CommandBuffer LayerDevice::begin_commands() const {
    auto made = device_.allocateCommandBuffers({*commands_, vk::CommandBufferLevel::ePrimary, 1});
    made.front().begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    return std::move(made.front());
}

void LayerDevice::submit_and_wait(vk::raii::CommandBuffer& commands) const {
    commands.end();
    const vk::raii::Fence fence(device_, vk::FenceCreateInfo());
    const vk::CommandBufferSubmitInfo buffer(*commands);
    queue_.submit2(vk::SubmitInfo2().setCommandBufferInfos(buffer), *fence);
    if (device_.waitForFences(*fence, VK_TRUE, UINT64_MAX) != vk::Result::eSuccess) throw vk::DeviceLostError("no answer");
}

void move_to(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
    const auto all = vk::PipelineStageFlagBits2::eAllCommands;
    const auto any = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
    const vk::ImageMemoryBarrier2 barrier(all, any, all, any, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image,
                                          {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barrier));
}

}  // namespace strata::ui
