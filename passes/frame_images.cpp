#include "passes/frame_images.h"

#include <cassert>

#include "capture_format/frame/frame.h"
#include "passes/graph/graph.h"

namespace strata {
namespace {

constexpr FrameImageRow rows[] = {
    {"visible", &FrameImages::visible, "1 where an opaque draw is drawn, by its number"},
    {"shadow_maps", &FrameImages::shadow_maps, "depth from each light", Content::coded},
    {"shadow_bounds", &FrameImages::shadow_bounds, "bounds of depth in blocks of shadow maps", Content::coded},
    {"visibility", &FrameImages::visibility, "share of each light that arrives, 1 lit"},
    {"depth", &FrameImages::depth, "device depth, near / z, reversed, of every sample", Content::depth},
    {"depth_layers", &FrameImages::depth_layers, "device depth with a layer for each sample", Content::depth},
    {"gbuffer0", &FrameImages::gbuffer0, "first image of the G-buffer, coded by its technique", Content::coded},
    {"gbuffer1", &FrameImages::gbuffer1, "second image of the G-buffer", Content::coded},
    {"gbuffer2", &FrameImages::gbuffer2, "third image of the G-buffer", Content::coded},
    {"emission", &FrameImages::emission, "radiance of emissive and unlit surfaces; alpha 1 on a surface", Content::radiance},
    {"surface_normal",
     &FrameImages::surface_normal,
     "view-space normal, view z in meters",
     Content::numbers,
     {"x, to the right", "y, up", "z, forward"}},
    {"surface_color", &FrameImages::surface_color, "base color, roughness"},
    {"surface_material",
     &FrameImages::surface_material,
     "lighting model, metallic, occlusion; where in its pixel the position lies, as a code",
     Content::numbers,
     {"lighting model", "metallic", "occlusion"}},
    {"edges", &FrameImages::edges, "1 where every sample of the pixel is shaded"},
    {"occlusion", &FrameImages::occlusion, "ambient visibility, 1 open"},
    {"indirect", &FrameImages::indirect, "indirect irradiance / pi", Content::radiance},
    {"volume_light", &FrameImages::volume_light, "light in the cells of light volumes, in records", Content::coded},
    {"light", &FrameImages::light, "radiance that opaque surfaces reflect", Content::radiance},
    {"shafts", &FrameImages::shafts, "sunlight that the air before surfaces scatters to the eye", Content::radiance},
    {"color", &FrameImages::color, "radiance of the frame", Content::radiance},
    {"exposure", &FrameImages::exposure, "factor of the recorded exposure, one texel"},
    {"display", &FrameImages::display, "the picture after exposure and tone curve", Content::display},
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

float sample_near(const FrameImages& images) {
    const bool are_at_sample = images.samples == 1 || has(images.capabilities, Capability::sample_varyings);
    return are_at_sample ? 0.f : images.recorded->view.near;
}

std::uint32_t tells_helpers(const FrameImages& images) {
    return has(images.capabilities, Capability::helper_invocations) ? 1u : 0u;
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
