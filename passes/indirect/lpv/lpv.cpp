// Light propagation volumes: what lights reach is injected into grids and handed from cell to cell.
#include <array>
#include <ranges>
#include <string_view>
#include <vector>

#include "passes/choice_names.h"
#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/indirect/lpv/ratios.h"
#include "passes/indirect/lpv/views/views.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/technique.h"

namespace strata::indirect {

ImageSet lpv_model(const StageInput&, const Settings&);

namespace {

constexpr auto propagations =
    choice_names({{propagation_linear, "linear"}, {propagation_clamped, "clamped"}, {propagation_energy_true, "energy_true"}});
constexpr auto face_rules = choice_names({{faces_centre, "centre"}, {faces_exact, "exact"}});
constexpr auto occlusions =
    choice_names({{occlusion_recorded, "recorded"}, {occlusion_none, "none"}, {occlusion_axial, "axial"}});
constexpr auto irradiances = choice_names({{irradiance_face, "face"}, {irradiance_cell, "cell"}});
constexpr auto cell_scales = choice_names({{cells_half, "1/2"}, {cells_recorded, "1"}, {cells_double, "2"}});
constexpr auto tap_rules = choice_names({{taps_all, "all"}, {taps_visible, "visible"}});

constexpr std::string_view on_borders =
    "of cells half as wide, borders lie exactly where walls inject and middles in the plane of a wall: rounding decides on "
    "which side";
constexpr std::array exceptions = {
    ToleranceException{"cell_scale=1/2", "two_rooms", 3e-2, .6, on_borders},
    ToleranceException{"cell_scale=1/2 iterations=64", "two_rooms", 3e-2, .6, on_borders},
    ToleranceException{"cell_scale=1/2 irradiance=face", "two_rooms", 3e-2, .6, on_borders},
    ToleranceException{"cell_scale=1/2 irradiance=face iterations=32", "two_rooms", 3e-2, .6, on_borders}};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<LpvParams>();
    frame.indirect = apply(graph, frame, params, lit_grids(graph, frame, params));
}

Image visible_taps(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    const std::vector<DeviceGrid> grids = lit_grids(graph, frame, params);
    Image picture = graph.create("visible taps", {.extent = frame.extent, .format = Format::rgba32f});
    graph.clear(picture, {});
    for (const DeviceGrid& grid : std::views::reverse(grids))
        see_light(graph.compute("indirect/lpv/apply/visible_taps.comp"), frame, params, grid)
            .stores("picture", picture)
            .over(frame.extent);
    return picture;
}

Image energy_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    inject_lights(graph, frame, params, grids);
    const std::uint32_t rows = grids.empty() ? 1 : iterations(params, grids.front()) + 1;
    Image numbers = graph.create("energy", {.extent = {1, rows}, .format = Format::rgba32f});
    graph.clear(numbers, {});
    if (grids.empty()) return numbers;
    DeviceGrid& grid = grids.front();
    propagate(graph, frame, params, grid, [&](std::uint32_t step, const Buffer& light) {
        fix_links(fix_faces(graph.compute("indirect/lpv/propagation/energy.comp"), params), grid)
            .loads("Before", light)
            .updates("numbers", numbers)
            .push(EnergyPush{.grid = grid.place, .step = step})
            .groups({1, 1, 1});
    });
    return numbers;
}

}  // namespace

