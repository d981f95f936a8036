#include "passes/lighting/z_binned/z_bins.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/scene/scene_facts.h"

namespace strata::lighting {
namespace {

std::uint32_t bin_of(const ZHeader& header, const ZBinsPush& push, float z) {
    const float way = push.spacing == spacing_logarithmic ? std::log(std::max(z, header.near) / header.near) : z - header.near;
    return static_cast<std::uint32_t>(std::clamp(way * header.scale, 0.0f, float(push.bins - 1)));
}

ZBinsPush push_of(const FrameImages& frame, const ZBinnedParams& params) {
    const auto lights = static_cast<uint>(frame.facts->lights().size());
    const uint tile_size = 8u << params.tile;
    return {.lights = lights,
            .padded = std::bit_ceil(std::max(lights, 2u)),
            .words = (lights + 31) / 32,
            .bins = params.bins,
            .spacing = params.spacing,
            .tile_size = tile_size,
            .tiles_across = (frame.extent.width + tile_size - 1) / tile_size};
}

}  // namespace

ZBins z_bins(Graph& graph, const FrameImages& frame, const ZBinnedParams& params) {
    ZBins made{.push = push_of(frame, params)};
    const Extent tiles{made.push.tiles_across, (frame.extent.height + made.push.tile_size - 1) / made.push.tile_size};
    made.sorted = graph.create("z-sorted lights", made.push.padded * sizeof(ZLight));
    made.header = graph.create("z-bin header", sizeof(ZHeader));
    made.bins = graph.create("z-bins", made.push.bins * sizeof(uint));
    made.masks = graph.create("tile masks", std::uint64_t(tiles.width) * tiles.height * made.push.words * sizeof(uint));
    graph.compute("lighting/z_binned/keys.comp").stores("Sorted", made.sorted).push(made.push).over({made.push.padded});
    graph.compute("lighting/z_binned/sort.comp")
        .updates("Sorted", made.sorted)
        .stores("Header", made.header)
        .push(made.push)
        .groups({1});
    graph.compute("lighting/z_binned/bins.comp")
        .loads("Sorted", made.sorted)
        .loads("Header", made.header)
        .stores("Bins", made.bins)
        .push(made.push)
        .over({made.push.bins});
    sample_gbuffer(graph.compute("lighting/z_binned/tile_masks.comp"), frame)
        .loads("Sorted", made.sorted)
        .loads("Header", made.header)
        .stores("Masks", made.masks)
        .fixes("bounds", params.bounds)
        .push(made.push)
        .groups(tiles);
    return made;
}

std::vector<BinRange> mirror_bins(std::span<const DepthReach> sorted, const ZHeader& header, const ZBinsPush& push) {
    std::vector<BinRange> bins(push.bins);
    for (std::uint32_t light = header.everywhere; light < sorted.size(); ++light) {
        const std::uint32_t from = bin_of(header, push, sorted[light].nearest), to = bin_of(header, push, sorted[light].farthest);
        for (std::uint32_t bin = from; bin <= to; ++bin) {
            bins[bin].low = std::min(bins[bin].low, light);
            bins[bin].high = std::max(bins[bin].high, light);
        }
    }
    return bins;
}

}  // namespace strata::lighting
