// A small renderer to compare times with: draws the triangles of a capture into linked lists of pixels, which it sorts and
// composites, or blends them in the order of submission. compare.py runs it in turns with `strata replay`.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <blend_frag.h>
#include <list_frag.h>
#include <resolve_comp.h>
#include <sphere_vert.h>
#include "tests/9_speed/peer/device.h"
#include "tests/9_speed/peer/spheres.h"

namespace strata::peer {
namespace {

enum class Mode { list, blend };

struct Options {
    std::string capture, picture;
    Mode mode = Mode::list;
    Sharing sharing = Sharing::all;
    int frames = 10;
};

constexpr auto all_stages =
    vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute;
constexpr std::uint32_t nodes_per_pixel = 16;

class Renderer {
public:
    Renderer(const Device&, const Spheres&, Mode);
    /// Milliseconds of drawing and of resolving.
    std::array<double, 2> render() const;
    std::array<std::uint32_t, 2> counters() const;  ///< nodes used, lists too long
    void write(const std::string& path) const;

private:
    vk::raii::Pipeline drawing(std::span<const std::uint32_t> fragment_code) const;
    vk::raii::Pipeline resolving() const;
    void write_descriptors() const;
    void draw(const vk::raii::CommandBuffer&) const;
    void clear(const vk::raii::CommandBuffer&) const;
    std::vector<std::byte> read(std::size_t bytes, auto copy) const;

