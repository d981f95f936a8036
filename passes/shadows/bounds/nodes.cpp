// Nodes over bounds of shadow maps.
#include "passes/shadows/bounds/nodes.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "passes/graph/graph.h"
#include "passes/shadows/bounds/bounds.shared.h"

namespace strata {

namespace {

/// Packed maps begin at multiples of their size rounded up to a power of two, so nodes of no more than that are of one map alone.
std::int32_t levels_over(std::span<const ShadowView> views, std::uint32_t block) {
    std::uint32_t smallest = std::numeric_limits<std::uint32_t>::max();
    for (const ShadowView& view : views)
        if (view.size >= block) smallest = std::min(smallest, view.size);
    if (smallest == std::numeric_limits<std::uint32_t>::max()) return 0;
    return std::min(static_cast<std::int32_t>(std::bit_width(smallest / block)) - 1, most_bounds_levels);
}

std::uint32_t divided(std::uint32_t size, std::uint32_t by) { return (size + by - 1) / by; }

}  // namespace

BoundsNodes add_bounds_nodes(Graph& graph, const Image& bounds, std::span<const ShadowView> views,
                             const BoundsSettings& settings) {
    assert(settings.form == BoundsForm::extremes);
    BoundsNodes nodes{.levels = levels_over(views, settings.block)};
    if (nodes.levels == 0) return nodes;
    const Shape shape = graph.shape(bounds);
    const std::uint32_t coarsest = 1u << nodes.levels;
    const std::uint32_t width = coarsest * divided(std::max(shape.extent.width, shape.extent.height), coarsest);
    nodes.image =
        graph.create("nodes of shadow_bounds",
                     {.extent = {width - width / coarsest, width / 2}, .format = Format::rg32f, .layers = shape.layers});
    graph.clear(nodes.image, {});
    for (std::int32_t level = 1; level <= nodes.levels; ++level) {
        for (const ShadowView& view : views) {
            if (view.size < settings.block) continue;
            const std::uint32_t edge = divided(view.size, settings.block << level);
            graph.compute("shadows/bounds/nodes.comp")
                .samples("shadow_bounds", bounds)
                .updates("nodes", nodes.image)
                .fixes("bounds_block", static_cast<std::int32_t>(settings.block))
                .fixes("level", level)
                .push(BoundsPush{.offset = view.offset, .layer = view.layer, .size = view.size, .is_face = 0})
                .over({edge, edge});
        }
    }
    return nodes;
}

ComputeStep& sample_bounds_nodes(ComputeStep& builder, const BoundsNodes& nodes) {
    return builder.samples("bounds_nodes", nodes.image).fixes("bounds_levels", nodes.levels);
}

}  // namespace strata
