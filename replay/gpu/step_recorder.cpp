#include "replay/gpu/step_recorder.h"

#include <algorithm>
#include <cassert>

#include "replay/gpu/access_table.h"
#include "replay/gpu/raster_state.h"

namespace strata {
namespace {

AccessSet all_of(AccessSet all, Access leading) { return all.empty() ? AccessSet(leading) : all; }

std::uint32_t at_mip(std::uint32_t size, std::uint32_t mip) { return std::max(1u, size >> mip); }

bool is_discarded(const PlannedStep& planned, const Image& image) {
    return std::ranges::any_of(planned.barriers,
                               [&](const Barrier& barrier) { return barrier.discard && barrier.image.id == image.id; });
}

}  // namespace

void full_barrier(const vk::raii::CommandBuffer& commands) {
    const auto everything = vk::PipelineStageFlagBits2::eAllCommands;
    const auto any = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite;
    const vk::MemoryBarrier2 barrier(everything, any, everything, any);
    commands.pipelineBarrier2(vk::DependencyInfo().setMemoryBarriers(barrier));
}

StepRecorder::StepRecorder(const vk::raii::CommandBuffer& commands, const Plan& plan, PlanResources& resources,
                           PipelineStore& pipelines, DescriptorSets& sets)
    : commands_(&commands), plan_(&plan), resources_(&resources), pipelines_(&pipelines), sets_(&sets) {}

void StepRecorder::barriers(const std::vector<Barrier>& planned) {
    std::vector<vk::ImageMemoryBarrier2> images;
    std::vector<vk::BufferMemoryBarrier2> buffers;
    const auto scopes = [](auto& barrier, const DeviceAccess& before, const DeviceAccess& after) {
        barrier.setSrcStageMask(before.stages).setSrcAccessMask(before.mask);
        barrier.setDstStageMask(after.stages).setDstAccessMask(after.mask);
    };
    for (const Barrier& barrier : planned) {
        const auto before = all_of(barrier.all_before, barrier.before), after = all_of(barrier.all_after, barrier.after);
        if (barrier.buffer) {
            auto& made = buffers.emplace_back();
            made.setBuffer(resources_->buffer(barrier.buffer).handle()).setSize(VK_WHOLE_SIZE);
            scopes(made, device_access(before), device_access(after));
            continue;
        }
        DeviceImage& image = resources_->image(barrier.image);
        const FormatKind kind = row(image.shape().format).kind;
        const DeviceAccess to = device_access(after, kind);
        const PartRange range = range_of(image.shape(), barrier.part);
        const auto contents = barrier.discard ? DeviceImage::Contents::discard : DeviceImage::Contents::keep;
        for (auto& made : image.transitions(range, to.layout, contents)) {
            scopes(made, device_access(before, kind), to);
            images.push_back(made);
        }
        image.set_layout(range, to.layout);
        resources_->take_over(barrier.image);
    }
    if (images.empty() && buffers.empty()) return;
    commands_->pipelineBarrier2(vk::DependencyInfo().setImageMemoryBarriers(images).setBufferMemoryBarriers(buffers));
}

void StepRecorder::work(const PlannedStep& planned) {
    std::visit([&](const auto& work) { record(planned, work); }, planned.step.work);
}

void StepRecorder::bind(const PlannedStep& planned) {
    const Pipeline& pipeline = pipelines_->find(planned, plan_->images);
    const bool is_compute = std::holds_alternative<ComputeWork>(planned.step.work);
    const auto point = is_compute ? vk::PipelineBindPoint::eCompute : vk::PipelineBindPoint::eGraphics;
    commands_->bindPipeline(point, *pipeline.handle);
    const auto sets = sets_->make(planned, pipeline, *resources_);
    if (!sets.empty()) commands_->bindDescriptorSets(point, *pipeline.layout, 0, sets, {});
    const auto& push = planned.step.push;
    if (push.empty()) return;
    commands_->pushConstants<std::byte>(*pipeline.layout, shader_stages(planned.step), 0, push);
}

void StepRecorder::record(const PlannedStep& planned, const ComputeWork& work) {
    bind(planned);
    if (work.arguments) {
        commands_->dispatchIndirect(resources_->buffer(work.arguments).handle(), work.arguments_offset);
    } else {
        commands_->dispatch(planned.groups.width, planned.groups.height, planned.groups.depth);
    }
}

void StepRecorder::record(const PlannedStep& planned, const DrawWork& work) {
    begin_rendering(planned, {.viewport = work.viewport, .rows = work.rows, .columns = work.columns});
    bind(planned);
    const DrawList& list = work.list;
    constexpr std::uint32_t stride = sizeof(vk::DrawIndexedIndirectCommand);
    const vk::Buffer commands = resources_->buffer(list.commands).handle();
    if (list.indices) commands_->bindIndexBuffer(resources_->buffer(list.indices).handle(), 0, vk::IndexType::eUint32);
    const vk::DeviceSize first = vk::DeviceSize{list.first} * stride;
    if (work.count) {
        const vk::Buffer count = resources_->buffer(work.count).handle();
        commands_->drawIndexedIndirectCount(commands, first, count, work.count_offset, list.count, stride);
    } else if (list.count > 0 && !list.indices) {
        commands_->drawIndirect(commands, first, list.count, stride);
    } else if (list.count > 0) {
        commands_->drawIndexedIndirect(commands, first, list.count, stride);
    }
    commands_->endRendering();
}

void StepRecorder::record(const PlannedStep& planned, const FullscreenWork& work) {
    begin_rendering(planned, {.viewport = work.viewport});
    bind(planned);
    commands_->draw(3, 1, 0, 0);
    commands_->endRendering();
}

void StepRecorder::record(const PlannedStep&, const CopyWork& work) {
    if (work.buffer_from) {
        const DeviceBuffer &from = resources_->buffer(work.buffer_from), &to = resources_->buffer(work.buffer_to);
        commands_->copyBuffer(from.handle(), to.handle(), vk::BufferCopy(0, 0, std::min(from.bytes(), to.bytes())));
        return;
    }
    const DeviceImage &from = resources_->image(work.from), &to = resources_->image(work.to);
    const Shape& shape = to.shape();
    std::vector<vk::ImageCopy> mips;
    for (std::uint32_t mip = 0; mip < std::min(from.shape().mips, shape.mips); ++mip) {
        const vk::ImageAspectFlags aspect = to.subresources({}).aspectMask;
        const vk::ImageSubresourceLayers layers(aspect, mip, 0, std::min(from.shape().layers, shape.layers));
        const vk::Extent3D extent(at_mip(shape.extent.width, mip), at_mip(shape.extent.height, mip),
                                  at_mip(shape.extent.depth, mip));
        mips.push_back({layers, {}, layers, {}, extent});
    }
    commands_->copyImage(from.handle(), from.layout({}), to.handle(), to.layout({}), mips);
}

void StepRecorder::record(const PlannedStep&, const ClearWork& work) {
    if (work.buffer) {
        const auto word = static_cast<std::uint32_t>(work.value.value[0]);
        commands_->fillBuffer(resources_->buffer(work.buffer).handle(), 0, VK_WHOLE_SIZE, word);
        return;
    }
    resources_->image(work.image).clear(*commands_, work.value);
}

vk::RenderingAttachmentInfo StepRecorder::attach(const PlannedStep& planned, const Attachment& attachment) {
    DeviceImage& image = resources_->image(attachment.image);
    PartRange range = range_of(image.shape(), attachment.part);
    range.mips = 1;
    const auto type = range.layers > 1 ? vk::ImageViewType::e2DArray : vk::ImageViewType::e2D;
    const bool is_read_only = attachment.access == Access::depth_tested;
    return vk::RenderingAttachmentInfo()
        .setImageView(image.view(type, range))
        .setImageLayout(image.layout(range))
        .setLoadOp(is_discarded(planned, attachment.image) ? vk::AttachmentLoadOp::eDontCare : vk::AttachmentLoadOp::eLoad)
        .setStoreOp(is_read_only ? vk::AttachmentStoreOp::eNone : vk::AttachmentStoreOp::eStore);
}

void StepRecorder::begin_rendering(const PlannedStep& planned, const Pixels& pixels) {
    std::vector<vk::RenderingAttachmentInfo> colors;
    vk::RenderingAttachmentInfo depth;
    Extent extent = pixels.viewport.value_or(Extent{});
    for (const Attachment& attachment : planned.step.attachments) {
        const Shape& shape = plan_->images[attachment.image.id].shape;
        const std::uint32_t mip = attachment.part.mip.value_or(0);
        if (!pixels.viewport) extent = {at_mip(shape.extent.width, mip), at_mip(shape.extent.height, mip), 1};
        if (is_depth(attachment)) {
            depth = attach(planned, attachment);
        } else {
            colors.push_back(attach(planned, attachment));
        }
    }
    const Rows rows = pixels.rows.value_or(Rows{0, extent.height});
    const PixelColumns columns = pixels.columns.value_or(PixelColumns{0, extent.width});
    const vk::Rect2D area({static_cast<std::int32_t>(columns.first), static_cast<std::int32_t>(rows.first)},
                          {columns.count, rows.count});
    commands_->beginRendering(vk::RenderingInfo({}, area, planned.layers, 0, colors, depth.imageView ? &depth : nullptr));
    const vk::Viewport whole(0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1);
    commands_->setViewport(0, whole);
    commands_->setScissor(0, area);
}

}  // namespace strata
