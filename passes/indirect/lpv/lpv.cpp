// Light propagation volumes: what lights reach is injected into grids and handed from cell to cell.
#include <algorithm>
#include <bit>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "passes/choice_names.h"
#include "passes/indirect/bounces.h"
#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/injection/bounce.h"
#include "passes/indirect/lpv/injection/injection.h"
#include "passes/indirect/lpv/occlusion/small_portals.h"
#include "passes/indirect/lpv/propagation/propagation.h"
#include "passes/indirect/lpv/ratios.h"
#include "passes/indirect/lpv/views/cell_views.h"
#include "passes/indirect/lpv/views/surface_views.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/scene/scene_facts.h"
#include "passes/technique.h"

namespace strata::indirect {

ImageSet lpv_model(const StageInput&, const Settings&);

namespace {

constexpr auto propagations =
    choice_names({{propagation_linear, "linear"}, {propagation_clamped, "clamped"}, {propagation_energy_true, "energy_true"}});
constexpr auto face_rules = choice_names({{faces_centre, "centre"}, {faces_exact, "exact"}});
constexpr auto occlusions = choice_names({{occlusion_recorded, "recorded"},
                                          {occlusion_none, "none"},
                                          {occlusion_axial, "axial"},
                                          {occlusion_fuzzy, "fuzzy"},
                                          {occlusion_both, "both"}});
constexpr auto irradiances = choice_names({{irradiance_face, "face"}, {irradiance_cell, "cell"}});
constexpr auto resolutions = choice_names({{resolution_full, "full"}, {resolution_half, "half"}});
constexpr std::string_view switches[] = {"off", "on"};
constexpr auto relights = choice_names({{relight_always, "always"}, {relight_changed, "changed"}});
constexpr auto cell_scales = choice_names({{cells_half, "1/2"}, {cells_recorded, "1"}, {cells_double, "2"}});
constexpr auto tap_rules = choice_names({{taps_all, "all"}, {taps_visible, "visible"}});

/// Turns of loops of a fragment that all blockers of the frame are near (passes/indirect/near_blockers.glsl); the last turn of
/// each loop only finds that it is over. Lanes of a vector take their turns together: each blocker may be that with the most
/// portals.
std::uint64_t turns_of_grid(const Frame& frame) {
    std::vector<std::uint64_t> own(frame.blockers.size() + 1);
    for (const Portal& portal : frame.portals) ++own[std::min<std::size_t>(portal.blocker, frame.blockers.size())];
    const std::uint64_t halvings = std::bit_width(frame.portals.size()), of_way = halvings + 1 + std::ranges::max(own) + 1;
    const std::uint64_t words = (frame.blockers.size() + 31) / 32, of_cells = 9;
    return 3 * (words + 1) + frame.blockers.size() * (2 + 8 + 8 * of_way) + of_cells;
}

/// A transparent fragment asks about the way to eight cells of each grid, after its lights, and has no counter that tells when a
/// driver ends its loops.
std::optional<std::string> beyond_device(const FrameImages& images, const Settings& settings) {
    const Frame& frame = *images.recorded;
    const bool asks_taps = settings.as<LpvParams>().taps == taps_visible;
    if (!asks_taps || has(images.capabilities, Capability::long_loops)) return std::nullopt;
    if (info(Stage::transparency).unwanted(*images.features)) return std::nullopt;
    const std::uint64_t turns = images.facts->light_turns() + light_grids(frame).size() * turns_of_grid(frame);
    if (turns <= most_short_turns) return std::nullopt;
    return fmt::format(
        "a transparent fragment asks light volumes about {} blockers with {} portals, up to {} turns of a loop with its lights, "
        "and this device ends loops after {}",
        frame.blockers.size(), frame.portals.size(), turns, most_short_turns);
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<LpvParams>();
    const std::vector<DeviceGrid> grids = shown_grids(graph, frame, params);
    frame.indirect = apply(graph, frame, params, grids);
    hand_on(graph, frame, params, grids);
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
        fix_links(fix_faces(graph.compute("indirect/lpv/propagation/energy.comp"), params), grid, step)
            .loads("Before", light)
            .updates("numbers", numbers)
            .push(EnergyPush{.grid = grid.place, .step = step})
            .groups({1, 1, 1});
    });
    return numbers;
}

