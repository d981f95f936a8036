// Draws the casters into shadow maps.
#include "passes/shadows/cast.h"

#include <numeric>
#include <span>
#include <utility>
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

/// Readers of a map: surfaces in its light's reach, and the air that shafts of the sun cross.
Product product_of(const FrameImages& frame, std::span<const ShadowView> views, std::uint32_t slot) {
    const ShadowView& view = views[slot];
    const Light& light = frame.facts->lights()[view.light];
    const Readers& readers = frame.facts->readers();
    if (has_range(light.type)) {
        const BoundingSphere reached{in_view_space(frame.recorded->view, light.position),
                                     double(light.range + light.source_radius)};
        return {.name = fmt::format("shadow map {} of '{}'", slot, light.name),
                .is_used = readers.has_surfaces_in(reached),
                .unused_because = "no surface in view is in the light's range"};
    }
    const bool is_read_by_air = !info(Stage::sun_shafts).unwanted(*frame.features);
    return {.name = fmt::format("shadow map {} of the sun", slot),
            .is_used = is_read_by_air || readers.has_surfaces_between(view.read_from, view.range_end),
            .unused_because = "no surface in view is in its range of depth"};
}

}  // namespace

std::vector<ShadowView> drawn_views(const FrameImages& frame, Allocation allocation) {
    const std::vector<ShadowView>& views = frame.facts->shadow_views(allocation);
    std::vector<ShadowView> drawn;
    for (std::uint32_t slot = 0; slot < views.size(); ++slot)
        if (frame.makes_unused || product_of(frame, views, slot).is_used) drawn.push_back(views[slot]);
    return drawn;
}

void cast_maps(Graph& graph, FrameImages& frame, Allocation allocation, CasterMask mask) {
    const std::vector<ShadowView>& views = frame.facts->shadow_views(allocation);
    if (views.empty()) return;
    const MapLayers in = map_layers(views);
    const auto count = static_cast<std::uint32_t>(views.size());
    std::vector<std::uint32_t> slots(count);
    std::iota(slots.begin(), slots.end(), 0u);
    slots = used_products(graph, frame, std::move(slots), [&](std::uint32_t slot) { return product_of(frame, views, slot); });
    frame.shadow_maps =
        graph.create("shadow_maps", {.extent = {in.extent, in.extent}, .format = Format::d32f, .layers = in.layers});
    graph.clear(frame.shadow_maps, {});
    const gbuffer::Coverage coverage = gbuffer::declare_coverage_of_texels(graph, frame, mode_of(mask));
    for (const std::uint32_t slot : slots) {
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
