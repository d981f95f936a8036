#include "passes/lighting/tiled/views.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/lighting/tiled/culling.h"
#include "passes/lighting/tiled/views.shared.h"
#include "passes/scene/scene_facts.h"
#include "passes/settings.h"
#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {
namespace {

// The least that a device of the baseline has (maxImageDimension2D).
constexpr std::uint32_t most_rows = 4096;

/// A table is an image one texel wide.
Image numbers_of(Graph& graph, std::uint32_t rows) {
    return graph.create("tiled table", Shape{.extent = {1, rows}, .format = Format::rgba32f});
}

/// The tiles with their spectra, what other stages shade of them included.
CulledTiles tiles_with_spectra(Graph& graph, FrameImages& frame, const Settings& settings) {
    CulledTiles culled = cull_tiles(graph, frame, settings.as<TiledParams>());
    if (frame.light_grids == 0) return culled;
    sample_gbuffer(graph.compute("lighting/tiled/tap_visibility.comp"), frame)
        .samples("volume_light", frame.volume_light)
        .updates("Records", culled.records)
        .fixes("light_grids", frame.light_grids)
        .fixes("blocker_count", static_cast<std::uint32_t>(frame.recorded->blockers.size()))
        .groups({culled.across, culled.down, 1});
    return culled;
}

Image nothing_shaded(Graph& graph, Extent extent, double value) {
    Image nothing = graph.create("tiled nothing", Shape{.extent = extent, .format = Format::rgba32f});
    graph.clear(nothing, {{value, value, value, 1}});
    return nothing;
}

template <std::uint32_t shown>
Image picture(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0)
        return nothing_shaded(graph, frame.extent, shown == view_mode_numbers || shown == view_spectrum ? -1 : 0);
    const CulledTiles culled = shown == view_spectrum || shown == view_features
                                   ? tiles_with_spectra(graph, frame, settings)
                                   : cull_tiles(graph, frame, settings.as<TiledParams>());
    Image picture = graph.create("tiled view", Shape{.extent = frame.extent, .format = Format::rgba32f});
    graph.compute("lighting/tiled/view.comp")
        .loads("Records", culled.records)
        .loads("Statistics", culled.statistics)
        .stores("picture", picture)
        .fixes("shown", shown)
        .push(culled.order)
        .over(frame.extent);
    return picture;
}

/// No row where nothing is opaque.
Image no_rows(Graph& graph) { return nothing_shaded(graph, {1, 1}, NAN); }

Image spectra_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return no_rows(graph);
    const CulledTiles culled = tiles_with_spectra(graph, frame, settings);
    Buffer histogram = graph.create("tiled histogram", 65536 * sizeof(std::uint32_t));
    graph.clear(histogram, 0);
    graph.compute("lighting/tiled/spectra_count.comp")
        .loads("Records", culled.records)
        .updates("Histogram", histogram)
        .fixes("tile_count", culled.count())
        .push(culled.order)
        .over({culled.count()});
    Image numbers = numbers_of(graph, std::min(culled.count(), most_rows));
    graph.clear(numbers, {{NAN, NAN, NAN, NAN}});
    graph.compute("lighting/tiled/spectra_table.comp")
        .loads("Histogram", histogram)
        .updates("numbers", numbers)
        .push(culled.order)
        .over({every_light_feature + 1});
    return numbers;
}

Image mode_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return no_rows(graph);
    const CulledTiles culled = cull_tiles(graph, frame, settings.as<TiledParams>());
    Image numbers = numbers_of(graph, culled.order.count);
    graph.compute("lighting/tiled/mode_table.comp")
        .loads("Dispatches", culled.dispatches)
        .stores("numbers", numbers)
        .push(culled.order)
        .over({1, culled.order.count});
    return numbers;
}

template <std::uint32_t shown>
Image list_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return no_rows(graph);
    const CulledTiles culled = cull_tiles(graph, frame, settings.as<TiledParams>());
    const auto lights = static_cast<std::uint32_t>(std::clamp<std::size_t>(frame.facts->lights().size(), 1, most_listed));
    const std::uint32_t rows_per_tile = std::clamp(most_rows / culled.count(), 1u, lights);
    Image numbers = numbers_of(graph, std::min(culled.count() * rows_per_tile, most_rows));
    graph.compute("lighting/tiled/list_table.comp")
        .loads("Records", culled.records)
        .stores("numbers", numbers)
        .fixes("shown", shown)
        .fixes("rows_per_tile", rows_per_tile)
        .over({graph.shape(numbers).extent.height});
    return numbers;
}

