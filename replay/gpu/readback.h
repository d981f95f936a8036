// Images and buffers copied to the host. Room is asked for first, then copies are recorded, then, when the queue is idle, the
// bytes are taken out in the same order.
#pragma once

#include <vector>

#include "replay/gpu/buffer.h"
#include "replay/gpu/image.h"
#include "replay/images/host_image.h"

namespace strata {

class Readback {
public:
    explicit Readback(OpenedDevice& device) : device_(&device) {}

    /// What is copied of an image: a shape with one mip, and where its first texel lies.
    struct Region {
        Shape shape;
        glm::uvec2 first{0};
    };
    /// Copies of mip 0 of a single-sampled image that is in the copied_from layout. Returns a ticket.
    std::size_t add(const vk::raii::CommandBuffer&, const DeviceImage&, const Region&);
    std::size_t add(const vk::raii::CommandBuffer&, const DeviceBuffer&, std::uint64_t bytes);
    /// Makes the copies visible to the host: the last command.
    void finish(const vk::raii::CommandBuffer&) const;

    std::vector<std::byte> take(std::size_t ticket) const;

private:
    OpenedDevice* device_;
    struct Copy {
        DeviceBuffer staging;
        std::uint64_t bytes;
    };
    std::vector<Copy> copies_;
};

}  // namespace strata