    const Device& device_;
    Scene scene_;
    Mode mode_;
    std::uint32_t index_count_;
    vk::Extent2D extent_;
    Buffer vertices_, indices_, nodes_, counters_;
    Image heads_, picture_, depth_;
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::DescriptorPool set_pool_ = nullptr;
    vk::raii::DescriptorSet set_ = nullptr;
    vk::raii::Pipeline drawing_ = nullptr, resolving_ = nullptr;
    vk::raii::QueryPool times_;
};

vk::raii::ShaderModule module(const Device& device, std::span<const std::uint32_t> code) {
    return {device.logical, vk::ShaderModuleCreateInfo({}, code.size_bytes(), code.data())};
}

Renderer::Renderer(const Device& device, const Spheres& spheres, Mode mode)
    : device_(device),
      scene_(spheres.scene),
      mode_(mode),
      index_count_(static_cast<std::uint32_t>(spheres.indices.size())),
      extent_(spheres.scene.width, spheres.scene.height),
      vertices_(Buffer::of(device, std::as_bytes(std::span(spheres.vertices)), vk::BufferUsageFlagBits::eVertexBuffer)),
      indices_(Buffer::of(device, std::as_bytes(std::span(spheres.indices)), vk::BufferUsageFlagBits::eIndexBuffer)),
      nodes_(device, vk::DeviceSize{scene_.width} * scene_.height * nodes_per_pixel * 16, vk::BufferUsageFlagBits::eStorageBuffer,
             vk::MemoryPropertyFlagBits::eDeviceLocal),
      counters_(
          device, 8,
          vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst | vk::BufferUsageFlagBits::eTransferSrc,
          vk::MemoryPropertyFlagBits::eDeviceLocal),
      heads_(device, extent_, vk::Format::eR32Uint, vk::ImageUsageFlagBits::eStorage | vk::ImageUsageFlagBits::eTransferDst),
      picture_(
          device, extent_, vk::Format::eR32G32B32A32Sfloat,
          vk::ImageUsageFlagBits::eStorage | vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc),
      depth_(device, extent_, vk::Format::eD32Sfloat, vk::ImageUsageFlagBits::eDepthStencilAttachment),
      times_(device.logical, vk::QueryPoolCreateInfo({}, vk::QueryType::eTimestamp, 3)) {
    scene_.nodes = scene_.width * scene_.height * nodes_per_pixel;
    using Type = vk::DescriptorType;
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const Type type : {Type::eStorageImage, Type::eStorageBuffer, Type::eStorageBuffer, Type::eStorageImage})
        bindings.push_back({static_cast<std::uint32_t>(bindings.size()), type, 1, all_stages});
    set_layout_ = {device.logical, vk::DescriptorSetLayoutCreateInfo({}, bindings)};
    const vk::PushConstantRange push(all_stages, 0, sizeof(Scene));
    layout_ = {device.logical, vk::PipelineLayoutCreateInfo({}, *set_layout_, push)};
    const std::array sizes{vk::DescriptorPoolSize(Type::eStorageImage, 2), vk::DescriptorPoolSize(Type::eStorageBuffer, 2)};
    set_pool_ = {device.logical, vk::DescriptorPoolCreateInfo(vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes)};
    set_ = std::move(vk::raii::DescriptorSets(device.logical, {*set_pool_, *set_layout_}).front());
    write_descriptors();
    drawing_ = mode == Mode::list ? drawing(list_frag) : drawing(blend_frag);
    resolving_ = resolving();
}

void Renderer::write_descriptors() const {
    const std::array images{vk::DescriptorImageInfo({}, *heads_.view, vk::ImageLayout::eGeneral),
                            vk::DescriptorImageInfo({}, *picture_.view, vk::ImageLayout::eGeneral)};
    const std::array buffers{vk::DescriptorBufferInfo(*nodes_.handle, 0, VK_WHOLE_SIZE),
                             vk::DescriptorBufferInfo(*counters_.handle, 0, VK_WHOLE_SIZE)};
    using Type = vk::DescriptorType;
    device_.logical.updateDescriptorSets({vk::WriteDescriptorSet(*set_, 0, 0, Type::eStorageImage, images[0]),
                                          vk::WriteDescriptorSet(*set_, 1, 0, Type::eStorageBuffer, {}, buffers),
                                          vk::WriteDescriptorSet(*set_, 3, 0, Type::eStorageImage, images[1])},
                                         {});
}

vk::raii::Pipeline Renderer::drawing(std::span<const std::uint32_t> fragment_code) const {
    const vk::raii::ShaderModule vertex = module(device_, sphere_vert), fragment = module(device_, fragment_code);
    const std::array stages{vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eVertex, *vertex, "main"),
                            vk::PipelineShaderStageCreateInfo({}, vk::ShaderStageFlagBits::eFragment, *fragment, "main")};
    const vk::VertexInputBindingDescription binding(0, sizeof(Vertex));
    const std::array attributes{
        vk::VertexInputAttributeDescription(0, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, position)),
        vk::VertexInputAttributeDescription(1, 0, vk::Format::eR32G32B32Sfloat, offsetof(Vertex, normal)),
        vk::VertexInputAttributeDescription(2, 0, vk::Format::eR32G32B32A32Sfloat, offsetof(Vertex, color))};
    const vk::PipelineVertexInputStateCreateInfo input({}, binding, attributes);
    const vk::PipelineInputAssemblyStateCreateInfo assembly({}, vk::PrimitiveTopology::eTriangleList);
    const vk::Viewport viewport(0, 0, float(extent_.width), float(extent_.height), 0, 1);
    const vk::Rect2D scissor({}, extent_);
    const vk::PipelineViewportStateCreateInfo view({}, viewport, scissor);
    vk::PipelineRasterizationStateCreateInfo raster;
    raster.setFrontFace(vk::FrontFace::eCounterClockwise).setLineWidth(1);
    const vk::PipelineMultisampleStateCreateInfo samples;
    const vk::PipelineDepthStencilStateCreateInfo depth({}, true, false, vk::CompareOp::eGreaterOrEqual);
    using Factor = vk::BlendFactor;
    const vk::PipelineColorBlendAttachmentState over(true, Factor::eOne, Factor::eOneMinusSrcAlpha, vk::BlendOp::eAdd,
                                                     Factor::eOne, Factor::eOneMinusSrcAlpha, vk::BlendOp::eAdd,
                                                     vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags);
    const std::vector blends(mode_ == Mode::blend ? 1 : 0, over);
    const std::vector formats(blends.size(), vk::Format::eR32G32B32A32Sfloat);
    const vk::PipelineColorBlendStateCreateInfo blend({}, false, {}, blends);
    const vk::PipelineRenderingCreateInfo rendering(0, formats, vk::Format::eD32Sfloat);
    vk::GraphicsPipelineCreateInfo info({}, stages, &input, &assembly, nullptr, &view, &raster, &samples, &depth, &blend, nullptr,
                                        *layout_);
    return {device_.logical, nullptr, info.setPNext(&rendering)};
}

