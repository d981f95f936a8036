#include "replay/gpu/memory.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <optional>
#include <utility>

namespace strata {
namespace {

// Half of it is the largest that shares a block: enough for a 1080p rgba16f image.
constexpr std::uint64_t block_bytes = 64ull << 20;

std::uint64_t aligned(std::uint64_t value, std::uint64_t alignment) { return (value + alignment - 1) / alignment * alignment; }

bool is_mapped(MemoryUse use) { return use == MemoryUse::upload || use == MemoryUse::readback; }

}  // namespace

/// One vk::DeviceMemory and its free ranges, offset to size.
class MemoryBlock {
public:
    MemoryBlock(const vk::raii::Device& device, const vk::MemoryAllocateInfo& info, MemoryUse use, PoolBytes& of_pool)
        : memory_(device, info),
          bytes_(info.allocationSize),
          type_(info.memoryTypeIndex),
          use_(use),
          free_{{0, bytes_}},
          of_pool_(&of_pool) {
        if (is_mapped(use)) mapped_ = static_cast<std::byte*>(memory_.mapMemory(0, VK_WHOLE_SIZE));
        of_pool.allocated += bytes_;
        of_pool.peak_allocated = std::max(of_pool.peak_allocated, of_pool.allocated);
    }

    MemoryBlock(const MemoryBlock&) = delete;
    ~MemoryBlock() { of_pool_->allocated -= bytes_; }

    bool fits(std::uint32_t type, MemoryUse use) const { return type == type_ && use == use_; }
    bool is_empty() const { return free_.size() == 1 && free_.begin()->second == bytes_; }
    bool is_shared() const { return bytes_ == block_bytes; }
    vk::DeviceMemory handle() const { return *memory_; }
    std::byte* mapped() const { return mapped_; }

    std::optional<std::uint64_t> take(std::uint64_t bytes, std::uint64_t alignment) {
        for (auto range = free_.begin(); range != free_.end(); ++range) {
            const auto [begin, size] = *range;
            const std::uint64_t offset = aligned(begin, alignment);
            if (offset + bytes > begin + size) continue;
            free_.erase(range);
            if (offset > begin) free_[begin] = offset - begin;
            if (offset + bytes < begin + size) free_[offset + bytes] = begin + size - offset - bytes;
            of_pool_->in_use += bytes;
            of_pool_->peak_in_use = std::max(of_pool_->peak_in_use, of_pool_->in_use);
            return offset;
        }
        return std::nullopt;
    }

    void give_back(std::uint64_t offset, std::uint64_t bytes) {
        of_pool_->in_use -= bytes;
        auto place = free_.emplace(offset, bytes).first;
        if (const auto next = std::next(place); next != free_.end() && offset + bytes == next->first) {
            place->second += next->second;
            free_.erase(next);
        }
        if (place == free_.begin()) return;
        const auto before = std::prev(place);
        if (before->first + before->second != offset) return;
        before->second += place->second;
        free_.erase(place);
    }

private:
    vk::raii::DeviceMemory memory_;
    std::uint64_t bytes_;
    std::uint32_t type_;
    MemoryUse use_;
    std::map<std::uint64_t, std::uint64_t> free_;
    PoolBytes* of_pool_;
    std::byte* mapped_ = nullptr;
};

Memory::Memory(MemoryBlock& block, std::uint64_t offset, std::uint64_t bytes) : block_(&block), offset_(offset), bytes_(bytes) {}

Memory::Memory(Memory&& other) noexcept
    : block_(std::exchange(other.block_, nullptr)), offset_(other.offset_), bytes_(other.bytes_) {}

Memory::~Memory() {
    if (block_) block_->give_back(offset_, bytes_);
}

vk::DeviceMemory Memory::handle() const { return block_->handle(); }

std::byte* Memory::mapped() const {
    assert(block_->mapped());
    return block_->mapped() + offset_;
}

MemoryPool::MemoryPool(const vk::raii::PhysicalDevice& physical, const vk::raii::Device& device, std::uint64_t budget)
    : device_(&device), properties_(physical.getMemoryProperties()), budget_(budget), bytes_(std::make_unique<PoolBytes>()) {}

MemoryPool::~MemoryPool() = default;

Memory MemoryPool::allocate(const vk::MemoryRequirements& needed, MemoryUse use) {
    const std::uint32_t type = type_for(needed.memoryTypeBits, use);
    const bool shares_blocks = budget_ == 0 && needed.size <= block_bytes / 2;
    // Large blocks that nobody uses any more are returned before the next is asked for.
    std::erase_if(blocks_, [&](const auto& block) { return block->is_empty() && (!block->is_shared() || budget_ != 0); });
    for (const auto& block : blocks_) {
        if (!shares_blocks || !block->fits(type, use)) continue;
        if (const auto offset = block->take(needed.size, needed.alignment)) return {*block, *offset, needed.size};
    }
    const std::uint64_t bytes = shares_blocks ? block_bytes : needed.size;
    if (budget_ != 0 && bytes_->allocated + bytes > budget_) throw vk::OutOfDeviceMemoryError("the memory budget is exceeded");
    MemoryBlock& block =
        *blocks_.emplace_back(std::make_unique<MemoryBlock>(*device_, vk::MemoryAllocateInfo(bytes, type), use, *bytes_));
    return {block, *block.take(needed.size, needed.alignment), needed.size};
}

void MemoryPool::give_back_empty() {
    std::erase_if(blocks_, [](const auto& block) { return block->is_empty(); });
}

std::uint32_t MemoryPool::type_for(std::uint32_t allowed, MemoryUse use) const {
    using Bit = vk::MemoryPropertyFlagBits;
    const vk::MemoryPropertyFlags host = Bit::eHostVisible | Bit::eHostCoherent;
    vk::MemoryPropertyFlags best, enough;
    switch (use) {
        case MemoryUse::images:
        case MemoryUse::buffers:
            best = Bit::eDeviceLocal;
            break;
        case MemoryUse::upload:
            best = enough = host;
            break;
        case MemoryUse::readback:
            best = host | Bit::eHostCached, enough = host;
            break;
    }
    for (const vk::MemoryPropertyFlags wanted : {best, enough}) {
        for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
            const bool is_allowed = (allowed >> type) & 1u;
            if (is_allowed && (properties_.memoryTypes[type].propertyFlags & wanted) == wanted) return type;
        }
    }
    throw vk::OutOfDeviceMemoryError("no memory type for the resource");
}

}  // namespace strata
