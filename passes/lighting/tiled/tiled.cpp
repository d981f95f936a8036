// Tiled lighting: per tile only the lights that reach it, less those that blockers hide, shaded by the cheapest shader that does
// what they and the tile's surfaces need.
#include <array>

#include "passes/choice_names.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/lighting/every_light.h"
#include "passes/lighting/tiled/culling.h"
#include "passes/lighting/tiled/modes.h"
#include "passes/lighting/tiled/ratios.h"
#include "passes/lighting/tiled/tables.h"
#include "passes/lighting/tiled/views.h"
#include "passes/shadows/filter.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::lighting {

ImageSet tiled_model(const StageInput&, const Settings&);

namespace {

constexpr auto blocker_uses =
    choice_names({{blockers_per_pixel, "per_pixel"}, {blockers_tile_only, "tile_only"}, {blockers_off, "off"}});
constexpr auto overflows = choice_names({{overflow_batch, "batch"}, {overflow_drop, "drop"}});
constexpr auto prefilters = choice_names({{prefilter_automatic, "auto"}, {prefilter_off, "off"}, {prefilter_on, "on"}});
constexpr auto shadow_sources = choice_names({{shadows_image, "image"}, {shadows_inline, "inline"}});
constexpr auto branch_kinds = choice_names({{branches_specialized, "specialized"}, {branches_uniform, "uniform"}});

void shade(Graph& graph, FrameImages& frame, const TiledParams& params, const CulledTiles& culled, std::uint32_t mode) {
    const bool is_inline = params.shadows == shadows_inline;
    ComputeStep builder = graph.compute("lighting/tiled/shade.comp");
    fix_shadow_filter(builder, frame.shadow_filter);
    sample_edges(sample_gbuffer(builder, frame), frame)
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
                          .help = "features of this shading mode: sum of bits of light_features.shared.h"});
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
             .help = "on: culls each tile as two depth ranges, split in the middle and shrunk to their surfaces; off: as one",
             .choices = switches}),
        param<&TiledParams::blockers>({.name = "blockers",
                                       .fallback = blockers_per_pixel,
                                       .help = "per_pixel: pixels test blockers whose shadow has an edge in their tile; "
                                               "tile_only: blockers hide whole tiles or nothing; off: no blockers",
                                       .choices = blocker_uses}),
        param<&TiledParams::classify>(
            {.name = "classify",
             .fallback = 1,
             .help = "on: classifies blockers and portals by tile; off: pixels test all of them, for the same picture",
             .choices = switches}),
        param<&TiledParams::overflow>({.name = "overflow",
                                       .fallback = overflow_batch,
                                       .help = "lights of a tile beyond 64; batch: shaded in further batches; drop: left out",
                                       .choices = overflows}),
        param<&TiledParams::prefilter>(
            {.name = "prefilter",
             .fallback = prefilter_automatic,
             .help = "on: culls lights by 128x128 pixels before tiles; auto: with more than 1024 lights; the picture is the same",
             .choices = prefilters}),
        param<&TiledParams::shadows>(
            {.name = "shadows",
             .fallback = shadows_image,
             .help =
                 "image: reads the shadow stage's image; inline: filters shadow maps here, only for lights that are not culled",
             .choices = shadow_sources}),
        param<&TiledParams::branches>(
            {.name = "branches",
             .fallback = branches_specialized,
             .help = "specialized: a shader variant per mode; uniform: one shader that branches on the features of the tile",
             .choices = branch_kinds}),
        param<&TiledParams::force>(
            {.name = "force",
             .low = 0,
             .high = 65535,
             .fallback = 0,
             .help = "feature bits added to every tile, to measure what a feature costs (light_features.shared.h)"}),
        param<&TiledParams::modes>(
            {.name = "modes",
             .low = 1,
             .high = 16,
             .fallback = 8,
             .help =
                 "number of shading modes (shader variants) from mode_0 on; if none has all features, one more that has them"}),
    };
    const std::vector<Param> modes = mode_rows();
    rows.insert(rows.end(), modes.begin(), modes.end());
    return rows;
}

