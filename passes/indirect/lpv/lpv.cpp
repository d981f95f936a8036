// Light propagation volumes: what lights reach is injected into grids and handed from cell to cell.
#include <algorithm>
#include <bit>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/core.h>
#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/indirect/bounces.h"
#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/occlusion/small_portals.h"
#include "passes/indirect/lpv/ratios.h"
#include "passes/indirect/lpv/tight_volumes.h"
#include "passes/indirect/lpv/views/cell_views.h"
#include "passes/indirect/lpv/views/energy_tables.h"
#include "passes/indirect/lpv/views/surface_views.h"
#include "passes/indirect/lpv/volumes.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/stages.h"
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
constexpr auto relights = choice_names({{relight_always, "always"}, {relight_changed, "changed"}});
constexpr auto cell_scales = choice_names({{cells_half, "1/2"}, {cells_recorded, "1"}, {cells_double, "2"}});
constexpr auto self_lights = choice_names({{self_kept, "kept"}, {self_uninjected, "uninjected"}, {self_facing, "by_facing"}});
constexpr auto lobe_rules = choice_names({{lobes_face, "face"}, {lobes_flow, "flow"}});
constexpr auto storages = choice_names({{storage_float, "float"}, {storage_half, "half"}});
constexpr auto tap_rules = choice_names({{taps_all, "all"}, {taps_visible, "visible"}});

/// Iterations of loops of a fragment that all blockers of the frame are near (passes/indirect/near_blockers.glsl); the last
/// iteration of each loop only finds that it is over. Lanes of a vector take their iterations together: each blocker may be that
/// with the most portals.
std::uint64_t iterations_of_grid(const Frame& frame) {
    std::vector<std::uint64_t> own(frame.blockers.size() + 1);
    for (const Portal& portal : frame.portals) ++own[std::min<std::size_t>(portal.blocker, frame.blockers.size())];
    const std::uint64_t halvings = std::bit_width(frame.portals.size()), of_way = halvings + 1 + std::ranges::max(own) + 1;
    const std::uint64_t words = (frame.blockers.size() + 31) / 32, of_cells = 9;
    return 3 * (words + 1) + frame.blockers.size() * (2 + 8 + 8 * of_way) + of_cells;
}

/// A transparent fragment asks about the way to eight cells of each grid, after its lights, and has no counter that tells when a
/// driver ends its loops.
std::optional<Error> beyond_device(const FrameImages& images, const Settings& settings) {
    const Frame& frame = *images.recorded;
    const bool asks_taps = settings.as<LpvParams>().taps == taps_visible;
    if (!asks_taps || has(images.capabilities, Capability::long_loops)) return std::nullopt;
    if (info(Stage::transparency).unwanted(*images.features)) return std::nullopt;
    const std::uint64_t iterations = images.facts->light_iterations() + light_grids(frame).size() * iterations_of_grid(frame);
    if (iterations <= most_short_iterations) return std::nullopt;
    return fail(Fault::device_lacks, "device.short_loops",
                "transparent fragments test {blockers} blockers and {portals} portals per cell of a light volume: with their "
                "lights up to "
                "{iterations} loop iterations per fragment, and this device ends loops after {limit}; choose taps=all",
                frame.blockers.size(), frame.portals.size(), iterations, most_short_iterations);
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<LpvParams>();
    const std::vector<DeviceGrid> grids = shown_grids(graph, frame, params);
    frame.indirect = apply(graph, frame, params, grids);
    hand_on(graph, frame, params, grids);
}

std::string_view approximates(const Settings& settings) {
    return settings.as<LpvParams>().bounces > 1 ? two_bounces : std::string_view();
}

