#include "replay/gpu/plan_memory.h"

#include "passes/frame_images.h"
#include "replay/gpu/opened_device.h"

namespace strata {

PlanMemory::PlanMemory(OpenedDevice& device, const Plan& plan) : key_(key_of(plan)) {
    for (std::uint32_t i = 0; i < plan.slots.size(); ++i) {
        const MemorySlot& slot = plan.slots[i];
        if (!slot.images.empty()) slots_.try_emplace(i, device, slot.shape, plan.images[slot.images.front()].name);
    }
    for (const std::uint32_t id : plan.used_buffers)
        buffers_.try_emplace(id, device, plan.buffers[id].bytes, plan.buffers[id].name);
}

std::vector<std::uint64_t> PlanMemory::key_of(const Plan& plan) {
    std::vector<std::uint64_t> key;
    for (const MemorySlot& slot : plan.slots) {
        const Shape& s = slot.shape;
        const std::uint64_t format = static_cast<std::uint64_t>(s.format);
        key.insert(key.end(), {s.extent.width, s.extent.height, s.extent.depth, format, s.layers, s.mips, s.samples});
    }
    for (const std::uint32_t id : plan.used_buffers) key.insert(key.end(), {id, plan.buffers[id].bytes});
    return key;
}

std::uint64_t PlanMemory::bytes_held() const {
    std::uint64_t total = 0;
    for (const auto& [slot, image] : slots_) total += image.bytes_held();
    for (const auto& [id, buffer] : buffers_) total += buffer.bytes_held();
    return total;
}

DeviceImage& PlanResources::image(Image image) const {
    if (const auto& import = plan_->images[image.id].import) return imports_->image(*import);
    return memory_->slots_.at(plan_->slot_of_image[image.id]);
}

DeviceBuffer& PlanResources::buffer(Buffer buffer) const {
    if (const auto& import = plan_->buffers[buffer.id].import) return imports_->buffer(*import);
    return memory_->buffers_.at(buffer.id);
}

bool PlanResources::holds(Image image) const {
    if (plan_->images[image.id].import) return true;
    const auto owner = owners_.find(plan_->slot_of_image[image.id]);
    return owner != owners_.end() && owner->second == image.id;
}

void PlanResources::take_over(Image image) {
    if (!plan_->images[image.id].import) owners_[plan_->slot_of_image[image.id]] = image.id;
}

}  // namespace strata
