// An image on the device with the views that were asked of it, and the layout each of its parts is in.
#pragma once

#include <cstdint>
#include <map>
#include <string_view>
#include <vector>

#include "passes/graph/step.h"
#include "replay/gpu/memory.h"

namespace strata {

class OpenedDevice;

/// Mips and layers a view or barrier covers.
struct PartRange {
    std::uint32_t mip = 0, mips = 1, layer = 0, layers = 1;
    friend auto operator<=>(const PartRange&, const PartRange&) = default;
};

/// What the part means for the shape: all mips and layers where nothing is said.
PartRange range_of(const Shape&, const Part&);

/// What an image of the shape takes of the device, without making it.
std::uint64_t device_bytes(const OpenedDevice&, const Shape&);

class DeviceImage {
public:
    DeviceImage(OpenedDevice&, const Shape&, std::string_view name);

    vk::Image handle() const { return *image_; }
    const Shape& shape() const { return shape_; }
    vk::ImageSubresourceRange subresources(const PartRange&) const;
    vk::ImageView view(vk::ImageViewType, const PartRange&);

    /// Sets every mip and layer to the value, in the layout it has.
    void clear(const vk::raii::CommandBuffer&, const ClearValue&) const;
    /// Clears to zero, whatever was there, and leaves the image in the general layout.
    void make_zero(const vk::raii::CommandBuffer&);
    std::uint64_t bytes_held() const { return memory_.bytes(); }

    /// The layout after everything recorded so far.
    vk::ImageLayout layout(const PartRange&) const;
    void set_layout(const PartRange&, vk::ImageLayout);
    /// Barriers that take the range from the layouts it has to another one; `discard` forgets the contents. They wait for
    /// everything and hold up everything, unless the caller narrows them.
    enum class Contents { keep, discard };
    std::vector<vk::ImageMemoryBarrier2> transitions(const PartRange&, vk::ImageLayout, Contents) const;
    const std::vector<vk::ImageLayout>& layouts() const { return layouts_; }

private:
    std::size_t index(std::uint32_t mip, std::uint32_t layer) const { return std::size_t{mip} * shape_.layers + layer; }

    const vk::raii::Device* device_;
    Shape shape_;
    vk::raii::Image image_;
    Memory memory_;
    std::map<std::pair<vk::ImageViewType, PartRange>, vk::raii::ImageView> views_;
    std::vector<vk::ImageLayout> layouts_;  // mip by mip, layer by layer
};

}  // namespace strata
