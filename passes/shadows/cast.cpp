// Draws the casters into shadow maps.
#include "passes/shadows/cast.h"

#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/fill_coverage.h"
#include "passes/graph/graph.h"
#include "passes/scene/map_places.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"
#include "passes/shadows/shadows.shared.h"

namespace strata {
namespace {

/// The mode of passes/gbuffer/coverage/coverage.shared.h that cast.frag is compiled for.
uint mode_of(CasterMask mask) {
    if (mask == CasterMask::mip_coverage) return gbuffer::masked_mip_coverage;
    return mask == CasterMask::dither ? gbuffer::masked_dithered : gbuffer::masked_clip;
}

}  // namespace

void cast_maps(Graph& graph, FrameImages& frame, Allocation allocation, CasterMask mask) {
    const std::vector<ShadowView>& views = frame.facts->shadow_views(allocation);
    if (views.empty()) return;
    const MapLayers in = map_layers(views);
    const auto count = static_cast<std::uint32_t>(views.size());
    frame.shadow_maps =
        graph.create("shadow_maps", {.extent = {in.extent, in.extent}, .format = Format::d32f, .layers = in.layers});
    graph.clear(frame.shadow_maps, {});
    const gbuffer::Coverage coverage = gbuffer::declare_coverage_of_texels(graph, frame, mode_of(mask));
    for (std::uint32_t slot = 0; slot < count; ++slot) {
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