std::vector<std::string> notes(const FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LpvParams>();
    const std::vector<LightGrid> grids = light_grids(*frame.recorded, cell_scale(params));
    std::vector<std::string> all = notes_on_tight_volumes(*frame.facts, grids);
    if (grids.empty()) all.emplace_back("the frame has no light volume: no light is indirect");
    for (std::string& note : notes_on_small_portals(*frame.recorded, grids, params.occlusion)) all.push_back(std::move(note));
    return all;
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
            "Injects virtual point lights (VPLs) into grids of spherical harmonics and propagates the light from cell to cell. "
            "Too dark beyond iterations/8 cells from a source; details smaller than a cell are lost.",
        .params =
            {param<&LpvParams::iterations>(
                 {.name = "iterations",
                  .high = 64,
                  .fallback = 0,
                  .help = "propagation steps of one cell each; more: light reaches farther and is brighter; 0: as recorded"}),
             param<&LpvParams::propagation>({.name = "propagation",
                                             .high = 2,
                                             .fallback = propagation_linear,
                                             .help =
                                                 "treatment of negative radiance at cell faces; linear: kept; clamped: set to 0 "
                                                 "(adds energy); energy_true: set to 0 and the rest scaled to conserve energy",
                                             .choices = propagations}),
             param<&LpvParams::faces>(
                 {.name = "faces",
                  .high = 1,
                  .fallback = faces_centre,
                  .help = "radiance through a cell face; centre: sampled at its center; exact: integrated over it",
                  .choices = face_rules}),
             param<&LpvParams::occlusion>({.name = "occlusion",
                                           .high = 4,
                                           .fallback = occlusion_recorded,
                                           .help = "occluders between cells; axial: blockers with their portals; fuzzy: surfaces "
                                                   "(geometry volume); recorded: as the volume says",
                                           .choices = occlusions}),
             param<&LpvParams::taps>({.name = "taps",
                                      .high = 1,
                                      .fallback = taps_visible,
                                      .help =
                                          "cells that a sample interpolates; all: the 8 around it; visible: without those that a "
                                          "blocker hides",
                                      .choices = tap_rules}),
             param<&LpvParams::irradiance>(
                 {.name = "irradiance",
                  .high = 1,
                  .fallback = irradiance_cell,
                  .help = "conversion of a cell's SH light to irradiance; face: as from a light at the cell's "
                          "face; cell: mean over the cell",
                  .choices = irradiances}),
             param<&LpvParams::map_size>(
                 {.name = "map_size",
                  .low = 16,
                  .high = 512,
                  .fallback = 128,
                  .help =
                      "largest resolution of reflective shadow maps (RSMs), texels per side, for parallel light three times as "
                      "much; larger: more VPLs",
                  .scale = Scale::logarithmic}),
             param<&LpvParams::map_density>(
                 {.name = "map_density",
                  .high = 16,
                  .fallback = 4,
                  .help = "texels of RSMs per cell width at half of a light's range, for parallel light three times as many; "
                          "0: map_size decides alone"}),
             param<&LpvParams::injection>({.name = "injection",
                                           .high = 1,
                                           .fallback = .5,
                                           .help = "offset of VPLs along the surface normal before injection, cells"}),
             param<&LpvParams::macro_cells>({.name = "macro_cells",
                                             .fallback = 1,
                                             .help = "blockers tested with taps=visible; on: those near the macro-cell (4x4x4 "
                                                     "cells); off: all, for the same image",
                                             .choices = switches}),
             param<&LpvParams::apply_resolution>({.name = "apply_resolution",
                                                  .high = 1,
                                                  .fallback = resolution_full,
                                                  .help = "resolution at which light is read from the grids; half: once per 2x2 "
                                                          "pixels, upsampled by depth and normal",
                                                  .choices = resolutions}),
             param<&LpvParams::relight>(
                 {.name = "relight",
                  .high = 1,
                  .fallback = relight_changed,
                  .help = "frames that light the volumes; always: all; changed: those in which lights, casters, "
                          "blockers or the volume differ",
                  .choices = relights}),
             param<&LpvParams::slice>({.name = "slice",
                                       .high = 64,
                                       .fallback = 0,
                                       .help = "propagation steps per frame with relight=changed; the old light is shown until "
                                               "all are done; 0: all at once"}),
             param<&LpvParams::damping>(
                 {.name = "damping",
                  .high = 4,
                  .fallback = 0,
                  .help = "exponent that darkens light arriving through the back of a surface; 0: off; 1 to 2: typical"}),
             param<&LpvParams::tap_tiles>({.name = "tap_tiles",
                                           .fallback = 0,
                                           .help = "on: 8x8-pixel tiles whose macro-cells have no blocker use a shader without "
                                                   "visibility tests; off: one shader",
                                           .choices = switches}),
             param<&LpvParams::bounces>(
                 {.name = "bounces",
                  .low = 1,
                  .high = 2,
                  .fallback = 1,
                  .help = "bounces of light; 2: surfaces also reflect the light that the grids bring them"}),
             param<&LpvParams::cell_scale>({.name = "cell_scale",
                                            .high = 2,
                                            .fallback = cells_recorded,
                                            .help =
                                                "cell width as a multiple of the recorded one; the volume's extent stays, so 1/2 "
                                                "means 8 times the cells",
                                            .choices = cell_scales}),
             param<&LpvParams::cell_storage>({.name = "cell_storage",
                                              .high = 1,
                                              .fallback = storage_float,
                                              .help = "format of light in cells; float: 32 bits; half: 16 bits, scaled by the "
                                                      "brightest cell: less than half the memory",
                                              .choices = storages}),
             param<&LpvParams::self_light>({.name = "self_light",
                                            .high = 2,
                                            .fallback = self_facing,
                                            .help =
                                                "reflected light that the volume returns to the surface it came from; kept: all; "
                                                "uninjected: without what was injected into the cell that is read; "
                                                "by_facing: without surfaces that face alike, twice the memory",
                                            .choices = self_lights}),
             param<&LpvParams::reading>(
                 {.name = "reading",
                  .high = 2,
                  .fallback = .5,
                  .help = "distance from a surface along its normal at which cells are read, cells; 1.5: past its own cell"}),
             param<&LpvParams::lobes>(
                 {.name = "lobes",
                  .high = 1,
                  .fallback = lobes_flow,
                  .help = "axis of the lobe into which the flux through a cell's face is projected; face: the face's normal, as "
                          "published; flow: away from the cell the flux comes from, reaches farther",
                  .choices = lobe_rules})},
        .variants = {"iterations=8",
                     "iterations=32",
                     "iterations=64",
                     "propagation=energy_true",
                     "propagation=clamped",
                     "faces=exact",
                     "occlusion=none",
                     "occlusion=fuzzy",
                     "occlusion=both",
                     "taps=all",
                     "occlusion=none taps=all",
                     "map_size=64",
                     "map_density=0",
                     "irradiance=face",
                     "irradiance=face iterations=8",
                     "cell_scale=2",
                     "cell_scale=1/2",
                     "cell_scale=1/2 iterations=64",
                     "cell_scale=1/2 irradiance=face",
                     "apply_resolution=half",
                     "damping=2",
                     "bounces=2",
                     "relight=always",
                     "cell_storage=half",
                     "self_light=kept",
                     "self_light=uninjected",
                     "reading=1.5",
                     "lobes=face",
                     "lobes=face self_light=kept"},
        .counters =
            {counter<&LpvCounters::injected>(
                 {.name = "injected", .help = "virtual point lights (VPLs) injected, summed over all grids"}),
             counter<&LpvCounters::guarded>(
                 {.name = "guarded", .help = "VPLs injected into a neighboring cell because a blocker hides the nearest one"}),
             counter<&LpvCounters::dropped>({.name = "dropped", .help = "VPLs lost because blockers hide all cells near them"}),
             counter<&LpvCounters::outside>(
                 {.name = "outside", .help = "surfaces outside the grid in maps that see it; they inject nothing"}),
             counter<&LpvCounters::samples>({.name = "samples", .help = "samples lit by a grid, summed over all grids"}),
             counter<&LpvCounters::hidden_taps>(
                 {.name = "hidden taps",
                  .help = "taps (cells around a sample) left out because a blocker hides them from it, summed over samples"}),
             counter<&LpvCounters::unfinished>(unfinished_row),
             counter<&LpvCounters::samples_near_blockers>(
                 {.name = "samples near blockers", .help = "samples with at least one blocker near their macro-cell"}),
             counter<&LpvCounters::blocker_tests>(
                 {.name = "blocker tests",
                  .help = "segment-blocker intersection tests; a segment leads from a sample to a cell or to another pixel"}),
             counter<&LpvCounters::full_resolution_pixels>(
                 {.name = "full resolution pixels",
                  .help = "samples that read the grid themselves with apply_resolution=half because no neighbor fits"}),
             counter<&LpvCounters::cells_relit>(
                 {.name = "cells relit", .help = "cells lit anew in this frame, summed over all grids; 0: their light was kept"}),
             counter<&LpvCounters::faces_rebuilt>(
                 {.name = "faces rebuilt",
                  .help = "cell faces whose transmission was computed in this frame; 0: all were kept from earlier frames"}),
             counter<&LpvCounters::overflowed>(
                 {.name = "overflowed", .help = "sums of light in a cell that overflowed their storage", .is_fatal = true}),
             counter<&LpvCounters::reflected>(
                 {.name = "reflected", .help = "surfels injected for the second bounce, summed over all grids"}),
             counter<&LpvCounters::tiles>(
                 {.name = "tiles", .help = "8x8-pixel tiles with a surface, summed over all grids (tap_tiles=on)"}),
             counter<&LpvCounters::tiles_near_blockers>(
                 {.name = "tiles near blockers",
                  .help = "8x8-pixel tiles shaded with visibility tests, summed over all grids (tap_tiles=on)"}),
             counter<&LpvCounters::map_casters>(
                 {.name = "map casters", .help = "draws into RSMs, summed over maps; 0 in a frame in which light is kept"})},
        .counter_bytes = sizeof(LpvCounters),
        .views =
            {{.name = "visible taps",
              .help = "cells that a pixel interpolates: those of the 8 around it that no blocker hides",
              .unit = "cells",
              .high = 8,
              .declare = visible_taps,
              .if_zero = "no grid lights a visible surface"},
             {.name = "macro-cells",
              .help = "blockers near a pixel's macro-cell (4x4x4 cells): its visibility tests ask these alone",
              .unit = "blockers",
              .high = 8,
              .declare = near_blockers,
              .if_zero = "no blocker is near the macro-cell of a visible surface"},
             {.name = "volume",
              .help = "number, from 1, of the grid that lights a pixel most; its fraction is half the share of all other grids; "
                      "0: no grid",
              .unit = "grid",
              .high = 8,
              .declare = lighting_volume,
              .if_zero = "no grid lights a visible surface"},
             {.name = "cells",
              .help =
                  "white diffuse sphere in each lit cell: irradiance / pi that the cell's light gives it; surfaces are dimmed",
              .unit = "W/(m^2 sr)",
              .high = .5,
              .declare = cells_view,
              .channels = {"red", "green", "blue"}},
             {.name = "injected",
              .help = "sphere in each cell with VPLs: radiant intensity sent along its normals, before propagation; surfaces "
                      "are dimmed",
              .unit = "W/sr",
              .high = .5,
              .declare = injected_view,
              .channels = {"red", "green", "blue"}},
             {.name = "axial occlusion",
              .help =
                  "axial occlusion at the faces of the surface's cell: share of light stopped, the larger of two faces per axis",
              .high = 1,
              .declare = axial_occlusion_view,
              .channels = {"across x", "across y", "across z"},
              .if_zero = "no blocker occludes a face of a visible surface's cell"}},
        .tables =
            {{.name = "energy",
              .help = "energy balance of the first grid by propagation step, R+G+B: held in cells, absorbed by blockers, escaped",
              .columns = {{"step", ""}, {"held", "W"}, {"absorbed", "W"}, {"escaped", "W"}},
              .declare = energy_table,
              .is_curves = true},
             {.name = "bounces",
              .help = "energy injected into the first grid for each bounce, R+G+B; 0 earlier bounces: from surfaces that lights "
                      "shine on",
              .columns = {{"earlier bounces", ""}, {"injected", "W"}},
              .declare = bounces_table}},
        .abilities = {.keeps_work = true},
        .beyond_device = beyond_device,
        .claims = {.ratios = lpv_ratios()},
        .declare = declare,
        .approximates = approximates,
        .model = lpv_model,
        .tolerance = {.rmse = 3e-3,
                      .worst = 8e-2,
                      .because = "half-float image; VPLs within a rounding of a cell's border fall to either side"},
        .notes = notes};
}

}  // namespace strata::indirect