std::vector<ViewColor> mode_colors() {
    std::vector<ViewColor> colors = {{glm::vec3(0), "nothing is shaded"}};
    for (std::uint32_t mode = 0; mode < most_modes; ++mode)
        colors.push_back(
            {{mode_channel(mode, most_modes, 0), mode_channel(mode, most_modes, 1), mode_channel(mode, most_modes, 2)},
             fmt::format("mode {}", mode)});
    return colors;
}

}  // namespace

std::vector<DebugView> tiled_views() {
    return {
        {"tile modes",
         "a color for the shading mode of each tile; black where nothing is shaded",
         "",
         0,
         1,
         picture<view_modes>,
         {},
         mode_colors()},
        {"LDS occupancy",
         "fill of a tile's lists in shared memory; red: lights, of 64; green: (light, blocker) pairs, of 256; blue: (light, "
         "portal) pairs, of 256",
         "",
         0,
         1,
         picture<view_lists>,
         {"lights, of 64", "(light, blocker) pairs, of 256", "(light, portal) pairs, of 256"}},
        {"LDS bytes", "bytes of shared memory that a tile's lists, pairs and masks use, of 2048", "bytes", 0, 2048,
         picture<view_bytes>},
        {"overflow",
         "red: more than 64 lights; green: more than 256 (light, blocker) pairs; blue: more than 256 (light, portal) pairs, "
         "in total and not per pixel",
         "",
         0,
         1,
         picture<view_overflow>,
         {"more than 64 lights", "more than 256 (light, blocker) pairs", "more than 256 (light, portal) pairs"},
         {},
         "no tile overflows"},
        {"tile lights",
         "red: lights shaded; green: lights that reach the tile if blockers are ignored; yellow: blockers kill none",
         "lights",
         0,
         64,
         picture<view_lights>,
         {"lights that are shaded", "lights that reach the tile if blockers are ignored"}},
        {"pixel tests",
         "(light, blocker) pairs that every pixel of the tile tests, because the blocker's shadow has an edge in it", "pairs", 0,
         16, picture<view_pixel_tests>},
        {"culled lights",
         "red: lights killed by a blocker; green: candidates that do not reach the tile",
         "lights",
         0,
         64,
         picture<view_culled>,
         {"lights killed by a blocker", "candidates that do not reach the tile"},
         {},
         "no light is culled"},
        {"tile features", "bits of the tile's feature spectrum", "bits", 0, 16, picture<view_features>},
        {"mode numbers", "number of the shading mode of each tile, as the table of modes has it; -1 where nothing is shaded", "",
         -1, 16, picture<view_mode_numbers>},
        {"spectrum", "each tile's feature spectrum as a number, as the table of spectra has it; -1 where nothing is shaded", "",
         -1, every_light_feature, picture<view_spectrum>},
    };
}

std::vector<DebugTable> tiled_tables() {
    return {
        {.name = "spectra",
         .help = "feature spectra, most tiles first: bits of light_features.shared.h, tiles, mode that shades them, features of "
                 "the mode they do not need",
         .columns = {{"spectrum", "bits"}, {"tiles", ""}, {"mode", ""}, {"superfluous", "bits"}},
         .declare = spectra_table},
        {.name = "modes",
         .help = "shading modes this frame may need, cheapest first: number, features, tiles",
         .columns = {{"mode", ""}, {"features", "bits"}, {"tiles", ""}},
         .declare = mode_table},
        {.name = "lists",
         .help = "lights of each tile, and which of a light's 32 blockers the tile's pixels test; cut where a tile has too many",
         .columns = {{"tile", ""}, {"light", ""}, {"blockers 0 to 15", "bits"}, {"blockers 16 to 31", "bits"}},
         .tile = tile_size,
         .declare = list_table<list_blockers>},
        {.name = "portals",
         .help = "lights of each tile, and which of a light's 32 portals the tile's pixels test; cut where a tile has too many",
         .columns = {{"tile", ""}, {"light", ""}, {"portals 0 to 15", "bits"}, {"portals 16 to 31", "bits"}},
         .tile = tile_size,
         .declare = list_table<list_portals>},
    };
}

}  // namespace strata::lighting
