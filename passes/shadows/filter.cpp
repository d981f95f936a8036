// Looks shadow maps up.
#include "passes/shadows/filter.h"

#include <algorithm>

#include "passes/choice_names.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/scene/map_places.h"
#include "passes/scene/scene_facts.h"
#include "passes/shadows/cast.h"
#include "passes/shadows/shadows.shared.h"

namespace strata {

namespace {

constexpr std::string_view kernels[] = {"2x2", "4x4", "8x8"};
constexpr auto allocations = choice_names({{std::uint32_t(Allocation::own), "own"}, {std::uint32_t(Allocation::need), "need"}});
constexpr auto caster_masks = choice_names({{std::uint32_t(CasterMask::clip), "clip"},
                                            {std::uint32_t(CasterMask::mip_coverage), "mip_coverage"},
                                            {std::uint32_t(CasterMask::dither), "dither"}});

Allocation allocation_of(const ShadowFilter& filter) { return static_cast<Allocation>(filter.allocation); }

/// Texels in units of 1024, rounded up: texels themselves would leave 32 bits at 64 maps of 8192 x 8192.
std::uint32_t kilotexels(std::uint64_t texels) { return static_cast<std::uint32_t>((texels + 1023) / 1024); }

AtlasPush atlas_push(const FrameImages& frame) {
    const std::vector<ShadowView>& views = frame.facts->shadow_views(allocation_of(frame.shadow_filter));
    const MapLayers in = map_layers(views);
    const bool is_alone = allocation_of(frame.shadow_filter) == Allocation::own;
    return {.first = is_alone ? 0 : static_cast<std::uint32_t>(views.size()), .extent = in.extent, .layers = in.layers};
}

Image atlas_view(Graph& graph, FrameImages& frame, const Settings&) {
    Image picture = graph.create("atlas", {.extent = frame.extent, .format = Format::rgba32f});
    graph.compute("shadows/atlas.comp")
        .samples("shadow_maps", frame.shadow_maps)
        .stores("picture", picture)
        .push(atlas_push(frame))
        .over(frame.extent);
    return picture;
}

Image atlas_table(Graph& graph, FrameImages& frame, const Settings&) {
    const auto rows = static_cast<std::uint32_t>(std::max<std::size_t>(frame.facts->shadow_views(Allocation::own).size(), 1));
    Image numbers = graph.create("atlas rows", {.extent = {1, rows}, .format = Format::rgba32f});
    graph.compute("shadows/atlas_table.comp").stores("numbers", numbers).push(atlas_push(frame)).over({1, rows});
    return numbers;
}

}  // namespace

void make_shadow_maps(Graph& graph, FrameImages& frame, const Settings& settings) {
    make_shadow_maps(graph, frame, settings.as<ShadowMapParams>());
}

void make_shadow_maps(Graph& graph, FrameImages& frame, const ShadowMapParams& params) {
    frame.shadow_filter = params.filter;
    cast_maps(graph, frame, allocation_of(params.filter), static_cast<CasterMask>(params.caster_mask));
}

void filter_shadow_maps(Graph& graph, FrameImages& frame, const std::string& shader) {
    if (frame.shadow_maps) filter_step(graph, frame, shader, frame.visibility);
}

ComputeStep filter_step(Graph& graph, const FrameImages& frame, const std::string& shader, Image& visibility) {
    const auto shadowed = static_cast<std::uint32_t>(shadowed_lights(frame.facts->shadow_views(Allocation::own)).size());
    const Shape maps = graph.shape(frame.shadow_maps);
    std::uint32_t drawn = 0;
    for (const DrawnMap& map : drawn_maps(frame, allocation_of(frame.shadow_filter)))
        drawn += kilotexels(std::uint64_t{map.part.columns.count} * map.part.rows.count);
    const std::uint64_t texels = std::uint64_t(maps.layers) * maps.extent.width * maps.extent.height;
    visibility = graph.create("visibility", {.extent = frame.extent, .format = Format::r16f, .layers = shadowed * frame.samples});
    ComputeStep builder = graph.compute(shader);
    fix_shadow_filter(builder, frame.shadow_filter);
    return sample_edges(sample_gbuffer(builder, frame), frame)
        .samples("shadow_maps", frame.shadow_maps)
        .samples("depth_layers", frame.depth_layers)
        .stores("visibility", visibility)
        .fixes("drawn_kilotexels", drawn)
        .fixes("layer_kilotexels", kilotexels(texels))
        .over({frame.extent.width, frame.extent.height, frame.samples});
}

ComputeStep& fix_shadow_filter(ComputeStep& builder, const ShadowFilter& filter) {
    return builder.fixes("shadow_kernel", std::int32_t(2) << filter.kernel)
        .fixes("shadow_slope_limit", filter.slope_limit)
        .fixes("shadow_allocation", filter.allocation)
        .fixes("shadow_search_taps", static_cast<std::int32_t>(filter.search_taps))
        .fixes("shadow_filter_taps", static_cast<std::int32_t>(filter.filter_taps))
        .fixes("shadow_noise", filter.noise);
}

std::vector<Param> shadow_map_params() {
    return {
        param<&ShadowFilter::kernel>(
            {.name = "kernel", .low = 0, .high = 2, .fallback = 1, .help = "texels compared per lookup", .choices = kernels}),
        param<&ShadowFilter::slope_limit>(
            {.name = "slope_limit",
             .low = 0,
             .high = 64,
             .fallback = 20,
             .help =
                 "steepest slope that the bias compensates: tangent of the angle between normal and light; 20 is 87 degrees"}),
        param<&ShadowFilter::allocation>({.name = "allocation",
                                          .low = 0,
                                          .high = 1,
                                          .fallback = 0,
                                          .help = "size of shadow maps; own: as recorded, a layer each; need: by the extent that "
                                                  "each light covers on the screen, packed",
                                          .choices = allocations}),
        param<&ShadowMapParams::caster_mask>(
            {.name = "caster_mask",
             .low = 0,
             .high = 2,
             .fallback = 0,
             .help = "how masked casters fill texels: clip tests alpha at the cutoff, mip_coverage scales it by mip, dither "
                     "fills alpha's share",
             .choices = caster_masks})};
}

std::vector<Counter> shadow_map_counters() {
    return {
        counter<&ShadowCounters::filtered>({.name = "filtered", .help = "shadow lookups, one per sample and light"}),
        counter<&ShadowCounters::penumbra>({.name = "penumbra", .help = "shadow lookups with a result between lit and shadowed"}),
        counter<&ShadowCounters::kilotexels_drawn>(
            {.name = "kilotexels_drawn", .help = "shadow map texels drawn, in units of 1024"}),
        counter<&ShadowCounters::kilotexels_allocated>(
            {.name = "kilotexels_allocated", .help = "texels of the layers that hold the maps, in units of 1024; 4 KiB each"}),
        counter<&ShadowCounters::casters_drawn>({.name = "casters_drawn", .help = "draws of casters into shadow maps"})};
}

std::vector<DebugView> shadow_map_views() {
    return {{.name = "atlas",
             .help = "the layers of the shadow maps side by side: black where no map lies, dark where nothing was drawn, "
                     "brighter towards the light",
             .unit = "",
             .low = 0,
             .high = 1,
             .declare = atlas_view}};
}

std::vector<DebugTable> shadow_map_tables() {
    return {{.name = "map_places",
             .help = "shadow maps by slot: layer, upper left texel in it, length of an edge",
             .columns = {{"layer", ""}, {"x", "texels"}, {"y", "texels"}, {"size", "texels"}},
             .declare = atlas_table}};
}

}  // namespace strata