std::vector<Counter> counters() {
    return {
        counter<&TiledCounters::tiles>({.name = "tiles", .help = "tiles of 16x16 pixels"}),
        counter<&TiledCounters::empty_tiles>({.name = "empty tiles", .help = "tiles with nothing to light"}),
        counter<&TiledCounters::lights_touching>(
            {.name = "lights touching", .help = "lights that reach a tile, summed over tiles"}),
        counter<&TiledCounters::lights_kept>({.name = "lights kept", .help = "lights that a tile shades, summed over tiles"}),
        counter<&TiledCounters::lights_killed>(
            {.name = "lights killed", .help = "lights that a blocker hides from a whole tile, summed over tiles"}),
        counter<&TiledCounters::portals_none>(
            {.name = "portals none", .help = "(light, portal) pairs that let no light into the tile"}),
        counter<&TiledCounters::portals_partial>(
            {.name = "portals partial", .help = "(light, portal) pairs that the tile's pixels test"}),
        counter<&TiledCounters::portals_full>(
            {.name = "portals full", .help = "(light, portal) pairs that let light into the whole tile"}),
        counter<&TiledCounters::blockers_none>(
            {.name = "blockers none", .help = "(light, blocker) pairs that shadow nothing of the tile"}),
        counter<&TiledCounters::blockers_partial>(
            {.name = "blockers partial", .help = "(light, blocker) pairs whose shadow has an edge in the tile"}),
        counter<&TiledCounters::blockers_full>(
            {.name = "blockers full", .help = "(light, blocker) pairs that shadow the whole tile"}),
        counter<&TiledCounters::tiles_over_lights>(
            {.name = "tiles over lights", .help = "tiles with more than 64 lights: shaded in batches, or cut (overflow)"}),
        counter<&TiledCounters::tiles_over_blocker_pairs>(
            {.name = "tiles over blocker pairs",
             .help = "tiles with more than 256 (light, blocker) pairs in a batch: pixels test the rest"}),
        counter<&TiledCounters::tiles_over_portal_pairs>(
            {.name = "tiles over portal pairs",
             .help = "tiles with more than 256 (light, portal) pairs in a batch: pixels test the rest"}),
        counter<&TiledCounters::tiles_testing_pixels>(
            {.name = "tiles testing pixels", .help = "tiles whose pixels test at least one blocker"}),
        counter<&TiledCounters::unlisted_tiles>(
            {.name = "unlisted tiles",
             .help = "tiles without memory for their list: shaded with all further lights, without culling"}),
        counter<&TiledCounters::most_lights>({.name = "most lights", .help = "largest number of lights that reach one tile"}),
        counter<&TiledCounters::most_blocker_pairs>(
            {.name = "most blocker pairs", .help = "largest number of (light, blocker) pairs in a batch"}),
        counter<&TiledCounters::most_portal_pairs>(
            {.name = "most portal pairs", .help = "largest number of (light, portal) pairs in a batch"}),
        counter<&TiledCounters::modes_compiled>(
            {.name = "modes compiled", .help = "shading modes compiled for this frame: those that a tile may need"}),
        counter<&TiledCounters::modes_used>({.name = "modes used", .help = "shading modes that at least one tile uses"}),
        counter<&TiledCounters::tiles_unserved>(
            {.name = "tiles unserved", .help = "tiles that need a feature no compiled mode has", .is_fatal = true}),
        counter<&TiledCounters::samples_shaded>(
            {.name = "samples_shaded", .help = "samples with a lit surface, plain pixels counted once"}),
        counter<&TiledCounters::evaluations>({.name = "evaluations", .help = "listed lights, summed over samples shaded"}),
        counter<&TiledCounters::blocker_tests>(
            {.name = "blocker tests", .help = "(light, blocker) pairs tested, summed over samples shaded"}),
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
            "Lists the lights of each 16x16-pixel tile, drops those that blockers hide from all of it, and shades it with a "
            "shader variant of few unneeded features. Exact; slow where depth jumps within a tile.",
        .params = params(),
        .variants = {"modes=1", "modes=16", "branches=uniform", "classify=off", "half_z=off", "prefilter=on", "shadows=inline",
                     "blockers=tile_only", "overflow=drop"},
        .counters = counters(),
        .counter_bytes = sizeof(TiledCounters),
        .views = tiled_views(),
        .tables = tiled_tables(),
        .abilities = {.variants = ShaderVariants{.constant = "mode", .view = "mode numbers", .table = "modes"},
                      .feature_modes =
                          FeatureModes{.table = "spectra", .constant = "mode_features", .count = "modes", .modes = mode_names}},
        .claims = {.ratios = tiled_ratios(), .tables = tiled_published_tables()},
        .declare = declare,
        .model = tiled_model,
        .model_is = ModelKind::mirror,
        .tolerance = shaded_light_tolerance};
}

}  // namespace strata::lighting
