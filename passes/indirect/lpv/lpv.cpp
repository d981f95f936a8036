// Light propagation volumes: what lights reach is injected into grids and handed from cell to cell.
#include <vector>

#include "passes/choice_names.h"
#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/apply/views.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/propagation/propagation.h"
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
constexpr auto resolutions = choice_names({{resolution_full, "full"}, {resolution_half, "half"}});
constexpr std::string_view switches[] = {"off", "on"};
constexpr auto tap_rules = choice_names({{taps_all, "all"}, {taps_visible, "visible"}});

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<LpvParams>();
    frame.indirect = apply(graph, frame, params, lit_grids(graph, frame, params));
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
             param<&LpvParams::macro_cells>(
                 {.name = "macro_cells",
                  .fallback = 1,
                  .help = "taps=visible asks the blockers near a macro-cell of 4x4x4 cells; off: all blockers of the frame",
                  .choices = switches}),
             param<&LpvParams::apply_resolution>(
                 {.name = "apply_resolution",
                  .high = 1,
                  .fallback = resolution_full,
                  .help = "cells are read per sample, or once per 2x2 pixels; half: pixels that no neighbor fits read them, too",
                  .choices = resolutions}),
             param<&LpvParams::damping>(
                 {.name = "damping",
                  .high = 4,
                  .fallback = 0,
                  .help = "exponent that dims light which grows towards the inside of a surface; 0: off, 1 to 2: typical"}),
             param<&LpvParams::tap_tiles>(
                 {.name = "tap_tiles",
                  .fallback = 0,
                  .help =
                      "tiles near no blocker, by their macro-cells, are lit by a shader that asks none; off: one shader for all",
                  .choices = switches})},
        .points = {"iterations=8", "iterations=32", "propagation=linear", "propagation=clamped", "faces=exact", "occlusion=none",
                   "taps=all", "map_size=64", "irradiance=face", "apply_resolution=half", "damping=2"},
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
                     counter<&LpvCounters::unfinished>(unfinished_row),
                     counter<&LpvCounters::samples_near_blockers>(
                         {.name = "samples near blockers", .help = "samples with a blocker near their macro-cell"}),
                     counter<&LpvCounters::blocker_tests>(
                         {.name = "blocker tests", .help = "ways to a cell or to another pixel tested against a blocker"}),
                     counter<&LpvCounters::full_resolution_pixels>(
                         {.name = "full resolution pixels",
                          .help = "samples that read cells themselves with apply_resolution=half: no neighbor fits"}),
                     counter<&LpvCounters::tiles>(
                         {.name = "tiles", .help = "tiles of 8x8 pixels with a surface, summed over grids, with tap_tiles=on"}),
                     counter<&LpvCounters::tiles_near_blockers>(
                         {.name = "tiles near blockers", .help = "of these, those lit by the shader that asks blockers"})},
        .counter_bytes = sizeof(LpvCounters),
        .views = {{.name = "visible taps",
                   .help = "of the eight interpolated cells, those that no blocker hides from the surface",
                   .unit = "cells",
                   .high = 8,
                   .declare = visible_taps},
                  {.name = "macro-cells",
                   .help = "blockers that a pixel's taps are tested against: those near its macro-cell of 4x4x4 cells",
                   .unit = "blockers",
                   .high = 8,
                   .declare = near_blockers,
                   .if_zero = "no blocker is near any macro-cell that is read"},
                  {.name = "volume",
                   .help = "number of the grid that gives the most light, from 1, plus half the share left to others; 0: none",
                   .unit = "grid",
                   .high = 8,
                   .declare = lighting_volume,
                   .if_zero = "no grid lights a surface"}},
        .tables = {{.name = "energy",
                    .help = "energy of the first grid by step: held in its cells, absorbed by blockers, escaped over the border",
                    .columns = {{"step", ""}, {"held", "W"}, {"absorbed", "W"}, {"escaped", "W"}},
                    .declare = energy_table}},
        .declare = declare,
        .model = lpv_model,
        .tolerance = {.rmse = 3e-3,
                      .worst = 8e-2,
                      .because = "half floats; virtual point lights within a rounding of a cell's border fall to either side"}};
}

}  // namespace strata::indirect
