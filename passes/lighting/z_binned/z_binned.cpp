// Lights in bins of view depth and tiles of the screen; a sample shades the lights that both of its hold.
#include "passes/choice_names.h"
#include "passes/edges/routing/shade_samples.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/lighting/every_light.h"
#include "passes/lighting/z_binned/z_bins.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::lighting {

ImageSet z_binned_model(const StageInput&, const Settings&);

namespace {

constexpr auto spacings = choice_names({{spacing_uniform, "uniform"}, {spacing_logarithmic, "logarithmic"}});
constexpr std::string_view tiles[] = {"8", "16", "32"};
constexpr auto bounds = choice_names({{bounds_frustum, "frustum"}, {bounds_depth, "depth"}});
constexpr auto merges = choice_names({{merge_lanes, "lanes"}, {merge_subgroup, "subgroup"}});

/// To a step that walks a sample's lights.
ComputeStep bind_lists(ComputeStep builder, const FrameImages& frame, const ZBins& lists) {
    return sample_gbuffer(builder, frame)
        .samples("visibility", frame.visibility)
        .loads("Sorted", lists.sorted)
        .loads("Header", lists.header)
        .loads("Bins", lists.bins)
        .loads("Masks", lists.masks)
        .fixes("has_visibility", frame.visibility ? 1u : 0u)
        .fixes("features", frame.facts->spectrum())
        .push(lists.push);
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.gbuffer0) return;
    const auto params = settings.as<ZBinnedParams>();
    const ZBins lists = z_bins(graph, frame, params);
    frame.light = graph.create("light", {.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples});
    edges::shade_samples(graph, frame, params.routing, {"light", frame.light}, [&] {
        return bind_lists(graph.compute("lighting/z_binned/shade.comp"), frame, lists).fixes("merge", params.merge);
    });
}

template <std::uint32_t shown>
Image view(Graph& graph, FrameImages& frame, const Settings& settings) {
    const ZBins lists = z_bins(graph, frame, settings.as<ZBinnedParams>());
    Image picture = graph.create("z-bin view", {.extent = frame.extent, .format = Format::rgba32f});
    bind_lists(graph.compute("lighting/z_binned/view.comp"), frame, lists)
        .stores("number_of_lights", picture)
        .fixes("shown", shown)
        .over(frame.extent);
    return picture;
}

Image bins_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    const ZBins lists = z_bins(graph, frame, settings.as<ZBinnedParams>());
    Image numbers = graph.create("z-bin table", Shape{.extent = {1, lists.push.bins}, .format = Format::rgba32f});
    graph.compute("lighting/z_binned/bins_table.comp")
        .loads("Header", lists.header)
        .loads("Bins", lists.bins)
        .stores("numbers", numbers)
        .push(lists.push)
        .over({1, lists.push.bins});
    return numbers;
}

std::vector<TimeRatio> ratios() {
    const std::vector<std::string_view> counters = {"evaluations", "tile lights"};
    const std::string_view none = "the talk gives times of a whole game's lights, and no ratio to all lights";
    return {{.name = "64 lights: against every light on every sample",
             .of = "",
             .against = "brute_force",
             .published = {},
             .source = none,
             .scenario = "hall_of_lights_64",
             .counters = counters},
            {.name = "512 lights",
             .of = "",
             .against = "brute_force",
             .published = {},
             .source = none,
             .scenario = "hall_of_lights_512",
             .counters = counters},
            {.name = "4096 lights",
             .of = "",
             .against = "brute_force",
             .published = {},
             .source = none,
             .scenario = "hall_of_lights_4096",
             .counters = counters},
            {.name = "lanes of a subgroup apart, against together",
             .of = "merge=lanes",
             .against = "merge=subgroup",
             .published = {},
             .source = {},
             .scenario = "hall_of_lights_512",
             .counters = counters},
            {.name = "tiles by their frustum, against by their depths",
             .of = "bounds=frustum",
             .against = "bounds=depth",
             .published = {},
             .source = {},
             .scenario = "hall_of_lights_512",
             .counters = counters}};
}

}  // namespace

