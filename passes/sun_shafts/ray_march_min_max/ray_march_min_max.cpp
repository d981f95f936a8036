// Sun shafts by the same march, where bounds of blocks of the shadow map answer most steps.
#include <algorithm>
#include <optional>
#include <span>

#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/sun_shafts/march.h"
#include "passes/sun_shafts/march_params.h"
#include "passes/technique.h"

namespace strata::sun_shafts {

ImageSet ray_march_min_max_model(const StageInput&, const Settings&);

namespace {

constexpr std::uint32_t widest_kernel_reach = 4;  // of 8 x 8 texels
constexpr auto bounds_choices = choice_names({{bounds_as_narrow, "as_narrow"}, {bounds_shared, "shared"}});

std::span<const ShadowView> sun_views(const FrameImages& frame) {
    const std::span<const ShadowView> views = frame.facts->shadow_views(static_cast<Allocation>(frame.shadow_filter.allocation));
    const auto end = std::ranges::find_if(views, [](const ShadowView& view) { return view.light != 0; });
    return views.first(static_cast<std::size_t>(end - views.begin()));
}

/// The bounds that the shadows' technique has built, if they answer what `wanted` would: wider windows decide less, and never
/// otherwise.
std::optional<BoundsSettings> built_bounds(const Graph& graph, const FrameImages& frame, BoundsSettings wanted,
                                           std::uint32_t widest_reach) {
    for (; wanted.reach <= widest_reach; ++wanted.reach)
        if (are_bounds(graph, frame.shadow_bounds, wanted)) return wanted;
    return std::nullopt;
}

/// One texel of the bounds answers a step that reads no texel farther than `reach` from its own.
SunBounds bounds_of_sun(Graph& graph, const FrameImages& frame, const MarchParams& params) {
    SunBounds bounds{.settings = {.form = BoundsForm::extremes, .block = 4, .reach = params.taps == taps_1 ? 0u : 1u},
                     .segment = params.segment};
    if (!has_sun_maps(frame)) return bounds;
    const std::uint32_t widest = params.bounds == bounds_shared ? widest_kernel_reach : bounds.settings.reach;
    if (const auto built = built_bounds(graph, frame, bounds.settings, widest)) {
        bounds.settings = *built;
        bounds.image = frame.shadow_bounds;
    } else {
        bounds.image = add_shadow_bounds(graph, frame.shadow_maps, sun_views(frame), bounds.settings);
    }
    if (params.segment > 1) bounds.nodes = add_bounds_nodes(graph, bounds.image, sun_views(frame), bounds.settings);
    return bounds;
}

MarchShader shader_of(Graph& graph, const FrameImages& frame, const Settings& settings) {
    return {.name = "sun_shafts/ray_march_min_max/march.comp", .bounds = bounds_of_sun(graph, frame, settings.as<MarchParams>())};
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (has_shafts(frame)) march_shafts(graph, frame, settings, shader_of(graph, frame, settings));
}

Image show_decided_steps(Graph& graph, FrameImages& frame, const Settings& settings) {
    Image picture = graph.create("shown decided steps", {.extent = frame.extent, .format = Format::rgba32f});
    if (!has_shafts(frame)) {
        graph.clear(picture, {});
        return picture;
    }
    const Image decided = show_decided(graph, frame, settings, shader_of(graph, frame, settings));
    graph.compute("sun_shafts/ray_march_min_max/show.comp")
        .samples("decided", decided)
        .stores("shown", picture)
        .over(frame.extent);
    return picture;
}

std::vector<Param> params() {
    std::vector<Param> rows = march_params();
    rows.push_back(param<&MarchParams::segment>(
        {.name = "shaft_segment",
         .low = 1,
         .high = 32,
         .fallback = 1,
         .help = "steps that coarser bounds may decide at once; 1: each step alone. The picture stays the same"}));
    rows.push_back(param<&MarchParams::bounds>({.name = "shaft_bounds",
                                                .fallback = bounds_as_narrow,
                                                .help = "min-max bounds reused from the shadow technique: only where their "
                                                        "windows are no wider than needed, or always (shared)",
                                                .choices = bounds_choices}));
    return rows;
}

std::vector<DebugView> views() {
    std::vector<DebugView> views = march_views();
    views.push_back({.name = "decided steps",
                     .help = "share of each ray's steps that bounds decide, so that the shadow map is not read",
                     .declare = show_decided_steps});
    return views;
}

std::vector<Counter> counters() {
    std::vector<Counter> rows = march_counters();
    rows.push_back(counter<&MarchCounters::kilobounds>(
        {.name = "kilobounds", .help = "min-max texels read by all march steps, in units of 1024"}));
    rows.push_back(counter<&MarchCounters::kiloskipped>(
        {.name = "kiloskipped", .help = "march steps that bounds answer without a shadow-map fetch, in units of 1024"}));
    rows.push_back(counter<&MarchCounters::kilosteps_in_segments>(
        {.name = "kilosteps_in_segments",
         .help = "march steps skipped because one lookup of bounds answers their whole segment, in units of 1024"}));
    return rows;
}

Claims claims() {
    const auto against = [](std::string_view name, std::string_view settings, std::string_view plain) {
        return TimeRatio{.name = name,
                         .of = settings,
                         .against = plain,
                         .scenario = "beams",
                         .counters = {"kilosteps", "kilofetches", "kilobounds", "kiloskipped"}};
    };
    return {.ratios = {against("16 steps, against a lookup at each", "shaft_steps=16", "ray_march shaft_steps=16"),
                       against("32 steps, against a lookup at each", "", "ray_march"),
                       against("64 steps, against a lookup at each", "shaft_steps=64", "ray_march shaft_steps=64"),
                       against("128 steps, against a lookup at each", "shaft_steps=128", "ray_march shaft_steps=128"),
                       against("128 steps in segments of 8, against a lookup at each", "shaft_steps=128 shaft_segment=8",
                               "ray_march shaft_steps=128")}};
}

}  // namespace

Technique ray_march_min_max() {
    return {
        .stage = Stage::sun_shafts,
        .name = "sun_shafts/ray_march_min_max",
        .title = "Marched sun shafts over min-max maps",
        .source =
            "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009; Chen, Baran, Durand, Jarosz: "
            "Real-Time Volumetric Shadows using 1D Min-Max Mipmaps, I3D 2011",
        .summary =
            "Skips shadow lookups where the minimum and maximum depth of a block of the map decide a step; the picture is that "
            "without bounds, to the bit. Saves little under foliage.",
        .params = params(),
        .variants = {"shaft_steps=16", "shaft_steps=64", "shaft_taps=1", "shaft_resolution=half", "shaft_segment=8",
                     "shaft_steps=128 shaft_segment=8"},
        .counters = counters(),
        .counter_bytes = sizeof(MarchCounters),
        .views = views(),
        .claims = claims(),
        .declare = declare,
        .approximates = truth_of_phase,
        .model = ray_march_min_max_model,
        .tolerance = {.rmse = 1e-3,
                      .worst = 4e-3,
                      .because = "half floats of undefined rounding in up to two images, 2^-10 each; lookups that rounding may "
                                 "turn change up to 2e-3, or are undecided"}};
}

}  // namespace strata::sun_shafts
