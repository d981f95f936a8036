#include "replay/gpu/pipelines.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <optional>
#include <span>
#include <thread>

#include "passes/graph/reached_code.h"
#include "passes/graph/shader.h"
#include "passes/stages.h"
#include "replay/gpu/format_table.h"
#include "replay/gpu/host_timer.h"
#include "replay/gpu/opened_device.h"
#include "replay/gpu/raster_state.h"

namespace strata {
namespace {

// Counter-clockwise on the screen as it is seen: view space looks along +z with x right and y up, clip space has y down, and
// Vulkan measures winding as displayed.
constexpr vk::FrontFace front_face = vk::FrontFace::eCounterClockwise;

/// Specialization constants of one shader, in the shader's order.
struct Constants {
    std::vector<vk::SpecializationMapEntry> entries;
    std::vector<std::uint32_t> values;
};

Constants constants_of(const Shader& shader, const Step& step) {
    Constants found;
    for (const ConstantBits& constant : fixed_constants(shader, step)) {
        const auto offset = static_cast<std::uint32_t>(found.values.size() * sizeof(std::uint32_t));
        found.entries.push_back({constant.id, offset, sizeof(std::uint32_t)});
        found.values.push_back(constant.bits);
    }
    return found;
}

template <typename T>
void append(std::string& key, const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
    key.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string key_of(const PlannedStep& planned, const RasterState& state) {
    std::string key;
    for (const Shader* shader : planned.shaders) {
        append(key, shader->hash);
        const Constants constants = constants_of(*shader, planned.step);
        for (std::size_t i = 0; i < constants.values.size(); ++i) {
            append(key, constants.entries[i].constantID);
            append(key, constants.values[i]);
        }
    }
    append(key, planned.step.push.size());
    append(key, state.depth);
    append(key, state.samples);
    append(key, state.cull);
    append(key, state.alpha_to_coverage);
    append(key, state.keeps_side_effects);
    for (const ColorTarget& target : state.colors) append(key, target);
    return key;
}

/// One layout per set number up to the highest; a slot that two shaders share stands once.
std::vector<vk::raii::DescriptorSetLayout> set_layouts(const vk::raii::Device& device, const PlannedStep& planned) {
    std::vector<std::map<std::uint32_t, vk::DescriptorSetLayoutBinding>> sets;
    for (const PlannedBinding& binding : planned.bindings) {
        if (binding.set >= sets.size()) sets.resize(binding.set + 1);
        sets[binding.set][binding.slot] = {binding.slot, descriptor_type(binding.kind), 1, shader_stages(planned.step)};
    }
    std::vector<vk::raii::DescriptorSetLayout> layouts;
    for (const auto& set : sets) {
        std::vector<vk::DescriptorSetLayoutBinding> slots;
        for (const auto& [number, slot] : set) slots.push_back(slot);
        layouts.emplace_back(device, vk::DescriptorSetLayoutCreateInfo({}, slots));
    }
    return layouts;
}

vk::raii::PipelineLayout pipeline_layout(const vk::raii::Device& device, const Step& step,
                                         const std::vector<vk::raii::DescriptorSetLayout>& sets) {
    std::vector<vk::DescriptorSetLayout> handles;
    for (const auto& set : sets) handles.push_back(*set);
    const vk::PushConstantRange push(shader_stages(step), 0, static_cast<std::uint32_t>(step.push.size()));
    vk::PipelineLayoutCreateInfo info({}, handles);
    if (push.size > 0) info.setPushConstantRanges(push);
    return {device, info};
}

/// A module with its constants; the stage info points into both.
struct ShaderPart {
    ShaderPart(const vk::raii::Device& device, const Shader& shader, const Step& step)
        : constants(constants_of(shader, step)), module(make_module(device, shader, step)), stage(shader.stage) {}

    static vk::raii::ShaderModule make_module(const vk::raii::Device& device, const Shader& shader, const Step& step) {
        const std::vector<std::uint32_t> code = reached_code(shader.code, fixed_constants(shader, step));
        return {device, vk::ShaderModuleCreateInfo({}, code.size() * sizeof code[0], code.data())};
    }

    vk::PipelineShaderStageCreateInfo info() {
        specialization.setMapEntries(constants.entries).setData<std::uint32_t>(constants.values);
        using Bit = vk::ShaderStageFlagBits;
        constexpr std::array bits = {Bit::eCompute, Bit::eVertex, Bit::eGeometry, Bit::eFragment};
        return {{}, bits[static_cast<std::size_t>(stage)], *module, "main", &specialization};
    }

    Constants constants;
    vk::raii::ShaderModule module;
    ShaderStage stage;
    vk::SpecializationInfo specialization;
};

/// What a pipeline is made with besides its shaders and its state.
struct MadeWith {
    vk::PipelineLayout layout;
    vk::PipelineCreateFlags flags;
};

vk::raii::Pipeline make_compute(const vk::raii::Device& device, const PlannedStep& planned, const MadeWith& with) {
    ShaderPart part(device, *planned.shaders.front(), planned.step);
    return {device, nullptr, vk::ComputePipelineCreateInfo(with.flags, part.info(), with.layout)};
}

vk::PipelineRasterizationStateCreateInfo rasterization(Cull cull) {
    constexpr std::array modes = {vk::CullModeFlagBits::eNone, vk::CullModeFlagBits::eBack, vk::CullModeFlagBits::eFront};
    return vk::PipelineRasterizationStateCreateInfo()
        .setCullMode(modes[static_cast<std::size_t>(cull)])
        .setFrontFace(front_face)
        .setLineWidth(1);
}

vk::PipelineDepthStencilStateCreateInfo depth_state(DepthUse depth) {
    return vk::PipelineDepthStencilStateCreateInfo()
        .setDepthTestEnable(depth != DepthUse::none)
        .setDepthWriteEnable(depth == DepthUse::test_and_write)
        .setDepthCompareOp(depth == DepthUse::test_equal ? vk::CompareOp::eEqual : vk::CompareOp::eGreaterOrEqual);
}

vk::raii::Pipeline make_raster(const vk::raii::Device& device, const PlannedStep& planned, const RasterState& state,
                               const MadeWith& with) {
    std::vector<ShaderPart> parts;
    for (const Shader* shader : planned.shaders) parts.emplace_back(device, *shader, planned.step);
    std::vector<vk::PipelineShaderStageCreateInfo> stages;
    for (ShaderPart& part : parts) stages.push_back(part.info());

    std::vector<vk::PipelineColorBlendAttachmentState> blends;
    std::vector<vk::Format> formats;
    for (const ColorTarget& target : state.colors) {
        blends.push_back(blend_state(state, target.blend));
        formats.push_back(target.format);
    }
    const vk::PipelineVertexInputStateCreateInfo pulled;
    const vk::PipelineInputAssemblyStateCreateInfo triangles({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    const auto raster = rasterization(state.cull);
    const auto samples = vk::PipelineMultisampleStateCreateInfo({}, static_cast<vk::SampleCountFlagBits>(state.samples))
                             .setAlphaToCoverageEnable(state.alpha_to_coverage);
    const auto depth = depth_state(state.depth);
    const vk::PipelineColorBlendStateCreateInfo blend({}, VK_FALSE, vk::LogicOp::eCopy, blends);
    constexpr std::array dynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamics({}, dynamic);
    const vk::PipelineRenderingCreateInfo rendering(
        0, formats, state.depth == DepthUse::none ? vk::Format::eUndefined : device_format(Format::d32f));
    const auto info = vk::GraphicsPipelineCreateInfo(with.flags, stages, &pulled, &triangles, nullptr, &viewport, &raster,
                                                     &samples, &depth, &blend, &dynamics, with.layout)
                          .setPNext(&rendering);
    return {device, nullptr, info};
}

bool is_compute(const PlannedStep& planned) { return std::holds_alternative<ComputeWork>(planned.step.work); }

RasterState state_of(const PlannedStep& planned, const std::vector<ImageRecord>& images, bool software) {
    return is_compute(planned) ? RasterState{} : raster_state(planned, images, software);
}

std::size_t code_bytes(const PlannedStep& planned) {
    std::size_t bytes = 0;
    for (const Shader* shader : planned.shaders) bytes += shader->code.size_bytes();
    return bytes;
}

}  // namespace

vk::DescriptorType descriptor_type(BindingKind kind) {
    switch (kind) {
        case BindingKind::sampled_image:
            return vk::DescriptorType::eCombinedImageSampler;
        case BindingKind::storage_image:
            return vk::DescriptorType::eStorageImage;
        case BindingKind::storage_buffer:
            return vk::DescriptorType::eStorageBuffer;
        case BindingKind::uniform_buffer:
            return vk::DescriptorType::eUniformBuffer;
    }
    return vk::DescriptorType::eStorageBuffer;
}

vk::ShaderStageFlags shader_stages(const Step& step) {
    using Bit = vk::ShaderStageFlagBits;
    if (std::holds_alternative<ComputeWork>(step.work)) return Bit::eCompute;
    const auto is_geometry = [](const std::string& shader) { return shader.ends_with(".geom"); };
    const bool geometry = std::ranges::any_of(step.shaders, is_geometry);
    return Bit::eVertex | Bit::eFragment | (geometry ? Bit::eGeometry : vk::ShaderStageFlags());
}

Pipeline make_pipeline(const vk::raii::Device& device, const PlannedStep& planned, const RasterState& state,
                       vk::PipelineCreateFlags flags) {
    auto sets = set_layouts(device, planned);
    auto layout = pipeline_layout(device, planned.step, sets);
    const MadeWith with{*layout, flags};
    auto handle = is_compute(planned) ? make_compute(device, planned, with) : make_raster(device, planned, state, with);
    return {std::move(sets), std::move(layout), std::move(handle)};
}

PipelineStore::PipelineStore(OpenedDevice& device) : device_(&device) {}

Pipeline PipelineStore::made(const PlannedStep& planned, const RasterState& state) const {
    Pipeline pipeline = make_pipeline(device_->handle(), planned, state);
    device_->label(*pipeline.handle, planned.step.name);
    return pipeline;
}

void PipelineStore::make(const Plan& plan, std::size_t steps, const std::stop_token& stop) {
    struct Missing {
        const PlannedStep* step;
        RasterState state;
        std::optional<Pipeline> pipeline;
    };
    std::map<std::string, Missing> missing;
    ++plans_;
    for (const PlannedStep& planned : std::span(plan.steps).first(steps)) {
        if (planned.shaders.empty()) continue;
        const RasterState state = state_of(planned, plan.images, device_->info().software);
        std::string key = key_of(planned, state);
        if (const auto kept = pipelines_.find(key); kept != pipelines_.end()) kept->second.used = plans_;
        else missing.try_emplace(std::move(key), Missing{&planned, state, {}});
    }
    if (missing.empty()) return;
    std::vector<Missing*> order;  // the largest first, so that none is left over at the end
    for (auto& [key, one] : missing) order.push_back(&one);
    std::ranges::sort(order, std::ranges::greater(), [](const Missing* one) { return code_bytes(*one->step); });
    HostTimer timer;
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < order.size() && !stop.stop_requested(); i = next++) try {
                order[i]->pipeline = made(*order[i]->step, order[i]->state);
            } catch (const vk::SystemError&) {  // find() meets it again and says at which step
            }
    };
    {
        const std::size_t workers = std::min<std::size_t>(order.size(), std::max(1u, std::thread::hardware_concurrency()));
        std::vector<std::jthread> others;
        for (std::size_t i = 1; i < workers; ++i) others.emplace_back(work);
        work();
    }
    milliseconds_ += timer();
    for (auto& [key, one] : missing)
        if (one.pipeline) keep(key, *std::move(one.pipeline));
    drop_old();
}

const Pipeline& PipelineStore::keep(std::string key, Pipeline pipeline) {
    ++created_;
    return pipelines_.emplace(std::move(key), Kept{std::move(pipeline), plans_}).first->second.pipeline;
}

void PipelineStore::drop_old() {
    if (pipelines_.size() <= most_kept_) return;
    std::vector<std::map<std::string, Kept>::iterator> old;
    for (auto kept = pipelines_.begin(); kept != pipelines_.end(); ++kept)
        if (kept->second.used < plans_) old.push_back(kept);
    std::ranges::sort(old, {}, [](const auto& kept) { return kept->second.used; });
    for (std::size_t i = 0; i < old.size() && pipelines_.size() > most_kept_; ++i) pipelines_.erase(old[i]);
}

const Pipeline& PipelineStore::find(const PlannedStep& planned, const std::vector<ImageRecord>& images) {
    const RasterState state = state_of(planned, images, device_->info().software);
    std::string key = key_of(planned, state);
    if (const auto found = pipelines_.find(key); found != pipelines_.end()) {
        found->second.used = plans_;
        return found->second.pipeline;
    }
    HostTimer timer;
    const Pipeline& made_now = keep(std::move(key), made(planned, state));
    milliseconds_ += timer();
    return made_now;
}

}  // namespace strata
