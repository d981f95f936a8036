// The image a frame of the inspector is drawn into: read back by scripts and tests, copied to a window's swapchain.
#pragma once

#include <functional>

#include "ui/window/changed_regions.h"
#include "ui/window/imgui_layer.h"
#include "ui/window/imgui_layer_device.h"

namespace strata::ui {

vk::Rect2D rect_of(const Region&);

class LayerTarget {
public:
    static constexpr vk::Format format = vk::Format::eB8G8R8A8Unorm;  // most windows have it: showing is a copy

    explicit LayerTarget(LayerDevice& device) : device_(&device) {}

    /// What was drawn is lost where the extent changes.
    void resize(vk::Extent2D);
    /// Clears the regions and draws each; the image is then ready to be copied from.
    void render(const std::vector<Region>&, const std::function<void(const vk::raii::CommandBuffer&, const Region&)>& record);
    Picture read_back() const;

    vk::Extent2D extent() const { return image_.extent; }
    vk::Image image() const { return *image_.image; }
    /// How many times it was drawn into.
    std::uint64_t revision() const { return revision_; }

private:
    LayerDevice* device_;
    LayerImage image_;
    vk::ImageLayout layout_ = vk::ImageLayout::eUndefined;
    std::uint64_t revision_ = 0;
};

}  // namespace strata::ui
