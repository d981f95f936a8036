#include "replay/gpu/imports.h"

#include <algorithm>
#include <cstring>

#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

// What travels to the device at once.
constexpr std::size_t staging_bytes = 16 << 20;

}  // namespace

void Imports::upload(ImportId id, std::span<const std::byte> bytes) {
    images_.erase(id.key);
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
    images_.try_emplace(id.key, *device_, shape, "imported image").first->second.make_zero(*device_);
    device_->run_once([&](const vk::raii::CommandBuffer& commands) { settle(commands); });
}

void Imports::forget(ImportId id) {
    images_.erase(id.key);
    buffers_.erase(id.key);
}

std::uint64_t Imports::bytes_held() const {
    std::uint64_t total = 0;
    for (const auto& [key, image] : images_) total += image.bytes_held();
    for (const auto& [key, buffer] : buffers_) total += buffer.bytes_held();
    return total;
}

void Imports::settle(const vk::raii::CommandBuffer& commands) {
    constexpr auto expected = vk::ImageLayout::eTransferSrcOptimal;
    for (auto& [key, image] : images_) {
        if (std::ranges::count(image.layouts(), expected) == std::ssize(image.layouts())) continue;
        const PartRange whole = range_of(image.shape(), {});
        const auto barriers = image.transitions(whole, expected, DeviceImage::Contents::keep);
        commands.pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(barriers));
        image.set_layout(whole, expected);
    }
}

Imports::Layouts Imports::layouts() const {
    Layouts all;
    for (const auto& [key, image] : images_) all.emplace(key, image.layouts());
    return all;
}

void Imports::restore(const Layouts& all) {
    for (const auto& [key, layouts] : all) images_.at(key).restore(layouts);
}

}  // namespace strata
