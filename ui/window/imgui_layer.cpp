#include "ui/window/imgui_layer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include <xxhash.h>

#include "capture_format/frame/texture.h"
#include "passes/scene/scene_facts.h"
#include "passes/stages.h"
#include "replay/images/image_io.h"
#include "ui/window/imgui_layer.frag.h"
#include "ui/window/imgui_layer.shared.h"
#include "ui/window/imgui_layer.vert.h"
#include "ui/window/imgui_layer_target.h"

namespace strata::ui {
namespace {

// Room for as many textures as a frame of any panel shows; a texture is an image of a replay, and a replay has some dozens.
constexpr std::uint32_t most_textures = 256;

/// The least float that display_byte() makes more than each byte of, from 0 to 254.
std::array<float, 255> byte_ends() {
    std::array<float, 255> ends{};
    for (std::uint32_t byte = 0; byte < ends.size(); ++byte) {
        std::uint32_t below = 0, above = std::bit_cast<std::uint32_t>(1.0f);  // floats from 0 to 1 are in the order of their bits
        while (above - below > 1) {
            const std::uint32_t middle = below + (above - below) / 2;
            const bool is_more = display_byte(double{std::bit_cast<float>(middle)}) > std::byte(byte);
            (is_more ? above : below) = middle;
        }
        ends[byte] = std::bit_cast<float>(above);
    }
    return ends;
}

struct Texture {
    LayerImage image;
    vk::raii::DescriptorSet set = nullptr;
    std::uint32_t version = 0;  ///< no two have the same
};

struct ShownTexture {
    TextureId texture = 0;
    Look look;
};

void set_look(LayerPush& push, const Look& look) {
    const float range = look.white == look.black ? 1e-30f : look.white - look.black;
    push.scale = std::exp2(look.exposure) / range;
    push.offset = -look.black / range;
    push.channel = look.channels <= Channels::alpha && look.channels != Channels::color
                       ? static_cast<std::uint32_t>(look.channels) - static_cast<std::uint32_t>(Channels::red)
                       : 0;
}

/// A pipeline per kind of look and curve.
std::size_t pipeline_index(std::uint32_t kind, std::uint32_t curve) { return kind * curve_kinds + curve; }

std::size_t pipeline_index(const Look& look) {
    const std::uint32_t curve = look.curve == Curve::srgb ? curve_srgb : curve_raw;
    switch (look.channels) {
        case Channels::color:
            return pipeline_index(look_color, curve);
        case Channels::luminance:
            return pipeline_index(look_luminance, curve);
        case Channels::false_color:
            return pipeline_index(look_false_color, curve);
        default:
            return pipeline_index(look_channel, curve);
    }
}

class Layer final : public ImguiLayer {
public:
    explicit Layer(std::unique_ptr<LayerDevice>);

    TextureId upload(TextureId, const Texels&) override;
    void release(TextureId texture) override { textures_.erase(texture); }
    ImTextureID shown(TextureId, const Look&) override;
    void begin() override;
    void begin_frame() override { shown_.clear(); }
    Result<void> draw(const ImDrawData&) override;
    void forget_drawn() override { changed_.forget(); }
    Picture read_back() override { return target_.read_back(); }
    LayerDevice& device() override { return *device_; }
    const LayerTarget& target() const override { return target_; }
    std::vector<std::string> take_messages() override { return device_->take_messages(); }

private:
    Texture make_texture(vk::Extent2D, vk::Format, std::span<const std::byte>);
    void grow(LayerBuffer&, std::uint64_t bytes, vk::BufferUsageFlags);
    void copy_triangles(const ImDrawData&);
    std::uint64_t look_of(ImTextureID) const;
    void record(const vk::raii::CommandBuffer&, const ImDrawData&, const Region&);
    void record_list(const vk::raii::CommandBuffer&, const ImDrawData&, const Region&, const ImDrawList&, glm::ivec2 first);
    /// Binds what a command shows: false where that is gone.
    bool bind_shown(const vk::raii::CommandBuffer&, ImTextureID, LayerPush&);

