// Draws the casters into shadow maps.
#include "passes/shadows/cast.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/culling/draw_command.shared.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/fill_coverage.h"
#include "passes/graph/graph.h"
#include "passes/scene/map_casters.h"
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

// Texels that a lookup reads beyond the receiver's own: half of the widest fixed kernel, or the largest disc of passes/shaders/
// shadow_filter.glsl; and rounding.
constexpr std::uint32_t kernel_margin = 8, disc_margin = 40;

MapPart whole(const ShadowView& view) { return {{0, view.size}, {0, view.size}}; }

/// The readers of a map are surfaces in its light's reach, and the air that shafts of the sun cross.
std::optional<MapPart> part_of(const FrameImages& frame, const ShadowView& view) {
    const Light& light = frame.facts->lights()[view.light];
    const Readers& readers = frame.facts->readers();
    const std::uint32_t margin = view.soft ? disc_margin : kernel_margin;
    if (frame.makes_unused) return whole(view);
    if (has_range(light.type)) {
        const BoundingSphere reach{in_view_space(frame.recorded->view, light.position),
                                   double(light.range + light.source_radius)};
        return readers.has_surfaces_in(reach) ? read_part(readers, view, reach, margin) : std::nullopt;
    }
    const bool is_read_by_air = !info(Stage::sun_shafts).unwanted(*frame.features);
    return is_read_by_air ? whole(view) : read_part(readers, view, {}, margin);
}

Product product_of(const FrameImages& frame, const ShadowView& view, std::uint32_t slot, bool is_used) {
    const Light& light = frame.facts->lights()[view.light];
    const bool has_end = has_range(light.type);
    return {.name = fmt::format("shadow map {} of {}", slot, has_end ? "'" + light.name + "'" : "the sun"),
            .is_used = is_used,
            .unused_because =
                fmt::format("no surface in view is in {}", has_end ? "what it sees of the light's range" : "its range of depth")};
}

/// Draw commands of all casters for each of the maps in turn, without instances where it need not draw them.
Buffer commands_of_casters(Graph& graph, const FrameImages& frame, std::span<const DrawnMap> maps) {
    const std::uint32_t count = frame.casters.count;
    Buffer commands = graph.create("commands of casters", maps.size() * count * sizeof(DrawCommand));
    for (std::uint32_t i = 0; i < maps.size(); ++i) {
        const Light& light = frame.facts->lights()[maps[i].view.light];
        MapCastersPush push = casters_push(maps[i].view, maps[i].part, frame.casters);
        push.to = i * count;
        if (has_range(light.type)) {
            push.light = glm::vec3(in_view_space(frame.recorded->view, light.position));
            push.range = light.range + light.source_radius;
        }
        graph.compute("shadows/casters.comp")
            .loads("AllCommands", frame.casters.commands)
            .stores("Commands", commands)
            .push(push)
            .over({count});
    }
    return commands;
}

/// Lists of casters by map.
std::vector<DrawList> casters_of(Graph& graph, const FrameImages& frame, std::span<const DrawnMap> maps) {
    std::vector<DrawList> all(maps.size(), frame.casters);
    if (frame.makes_unused || all.empty() || frame.casters.count == 0) return all;
    const Buffer commands = commands_of_casters(graph, frame, maps);
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        all[i].commands = commands;
        all[i].first = i * frame.casters.count;
    }
    return all;
}

}  // namespace

std::vector<DrawnMap> drawn_maps(const FrameImages& frame, Allocation allocation) {
    const std::vector<ShadowView>& views = frame.facts->shadow_views(allocation);
    std::vector<DrawnMap> drawn;
    for (std::uint32_t slot = 0; slot < views.size(); ++slot)
        if (const auto part = part_of(frame, views[slot])) drawn.push_back({slot, views[slot], *part});
    return drawn;
}

void cast_maps(Graph& graph, FrameImages& frame, Allocation allocation, CasterMask mask) {
    const std::vector<ShadowView>& views = frame.facts->shadow_views(allocation);
    if (views.empty()) return;
    const MapLayers in = map_layers(views);
    const auto count = static_cast<std::uint32_t>(views.size());
    const std::vector<DrawnMap> drawn = drawn_maps(frame, allocation);
    used_products(graph, frame, count, [&](std::uint32_t slot) {
        return product_of(frame, views[slot], slot, std::ranges::count(drawn, slot, &DrawnMap::slot) > 0);
    });
    frame.shadow_maps =
        graph.create("shadow_maps", {.extent = {in.extent, in.extent}, .format = Format::d32f, .layers = in.layers});
    graph.clear(frame.shadow_maps, {});
    const gbuffer::Coverage coverage = gbuffer::declare_coverage_of_texels(graph, frame, mode_of(mask));
    const std::vector<DrawList> casters = casters_of(graph, frame, drawn);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const auto& [slot, view, part] = drawn[i];
        const bool is_alone = allocation == Allocation::own;
        const std::uint32_t viewport = is_alone ? view.size : in.extent;
        DrawStep cast = graph.draw("shadows/cast", casters[i]);
        fix_materials(cast, frame, Surfaces::opaque)
            .writes_depth(frame.shadow_maps, {.layer = view.layer})
            .within({viewport, viewport})
            .in_columns({view.offset.x + part.columns.first, part.columns.count})
            .in_rows({view.offset.y + part.rows.first, part.rows.count})
            .push(CastPush{.record = slot + (is_alone ? 0 : count), .viewport = viewport});
        gbuffer::add_coverage(cast, coverage);
    }
}

}  // namespace strata
