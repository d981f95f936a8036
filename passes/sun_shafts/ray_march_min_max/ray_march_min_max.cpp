// Sun shafts by the same march, where bounds of blocks of the shadow map answer most steps.
#include <algorithm>
#include <span>

#include "passes/scene/scene_facts.h"
#include "passes/sun_shafts/march.h"

namespace strata::sun_shafts {

ImageSet ray_march_min_max_model(const StageInput&, const Settings&);

namespace {

/// One texel of the bounds answers a step that reads no texel farther than `reach` from its own.
SunBounds bounds_of_sun(Graph& graph, const FrameImages& frame, std::uint32_t taps) {
    SunBounds bounds{.settings = {.form = BoundsForm::extremes, .block = 4, .reach = taps == taps_1 ? 0u : 1u}};
    if (!has_sun_maps(frame)) return bounds;
    const auto allocation = static_cast<Allocation>(frame.shadow_filter.allocation);
    const std::span<const ShadowView> views = frame.facts->shadow_views(allocation);
    const auto end = std::ranges::find_if(views, [](const ShadowView& view) { return view.light != 0; });
    const auto cascades = static_cast<std::size_t>(end - views.begin());
    bounds.image = add_shadow_bounds(graph, frame.shadow_maps, views.first(cascades), bounds.settings);
    return bounds;
}

MarchShader shader_of(Graph& graph, const FrameImages& frame, const Settings& settings) {
    return {.name = "sun_shafts/ray_march_min_max/march.comp",
            .bounds = bounds_of_sun(graph, frame, settings.as<MarchParams>().taps)};
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

std::vector<DebugView> views() {
    std::vector<DebugView> views = march_views();
    views.push_back({.name = "decided steps",
                     .help = "share of each ray's steps that bounds decide, so that the shadow map is not read",
                     .declare = show_decided_steps});
    return views;
}

Claims claims() {
    const auto against = [](std::string_view name, std::string_view settings, std::string_view plain) {
        return TimeRatio{.name = name,
                         .of = settings,
                         .against = plain,
                         .scenario = "beams",
                         .counters = {"steps", "fetches", "bounds", "skipped"}};
    };
    return {.ratios = {against("16 steps, against a lookup at each", "shaft_steps=16", "ray_march shaft_steps=16"),
                       against("32 steps, against a lookup at each", "", "ray_march"),
                       against("64 steps, against a lookup at each", "shaft_steps=64", "ray_march shaft_steps=64")}};
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
        .params = march_params(),
        .points = {"shaft_steps=16", "shaft_steps=64", "shaft_taps=1", "shaft_resolution=half"},
        .counters = {counter<&MarchCounters::rays>({.name = "rays", .help = "rays marched"}),
                     counter<&MarchCounters::steps>({.name = "steps", .help = "steps of all rays"}),
                     counter<&MarchCounters::fetches>({.name = "fetches", .help = "texels of shadow maps read by all steps"}),
                     counter<&MarchCounters::bounds>({.name = "bounds", .help = "bounds of blocks read by all steps"}),
                     counter<&MarchCounters::skipped>(
                         {.name = "skipped", .help = "steps that bounds decide without a fetch of the map"})},
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