Technique z_binned() {
    return {
        .stage = Stage::lighting,
        .name = "lighting/z_binned",
        .title = "Z-binning",
        .source = "Drobot: Improved Culling for Tiled and Clustered Rendering, SIGGRAPH 2017 Advances in Real-Time Rendering",
        .summary =
            "Shades the lights that a sample's depth bin and screen tile have in common; sums them in the order of depth, so "
            "rounding differs from a plain loop.",
        .params =
            {param<&ZBinnedParams::bins>(
                 {.name = "bins",
                  .low = 256,
                  .high = 8192,
                  .fallback = 4096,
                  .help =
                      "slices of view depth between the nearest and the farthest light; more: fewer needless lights, more memory",
                  .scale = Scale::logarithmic}),
             param<&ZBinnedParams::spacing>(
                 {.name = "spacing",
                  .high = 1,
                  .fallback = spacing_uniform,
                  .help = "thickness of bins; uniform: all the same; logarithmic: in proportion to depth",
                  .choices = spacings}),
             param<&ZBinnedParams::tile>(
                 {.name = "tile", .high = 2, .fallback = 1, .help = "edge of a tile in pixels", .choices = tiles}),
             param<&ZBinnedParams::bounds>({.name = "bounds",
                                            .high = 1,
                                            .fallback = bounds_depth,
                                            .help = "lights on a tile's list; frustum: those that touch its frustum; depth: only "
                                                    "between its nearest and farthest surface",
                                            .choices = bounds}),
             param<&ZBinnedParams::merge>(
                 {.name = "merge",
                  .high = 1,
                  .fallback = merge_subgroup,
                  .help =
                      "loop over lights; lanes: each lane walks its own list; subgroup: all lanes walk the union of their lists",
                  .choices = merges}),
             param<&ZBinnedParams::routing>(edges::routing_row)},
        .variants = {"spacing=logarithmic", "bounds=frustum", "bins=256", "tile=32", "merge=lanes"},
        .counters = {counter<&ZBinnedCounters::evaluations>(
                         {.name = "evaluations", .help = "lights shaded, summed over samples"}),
                     counter<&ZBinnedCounters::words_read>(
                         {.name = "words_read", .help = "mask words of 32 lights read, summed over samples"}),
                     counter<&ZBinnedCounters::samples_shaded>(
                         {.name = "samples_shaded", .help = "samples with a lit surface, plain pixels counted once"}),
                     counter<&ZBinnedCounters::tile_lights>(
                         {.name = "tile lights", .help = "lights on the lists of tiles, summed over tiles"}),
                     counter<&ZBinnedCounters::unfinished>(unfinished_row)},
        .counter_bytes = sizeof(ZBinnedCounters),
        .views = {{.name = "pixel lights",
                   .help = "lights that the pixel's depth bin and tile have in common",
                   .unit = "lights",
                   .high = 64,
                   .declare = view<view_pixel_lights>},
                  {.name = "tile lights",
                   .help = "lights of the tile at all depths",
                   .unit = "lights",
                   .high = 64,
                   .declare = view<view_tile_lights>},
                  {.name = "idle lights",
                   .help = "lights of the pixel's list that add nothing to it",
                   .unit = "lights",
                   .high = 64,
                   .declare = view<view_idle_lights>}},
        .tables = {{.name = "bins",
                    .help = "depth bins: begin, end, first light in the order of depth, number of lights",
                    .columns = {{"begins", "m"}, {"ends", "m"}, {"first light", ""}, {"lights", ""}},
                    .declare = bins_table}},
        .claims = {.ratios = ratios()},
        .declare = declare,
        .model = z_binned_model,
        .tolerance = shaded_light_tolerance};
}

}  // namespace strata::lighting
