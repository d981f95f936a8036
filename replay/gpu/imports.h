// Images and buffers that outlive plans, by the key of their ImportId.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

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
    DeviceImage& image(ImportId id) { return lent_.contains(id.key) ? *lent_.at(id.key) : images_.at(id.key); }
    DeviceBuffer& buffer(ImportId id) { return buffers_.at(id.key); }
    std::uint64_t bytes_held() const;

    /// Brings every image into the layout plans expect imports in, copied_from.
    void settle(const vk::raii::CommandBuffer&);
    /// The layouts of all images, to be put back when what was recorded is thrown away.
    using Layouts = std::map<std::uint64_t, std::vector<vk::ImageLayout>>;
    Layouts layouts() const;
    void restore(const Layouts&);

private:
    OpenedDevice* device_;
    std::map<std::uint64_t, DeviceImage> images_;
    std::map<std::uint64_t, DeviceBuffer> buffers_;
    std::map<std::uint64_t, DeviceImage*> lent_;
};

}  // namespace strata