    std::unique_ptr<LayerDevice> device_;
    LayerTarget target_;
    vk::raii::Sampler sampler_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    std::vector<vk::raii::Pipeline> pipelines_;  // by pipeline_index()
    vk::raii::DescriptorPool pool_;
    LayerBuffer ends_, vertices_, indices_;
    std::map<TextureId, Texture> textures_;  // 0: the fonts
    TextureId next_ = 1;
    std::uint32_t versions_ = 0;
    ChangedRegions changed_;
    std::vector<ShownTexture> shown_;  // ImTextureID is an index of it, from 1; 0 is the fonts
};

vk::raii::DescriptorSetLayout make_set_layout(const vk::raii::Device& device) {
    const std::array bindings = {
        vk::DescriptorSetLayoutBinding(0, vk::DescriptorType::eCombinedImageSampler, 1, vk::ShaderStageFlagBits::eFragment),
        vk::DescriptorSetLayoutBinding(1, vk::DescriptorType::eStorageBuffer, 1, vk::ShaderStageFlagBits::eFragment)};
    return {device, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
}

vk::raii::PipelineLayout make_layout(const vk::raii::Device& device, vk::DescriptorSetLayout set) {
    const vk::PushConstantRange push(vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, sizeof(LayerPush));
    return {device, vk::PipelineLayoutCreateInfo({}, set, push)};
}

vk::raii::DescriptorPool make_pool(const vk::raii::Device& device) {
    const std::array sizes = {vk::DescriptorPoolSize(vk::DescriptorType::eCombinedImageSampler, most_textures),
                              vk::DescriptorPoolSize(vk::DescriptorType::eStorageBuffer, most_textures)};
    return {device, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, most_textures, sizes)};
}

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, vk::PipelineLayout layout,
                                 const std::array<std::uint32_t, 2>& kind_and_curve) {
    const vk::raii::ShaderModule vertex(device, vk::ShaderModuleCreateInfo({}, sizeof imgui_layer_vert, imgui_layer_vert));
    const vk::raii::ShaderModule fragment(device, vk::ShaderModuleCreateInfo({}, sizeof imgui_layer_frag, imgui_layer_frag));
    constexpr std::array entries = {vk::SpecializationMapEntry(0, 0, 4), vk::SpecializationMapEntry(1, 4, 4)};
    const vk::SpecializationInfo constants(entries.size(), entries.data(), sizeof kind_and_curve, kind_and_curve.data());
    const std::array stages = {
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
        vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main", &constants)};
    const vk::VertexInputBindingDescription binding(0, sizeof(ImDrawVert), vk::VertexInputRate::eVertex);
    const std::array attributes = {
        vk::VertexInputAttributeDescription(0, 0, vk::Format::eR32G32Sfloat, IM_OFFSETOF(ImDrawVert, pos)),
        vk::VertexInputAttributeDescription(1, 0, vk::Format::eR32G32Sfloat, IM_OFFSETOF(ImDrawVert, uv)),
        vk::VertexInputAttributeDescription(2, 0, vk::Format::eR8G8B8A8Unorm, IM_OFFSETOF(ImDrawVert, col))};
    const vk::PipelineVertexInputStateCreateInfo input({}, binding, attributes);
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::PipelineViewportStateCreateInfo viewport({}, 1, nullptr, 1, nullptr);
    const vk::PipelineRasterizationStateCreateInfo raster({}, VK_FALSE, VK_FALSE, vk::PolygonMode::eFill, {}, {}, VK_FALSE, 0, 0,
                                                          0, 1);
    const vk::PipelineMultisampleStateCreateInfo samples({}, vk::SampleCountFlagBits::e1);
    using Factor = vk::BlendFactor;
    const vk::PipelineColorBlendAttachmentState over(VK_TRUE, Factor::eSrcAlpha, Factor::eOneMinusSrcAlpha, vk::BlendOp::eAdd,
                                                     Factor::eOne, Factor::eOneMinusSrcAlpha, vk::BlendOp::eAdd,
                                                     vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags);
    const auto blend = vk::PipelineColorBlendStateCreateInfo().setAttachments(over);
    const std::array dynamic = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamics({}, dynamic);
    const auto rendering = vk::PipelineRenderingCreateInfo().setColorAttachmentFormats(LayerTarget::format);
    vk::GraphicsPipelineCreateInfo info({}, stages, &input, &assembly, nullptr, &viewport, &raster, &samples, nullptr, &blend,
                                        &dynamics, layout);
    info.setPNext(&rendering);
    return {device, nullptr, info};
}

std::vector<vk::raii::Pipeline> make_pipelines(const vk::raii::Device& device, vk::PipelineLayout layout) {
    std::vector<vk::raii::Pipeline> pipelines;
    for (std::uint32_t kind = 0; kind < look_kinds; ++kind)
        for (std::uint32_t curve = 0; curve < curve_kinds; ++curve)
            pipelines.push_back(make_pipeline(device, layout, {kind, curve}));
    return pipelines;
}

Layer::Layer(std::unique_ptr<LayerDevice> device)
    : device_(std::move(device)),
      target_(*device_),
      // Fonts and shapes have soft edges; images are fetched texel by texel.
      sampler_(device_->handle(),
               vk::SamplerCreateInfo({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest,
                                     vk::SamplerAddressMode::eClampToEdge, vk::SamplerAddressMode::eClampToEdge)),
      set_layout_(make_set_layout(device_->handle())),
      layout_(make_layout(device_->handle(), *set_layout_)),
      pipelines_(make_pipelines(device_->handle(), *layout_)),
      pool_(make_pool(device_->handle())),
      ends_(device_->buffer(sizeof(float) * 255, vk::BufferUsageFlagBits::eStorageBuffer)) {
    const auto ends = byte_ends();
    std::memcpy(ends_.mapped, ends.data(), sizeof ends);
}

Texture Layer::make_texture(vk::Extent2D extent, vk::Format format, std::span<const std::byte> texels) {
    Texture texture{
        .image = device_->image(extent, format, vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst),
        .version = ++versions_};
    const LayerBuffer staging = device_->buffer(texels.size(), vk::BufferUsageFlagBits::eTransferSrc);
    std::memcpy(staging.mapped, texels.data(), texels.size());
    auto commands = device_->begin_commands();
    move_to(commands, *texture.image.image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    commands.copyBufferToImage(
        *staging.buffer, *texture.image.image, vk::ImageLayout::eTransferDstOptimal,
        vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {extent.width, extent.height, 1}));
    move_to(commands, *texture.image.image, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    device_->submit_and_wait(commands);

    texture.set = std::move(vk::raii::DescriptorSets(device_->handle(), {*pool_, *set_layout_}).front());
    const vk::DescriptorImageInfo image(*sampler_, *texture.image.view, vk::ImageLayout::eShaderReadOnlyOptimal);
    const vk::DescriptorBufferInfo ends(*ends_.buffer, 0, VK_WHOLE_SIZE);
    device_->handle().updateDescriptorSets(
        {vk::WriteDescriptorSet(*texture.set, 0, 0, vk::DescriptorType::eCombinedImageSampler, image),
         vk::WriteDescriptorSet(*texture.set, 1, 0, vk::DescriptorType::eStorageBuffer, {}, ends)},
        {});
    return texture;
}

TextureId Layer::upload(TextureId replaced, const Texels& texels) {
    assert(texels.width > 0 && texels.height > 0);
    const TextureId id = replaced == 0 ? next_++ : replaced;
    textures_.erase(id);
    textures_.emplace(
        id, make_texture({texels.width, texels.height}, vk::Format::eR32G32B32A32Sfloat, std::as_bytes(std::span(texels.rgba))));
    return id;
}

ImTextureID Layer::shown(TextureId texture, const Look& look) {
    shown_.push_back({texture, look});
    return reinterpret_cast<ImTextureID>(shown_.size());
}

void Layer::begin() {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    const vk::Extent2D extent(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
    textures_.clear();
    forget_drawn();
    textures_.emplace(0, make_texture(extent, vk::Format::eR8G8B8A8Unorm,
                                      std::as_bytes(std::span(pixels, std::size_t{4} * extent.width * extent.height))));
}

void Layer::grow(LayerBuffer& buffer, std::uint64_t bytes, vk::BufferUsageFlags usage) {
    if (buffer.bytes < bytes) buffer = device_->buffer(std::bit_ceil(bytes), usage);
}

void Layer::copy_triangles(const ImDrawData& data) {
    grow(vertices_, std::max<std::uint64_t>(1, static_cast<std::uint64_t>(data.TotalVtxCount)) * sizeof(ImDrawVert),
         vk::BufferUsageFlagBits::eVertexBuffer);
    grow(indices_, std::max<std::uint64_t>(1, static_cast<std::uint64_t>(data.TotalIdxCount)) * sizeof(ImDrawIdx),
         vk::BufferUsageFlagBits::eIndexBuffer);
    std::byte *vertex = vertices_.mapped, *index = indices_.mapped;
    for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount))) {
        std::memcpy(vertex, list->VtxBuffer.Data, static_cast<std::size_t>(list->VtxBuffer.size_in_bytes()));
        std::memcpy(index, list->IdxBuffer.Data, static_cast<std::size_t>(list->IdxBuffer.size_in_bytes()));
        vertex += list->VtxBuffer.size_in_bytes();
        index += list->IdxBuffer.size_in_bytes();
    }
}

std::uint64_t Layer::look_of(ImTextureID id) const {
    const auto place = reinterpret_cast<std::size_t>(id);
    const ShownTexture shown = place == 0 ? ShownTexture() : shown_[place - 1];
    const auto texture = textures_.find(shown.texture);
    const Look& look = shown.look;
    const std::array<std::uint32_t, 7> facts = {place == 0,
                                                texture == textures_.end() ? 0 : texture->second.version,
                                                std::bit_cast<std::uint32_t>(look.exposure),
                                                std::bit_cast<std::uint32_t>(look.black),
                                                std::bit_cast<std::uint32_t>(look.white),
                                                static_cast<std::uint32_t>(look.channels),
                                                static_cast<std::uint32_t>(look.curve)};
    return XXH3_64bits(facts.data(), sizeof facts);
}

bool Layer::bind_shown(const vk::raii::CommandBuffer& commands, ImTextureID id, LayerPush& push) {
    const auto place = reinterpret_cast<std::size_t>(id);
    const auto texture = textures_.find(place == 0 ? 0 : shown_[place - 1].texture);
    if (texture == textures_.end()) return false;
    std::size_t pipeline = pipeline_index(look_widgets, curve_raw);
    if (place > 0) {
        set_look(push, shown_[place - 1].look);
        pipeline = pipeline_index(shown_[place - 1].look);
    }
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines_[pipeline]);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_, 0, *texture->second.set, {});
    commands.pushConstants<LayerPush>(*layout_, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, push);
    return true;
}

