// Images and buffers that outlive plans, by the key of their ImportId.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>

#include "replay/gpu/buffer.h"
#include "replay/gpu/image.h"

namespace strata {

class Imports {
public:
    explicit Imports(OpenedDevice& device) : device_(&device) {}

    void upload(ImportId, std::span<const std::byte>);
    void create_image(ImportId, const Shape&);
    void forget(ImportId);
    /// Somebody else's image under a key: the caller keeps it alive.
    void lend(ImportId id, DeviceImage& image) { lent_.insert_or_assign(id.key, &image); }

    /// Throws std::out_of_range for an import nobody made.
    DeviceImage& image(ImportId);
    DeviceBuffer& buffer(ImportId id) { return buffers_.at(id.key); }
    std::uint64_t bytes_held() const;

    /// Brings the images that image() gave back into the layout plans expect imports in, copied_from. All others are in it: a
    /// memo holds thousands.
    void settle(const vk::raii::CommandBuffer&);
    /// What was recorded since then is thrown away: the images are as they were.
    void forget_use();

private:
    void forget_image(ImportId);

    OpenedDevice* device_;
    std::map<std::uint64_t, DeviceImage> images_;
    std::map<std::uint64_t, DeviceBuffer> buffers_;
    std::map<std::uint64_t, DeviceImage*> lent_;
    std::set<std::uint64_t> used_;  // of images_, since they were settled
};

}  // namespace strata
