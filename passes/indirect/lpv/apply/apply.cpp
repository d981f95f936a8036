#include "passes/indirect/lpv/apply/apply.h"

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"

namespace strata::indirect {
namespace {

/// Meters over which a grid fades at its border: a cell, of cascades two.
float border(const LightGrid& grid) { return float((grid.is_local ? 1 : 2) * grid.cell); }

std::uint32_t words_of(const FrameImages& frame) {
    return static_cast<std::uint32_t>((frame.recorded->blockers.size() + 31) / 32);
}

glm::uvec3 macro_extent(const DeviceGrid& grid) { return (grid.grid.cells + macro_side - 1u) / macro_side; }

/// Of all lists of blockers near macro-cells, as many along z as a list takes.
Extent list_texels(const FrameImages& frame, const DeviceGrid& grid) {
    const glm::uvec3 cells = macro_extent(grid);
    return {cells.x, cells.y, cells.z * ((words_of(frame) + list_words_per_texel - 1) / list_words_per_texel)};
}

std::uint32_t rows_of(std::uint64_t texels) {
    return static_cast<std::uint32_t>((texels + volume_texels_per_row - 1) / volume_texels_per_row);
}

/// A texel for each 2 x 2 pixels.
Extent half_extent(const FrameImages& frame) { return {(frame.extent.width + 1) / 2, (frame.extent.height + 1) / 2}; }

/// Of each 2 x 2 pixels the one that reads cells.
Image chosen_pixels(Graph& graph, const FrameImages& frame) {
    Image chosen = graph.create("pixels that read cells", {.extent = half_extent(frame), .format = Format::r8ui});
    sample_gbuffer(graph.compute("indirect/lpv/apply/choose_pixels.comp"), frame)
        .stores("chosen_pixels", chosen)
        .over(half_extent(frame));
    return chosen;
}

}  // namespace

std::uint32_t asks_taps(const LpvParams& params, const DeviceGrid& grid) {
    return grid.has_links && params.taps == taps_visible ? 1 : 0;
}

ApplyPush apply_push(const DeviceGrid& grid) {
    return {.grid = grid.place, .border = border(grid.grid), .number = static_cast<std::uint32_t>(grid.number + 1)};
}

void find_macro_cells(Graph& graph, const FrameImages& frame, const LpvParams& params, DeviceGrid& grid) {
    if (asks_taps(params, grid) == 0 || params.macro_cells == 0) return;
    const std::uint32_t words = words_of(frame);
    const glm::uvec3 cells = macro_extent(grid);
    grid.macro_cells = graph.create(grid.name("macro-cells of grid"),
                                    std::uint64_t{cells.x} * cells.y * cells.z * words * sizeof(std::uint32_t));
    graph.compute("indirect/lpv/apply/macro_cells.comp")
        .stores("MacroCells", grid.macro_cells)
        .fixes("blocker_count", static_cast<std::uint32_t>(frame.recorded->blockers.size()))
        .fixes("reading", params.reading)
        .push(grid.place)
        .over({cells.x, cells.y, cells.z * words});
}

ComputeStep see_light(ComputeStep builder, const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid) {
    return sample_gbuffer(bind_taps(builder, frame, params, grid), frame).push(apply_push(grid));
}

namespace {

/// What a grid gives at the chosen pixels.
Image block_light(Graph& graph, const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid, const Image& chosen) {
    Image light = graph.create(grid.name("half-resolution light of grid"), {.extent = half_extent(frame)});
    see_light(graph.compute("indirect/lpv/apply/read_blocks.comp"), frame, params, grid)
        .samples("chosen_pixels", chosen)
        .stores("block_light", light)
        .fixes("irradiance", params.irradiance)
        .fixes("damping", params.damping)
        .over(half_extent(frame));
    return light;
}

/// Tiles of 8 x 8 pixels: the first list of those near no blocker, the second of the others.
struct TileLists {
    Buffer dispatches, tiles;
    explicit operator bool() const { return bool(tiles); }
};

TileLists classify_tiles(Graph& graph, const FrameImages& frame, const LpvParams& params, const DeviceGrid& grid) {
    if (!grid.macro_cells || params.tap_tiles == 0) return {};
    const std::uint64_t count = std::uint64_t{(frame.extent.width + 7) / 8} * ((frame.extent.height + 7) / 8);
    TileLists lists{.dispatches = graph.create(grid.name("dispatches over tiles of grid"), 2 * sizeof(TileDispatch)),
                    .tiles = graph.create(grid.name("tiles by near blockers of grid"), 2 * count * sizeof(std::uint32_t))};
    graph.clear(lists.dispatches, 0);
    sample_gbuffer(graph.compute("indirect/lpv/apply/classify_tiles.comp"), frame)
        .loads("MacroCells", grid.macro_cells)
        .updates("Dispatches", lists.dispatches)
        .stores("Tiles", lists.tiles)
        .fixes("has_macro_cells", 1u)
        .fixes("blocker_count", static_cast<std::uint32_t>(frame.recorded->blockers.size()))
        .fixes("damping", params.damping)
        .fixes("reading", params.reading)
        .push(apply_push(grid))
        .over(frame.extent);
    return lists;
}

/// What all steps that light samples read.
struct Readings {
    const FrameImages& frame;
    const LpvParams& params;
    Image chosen;  ///< none at full resolution
};

ComputeStep light_samples(Graph& graph, const Readings& readings, const DeviceGrid& grid, const TileLists& lists) {
    const auto& [frame, params, chosen] = readings;
    return sample_edges(see_light(graph.compute("indirect/lpv/apply/apply.comp"), frame, params, grid), frame)
        .samples("chosen_pixels", chosen)
        .loads("Dispatches", lists ? lists.dispatches : grid.total)
        .loads("Tiles", lists ? lists.tiles : grid.total)
        .fixes("has_lists", lists ? 1u : 0u)
        .fixes("irradiance", params.irradiance)
        .fixes("damping", params.damping)
        .fixes("resolution", params.apply_resolution);
}

void apply_grid(Graph& graph, const Readings& readings, const DeviceGrid& grid, Image& light) {
    const FrameImages& frame = readings.frame;
    const Image blocks = readings.chosen ? block_light(graph, frame, readings.params, grid, readings.chosen) : Image();
    const TileLists lists = classify_tiles(graph, frame, readings.params, grid);
    if (!lists) {
        light_samples(graph, readings, grid, lists)
            .samples("block_light", blocks)
            .updates("indirect", light)
            .over({frame.extent.width, frame.extent.height, frame.samples});
        return;
    }
    DeviceGrid unblocked = grid;
    unblocked.has_links = false;
    unblocked.macro_cells = {};
    for (const bool asks : {false, true})
        light_samples(graph, readings, asks ? grid : unblocked, lists)
            .samples("block_light", blocks)
            .updates("indirect", light)
            .indirect(lists.dispatches, asks ? sizeof(TileDispatch) : 0);
}

}  // namespace

Image apply(Graph& graph, const FrameImages& frame, const LpvParams& params, std::span<const DeviceGrid> grids) {
    const bool is_half = params.apply_resolution == resolution_half && !grids.empty();
    const Readings readings{.frame = frame, .params = params, .chosen = is_half ? chosen_pixels(graph, frame) : Image()};
    Image light = graph.create("indirect", {.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples});
    graph.clear(light, {});
    for (auto grid = grids.rbegin(); grid != grids.rend(); ++grid) apply_grid(graph, readings, *grid, light);
    return light;
}

namespace {

/// Where things lie in volume_light.
struct VolumeLayout {
    std::vector<std::uint32_t> macro_rows = {};  ///< of grids; 0: none
    std::uint32_t rows = 0;
};

/// Records of a grid's cells: one of their light, one of the way that its sources face.
std::uint32_t cell_records(const DeviceGrid& grid) { return grid.cells() * (grid.channels / color_channels); }

VolumeLayout volume_layout(const FrameImages& frame, std::span<const DeviceGrid> grids) {
    std::uint64_t records = records_per_grid * grids.size();
    for (const DeviceGrid& grid : grids) records += cell_records(grid);
    VolumeLayout layout{.rows = rows_of(texels_per_record * records)};
    for (const DeviceGrid& grid : grids) {
        layout.macro_rows.push_back(grid.macro_cells ? layout.rows : 0);
        const Extent lists = list_texels(frame, grid);
        if (grid.macro_cells) layout.rows += rows_of(std::uint64_t{lists.width} * lists.height * lists.depth);
    }
    return layout;
}

void hand_on_macro_cells(Graph& graph, FrameImages& frame, const DeviceGrid& grid, std::uint32_t row) {
    graph.compute("indirect/lpv/apply/hand_on_macro_cells.comp")
        .loads("MacroCells", grid.macro_cells)
        .updates("volume_light", frame.volume_light)
        .fixes("blocker_count", static_cast<std::uint32_t>(frame.recorded->blockers.size()))
        .push(HandOnMacroPush{.grid = grid.place, .row = row})
        .over(list_texels(frame, grid));
}

}  // namespace

void hand_on(Graph& graph, FrameImages& frame, const LpvParams& params, std::span<const DeviceGrid> grids) {
    const auto count = static_cast<std::uint32_t>(grids.size());
    if (count == 0) return;
    const VolumeLayout layout = volume_layout(frame, grids);
    frame.light_grids = count;
    frame.light_grid_rule = params.irradiance;
    frame.volume_light =
        graph.create("volume_light", {.extent = {volume_texels_per_row, layout.rows}, .format = Format::rgba32f});
    graph.clear(frame.volume_light, {});
    std::uint32_t first_cell = records_per_grid * count;
    for (std::uint32_t i = 0; i < count; ++i) {
        const DeviceGrid& grid = grids[i];
        if (layout.macro_rows[i] > 0) hand_on_macro_cells(graph, frame, grid, layout.macro_rows[i]);
        graph.compute("indirect/lpv/apply/hand_on.comp")
            .loads("Total", grid.total)
            .updates("volume_light", frame.volume_light)
            .fixes("cell_storage", grid.storage)
            .fixes("channels", grid.channels)
            .push(HandOnPush{.grid = grid.place,
                             .border = border(grid.grid),
                             .asks_taps = asks_taps(params, grid),
                             .irradiance = params.irradiance,
                             .number = i,
                             .count = count,
                             .first_cell = first_cell,
                             .macro_row = layout.macro_rows[i],
                             .reading = params.reading})
            .over(grid.threads());
        first_cell += cell_records(grid);
    }
}

}  // namespace strata::indirect
