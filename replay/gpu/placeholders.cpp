#include "replay/gpu/placeholders.h"

#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

// Shaders index an absent buffer at will as long as they take nothing from it; its first records must be there.
constexpr std::uint64_t buffer_bytes = 64 << 10;

Format format_of(const PlannedBinding& binding) {
    if (binding.format) return *binding.format;
    return binding.integer ? Format::r32ui : Format::rgba8_unorm;
}

}  // namespace

Placeholders::Placeholders(OpenedDevice& device) : device_(&device) {}

DeviceImage& Placeholders::image(const PlannedBinding& binding) {
    const Kind kind{format_of(binding), binding.dimension, binding.multisampled ? 4u : 1u, writes(binding.binding.access)};
    if (const auto found = images_.find(kind); found != images_.end()) return found->second;
    // A depth of 2 is what makes an image 3D.
    const Extent extent{1, 1, kind.dimension == ImageDimension::three ? 2u : 1u};
    const Shape shape{.extent = extent, .format = kind.format, .samples = kind.samples};
    DeviceImage& image = images_.try_emplace(kind, *device_, shape, "absent image").first->second;
    image.make_zero(*device_);
    return image;
}

DeviceBuffer& Placeholders::buffer(Access access) {
    const bool is_written = writes(access);
    if (const auto found = buffers_.find(is_written); found != buffers_.end()) return found->second;
    DeviceBuffer& buffer = buffers_.try_emplace(is_written, *device_, buffer_bytes, "absent buffer").first->second;
    device_->run_once([&](const vk::raii::CommandBuffer& commands) { commands.fillBuffer(buffer.handle(), 0, VK_WHOLE_SIZE, 0); });
    return buffer;
}

}  // namespace strata
