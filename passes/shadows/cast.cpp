// Draws the casters into shadow maps.
#include "passes/shadows/cast.h"

#include <vector>

#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/fill_coverage.h"
#include "passes/graph/graph.h"
#include "passes/scene/map_places.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/readers.h"
#include "passes/scene/scene_facts.h"
#include "passes/scene/view_space.h"
#include "passes/shadows/shadows.shared.h"
#include "passes/stages.h"

namespace strata {
namespace {

/// The mode of passes/gbuffer/coverage/coverage.shared.h that cast.frag is compiled for.
uint mode_of(CasterMask mask) {
    if (mask == CasterMask::mip_coverage) return gbuffer::masked_mip_coverage;
    return mask == CasterMask::dither ? gbuffer::masked_dithered : gbuffer::masked_clip;
}

/// The readers of a map are surfaces in its light's reach, and the air that shafts of the sun cross.
bool is_read(const FrameImages& frame, const ShadowView& view) {
    const Light& light = frame.facts->lights()[view.light];
    const Readers& readers = frame.facts->readers();
    if (has_range(light.type))
        return readers.has_surfaces_in(
            {in_view_space(frame.recorded->view, light.position), double(light.range + light.source_radius)});
    const bool is_read_by_air = !info(Stage::sun_shafts).unwanted(*frame.features);
    return is_read_by_air || readers.has_surfaces_between(view.read_from, view.range_end);
}

Product product_of(const FrameImages& frame, const ShadowView& view, std::uint32_t slot) {
    const Light& light = frame.facts->lights()[view.light];
    const bool has_end = has_range(light.type);
    return {.name = fmt::format("shadow map {} of {}", slot, has_end ? "'" + light.name + "'" : "the sun"),
            .is_used = is_read(frame, view),
            .unused_because = fmt::format("no surface in view is in {}", has_end ? "the light's range" : "its range of depth")};
}

}  // namespace

std::vector<ShadowView> drawn_views(const FrameImages& frame, Allocation allocation) {
    std::vector<ShadowView> drawn = frame.facts->shadow_views(allocation);
    if (!frame.makes_unused) std::erase_if(drawn, [&](const ShadowView& view) { return !is_read(frame, view); });
    return drawn;
}

void cast_maps(Graph& graph, FrameImages& frame, Allocation allocation, CasterMask mask) {
    const std::vector<ShadowView>& views = frame.facts->shadow_views(allocation);
    if (views.empty()) return;
    const MapLayers in = map_layers(views);
    const auto count = static_cast<std::uint32_t>(views.size());
    const std::vector<std::uint32_t> used =
        used_products(graph, frame, count, [&](std::uint32_t slot) { return product_of(frame, views[slot], slot); });
    frame.shadow_maps =
        graph.create("shadow_maps", {.extent = {in.extent, in.extent}, .format = Format::d32f, .layers = in.layers});
    graph.clear(frame.shadow_maps, {});
    const gbuffer::Coverage coverage = gbuffer::declare_coverage_of_texels(graph, frame, mode_of(mask));
    for (const std::uint32_t slot : used) {
        const bool is_alone = allocation == Allocation::own;
        const std::uint32_t viewport = is_alone ? views[slot].size : in.extent;
        DrawStep cast = graph.draw("shadows/cast", frame.casters);
        fix_materials(cast, frame, Surfaces::opaque)
            .writes_depth(frame.shadow_maps, {.layer = views[slot].layer})
            .within({viewport, viewport})
            .push(CastPush{.record = slot + (is_alone ? 0 : count), .viewport = viewport});
        gbuffer::add_coverage(cast, coverage);
    }
}

}  // namespace strata
