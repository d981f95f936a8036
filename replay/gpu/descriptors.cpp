#include "replay/gpu/descriptors.h"

#include <array>
#include <deque>

#include "passes/frame_images.h"
#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

vk::raii::Sampler make_sampler(OpenedDevice& device, vk::Filter filter, vk::SamplerMipmapMode mipmap) {
    constexpr auto edge = vk::SamplerAddressMode::eClampToEdge;
    const auto info = vk::SamplerCreateInfo({}, filter, filter, mipmap, edge, edge, edge).setMaxLod(VK_LOD_CLAMP_NONE);
    return {device.handle(), info};
}

vk::raii::DescriptorPool make_pool(OpenedDevice& device, const Plan& plan) {
    std::map<vk::DescriptorType, std::uint32_t> counts;
    std::uint32_t sets = 1;
    for (const PlannedStep& planned : plan.steps) {
        std::uint32_t step_sets = 0;
        for (const PlannedBinding& binding : planned.bindings) {
            ++counts[descriptor_type(binding.kind)];
            step_sets = std::max(step_sets, binding.set + 1);
        }
        sets += step_sets;
    }
    std::vector<vk::DescriptorPoolSize> sizes;
    for (const auto& [type, count] : counts) sizes.push_back({type, count});
    if (sizes.empty()) sizes.push_back({vk::DescriptorType::eStorageBuffer, 1});
    return {device.handle(), vk::DescriptorPoolCreateInfo({}, sets, sizes)};
}

vk::ImageViewType view_type(const PlannedBinding& binding) {
    if (binding.dimension == ImageDimension::three) return vk::ImageViewType::e3D;
    return binding.arrayed ? vk::ImageViewType::e2DArray : vk::ImageViewType::e2D;
}

/// The part a view of the binding covers: storage images have one mip, a shader that declares no array sees one layer.
PartRange viewed(const PlannedBinding& binding, const Shape& shape) {
    PartRange range = range_of(shape, binding.binding.part);
    if (binding.kind == BindingKind::storage_image) range.mips = 1;
    if (!binding.arrayed) range.layers = 1;
    return range;
}

}  // namespace

Samplers::Samplers(OpenedDevice& device)
    : nearest_(make_sampler(device, vk::Filter::eNearest, vk::SamplerMipmapMode::eNearest)),
      linear_(make_sampler(device, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear)) {}

DescriptorSets::DescriptorSets(OpenedDevice& device, const Plan& plan, const Samplers& samplers, Placeholders& placeholders)
    : device_(&device), samplers_(&samplers), placeholders_(&placeholders), pool_(make_pool(device, plan)) {}

std::vector<vk::DescriptorSet> DescriptorSets::make(const PlannedStep& planned, const Pipeline& pipeline,
                                                    const PlanResources& resources) {
    if (pipeline.sets.empty()) return {};
    std::vector<vk::DescriptorSetLayout> layouts;
    for (const auto& layout : pipeline.sets) layouts.push_back(*layout);
    const vk::Device handle = *device_->handle();
    const vk::DescriptorSetAllocateInfo wanted(*pool_, layouts);
    auto sets = handle.allocateDescriptorSets(wanted, *device_->handle().getDispatcher());

    std::deque<vk::DescriptorImageInfo> images;  // addresses stay
    std::deque<vk::DescriptorBufferInfo> buffers;
    std::vector<vk::WriteDescriptorSet> writes;
    for (const PlannedBinding& binding : planned.bindings) {
        auto& write = writes.emplace_back(sets[binding.set], binding.slot, 0, 1, descriptor_type(binding.kind));
        const bool is_image = binding.kind == BindingKind::sampled_image || binding.kind == BindingKind::storage_image;
        if (is_image) {
            write.setPImageInfo(&images.emplace_back(describe_image(binding, resources)));
        } else {
            write.setPBufferInfo(&buffers.emplace_back(describe_buffer(binding, resources)));
        }
    }
    device_->handle().updateDescriptorSets(writes, {});
    return sets;
}

vk::DescriptorImageInfo DescriptorSets::describe_image(const PlannedBinding& planned, const PlanResources& resources) const {
    const Binding& binding = planned.binding;
    DeviceImage& image = binding.image ? resources.image(binding.image) : placeholders_->image(planned);
    const PartRange range = viewed(planned, image.shape());
    return {samplers_->of(binding.filter), image.view(view_type(planned), range), image.layout(range)};
}

vk::DescriptorBufferInfo DescriptorSets::describe_buffer(const PlannedBinding& planned, const PlanResources& resources) const {
    return {resources.buffer(planned.binding.buffer).handle(), 0, VK_WHOLE_SIZE};
}

}  // namespace strata