void Layer::record_list(const vk::raii::CommandBuffer& commands, const ImDrawData& data, const Region& region,
                        const ImDrawList& list, glm::ivec2 first) {
    LayerPush push{.to_clip = {2 / data.DisplaySize.x, 2 / data.DisplaySize.y}, .clip_offset = {-1, -1}};
    for (const ImDrawCmd& command : list.CmdBuffer) {
        const Region shown = intersection(clip_of(command, data.DisplaySize), region);
        if (shown.is_empty() || command.ElemCount == 0 || !bind_shown(commands, command.TextureId, push)) continue;
        commands.setScissor(0, rect_of(shown));
        commands.drawIndexed(command.ElemCount, 1, static_cast<std::uint32_t>(first.y) + command.IdxOffset,
                             first.x + static_cast<std::int32_t>(command.VtxOffset), 0);
    }
}

void Layer::record(const vk::raii::CommandBuffer& commands, const ImDrawData& data, const Region& region) {
    commands.bindVertexBuffers(0, *vertices_.buffer, vk::DeviceSize{0});
    commands.bindIndexBuffer(*indices_.buffer, 0, sizeof(ImDrawIdx) == 2 ? vk::IndexType::eUint16 : vk::IndexType::eUint32);
    commands.setViewport(0, vk::Viewport(0, 0, data.DisplaySize.x, data.DisplaySize.y, 0, 1));
    glm::ivec2 first(0);
    for (const ImDrawList* list : std::span(data.CmdLists, static_cast<std::size_t>(data.CmdListsCount))) {
        record_list(commands, data, region, *list, first);
        first += glm::ivec2(list->VtxBuffer.Size, list->IdxBuffer.Size);
    }
}