Image bounces_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    std::vector<DeviceGrid> grids = make_grids(graph, frame, params);
    inject_lights(graph, frame, params, grids);
    Image numbers = graph.create("energy of bounces", {.extent = {1, params.bounces}, .format = Format::rgba32f});
    graph.clear(numbers, {});
    if (grids.empty()) return numbers;
    DeviceGrid grid = grids.front();
    for (std::uint32_t bounce = 0; bounce < params.bounces; ++bounce) {
        if (bounce > 0) grid = reflected(graph, frame, params, grid);
        propagate(graph, frame, params, grid, [&](std::uint32_t step, const Buffer& light) {
            if (step > 0) return;
            fix_links(fix_faces(graph.compute("indirect/lpv/propagation/energy.comp"), params), grid, step)
                .loads("Before", light)
                .updates("numbers", numbers)
                .push(EnergyPush{.grid = grid.place, .step = bounce})
                .groups({1, 1, 1});
        });
    }
    return numbers;
}

std::string_view approximates(const Settings& settings) {
    return settings.as<LpvParams>().bounces > 1 ? two_bounces : std::string_view();
}

std::vector<std::string> notes(const FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    return notes_on_small_portals(*frame.recorded, light_grids(*frame.recorded, cell_scale(params)), params.occlusion);
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
                                           .high = 4,
                                           .fallback = occlusion_recorded,
                                           .help = "what stops light between cells; axial: blockers with their portals; "
                                                   "fuzzy: surfaces",
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
             param<&LpvParams::relight>({.name = "relight",
                                         .high = 1,
                                         .fallback = relight_always,
                                         .help = "when volumes are lit: in every frame, or where lights, casters, blockers or "
                                                 "the volume changed",
                                         .choices = relights}),
             param<&LpvParams::slice>(
                 {.name = "slice",
                  .high = 64,
                  .fallback = 0,
                  .help = "steps of propagation per frame (relight=changed); surfaces keep the old light meanwhile; 0: all"}),
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
                  .choices = switches}),
             param<&LpvParams::bounces>({.name = "bounces",
                                         .low = 1,
                                         .high = 2,
                                         .fallback = 1,
                                         .help = "reflections of light on its way; 2: surfaces reflect once more what grids "
                                                 "brought them"}),
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
                   "occlusion=fuzzy",
                   "occlusion=both",
                   "taps=all",
                   "occlusion=none taps=all",
                   "map_size=64",
                   "irradiance=face",
                   "irradiance=face iterations=8",
                   "cell_scale=2",
                   "cell_scale=1/2",
                   "cell_scale=1/2 iterations=64",
                   "cell_scale=1/2 irradiance=face",
                   "apply_resolution=half",
                   "damping=2",
                   "bounces=2",
                   "relight=changed"},
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
                     counter<&LpvCounters::cells_relit>(
                         {.name = "cells relit", .help = "cells whose light was injected in this frame, summed over all grids"}),
                     counter<&LpvCounters::faces_rebuilt>(
                         {.name = "faces rebuilt", .help = "faces between cells that were tested against all blockers"}),
                     counter<&LpvCounters::overflowed>(
                         {.name = "overflowed", .help = "sums of light in a cell that left their fixed point", .is_fatal = true}),
                     counter<&LpvCounters::reflected>(
                         {.name = "reflected", .help = "pieces of surfaces injected for a second bounce, summed over all grids"}),
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
                   .if_zero = "no grid lights a surface"},
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
                    .is_curves = true},
                   {.name = "bounces",
                    .help = "energy that surfaces reflect into the first grid, by earlier bounces of the light",
                    .columns = {{"earlier bounces", ""}, {"injected", "W"}},
                    .declare = bounces_table}},
        .beyond_device = beyond_device,
        .claims = {.ratios = lpv_ratios()},
        .declare = declare,
        .approximates = approximates,
        .model = lpv_model,
        .tolerance = {.rmse = 3e-3,
                      .worst = 8e-2,
                      .because = "half floats; virtual point lights within a rounding of a cell's border fall to either side"},
        .notes = notes};
}

}  // namespace strata::indirect