Technique lpv() {
    return {
        .stage = Stage::indirect,
        .name = "indirect/lpv",
        .title = "Light propagation volumes",
        .source =
            "Kaplanyan, Dachsbacher: Cascaded Light Propagation Volumes for Real-Time Indirect Illumination, I3D 2010; axial "
            "occlusion and visible taps: Kircher, Rendering Technology in Agents of Mayhem, GDC 2018",
        .summary =
            "Hands light on from cell to cell of a grid. Light from farther than an eighth of the iterations, in cells, is too "
            "dark; "
            "details smaller than a cell are lost.",
        .params =
            {param<&LpvParams::iterations>(
                 {.name = "iterations", .high = 64, .fallback = 0, .help = "steps of propagation; 0: as the capture says"}),
             param<&LpvParams::propagation>(
                 {.name = "propagation",
                  .high = 2,
                  .fallback = propagation_energy_true,
                  .help =
                      "negative radiance at a face: kept, clamped to 0, or clamped and scaled so that a cell sends what it holds",
                  .choices = propagations}),
             param<&LpvParams::faces>({.name = "faces",
                                       .high = 1,
                                       .fallback = faces_centre,
                                       .help = "radiance at the center of a face, or integrated over it",
                                       .choices = face_rules}),
             param<&LpvParams::occlusion>({.name = "occlusion",
                                           .high = 2,
                                           .fallback = occlusion_recorded,
                                           .help = "what stops light between cells; axial: blockers with their portals",
                                           .choices = occlusions}),
             param<&LpvParams::taps>({.name = "taps",
                                      .high = 1,
                                      .fallback = taps_visible,
                                      .help = "cells to interpolate: all, or only those that no blocker hides from the surface",
                                      .choices = tap_rules}),
             param<&LpvParams::irradiance>({.name = "irradiance",
                                            .high = 1,
                                            .fallback = irradiance_cell,
                                            .help = "how a cell's light becomes irradiance: face, as of a light at the cell's "
                                                    "face; cell, as the mean over the cell",
                                            .choices = irradiances}),
             param<&LpvParams::map_size>({.name = "map_size",
                                          .low = 16,
                                          .high = 512,
                                          .fallback = 128,
                                          .help = "resolution of reflective shadow maps, texels per side",
                                          .scale = Scale::logarithmic}),
             param<&LpvParams::injection>({.name = "injection",
                                           .high = 1,
                                           .fallback = .5,
                                           .help = "offset of injected light along the surface's normal, cells"}),
             param<&LpvParams::cell_scale>({.name = "cell_scale",
                                            .high = 2,
                                            .fallback = cells_recorded,
                                            .help = "width of cells as a multiple of the recorded one; the extent stays, so 1/2 "
                                                    "is 8 times the cells",
                                            .choices = cell_scales})},
        .points = {"iterations=8",
                   "iterations=32",
                   "iterations=64",
                   "propagation=linear",
                   "propagation=clamped",
                   "faces=exact",
                   "occlusion=none",
                   "taps=all",
                   "occlusion=none taps=all",
                   "map_size=64",
                   "irradiance=face",
                   "irradiance=face iterations=8",
                   "irradiance=face iterations=32",
                   "cell_scale=2",
                   "cell_scale=2 iterations=8",
                   "cell_scale=2 irradiance=face",
                   "cell_scale=1/2",
                   "cell_scale=1/2 iterations=64",
                   "cell_scale=1/2 irradiance=face",
                   "cell_scale=1/2 irradiance=face iterations=32"},
        .counters = {counter<&LpvCounters::injected>(
                         {.name = "injected", .help = "virtual point lights injected, summed over all grids"}),
                     counter<&LpvCounters::guarded>(
                         {.name = "guarded",
                          .help = "virtual point lights injected into another cell, because a blocker hides the nearest"}),
                     counter<&LpvCounters::dropped>(
                         {.name = "dropped", .help = "virtual point lights lost, because blockers hide all cells near them"}),
                     counter<&LpvCounters::outside>({.name = "outside", .help = "virtual point lights outside of the grid"}),
                     counter<&LpvCounters::samples>({.name = "samples", .help = "samples lit by a grid"}),
                     counter<&LpvCounters::hidden_taps>(
                         {.name = "hidden taps", .help = "interpolated cells that a blocker hides, summed over samples"}),
                     counter<&LpvCounters::unfinished>(unfinished_row)},
        .counter_bytes = sizeof(LpvCounters),
        .views = {{.name = "visible taps",
                   .help = "of the eight interpolated cells, those that no blocker hides from the surface",
                   .unit = "cells",
                   .high = 8,
                   .declare = visible_taps},
                  {.name = "cells",
                   .help = "a sphere per lit cell: the radiant intensity it sends where the sphere's surface points",
                   .unit = "W/sr",
                   .high = .5,
                   .declare = cells_view,
                   .channels = {"red", "green", "blue"}},
                  {.name = "injected",
                   .help = "a sphere per cell with injected light: its radiant intensity before propagation",
                   .unit = "W/sr",
                   .high = .5,
                   .declare = injected_view,
                   .channels = {"red", "green", "blue"}},
                  {.name = "axial occlusion",
                   .help = "share of light that blockers stop at the faces of the surface's cell, the larger of two per axis",
                   .unit = "share",
                   .high = 1,
                   .declare = axial_occlusion_view,
                   .channels = {"across x", "across y", "across z"},
                   .if_zero = "no blocker stops light between the cells at these surfaces"}},
        .tables = {{.name = "energy",
                    .help = "energy of the first grid by step: held in its cells, absorbed by blockers, escaped over the border",
                    .columns = {{"step", ""}, {"held", "W"}, {"absorbed", "W"}, {"escaped", "W"}},
                    .declare = energy_table,
                    .is_curves = true}},
        .claims = {.ratios = lpv_ratios()},
        .declare = declare,
        .model = lpv_model,
        .tolerance = {.rmse = 3e-3,
                      .worst = 8e-2,
                      .because = "half floats; virtual point lights within a rounding of a cell's border fall to either side",
                      .exceptions = exceptions}};
}

}  // namespace strata::indirect
