#include "replay/gpu/imports.h"

#include <algorithm>
#include <cstring>

#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

// What travels to the device at once.
constexpr std::size_t staging_bytes = 16 << 20;
// The layout of every image between plans.
constexpr auto settled = vk::ImageLayout::eTransferSrcOptimal;

}  // namespace

void Imports::upload(ImportId id, std::span<const std::byte> bytes) {
    forget_image(id);
    auto found = buffers_.find(id.key);
    if (found == buffers_.end() || found->second.bytes() < bytes.size() || found->second.bytes() > 2 * bytes.size() + 64) {
        buffers_.erase(id.key);
        found = buffers_.try_emplace(id.key, *device_, bytes.size(), "imported buffer").first;
    }
    if (bytes.empty()) return;
    const DeviceBuffer staging(*device_, std::min(bytes.size(), staging_bytes), "upload", MemoryUse::upload);
    for (std::size_t done = 0; done < bytes.size(); done += staging_bytes) {
        const auto piece = bytes.subspan(done, std::min(staging_bytes, bytes.size() - done));
        std::memcpy(staging.mapped(), piece.data(), piece.size());
        device_->run_once([&](const vk::raii::CommandBuffer& commands) {
            commands.copyBuffer(staging.handle(), found->second.handle(), vk::BufferCopy(0, done, piece.size()));
        });
    }
}

void Imports::create_image(ImportId id, const Shape& shape) {
    forget(id);
    images_.try_emplace(id.key, *device_, shape, "imported image");
    device_->run_once([&](const vk::raii::CommandBuffer& commands) {
        image(id).make_zero(commands);
        settle(commands);
    });
}

void Imports::forget(ImportId id) {
    forget_image(id);
    buffers_.erase(id.key);
}

void Imports::forget_image(ImportId id) {
    images_.erase(id.key);
    used_.erase(id.key);
}

std::uint64_t Imports::bytes_held() const {
    std::uint64_t total = 0;
    for (const auto& [key, image] : images_) total += image.bytes_held();
    for (const auto& [key, buffer] : buffers_) total += buffer.bytes_held();
    return total;
}

DeviceImage& Imports::image(ImportId id) {
    if (const auto lent = lent_.find(id.key); lent != lent_.end()) return *lent->second;
    DeviceImage& image = images_.at(id.key);
    used_.insert(id.key);
    return image;
}

void Imports::settle(const vk::raii::CommandBuffer& commands) {
    for (const std::uint64_t key : used_) {
        DeviceImage& image = images_.at(key);
        if (std::ranges::count(image.layouts(), settled) == std::ssize(image.layouts())) continue;
        const PartRange whole = range_of(image.shape(), {});
        const auto barriers = image.transitions(whole, settled, DeviceImage::Contents::keep);
        commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barriers));
        image.set_layout(whole, settled);
    }
    used_.clear();
}

void Imports::forget_use() {
    for (const std::uint64_t key : used_) {
        DeviceImage& image = images_.at(key);
        image.set_layout(range_of(image.shape(), {}), settled);
    }
    used_.clear();
}

}  // namespace strata
