#include "tests/9_speed/peer/device.h"

#include <cstring>
#include <stdexcept>

namespace strata::peer {
namespace {

vk::raii::Instance make_instance(const vk::raii::Context& context) {
    const vk::ApplicationInfo application("strata peer", 1, nullptr, 0, VK_API_VERSION_1_3);
    return {context, vk::InstanceCreateInfo({}, &application)};
}

/// The first device whose driver is a real one: RADV without a GPU comes first and can draw nothing.
vk::raii::PhysicalDevice choose(const vk::raii::Instance& instance) {
    for (const vk::raii::PhysicalDevice& physical : vk::raii::PhysicalDevices(instance))
        if (physical.getMemoryProperties().memoryHeapCount > 0) return physical;
    throw std::runtime_error("no Vulkan device");
}

std::uint32_t queue_family(const vk::raii::PhysicalDevice& physical) {
    const auto families = physical.getQueueFamilyProperties();
    const auto all = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    for (std::uint32_t i = 0; i < families.size(); ++i)
        if ((families[i].queueFlags & all) == all) return i;
    throw std::runtime_error("no queue that draws and computes");
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family) {
    constexpr float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
    vk::PhysicalDeviceFeatures2 features(vk::PhysicalDeviceFeatures().setFragmentStoresAndAtomics(true));
    vk::PhysicalDeviceVulkan12Features features12;
    vk::PhysicalDeviceVulkan13Features features13;
    features12.setScalarBlockLayout(true);
    features13.setDynamicRendering(true).setSynchronization2(true).setMaintenance4(true);
    features.setPNext(&features12);
    features12.setPNext(&features13);
    return {physical, vk::DeviceCreateInfo({}, queue).setPNext(&features)};
}

}  // namespace

Device::Device()
    : instance(make_instance(context)),
      physical(choose(instance)),
      family(queue_family(physical)),
      logical(make_device(physical, family)),
      queue(logical, family, 0),
      pool(logical, vk::CommandPoolCreateInfo({}, family)) {}

vk::raii::CommandBuffer Device::begin() const {
    vk::raii::CommandBuffers made(logical, {*pool, vk::CommandBufferLevel::ePrimary, 1});
    made.front().begin(vk::CommandBufferBeginInfo());
    return std::move(made.front());
}

void Device::submit(const vk::raii::CommandBuffer& commands) const {
    commands.end();
    queue.submit(vk::SubmitInfo({}, {}, *commands));
    queue.waitIdle();
}

vk::raii::DeviceMemory Device::memory(const vk::MemoryRequirements& needed, vk::MemoryPropertyFlags wanted) const {
    const vk::PhysicalDeviceMemoryProperties types = physical.getMemoryProperties();
    for (std::uint32_t i = 0; i < types.memoryTypeCount; ++i)
        if ((needed.memoryTypeBits >> i & 1) && (types.memoryTypes[i].propertyFlags & wanted) == wanted)
            return {logical, vk::MemoryAllocateInfo(needed.size, i)};
    throw std::runtime_error("no memory of the wanted kind");
}

Buffer::Buffer(const Device& device, vk::DeviceSize bytes, vk::BufferUsageFlags usage, vk::MemoryPropertyFlags wanted)
    : handle(device.logical, vk::BufferCreateInfo({}, bytes, usage)) {
    memory = device.memory(handle.getMemoryRequirements(), wanted);
    handle.bindMemory(*memory, 0);
}

Buffer Buffer::of(const Device& device, std::span<const std::byte> bytes, vk::BufferUsageFlags usage) {
    const auto mapped = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    const Buffer staged(device, bytes.size(), vk::BufferUsageFlagBits::eTransferSrc, mapped);
    std::memcpy(staged.memory.mapMemory(0, bytes.size()), bytes.data(), bytes.size());
    Buffer made(device, bytes.size(), usage | vk::BufferUsageFlagBits::eTransferDst, vk::MemoryPropertyFlagBits::eDeviceLocal);
    const vk::raii::CommandBuffer commands = device.begin();
    commands.copyBuffer(*staged.handle, *made.handle, vk::BufferCopy(0, 0, bytes.size()));
    device.submit(commands);
    return made;
}

Image::Image(const Device& device, vk::Extent2D extent, vk::Format format, vk::ImageUsageFlags usage)
    : handle(device.logical, vk::ImageCreateInfo({}, vk::ImageType::e2D, format, {extent.width, extent.height, 1}, 1, 1,
                                                 vk::SampleCountFlagBits::e1, vk::ImageTiling::eOptimal, usage)),
      aspect(format == vk::Format::eD32Sfloat ? vk::ImageAspectFlagBits::eDepth : vk::ImageAspectFlagBits::eColor) {
    memory = device.memory(handle.getMemoryRequirements(), vk::MemoryPropertyFlagBits::eDeviceLocal);
    handle.bindMemory(*memory, 0);
    const vk::ImageSubresourceRange all(aspect, 0, 1, 0, 1);
    view = vk::raii::ImageView(device.logical, {{}, *handle, vk::ImageViewType::e2D, format, {}, all});
    const vk::raii::CommandBuffer commands = device.begin();
    const auto every = vk::PipelineStageFlagBits2::eAllCommands;
    const vk::ImageMemoryBarrier2 general(every, {}, every, vk::AccessFlagBits2::eMemoryWrite, vk::ImageLayout::eUndefined,
                                          vk::ImageLayout::eGeneral, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, *handle,
                                          all);
    commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(general));
    device.submit(commands);
}

void wait_for_all(const vk::raii::CommandBuffer& commands) {
    const auto every = vk::PipelineStageFlagBits2::eAllCommands;
    const auto any = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
    const vk::MemoryBarrier2 barrier(every, any, every, any);
    commands.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(barrier));
}

}  // namespace strata::peer