vk::raii::Pipeline Renderer::resolving() const {
    const vk::raii::ShaderModule compute = module(device_, resolve_comp);
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *compute, "main");
    return {device_.logical, nullptr, vk::ComputePipelineCreateInfo({}, stage, *layout_)};
}

void Renderer::clear(const vk::raii::CommandBuffer& commands) const {
    const vk::ImageSubresourceRange all(vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
    constexpr std::uint32_t none = ~0u;
    const vk::ClearColorValue no_node(std::array{none, none, none, none});
    commands.clearColorImage(*heads_.handle, vk::ImageLayout::eGeneral, no_node, all);
    commands.fillBuffer(*counters_.handle, 0, VK_WHOLE_SIZE, 0);
    wait_for_all(commands);
}

void Renderer::draw(const vk::raii::CommandBuffer& commands) const {
    const glm::vec3 back = scene_.background;
    const vk::ClearValue background(vk::ClearColorValue(std::array{back.x, back.y, back.z, 1.0f}));
    const auto attachment = [](const Image& image, vk::ClearValue value) {
        return vk::RenderingAttachmentInfo(*image.view, vk::ImageLayout::eGeneral, {}, {}, {}, vk::AttachmentLoadOp::eClear,
                                           vk::AttachmentStoreOp::eStore, value);
    };
    const vk::RenderingAttachmentInfo color = attachment(picture_, background),
                                      depth = attachment(depth_, vk::ClearDepthStencilValue(0, 0));
    const std::vector colors(mode_ == Mode::blend ? 1 : 0, color);
    commands.beginRendering(vk::RenderingInfo({}, {{}, extent_}, 1, 0, colors, &depth));
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *drawing_);
    commands.bindVertexBuffers(0, *vertices_.handle, {0});
    commands.bindIndexBuffer(*indices_.handle, 0, vk::IndexType::eUint32);
    commands.drawIndexed(index_count_, 1, 0, 0, 0);
    commands.endRendering();
}

std::array<double, 2> Renderer::render() const {
    const vk::raii::CommandBuffer commands = device_.begin();
    commands.resetQueryPool(*times_, 0, 3);
    for (const auto point : {vk::PipelineBindPoint::eGraphics, vk::PipelineBindPoint::eCompute})
        commands.bindDescriptorSets(point, *layout_, 0, *set_, {});
    commands.pushConstants<Scene>(*layout_, all_stages, 0, scene_);
    const auto write_time = [&](std::uint32_t query) {
        wait_for_all(commands);
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *times_, query);
        wait_for_all(commands);
    };
    write_time(0);
    clear(commands);
    draw(commands);
    write_time(1);
    if (mode_ == Mode::list) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *resolving_);
        commands.dispatch((extent_.width + 7) / 8, (extent_.height + 7) / 8, 1);
    }
    write_time(2);
    device_.submit(commands);
    const auto [result, ticks] = times_.getResults<std::uint64_t>(0, 3, 3 * sizeof(std::uint64_t), sizeof(std::uint64_t),
                                                                  vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
    const double milliseconds = device_.physical.getProperties().limits.timestampPeriod * 1e-6;
    return {double(ticks[1] - ticks[0]) * milliseconds, double(ticks[2] - ticks[1]) * milliseconds};
}

std::vector<std::byte> Renderer::read(std::size_t bytes, auto copy) const {
    const auto mapped = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    const Buffer to(device_, bytes, vk::BufferUsageFlagBits::eTransferDst, mapped);
    const vk::raii::CommandBuffer commands = device_.begin();
    wait_for_all(commands);
    copy(commands, *to.handle);
    wait_for_all(commands);
    device_.submit(commands);
    const auto* first = static_cast<const std::byte*>(to.memory.mapMemory(0, bytes));
    return {first, first + bytes};
}

std::array<std::uint32_t, 2> Renderer::counters() const {
    const std::vector<std::byte> bytes = read(
        8, [&](const auto& commands, vk::Buffer to) { commands.copyBuffer(*counters_.handle, to, vk::BufferCopy(0, 0, 8)); });
    std::array<std::uint32_t, 2> values;
    std::memcpy(values.data(), bytes.data(), sizeof(values));
    return values;
}

