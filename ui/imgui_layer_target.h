// The image a frame of the inspector is drawn into: read back by scripts and tests, copied to a window's swapchain.
#pragma once

#include <functional>

#include "ui/imgui_layer.h"
#include "ui/imgui_layer_device.h"

namespace strata::ui {

class LayerTarget {
public:
    static constexpr vk::Format format = vk::Format::eR8G8B8A8Unorm;

    explicit LayerTarget(LayerDevice& device) : device_(&device) {}

    /// What was drawn is lost where the extent changes.
    void resize(vk::Extent2D);
    /// Clears it and draws; the image is then ready to be copied from.
    void render(const std::function<void(const vk::raii::CommandBuffer&)>& record);
    Picture read_back() const;

    vk::Extent2D extent() const { return image_.extent; }
    vk::Image image() const { return *image_.image; }

private:
    LayerDevice* device_;
    LayerImage image_;
    vk::ImageLayout layout_ = vk::ImageLayout::eUndefined;
};

}  // namespace strata::ui
