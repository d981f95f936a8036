// The images a window shows, each a copy of what the layer drew.
#pragma once

#include <optional>
#include <vector>

#include "ui/window/imgui_layer_target.h"

namespace strata::ui {

class Swapchain {
public:
    explicit Swapchain(LayerDevice&);

    /// Copies the target to the window's next image. False where the window just changed its size: it may not be seen.
    bool show(const LayerTarget&, vk::Extent2D);

private:
    void make(vk::Extent2D);
    void copy(const LayerTarget&, std::uint32_t index);

    LayerDevice* device_;
    vk::SurfaceFormatKHR format_;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    std::vector<vk::Image> images_;
    vk::Extent2D extent_;
    vk::raii::Fence acquired_;
};

}  // namespace strata::ui
