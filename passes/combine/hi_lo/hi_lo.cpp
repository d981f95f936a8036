// Combine and develop: linear color per sample at `combine`, display light at `film`, after everything was drawn over it.
#include <algorithm>

#include "capture_format/frame/frame.h"
#include "passes/choice_names.h"
#include "passes/combine/hi_lo/hi_lo.shared.h"
#include "passes/combine/hi_lo/hi_lo_params.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/lighting/material_table.h"
#include "passes/shaders/scene/view.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::combine {

ImageSet hi_lo_model(const StageInput&, const Settings&);

namespace {

constexpr auto resolves = choice_names(
    {{resolve_tone_mapped, "tone_mapped"}, {resolve_linear, "linear"}, {resolve_weighted, "weighted"}, {resolve_lo_hi, "lo_hi"}});
constexpr auto fogs = choice_names({{fog_exponential, "exponential"}, {fog_linear, "linear"}});
constexpr auto fog_distances =
    choice_names({{fog_by_view_depth, "view_depth"}, {fog_by_distance, "distance"}, {fog_as_recorded, "recorded"}});
constexpr auto hemispheres = choice_names({{hemisphere_recorded, "recorded"}, {hemisphere_table, "table"}});
constexpr auto fog_skies = choice_names({{fog_sky_apart, "apart"}, {fog_sky_blended, "blended"}});

LinearFog linear_fog(const Frame& frame, const HiLoParams& params) {
    const float length = std::max(params.fog_far - params.fog_near, least_fog_length);
    return {.factor = frame.fog.density / length, .offset = -params.fog_near / length};
}

void add_color(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<HiLoParams>();
    frame.color = graph.create("color", {.extent = frame.extent, .format = Format::rgba32f, .layers = frame.samples});
    // Where nothing opaque is drawn there is a background alone, and nothing to read.
    const bool has_surfaces = frame.emission && frame.all_opaque.count > 0;
    const FrameImages read = has_surfaces ? frame : FrameImages{};
    const bool has_table = has_surfaces && params.hemisphere == hemisphere_table && frame.features->has(Feature::hemisphere);
    const Image table = has_table ? lighting::material_table(graph) : Image{};
    sample_edges(sample_gbuffer(graph.compute("combine/hi_lo/combine.comp"), read), read)
        .samples("emission", read.emission)
        .samples("light", read.light)
        .samples("occlusion", read.occlusion)
        .samples("indirect", read.indirect)
        .samples("shafts", read.shafts)
        .stores("color", frame.color)
        .fixes("has_surfaces", has_surfaces ? 1u : 0u)
        .fixes("has_light", read.light ? 1u : 0u)
        .fixes("has_occlusion", read.occlusion ? 1u : 0u)
        .fixes("has_indirect", read.indirect ? 1u : 0u)
        .fixes("has_shafts", read.shafts ? 1u : 0u)
        .samples("material_table", table)
        .fixes("hemisphere", has_table ? hemisphere_table : hemisphere_recorded)
        .fixes("has_fog", frame.features->has(Feature::fog) ? 1u : 0u)
        .fixes("fog", params.fog)
        .fixes("fog_distance", params.fog_distance)
        .fixes("fog_sky", params.fog_sky)
        .push(linear_fog(*frame.recorded, params))
        .over({frame.extent.width, frame.extent.height, frame.samples});
}

void add_display(Graph& graph, FrameImages& frame, const Settings& settings) {
    std::uint32_t resolve = settings.as<HiLoParams>().resolve;
    if (frame.samples == 1 && resolve != resolve_lo_hi) resolve = resolve_tone_mapped;  // one sample is its own mean
    frame.display = graph.create("display", {.extent = frame.extent, .format = Format::rgba16f});
    graph.compute("combine/hi_lo/film.comp")
        .samples("color", frame.color)
        .samples("exposure", frame.exposure)
        .stores("display", frame.display)
        .fixes("resolve", resolve)
        .fixes("has_exposure", frame.exposure ? 1u : 0u)
        .over(frame.extent);
}

Image highlights(Graph& graph, FrameImages& frame, const Settings&) {
    Image picture = graph.create("highlights", {.extent = frame.extent, .format = Format::rgba32f});
    graph.compute("combine/hi_lo/highlights.comp").samples("color", frame.color).stores("picture", picture).over(frame.extent);
    return picture;
}

std::vector<Param> params() {
    return {
        param<&HiLoParams::resolve>(
            {.name = "resolve",
             .low = 0,
             .high = resolve_lo_hi,
             .fallback = resolve_tone_mapped,
             .help = "resolve of samples: mean after or before the tone curve, weighted mean, or mean after it in 8 bits",
             .choices = resolves}),
        param<&HiLoParams::fog>({.name = "fog",
                                 .fallback = fog_exponential,
                                 .help = "fog's share of an opaque surface: exponential, or a ramp between fog_near and fog_far",
                                 .choices = fogs}),
        param<&HiLoParams::fog_distance>(
            {.name = "fog_distance",
             .low = 0,
             .high = fog_as_recorded,
             .fallback = fog_as_recorded,
             .help = "path length of fog before opaque surfaces: view depth, distance from the eye, or what the capture records",
             .choices = fog_distances}),
        param<&HiLoParams::fog_sky>(
            {.name = "fog_sky",
             .fallback = fog_sky_apart,
             .help = "what thick fog ends as: its own color, or blended into the background by the square of its share",
             .choices = fog_skies}),
        param<&HiLoParams::fog_near>({.name = "fog_near",
                                      .low = 0,
                                      .high = 5,
                                      .fallback = 0,
                                      .help = "where linear fog begins, in mean free paths (1 / recorded density); fog=linear"}),
        param<&HiLoParams::fog_far>(
            {.name = "fog_far",
             .low = 0.1,
             .high = 10,
             .fallback = 2,
             .help = "where linear fog hides everything, in mean free paths; larger: thinner fog; fog=linear"}),
        param<&HiLoParams::hemisphere>({.name = "hemisphere",
                                        .fallback = hemisphere_recorded,
                                        .help = "light of sky and ground: as recorded, or through an 8-bit table of four "
                                                "materials (X-Ray)",
                                        .choices = hemispheres})};
}

}  // namespace

Technique hi_lo() {
    return {.stage = Stage::combine,
            .name = "combine/hi_lo",
            .title = "Hemisphere light, fog, tone curve per sample",
            .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009",
            .summary =
                "Adds emission, light and hemisphere light, applies fog, tone maps every sample and averages; per channel, so "
                "that bright saturated colors turn white.",
            .params = params(),
            .variants = {"resolve=linear", "resolve=weighted", "resolve=lo_hi", "fog=linear", "fog_distance=view_depth",
                         "fog_distance=distance", "fog=linear fog_distance=distance fog_sky=blended", "hemisphere=table"},
            .views = {{.name = "highlights",
                       .help = "the 8-bit target Hi of the original: a ninth of the exposed radiance, clipped at 9",
                       .declare = highlights}},
            .abilities = {.is_time_unit = true},
            .declare = add_color,
            .at_other_stages = {{.at = Stage::film, .declare = add_display}},
            .model = hi_lo_model,
            .tolerance = {
                .rmse = 1e-3,
                .worst = 2e-3,
                .because = "display light is stored as half floats of undefined rounding, 2^-10 of itself; color is float"}};
}

}  // namespace strata::combine
