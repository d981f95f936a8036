#include "passes/frame_images.h"

#include <cassert>

namespace strata {
namespace {

constexpr FrameImageRow rows[] = {
    {"visible", &FrameImages::visible},
    {"shadow_maps", &FrameImages::shadow_maps, Content::coded},
    {"visibility", &FrameImages::visibility},
    {"depth", &FrameImages::depth, Content::depth},
    {"depth_layers", &FrameImages::depth_layers, Content::depth},
    {"gbuffer0", &FrameImages::gbuffer0, Content::coded},
    {"gbuffer1", &FrameImages::gbuffer1, Content::coded},
    {"gbuffer2", &FrameImages::gbuffer2, Content::coded},
    {"emission", &FrameImages::emission, Content::radiance},
    {"surface_normal", &FrameImages::surface_normal},
    {"surface_color", &FrameImages::surface_color},
    {"surface_material", &FrameImages::surface_material},
    {"edges", &FrameImages::edges},
    {"occlusion", &FrameImages::occlusion},
    {"indirect", &FrameImages::indirect, Content::radiance},
    {"light", &FrameImages::light, Content::radiance},
    {"color", &FrameImages::color, Content::radiance},
    {"display", &FrameImages::display, Content::display},
};

std::string spread_shader(const Shape& shape) {
    switch (row(shape.format).kind) {
        case FormatKind::depth:
            return shape.samples > 1 ? "shaders/spread_depth.comp" : "shaders/spread_depth_single.comp";
        case FormatKind::integer:
            return "shaders/spread_integer.comp";
        case FormatKind::real:
            break;
    }
    return "shaders/spread_real.comp";
}

}  // namespace

std::span<const FrameImageRow> frame_images() { return rows; }

const FrameImageRow* find_frame_image(std::string_view name) {
    for (const FrameImageRow& candidate : rows)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

Image spread(Graph& graph, const Image& multisampled, std::string_view name) {
    const Shape shape = graph.shape(multisampled);
    assert(shape.layers == 1 && shape.mips == 1);
    const bool is_depth = row(shape.format).kind == FormatKind::depth;
    if (shape.samples == 1 && !is_depth) return multisampled;
    Image layers = graph.create(
        std::string(name), {.extent = shape.extent, .format = is_depth ? Format::r32f : shape.format, .layers = shape.samples});
    graph.compute(spread_shader(shape))
        .samples("samples", multisampled)
        .stores("layers", layers)
        .over({shape.extent.width, shape.extent.height, shape.samples});
    return layers;
}

Image gather(Graph& graph, const Image& layered, std::string_view name) {
    const Shape shape = graph.shape(layered);
    assert(shape.samples == 1 && shape.mips == 1 && row(shape.format).kind != FormatKind::depth);
    if (shape.layers == 1) return layered;
    Image samples = graph.create(std::string(name), {.extent = shape.extent, .format = shape.format, .samples = shape.layers});
    const bool is_integer = row(shape.format).kind == FormatKind::integer;
    graph.fullscreen(is_integer ? "shaders/gather_integer" : "shaders/gather_real").samples("layers", layered).covers(samples);
    return samples;
}

}  // namespace strata
