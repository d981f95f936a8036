#include "replay/gpu/placeholders.h"

#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

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
    device_->run_once([&](const vk::raii::CommandBuffer& commands) { image.make_zero(commands); });
    return image;
}

}  // namespace strata
