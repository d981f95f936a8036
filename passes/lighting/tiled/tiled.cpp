// Tiled lighting: per tile only the lights that reach it, less those that blockers hide, shaded by the cheapest shader that does
// what they and the tile's surfaces need.
#include <array>

#include "passes/choice_names.h"
#include "passes/edges/plain_pixels.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/lighting/every_light.h"
#include "passes/lighting/tiled/culling.h"
#include "passes/lighting/tiled/modes.h"
#include "passes/lighting/tiled/ratios.h"
#include "passes/lighting/tiled/views.h"
#include "passes/shadows/filter.h"
#include "passes/technique.h"

namespace strata::lighting {

ImageSet tiled_model(const StageInput&, const Settings&);

namespace {

constexpr std::string_view switches[] = {"off", "on"};
constexpr auto blocker_uses =
    choice_names({{blockers_per_pixel, "per_pixel"}, {blockers_tile_only, "tile_only"}, {blockers_off, "off"}});
constexpr auto overflows = choice_names({{overflow_batch, "batch"}, {overflow_drop, "drop"}});
constexpr auto prefilters = choice_names({{prefilter_automatic, "auto"}, {prefilter_off, "off"}, {prefilter_on, "on"}});
constexpr auto shadow_sources = choice_names({{shadows_image, "image"}, {shadows_inline, "inline"}});
constexpr auto branch_kinds = choice_names({{branches_specialized, "specialized"}, {branches_uniform, "uniform"}});

void shade(Graph& graph, FrameImages& frame, const TiledParams& params, const CulledTiles& culled, std::uint32_t mode) {
    const bool is_inline = params.shadows == shadows_inline;
    ComputePass pass = graph.compute("lighting/tiled/shade.comp");
    fix_shadow_filter(pass, frame.shadow_filter);
    sample_edges(sample_gbuffer(pass, frame), frame)
        .samples("visibility", is_inline ? Image{} : frame.visibility)
        .samples("shadow_maps", is_inline ? frame.shadow_maps : Image{})
        .updates("light", frame.light)
        .loads("Records", culled.records)
        .loads("Tiles", culled.tiles)
        .loads("Dispatches", culled.dispatches)
        .fixes("has_shadows", has_shadows(frame, params) ? 1u : 0u)
        .fixes("shadow_source", params.shadows)
        .fixes("branches", params.branches)
        .fixes("mode", mode >> 16)
        .fixes("mode_features", mode & 0xffffu)
        .fixes("asks_blockers", params.blockers == blockers_per_pixel ? 1u : 0u)
        .indirect(culled.dispatches, (mode >> 16) * sizeof(ModeDispatch));
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<TiledParams>();
    frame.light = graph.create("light", {.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples});
    // Tiles without anything to light are in no list.
    graph.clear(frame.light, {{0, 0, 0, 1}});
    const CulledTiles culled = cull_tiles(graph, frame, params);
    for (std::uint32_t i = 0; i < culled.order.count; ++i) shade(graph, frame, params, culled, culled.order.modes[i]);
}

constexpr std::array<std::string_view, 16> mode_names = {"mode_0",  "mode_1",  "mode_2",  "mode_3", "mode_4",  "mode_5",
                                                         "mode_6",  "mode_7",  "mode_8",  "mode_9", "mode_10", "mode_11",
                                                         "mode_12", "mode_13", "mode_14", "mode_15"};

template <auto Member>
Param mode_row(std::string_view name, double features) {
    return param<Member>({.name = name,
                          .low = 0,
                          .high = 65535,
                          .fallback = features,
                          .help = "features of the shading mode, bits of light_features.shared.h added up"});
}

// What serves the tiles of agents_hq at 320 x 180 with the fewest cycles by the compiler of a Bonaire, see README.md: each is the
// one that saves most beside those before it, so that the first N are sensible whatever N is. The first four leave room for as
// many waves as a mode for every spectrum would.
std::vector<Param> mode_rows() {
    return {
        mode_row<&TiledParams::mode_0>(mode_names[0], 0xffff),    // all
        mode_row<&TiledParams::mode_1>(mode_names[1], 0x1f77),    // no soft shadows, tubes, skin, hair
        mode_row<&TiledParams::mode_2>(mode_names[2], 0x0463),    // blockers, portals, round spots, omni lights, darks
        mode_row<&TiledParams::mode_3>(mode_names[3], 0x7777),    // no soft shadows, tubes, clip planes
        mode_row<&TiledParams::mode_4>(mode_names[4], 0x0df7),    // tubes and areas, clip planes
        mode_row<&TiledParams::mode_5>(mode_names[5], 0x0d67),    // areas, clip planes, no square spots
        mode_row<&TiledParams::mode_6>(mode_names[6], 0x0ff7),    // every kind of light, clip planes
        mode_row<&TiledParams::mode_7>(mode_names[7], 0x0677),    // spots and their textures
        mode_row<&TiledParams::mode_8>(mode_names[8], 0x0de7),    // tubes and areas, no square spots
        mode_row<&TiledParams::mode_9>(mode_names[9], 0x0464),    // shadows
        mode_row<&TiledParams::mode_10>(mode_names[10], 0x0f77),  // every kind of light but tubes
        mode_row<&TiledParams::mode_11>(mode_names[11], 0x1ff7),  // every kind of light, clip planes, cloth
        mode_row<&TiledParams::mode_12>(mode_names[12], 0x01e4),  // shadows, tubes, areas
        mode_row<&TiledParams::mode_13>(mode_names[13], 0x0565),  // blockers, shadows, areas
        mode_row<&TiledParams::mode_14>(mode_names[14], 0x0577),  // areas, square spots, no clip planes
        mode_row<&TiledParams::mode_15>(mode_names[15], 0x1d77),  // areas, clip planes, cloth
    };
}

std::vector<Param> params() {
    std::vector<Param> rows = {
        param<&TiledParams::half_z>(
            {.name = "half_z",
             .fallback = 1,
             .help = "two cells per tile, one on either side of the middle of its depths, each as deep as what is in it",
             .choices = switches}),
        param<&TiledParams::blockers>(
            {.name = "blockers",
             .fallback = blockers_per_pixel,
             .help = "per_pixel: tested where a blocker's shadow has an edge; tile_only: they darken whole tiles or nothing; "
                     "off: they let light through",
             .choices = blocker_uses}),
        param<&TiledParams::classify>({.name = "classify",
                                       .fallback = 1,
                                       .help = "blockers and portals against tiles; without it pixels test all of them",
                                       .choices = switches}),
        param<&TiledParams::overflow>({.name = "overflow",
                                       .fallback = overflow_batch,
                                       .help = "a tile's lights beyond 64: in further batches, or dropped",
                                       .choices = overflows}),
        param<&TiledParams::prefilter>(
            {.name = "prefilter",
             .fallback = prefilter_automatic,
             .help = "a list of candidates for each 128 x 128 pixels; auto: with more than 1024 lights",
             .choices = prefilters}),
        param<&TiledParams::shadows>({.name = "shadows",
                                      .fallback = shadows_image,
                                      .help = "from the shadow stage's image, or filtered here, where a light is not culled",
                                      .choices = shadow_sources}),
        param<&TiledParams::branches>(
            {.name = "branches",
             .fallback = branches_specialized,
             .help = "specialized: a shader per mode; uniform: one of all features that branches on the tile's spectrum",
             .choices = branch_kinds}),
        param<&TiledParams::force>({.name = "force",
                                    .low = 0,
                                    .high = 65535,
                                    .fallback = 0,
                                    .help = "features that every tile is said to have: what one costs"}),
        param<&TiledParams::modes>({.name = "modes",
                                    .low = 1,
                                    .high = 16,
                                    .fallback = 8,
                                    .help = "shading modes: mode_0 and on, and one of all features if none of them is"}),
    };
    const std::vector<Param> modes = mode_rows();
    rows.insert(rows.end(), modes.begin(), modes.end());
    return rows;
}

std::vector<Counter> counters() {
    return {
        counter<&TiledCounters::tiles>({.name = "tiles", .help = "of 16 x 16 pixels"}),
        counter<&TiledCounters::empty_tiles>({.name = "empty tiles", .help = "of these, with nothing to light"}),
        counter<&TiledCounters::lights_touching>({.name = "lights touching", .help = "a tile, summed over tiles"}),
        counter<&TiledCounters::lights_kept>({.name = "lights kept", .help = "of these, shaded in the tile"}),
        counter<&TiledCounters::lights_killed>(
            {.name = "lights killed", .help = "of these, hidden from all of the tile by a blocker"}),
        counter<&TiledCounters::portals_none>({.name = "portals none", .help = "(light, portal) that the tile has nothing of"}),
        counter<&TiledCounters::portals_partial>({.name = "portals partial", .help = "(light, portal) that its pixels test"}),
        counter<&TiledCounters::portals_full>({.name = "portals full", .help = "(light, portal) open to all of the tile"}),
        counter<&TiledCounters::blockers_none>({.name = "blockers none", .help = "(light, blocker) that shade nothing of it"}),
        counter<&TiledCounters::blockers_partial>({.name = "blockers partial", .help = "(light, blocker) with an edge in it"}),
        counter<&TiledCounters::blockers_full>({.name = "blockers full", .help = "(light, blocker) that shade all of it"}),
        counter<&TiledCounters::tiles_over_lights>(
            {.name = "tiles over lights", .help = "with more than 64: done in batches, or cut"}),
        counter<&TiledCounters::tiles_over_blocker_pairs>(
            {.name = "tiles over blocker pairs", .help = "with more than 256 in a batch: pixels test the rest"}),
        counter<&TiledCounters::tiles_over_portal_pairs>(
            {.name = "tiles over portal pairs", .help = "with more than 256 in a batch: pixels test the rest"}),
        counter<&TiledCounters::tiles_testing_pixels>(
            {.name = "tiles testing pixels", .help = "whose pixels test a blocker of any light"}),
        counter<&TiledCounters::unlisted_tiles>(
            {.name = "unlisted tiles", .help = "for whose lights no record was left: shaded with all that follow, untested"}),
        counter<&TiledCounters::most_lights>({.name = "most lights", .help = "that reach one tile"}),
        counter<&TiledCounters::most_blocker_pairs>({.name = "most blocker pairs", .help = "of one batch"}),
        counter<&TiledCounters::most_portal_pairs>({.name = "most portal pairs", .help = "of one batch"}),
        counter<&TiledCounters::modes_compiled>(
            {.name = "modes compiled", .help = "shading modes compiled for this frame: those that a tile may need"}),
        counter<&TiledCounters::modes_used>({.name = "modes used", .help = "by any tile"}),
        counter<&TiledCounters::tiles_unserved>(
            {.name = "tiles unserved", .help = "tiles that need a feature no compiled mode has", .is_fatal = true}),
        counter<&TiledCounters::samples_shaded>(
            {.name = "samples_shaded", .help = "samples with a lit surface, plain pixels counted once"}),
        counter<&TiledCounters::evaluations>({.name = "evaluations", .help = "listed lights, summed over samples shaded"}),
        counter<&TiledCounters::blocker_tests>(
            {.name = "blocker tests", .help = "(light, blocker) asked for, summed over samples shaded"}),
        counter<&TiledCounters::unfinished>(unfinished_row),
    };
}

}  // namespace

Technique tiled() {
    return {
        .stage = Stage::lighting,
        .name = "lighting/tiled",
        .title = "Tiled, with light blockers and feature spectra",
        .source =
            "Kircher: Rendering Technology in Agents of Mayhem, GDC 2018; Andersson: DirectX 11 Rendering in Battlefield 3, "
            "GDC 2011",
        .summary =
            "Lists the lights of each tile of 16 x 16 pixels, drops what blockers hide from all of it, and shades it by a shader "
            "with no more features than it needs; exact like a loop over all lights, slow where depth jumps within a tile.",
        .params = params(),
        .points = {"modes=1", "modes=16", "branches=uniform", "classify=off", "half_z=off", "prefilter=on", "shadows=inline",
                   "blockers=tile_only", "overflow=drop"},
        .counters = counters(),
        .counter_bytes = sizeof(TiledCounters),
        .views = tiled_views(),
        .tables = tiled_tables(),
        .abilities = {.variants = ShaderVariants{.constant = "mode", .view = "mode numbers", .table = "modes"},
                      .feature_modes =
                          FeatureModes{.table = "spectra", .constant = "mode_features", .count = "modes", .modes = mode_names}},
        .claims = {.ratios = tiled_ratios()},
        .declare = declare,
        .model = tiled_model,
        .model_is = ModelKind::mirror,
        .tolerance = shaded_light_tolerance};
}

}  // namespace strata::lighting
