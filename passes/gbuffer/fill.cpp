#include "passes/gbuffer/fill.h"

#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/fill_coverage.h"
#include "passes/gbuffer/fill_params.h"
#include "passes/gbuffer/layout.shared.h"
#include "passes/gbuffer/surfaces.h"
#include "passes/graph/graph.h"
#include "passes/registry.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"

namespace strata::gbuffer {
namespace {

constexpr auto attribute_places = choice_names({{attributes_at_center, "center"}, {attributes_at_sample, "sample"}});

/// A cleared raster target. At one sample it is the layered image itself and has its name.
Image target(Graph& graph, const FrameImages& frame, std::string_view name, Format format) {
    const std::string raster_name = frame.samples > 1 ? std::string(name) + " samples" : std::string(name);
    Image image = graph.create(raster_name, {.extent = frame.extent, .format = format, .samples = frame.samples});
    graph.clear(image, {});
    return image;
}

Image empty_depth(Graph& graph, const FrameImages& frame) {
    Image depth = graph.create("depth", {.extent = frame.extent, .format = Format::d32f, .samples = frame.samples});
    graph.clear(depth, {});
    return depth;
}

/// Takes what was in depth before the draws out of it again.
void leave_surfaces(Graph& graph, FrameImages& frame) {
    const Image drawn = spread(graph, frame.depth, "depth drawn into, by sample");
    frame.depth = empty_depth(graph, frame);
    graph.fullscreen("gbuffer/surface_depth")
        .samples("drawn_depth", drawn)
        .samples("emission", frame.emission)
        .writes_depth(frame.depth);
}

/// Whether attributes are shaded sample by sample. One sample is the pixel's center.
bool shades_samples(const FrameImages& frame, const FillParams& params) {
    return params.attributes == attributes_at_sample && frame.samples > 1;
}

/// What readers must know.
std::uint32_t layout_number(const FrameImages& frame, const Layout& layout, const FillParams& params) {
    std::uint32_t number = index_in_stage(**find_technique(layout.technique));
    if (shades_samples(frame, params)) number |= layout_shaded_at_sample;
    if (layout.depth == DepthFrom::depth_buffer) number |= layout_reads_depth;
    return number | params.masked << layout_masked_shift;
}

/// The draw into the targets; in front of it, of two passes, the one into depth.
DrawStep fill_pass(Graph& graph, FrameImages& frame, const Layout& layout, const FillParams& params) {
    const bool at_sample = shades_samples(frame, params);
    const Coverage coverage = declare_coverage(graph, frame, params.masked, at_sample ? ShadingRate::sample : ShadingRate::pixel);
    const bool has_depth = coverage.mode == masked_hardware;
    if (has_depth) draw_depth_by_alpha(graph, frame);
    DrawStep fill = graph.draw(fmt::format("{}/fill{}", layout.technique, at_sample ? "_sample" : ""), frame.opaque);
    fix_materials(fill, frame, Surfaces::opaque);
    add_coverage(fill, coverage);
    if (at_sample) fill.fixes("sample_near", sample_near(frame));
    // The shader discards backs draw by draw: the same pixels, shaded in vain.
    if (shows_no_backs(*frame.recorded, frame.facts->lists().opaque)) fill.culls(Cull::back);
    if (has_depth) fill.tests_depth(frame.depth).at_equal_depth();
    else fill.writes_depth(frame.depth);
    return fill;
}

}  // namespace

std::vector<Param> fill_params() {
    return {param<&FillParams::attributes>({.name = "attributes",
                                            .low = 0,
                                            .high = attributes_at_sample,
                                            .fallback = attributes_at_center,
                                            .help = "where attributes are evaluated: once at the pixel's center, or at each "
                                                    "sample (exact at edges, one shader run per sample)",
                                            .choices = attribute_places}),
            masked_param()};
}

void add_fill(Graph& graph, FrameImages& frame, const Layout& layout, const Settings& settings) {
    const auto params = settings.as<FillParams>();
    const bool has_third = layout.targets.size() > 2;
    Image gbuffer0 = target(graph, frame, "gbuffer0", layout.targets[0]);
    Image gbuffer1 = target(graph, frame, "gbuffer1", layout.targets[1]);
    Image gbuffer2 = has_third ? target(graph, frame, "gbuffer2", layout.targets[2]) : Image{};
    Image emission = target(graph, frame, "emission", Format::rgba16f);
    const bool begins_empty = !frame.depth;
    if (begins_empty) frame.depth = empty_depth(graph, frame);
    if (frame.opaque.count > 0) {
        DrawStep fill = fill_pass(graph, frame, layout, params);
        fill.covers(gbuffer0).covers(gbuffer1).covers(emission);
        if (has_third) fill.covers(gbuffer2);
    }
    frame.gbuffer0 = spread(graph, gbuffer0, "gbuffer0");
    frame.gbuffer1 = spread(graph, gbuffer1, "gbuffer1");
    if (has_third) frame.gbuffer2 = spread(graph, gbuffer2, "gbuffer2");
    frame.emission = spread(graph, emission, "emission");
    if (!begins_empty) leave_surfaces(graph, frame);
    frame.depth_layers = spread(graph, frame.depth, "depth_layers");
    frame.gbuffer_layout = layout_number(frame, layout, params);
    add_surfaces(graph, frame);
}

}  // namespace strata::gbuffer
