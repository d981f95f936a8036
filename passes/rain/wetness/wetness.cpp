// Wet surfaces: a rain map along the rain's direction, and the G-buffer's surfaces with water on them.
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "passes/choice_names.h"
#include "passes/culling/draw_command.shared.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/gbuffer/surfaces.h"
#include "passes/rain/look.h"
#include "passes/rain/wetness/weather.h"
#include "passes/scene/map_casters.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/readers.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::rain {

ImageSet wetness_model(const StageInput&, const Settings&);

namespace {

constexpr std::string_view map_sizes[] = {"64", "128", "256", "512", "1024", "2048"};
constexpr auto jitters = choice_names({{jitter_none, "none"}, {jitter_world, "world"}});
constexpr auto caster_choices = choice_names({{casters_all, "all"}, {casters_fixed, "fixed"}});
constexpr auto beyond_choices = choice_names({{beyond_open, "open"}, {beyond_dry, "dry"}});
constexpr auto forms = choice_names({{form_porosity, "porosity"}, {form_xray, "xray"}});
constexpr std::string_view map_name = "rain map", records_name = "places of rain maps";

/// One for each direction of the rain.
std::vector<RainMap> maps_of(const FrameImages& frame, const WetnessParams& params) {
    std::vector<BoundingSphere> casters;
    for (const std::uint32_t draw : frame.facts->lists().casters) casters.push_back(frame.facts->bounds().spheres[draw]);
    const RainMapShape shape{
        .size = smallest_map << params.map_size, .radius = double(params.radius), .reach = double(params.reach)};
    const double spread = glm::radians(double(params.spread));
    std::vector<RainMap> maps;
    for (const glm::dvec3& along : rain_directions(glm::dvec3(frame.recorded->rain.direction), params.directions, spread))
        maps.push_back(rain_map_along(along, *frame.recorded, casters, shape));
    return maps;
}

/// Runs of the casters that keep rain away.
std::vector<DrawList> caster_runs(const FrameImages& frame, std::uint32_t which) {
    if (which == casters_all) return {frame.casters};
    std::vector<DrawList> runs;
    std::uint32_t place = 0, last = 0;
    for (const std::uint32_t draw : frame.facts->lists().casters) {
        const bool stays = frame.recorded->draws[draw].mobility == Mobility::fixed;
        if (stays && (runs.empty() || last != place)) {
            runs.push_back(frame.casters);
            runs.back().first = frame.casters.first + place;
            runs.back().count = 0;
        }
        ++place;
        if (!stays) continue;
        ++runs.back().count;
        last = place;
    }
    return runs;
}

/// Where several maps lie; one is told by push constants.
void keep_records(Graph& graph, const std::vector<RainMap>& maps, const WetnessParams& params) {
    if (maps.size() == 1) return;
    const auto count = static_cast<std::uint32_t>(maps.size());
    Image records = graph.create(std::string(records_name), {.extent = {4, count}, .format = Format::rgba32f});
    for (std::uint32_t i = 0; i < count; ++i) {
        ComputeStep keep = graph.compute("rain/wetness/record.comp");
        i == 0 ? keep.stores("records", records) : keep.updates("records", records);
        keep.push(RecordPush{.map = record_of(maps[i], params), .place = i}).groups({1, 1, 1});
    }
}

/// Looks from a rain map as from a shadow map: to u and v from 0 to 1, and depth.
ShadowView as_shadow_map(const RainMap& map, std::uint32_t size) {
    const glm::dvec4 one(0, 0, 0, 1);
    return {.view_to_map = glm::transpose(glm::dmat4(map.u / double(size), map.v / double(size), map.depth, one)),
            .size = size,
            .read_from = -std::numeric_limits<double>::infinity(),
            .range_end = std::numeric_limits<double>::infinity()};
}

/// Taps lie within a disc around the receiver, which is moved out by no more than that.
std::optional<MapPart> part_of(const FrameImages& frame, const ShadowView& view, const WetnessParams& params) {
    if (frame.makes_unused) return MapPart{{0, view.size}, {0, view.size}};
    return read_part(frame.facts->readers(), view, {}, 2 * static_cast<std::uint32_t>(std::ceil(params.radius)) + 4);
}

/// Commands of a run of casters, without instances for those that the part of the map does not see.
DrawList seen_casters(Graph& graph, const DrawList& run, const ShadowView& view, const MapPart& part) {
    DrawList seen = run;
    seen.commands = graph.create("commands of casters of rain", run.count * sizeof(DrawCommand));
    seen.first = 0;
    graph.compute("rain/wetness/casters.comp")
        .loads("AllCommands", run.commands)
        .stores("Commands", seen.commands)
        .push(casters_push(view, part, run))
        .over({run.count});
    return seen;
}

void draw_map(Graph& graph, const FrameImages& frame, const WetnessParams& params, const RainMap& map, Image& layers,
              Part layer) {
    const std::uint32_t size = smallest_map << params.map_size;
    const ShadowView view = as_shadow_map(map, size);
    const auto part = part_of(frame, view, params);
    if (!part) return;
    for (const DrawList& run : caster_runs(frame, params.casters)) {
        if (run.count == 0) continue;
        DrawStep cast = graph.draw("rain/wetness/cast", frame.makes_unused ? run : seen_casters(graph, run, view, *part));
        fix_materials(cast, frame, Surfaces::opaque)
            .writes_depth(layers, layer)
            .within({size, size})
            .in_columns(part->columns)
            .in_rows(part->rows)
            .push(RainMapPush{.view_to_map = glm::mat4(to_clip(view))});
    }
}

void draw_maps(Graph& graph, const FrameImages& frame, const WetnessParams& params, const std::vector<RainMap>& maps) {
    const std::uint32_t size = smallest_map << params.map_size;
    const auto count = static_cast<std::uint32_t>(maps.size());
    Image layers = graph.create(std::string(map_name), {.extent = {size, size}, .format = Format::d32f, .layers = count});
    graph.clear(layers, {});
    const std::vector<std::uint32_t> used = used_products(graph, frame, count, [&](std::uint32_t i) {
        return Product{.name = fmt::format("rain map {}", i),
                       .is_used = frame.facts->readers().has_surfaces(),
                       .unused_because = "no surface is in view"};
    });
    for (const std::uint32_t i : used) draw_map(graph, frame, params, maps[i], layers, count > 1 ? Part{.layer = i} : Part{});
    keep_records(graph, maps, params);
}

/// Binds the maps in a step whose shader includes passes/rain/wetness/lookup.glsl.
ComputeStep read_maps(Graph& graph, ComputeStep builder, const WetnessParams& params) {
    return builder.samples("rain_map", graph.find_image(map_name))
        .samples("records", graph.find_image(records_name))
        .fixes("directions", params.directions)
        .fixes("map_size", static_cast<std::int32_t>(smallest_map << params.map_size))
        .fixes("jitter", params.jitter)
        .fixes("radius", params.radius);
}

/// The wet G-buffer, written beside the dry one: an image cannot be read and written in one step.
void wet_surfaces(Graph& graph, FrameImages& frame, const WetnessParams& params, const WetnessPush& push) {
    const bool has_third = bool(frame.gbuffer2);
    const auto like = [&](const char* name, const Image& dry) { return graph.create(name, graph.shape(dry)); };
    Image wet0 = like("gbuffer0", frame.gbuffer0), wet1 = like("gbuffer1", frame.gbuffer1);
    Image wet2 = has_third ? like("gbuffer2", frame.gbuffer2) : Image{};
    ComputeStep builder = graph.compute(has_third ? "rain/wetness/wet_three.comp" : "rain/wetness/wet_two.comp");
    read_maps(graph, sample_edges(sample_gbuffer(builder, frame), frame), params)
        .stores("wet0", wet0)
        .stores("wet1", wet1)
        .fixes("form", params.form)
        .fixes("wet_albedo", params.albedo)
        .fixes("wet_gloss", params.gloss)
        .fixes("ripple_height", params.ripple_height * 1e-3f)
        .fixes("flow_height", params.flow_height * 1e-3f)
        .fixes("puddles", params.puddles)
        .fixes("reach", params.reach)
        .fixes("fade_begin", params.reach * params.fade)
        .fixes("beyond", params.beyond)
        .fixes("ripple_filter", params.ripple_filter)
        .push(push)
        .over({frame.extent.width, frame.extent.height, frame.samples});
    if (has_third) builder.stores("wet2", wet2);
    frame.gbuffer0 = wet0;
    frame.gbuffer1 = wet1;
    frame.gbuffer2 = wet2;
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    const Rain& rain = frame.recorded->rain;
    if (rain.intensity <= 0 && rain.wetness <= 0) return;  // the stage was forced
    const auto params = settings.as<WetnessParams>();
    const std::vector<RainMap> maps = maps_of(frame, params);
    draw_maps(graph, frame, params, maps);
    wet_surfaces(graph, frame, params, weather_push(*frame.recorded, maps.front(), params));
    gbuffer::add_surfaces(graph, frame);
}

Image show(Graph& graph, const FrameImages& frame, const Settings& settings, std::uint32_t shows_map) {
    const auto params = settings.as<WetnessParams>();
    Image picture = graph.create("shown rain", {.extent = frame.extent, .format = Format::rgba32f});
    read_maps(graph, sample_gbuffer(graph.compute("rain/wetness/show.comp"), frame), params)
        .stores("picture", picture)
        .fixes("shows_map", shows_map)
        .push(weather_push(*frame.recorded, maps_of(frame, params).front(), params))
        .over(frame.extent);
    return picture;
}

Image show_map(Graph& graph, FrameImages& frame, const Settings& settings) { return show(graph, frame, settings, 1); }

Image show_arriving(Graph& graph, FrameImages& frame, const Settings& settings) { return show(graph, frame, settings, 0); }

std::string_view approximates(const Settings& settings) {
    const auto params = settings.as<WetnessParams>();
    if (params.directions > 1) return params.form == form_xray ? xray_wind_truth_name : wind_truth_name;
    return params.form == form_xray ? xray_truth_name : std::string_view();
}

std::vector<Param> map_params() {
    return {
        param<&WetnessParams::map_size>(
            {.name = "rain_map_size",
             .group = "rain map",
             .fallback = 4,
             .help = "texels along an edge of the rain map; more: finer edges of dry areas, more memory",
             .choices = map_sizes}),
        param<&WetnessParams::radius>(
            {.name = "rain_radius",
             .low = 0,
             .high = 16,
             .fallback = 2,
             .help = "radius in texels of the disc that four taps sample; larger: softer edges of dry areas"}),
        param<&WetnessParams::jitter>({.name = "rain_jitter",
                                       .fallback = jitter_world,
                                       .help = "places of the taps: random in the disc and fixed to the world, or half a texel "
                                               "aside (none), with visible blocks",
                                       .choices = jitters}),
        param<&WetnessParams::casters>({.name = "rain_casters",
                                        .fallback = casters_all,
                                        .help = "draws that keep rain away: all shadow casters, or only those of fixed mobility",
                                        .choices = caster_choices}),
        param<&WetnessParams::bias>({.name = "rain_bias",
                                     .low = 0,
                                     .high = 1,
                                     .fallback = 0.05,
                                     .help = "meters by which a caster must lie above a surface to keep rain away"}),
        param<&WetnessParams::reach>({.name = "rain_reach",
                                      .low = 5,
                                      .high = 200,
                                      .fallback = 40,
                                      .help = "view depth in meters that the map covers; more: coarser texels"}),
        param<&WetnessParams::fade>({.name = "rain_fade",
                                     .low = 0,
                                     .high = 0.95,
                                     .fallback = 0.5,
                                     .help = "share of rain_reach at which the map begins to fade out"}),
        param<&WetnessParams::beyond>({.name = "rain_beyond",
                                       .fallback = beyond_open,
                                       .help = "surfaces beyond rain_reach: open are rained on; dry never are (X-Ray)",
                                       .choices = beyond_choices})};
}

std::vector<Param> look_params() {
    constexpr Look usual;
    return {param<&WetnessParams::form>(
                {.name = "wet_form",
                 .group = "water",
                 .fallback = usual.form,
                 .help = "rule that darkens wet surfaces: by porosity, which roughness tells, or by brightness (X-Ray)",
                 .choices = forms}),
            param<&WetnessParams::albedo>(
                {.name = "wet_albedo",
                 .low = 0.1,
                 .high = 1,
                 .fallback = usual.albedo,
                 .help = "base color of a soaked porous surface relative to its dry one (wet_form=porosity)"}),
            param<&WetnessParams::gloss>({.name = "wet_gloss",
                                          .fallback = usual.gloss,
                                          .help = "1 - roughness of a soaked porous surface (wet_form=porosity)"}),
            param<&WetnessParams::ripple_height>({.name = "ripple_height",
                                                  .low = 0,
                                                  .high = 10,
                                                  .fallback = usual.ripple_height * 1e3,
                                                  .help = "height in millimeters of the rings that drops make; 0: no rings"}),
            param<&WetnessParams::flow_height>({.name = "flow_height",
                                                .low = 0,
                                                .high = 10,
                                                .fallback = usual.flow_height * 1e3,
                                                .help = "height in millimeters of streams that run down walls; 0: no streams"}),
            param<&WetnessParams::puddles>({.name = "puddles",
                                            .fallback = usual.puddles,
                                            .help = "how much of a level floor is under water at full wetness; 0: no puddles"}),
            param<&WetnessParams::ripple_filter>(
                {.name = "ripple_filter",
                 .fallback = 1,
                 .help = "fades rings and streams where a pixel is wider than they are; off: they sparkle in the distance",
                 .choices = switches})};
}

std::vector<Param> wind_params() {
    return {param<&WetnessParams::directions>({.name = "rain_directions",
                                               .group = "wind",
                                               .low = 1,
                                               .high = most_directions,
                                               .fallback = 1,
                                               .help = "number of rain maps, tilted around the recorded direction as in a "
                                                       "turning wind; more: smoother borders, more memory"}),
            param<&WetnessParams::spread>(
                {.name = "rain_spread",
                 .low = 0,
                 .high = 45,
                 .fallback = wind_spread,
                 .help = "tilt in degrees of the directions from the recorded one (rain_directions above 1)"})};
}

std::vector<Param> params() {
    std::vector<Param> rows = map_params();
    for (const std::vector<Param>& more : {look_params(), wind_params()}) rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

Claims claims() {
    const auto ratio = [](std::string_view name, std::string_view of, std::string_view against) {
        return TimeRatio{
            .name = name, .of = of, .against = against, .scenario = "roof_in_rain", .counters = {"looked_up", "wet"}};
    };
    return {.ratios = {ratio("a map of 2048 texels, against 256", "rain_map_size=2048", "rain_map_size=256"),
                       ratio("maps of five directions, against one", "rain_directions=5", ""),
                       ratio("rings, streams and puddles, against none", "", "ripple_height=0 flow_height=0 puddles=0")}};
}

}  // namespace

Technique wetness() {
    return {
        .stage = Stage::rain,
        .name = "rain/wetness",
        .title = "Wet surfaces under a rain map",
        .source =
            "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, a showcase for Direct3D 10.0/1, GDC 2009; porosity "
            "from roughness: Lagarde, Water drop 3b, 2013",
        .summary =
            "Darkens and smooths surfaces that a map of the rain reaches, with rings, streams and puddles; edges of dry areas "
            "are as wide as the lookup, and low shelters near walls are missed.",
        .params = params(),
        .variants = {"rain_map_size=64",   "rain_map_size=256",
                     "rain_map_size=512",  "rain_map_size=2048",
                     "rain_radius=0",      "rain_radius=4",
                     "rain_radius=8",      "rain_jitter=none",
                     "rain_casters=fixed", "rain_beyond=dry rain_reach=20 rain_fade=0.25",
                     "wet_form=xray",      "wet_form=xray puddles=0",
                     "ripple_height=0",    "flow_height=0",
                     "puddles=0",          "puddles=1",
                     "ripple_filter=off",  "rain_directions=3",
                     "rain_directions=5",  "rain_directions=8"},
        .counters =
            {counter<&WetnessCounters::looked_up>(
                 {.name = "looked_up", .help = "samples for which the rain map was looked up, one for all of a plain pixel"}),
             counter<&WetnessCounters::sheltered>({.name = "sheltered", .help = "of these, those that no tap found open"}),
             counter<&WetnessCounters::partly>({.name = "partly", .help = "of these, those that some taps found open"}),
             counter<&WetnessCounters::wet>({.name = "wet", .help = "samples whose surface was written wet"})},
        .counter_bytes = sizeof(WetnessCounters),
        .views =
            {{.name = "arriving rain",
              .help = "share of rain that arrives at each pixel's first sample, with normals as the waves have left them",
              .declare = show_arriving},
             {.name = "rain map",
              .help = "rain map of the first direction, a square in the middle: brighter is nearer to where the rain comes from, "
                      "black is where nothing shelters",
              .declare = show_map}},
        .abilities = {.is_time_unit = true},
        .claims = claims(),
        .declare = declare,
        .approximates = approximates,
        .model = wetness_model,
        .tolerance = {
            .rmse = 2e-4,
            .worst = 0.03,
            .because = "normals are off by 1e-4, as the layout rounds them; base color and roughness are stored in 8 bits, and a "
                       "float on a rounding boundary takes the next code: 1/255 is .024 of a puddle's roughness"}};
}

}  // namespace strata::rain
