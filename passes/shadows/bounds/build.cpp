// Bounds of shadow maps.
#include "passes/shadows/bounds/build.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <numeric>
#include <string>
#include <vector>

#include "passes/graph/graph.h"
#include "passes/shadows/bounds/bounds.shared.h"

namespace strata {

namespace {

struct Wanted {
    const Image& maps;
    std::vector<BoundsPush> pushes;  ///< of the maps that are as large as a block
    BoundsSettings settings;
};

std::vector<BoundsPush> pushes_of(std::span<const ShadowView> views, std::uint32_t block) {
    std::vector<BoundsPush> pushes;
    for (const ShadowView& view : views) {
        if (view.size < block) continue;
        // A light with perspective maps has one, or a cube's six.
        const bool is_perspective = glm::dvec3(glm::transpose(view.view_to_map)[3]) != glm::dvec3(0);
        const bool is_face = is_perspective && std::ranges::count(views, view.light, &ShadowView::light) > 1;
        pushes.push_back({.offset = view.offset, .layer = view.layer, .size = view.size, .is_face = is_face ? 1u : 0u});
    }
    return pushes;
}

std::uint32_t blocks(std::uint32_t texels, std::uint32_t block) { return (texels + block - 1) / block; }

struct Blocks {
    std::string name;
    std::uint32_t block;
    Format format;
};

Image create_blocks(Graph& graph, const Wanted& work, const Blocks& what) {
    const Shape maps = graph.shape(work.maps);
    const Extent extent{blocks(maps.extent.width, what.block), blocks(maps.extent.height, what.block)};
    Image image = graph.create(what.name, {.extent = extent, .format = what.format, .layers = maps.layers});
    graph.clear(image, {});
    return image;
}

Extent block_extent(const BoundsPush& push, std::uint32_t block) { return {blocks(push.size, block), blocks(push.size, block)}; }

void add_extremes(Graph& graph, const Wanted& work, const BoundsSettings& settings, Image& bounds) {
    for (const BoundsPush& push : work.pushes) {
        ComputeStep builder = graph.compute("shadows/bounds/extremes.comp");
        fix_shadow_bounds(builder, settings)
            .samples("shadow_maps", work.maps)
            .stores("bounds", bounds)
            .push(push)
            .over(block_extent(push, settings.block));
    }
}

/// Of windows: by way of the largest blocks that both the block and the reach are made of.
Image extremes_of(Graph& graph, const Wanted& work) {
    Image bounds = create_blocks(graph, work, {bounds_name(work.settings), work.settings.block, Format::rg32f});
    const std::uint32_t part = std::gcd(work.settings.block, work.settings.reach);
    if (work.settings.reach == 0 || part == 1) {
        add_extremes(graph, work, work.settings, bounds);
        return bounds;
    }
    Image parts = create_blocks(graph, work, {"parts of shadow_bounds", part, Format::rg32f});
    add_extremes(graph, work, {.block = part, .reach = 0}, parts);
    for (const BoundsPush& push : work.pushes) {
        ComputeStep builder = graph.compute("shadows/bounds/join.comp");
        fix_shadow_bounds(builder, work.settings)
            .samples("parts", parts)
            .stores("bounds", bounds)
            .fixes("part", static_cast<std::int32_t>(part))
            .push(push)
            .over(block_extent(push, work.settings.block));
    }
    return bounds;
}

/// Levels side by side: of an image of 2 h texels per edge the first is h wide, the second h / 2, and so on.
Image levels_of(Graph& graph, const Wanted& work) {
    const Shape maps = graph.shape(work.maps);
    const std::uint32_t block = work.settings.block;
    const std::uint32_t texels = block * blocks(std::max(maps.extent.width, maps.extent.height), block);
    const Extent extent{texels - texels / block, texels / 2};
    Image bounds = graph.create(bounds_name(work.settings), {.extent = extent, .format = Format::rg32f, .layers = maps.layers});
    graph.clear(bounds, {});
    add_extremes(graph, work, {.block = 2, .reach = 0}, bounds);
    for (std::uint32_t level = 2; 1u << level <= block; ++level) {
        for (const BoundsPush& push : work.pushes) {
            graph.compute("shadows/bounds/halve.comp")
                .updates("bounds", bounds)
                .fixes("level", static_cast<std::int32_t>(level))
                .push(push)
                .over(block_extent(push, 1u << level));
        }
    }
    return bounds;
}

Image slabs_of(Graph& graph, const Wanted& work) {
    Image bounds = create_blocks(graph, work, {bounds_name(work.settings), work.settings.block, Format::rgba32f});
    for (const BoundsPush& push : work.pushes) {
        ComputeStep builder = graph.compute("shadows/bounds/slabs.comp");
        fix_shadow_bounds(builder, work.settings)
            .samples("shadow_maps", work.maps)
            .stores("bounds", bounds)
            .fixes("planes_only", work.settings.form == BoundsForm::planes ? 1u : 0u)
            .fixes("tolerance", plane_tolerance)
            .push(push)
            .over(block_extent(push, work.settings.block));
    }
    return bounds;
}

}  // namespace

Image add_shadow_bounds(Graph& graph, const Image& shadow_maps, std::span<const ShadowView> views,
                        const BoundsSettings& settings) {
    assert(settings.block >= 2 && settings.block <= 8 && std::has_single_bit(settings.block));
    const Wanted work{shadow_maps, pushes_of(views, settings.block), settings};
    if (settings.form == BoundsForm::extremes) return extremes_of(graph, work);
    return settings.form == BoundsForm::levels ? levels_of(graph, work) : slabs_of(graph, work);
}

std::string bounds_name(const BoundsSettings& settings) {
    constexpr std::array forms = {"extremes", "levels", "slabs", "planes"};
    return std::string("shadow_bounds ") + forms[static_cast<std::size_t>(settings.form)] + " block " +
           std::to_string(settings.block) + " reach " + std::to_string(settings.reach);
}

bool are_bounds(const Graph& graph, const Image& image, const BoundsSettings& settings) {
    return image && graph.record(image).name == bounds_name(settings);
}

ComputeStep& fix_shadow_bounds(ComputeStep& builder, const BoundsSettings& settings) {
    return builder.fixes("bounds_block", static_cast<std::int32_t>(settings.block))
        .fixes("bounds_reach", static_cast<std::int32_t>(settings.reach));
}

}  // namespace strata