void Renderer::write(const std::string& path) const {
    std::vector<std::byte> texels =
        read(std::size_t{extent_.width} * extent_.height * 16, [&](const auto& commands, vk::Buffer to) {
            const vk::ImageSubresourceLayers layer(vk::ImageAspectFlagBits::eColor, 0, 0, 1);
            const vk::BufferImageCopy whole(0, 0, 0, layer, {}, {extent_.width, extent_.height, 1});
            commands.copyImageToBuffer(*picture_.handle, vk::ImageLayout::eGeneral, to, whole);
        });
    Imf::Header header(int(extent_.width), int(extent_.height));
    Imf::FrameBuffer channels;
    for (std::size_t i = 0; i < 3; ++i) {
        const char name[] = {"RGB"[i], 0};
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        channels.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(texels.data()) + 4 * i, 16, 16 * extent_.width));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(channels);
    file.writePixels(int(extent_.height));
}

/// The value of that name. Throws where there is none.
template <typename Value, std::size_t count>
Value named(const std::array<std::pair<std::string_view, Value>, count>& values, std::string_view name) {
    for (const auto& [known, value] : values)
        if (known == name) return value;
    throw std::invalid_argument("'" + std::string(name) + "' is not a value of this option");
}

constexpr std::array modes{std::pair<std::string_view, Mode>("list", Mode::list),
                           std::pair<std::string_view, Mode>("blend", Mode::blend)};
constexpr std::array sharings{std::pair<std::string_view, Sharing>("all", Sharing::all),
                              std::pair<std::string_view, Sharing>("all_but_first", Sharing::all_but_first),
                              std::pair<std::string_view, Sharing>("none", Sharing::none)};

std::optional<Options> parse(std::span<const std::string_view> words) {
    Options options;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string_view word = words[i];
        if (!word.starts_with("--")) {
            options.capture = word;
            continue;
        }
        if (++i == words.size()) return std::nullopt;
        if (word == "--output") options.picture = words[i];
        else if (word == "--frames") options.frames = std::max(1, std::atoi(std::string(words[i]).c_str()));
        else if (word == "--mode") options.mode = named(modes, words[i]);
        else if (word == "--sharing") options.sharing = named(sharings, words[i]);
        else return std::nullopt;
    }
    return options.capture.empty() ? std::nullopt : std::optional(options);
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

int run(const Options& options) {
    const Result<Spheres> spheres = read_spheres(options.capture, options.sharing);
    if (!spheres) return std::fprintf(stderr, "peer: %s\n", spheres.error().sentence.c_str()), 3;
    const Device device;
    const Renderer renderer(device, *spheres, options.mode);
    renderer.render();  // the driver compiles at the first draw
    std::vector<double> drawn, resolved, whole;
    for (int i = 0; i < options.frames; ++i) {
        const auto [drawing, resolving] = renderer.render();
        drawn.push_back(drawing);
        resolved.push_back(resolving);
        whole.push_back(drawing + resolving);
    }
    const auto [used, too_long] = renderer.counters();
    if (too_long > 0 || used > spheres->scene.width * spheres->scene.height * nodes_per_pixel)
        return std::fprintf(stderr, "peer: %u nodes and %u lists of more than 64 layers do not fit\n", used, too_long), 1;
    const auto [least, most] = std::ranges::minmax(whole);
    std::printf("%.3f ms, %.3f to %.3f, of %d frames: drawing %.3f, resolving %.3f; %u nodes, %zu vertices, %zu indices; %s\n",
                median(whole), least, most, options.frames, median(drawn), median(resolved), used, spheres->vertices.size(),
                spheres->indices.size(), device.physical.getProperties().deviceName.data());
    if (!options.picture.empty()) renderer.write(options.picture);
    return 0;
}

}  // namespace
}  // namespace strata::peer

int main(int count, char** words) {
    const std::vector<std::string_view> given(words + 1, words + count);
    try {
        if (const auto options = strata::peer::parse(given)) return strata::peer::run(*options);
        std::fprintf(stderr,
                     "usage: peer CAPTURE [--mode list|blend] [--frames N] [--output EXR] [--sharing all|all_but_first|none]\n");
        return 2;
    } catch (const std::invalid_argument& error) {
        return std::fprintf(stderr, "peer: %s\n", error.what()), 2;
    } catch (const std::exception& error) {
        return std::fprintf(stderr, "peer: %s\n", error.what()), 5;
    }
}