Result<void> Layer::draw(const ImDrawData& data) {
    try {
        target_.resize({static_cast<std::uint32_t>(data.DisplaySize.x), static_cast<std::uint32_t>(data.DisplaySize.y)});
        const auto regions = changed_.next(data, [this](ImTextureID id) { return look_of(id); });
        if (regions.empty()) return {};
        copy_triangles(data);
        target_.render(regions,
                       [&](const vk::raii::CommandBuffer& commands, const Region& region) { record(commands, data, region); });
        return {};
    } catch (const vk::SystemError& problem) {
        forget_drawn();
        return fail(Fault::device_failed, "window.cannot_draw", "the inspector cannot be drawn: {reason}", problem.what());
    }
}

}  // namespace

Result<std::unique_ptr<ImguiLayer>> ImguiLayer::on(std::unique_ptr<LayerDevice> device) {
    try {
        return std::unique_ptr<ImguiLayer>(std::make_unique<Layer>(std::move(device)));
    } catch (const vk::SystemError& problem) {
        return fail(Fault::device_failed, "window.cannot_make_renderer", "the inspector's renderer cannot be made: {reason}",
                    problem.what());
    }
}

Result<std::unique_ptr<ImguiLayer>> ImguiLayer::headless(const DeviceChoice& choice) {
    return LayerDevice::open(choice.validation ? Validation::on : Validation::off).and_then([&](auto& device) {
        return on(std::move(device));
    });
}

}  // namespace strata::ui
