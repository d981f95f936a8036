// Declares the march: one ray per sample, or one per 2 x 2 pixels and an upsampling.
#include "passes/sun_shafts/march.h"

#include <algorithm>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "passes/choice_names.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/sun_shafts/march_params.h"
#include "passes/sun_shafts/truths.h"

namespace strata::sun_shafts {
namespace {

constexpr auto tap_counts = choice_names({{taps_1, "1"}, {taps_4, "4"}});
constexpr auto steppings = choice_names({{stepping_stratified, "stratified"}, {stepping_xray, "xray"}});
constexpr auto jitters = choice_names({{jitter_none, "none"},
                                       {jitter_interleaved_gradient, "interleaved_gradient"},
                                       {jitter_hash, "hash"},
                                       {jitter_interleaved, "interleaved"}});
constexpr auto resolutions = choice_names({{resolution_full, "full"}, {resolution_half, "half"}});
constexpr auto extinctions = choice_names({{extinction_integrated, "integrated"}, {extinction_sampled, "sampled"}});
constexpr auto normalizations = choice_names({{normalization_physical, "physical"}, {normalization_steps, "steps"}});
constexpr auto phases =
    choice_names({{phase_isotropic, "isotropic"}, {phase_xray, "xray"}, {phase_henyey_greenstein, "henyey_greenstein"}});
constexpr std::string_view asymmetries[] = {"0.2", "0.4", "0.6", "0.8"};
static_assert(std::size(asymmetries) == phase_asymmetries.size());
constexpr auto cascade_rules = choice_names({{cascade_of_step, "of_step"}, {cascade_last, "last"}});

glm::dvec3 to_sun(const Frame& frame) { return -(frame.view.to_view * glm::normalize(glm::dvec3(frame.sun.direction))); }

/// X-Ray's factor by the angle between the view's axis and the way to the sun (docs/algorithms/deferred.md 6.2).
double view_factor(const Frame& frame) { return 0.8 * (0.5 * to_sun(frame).z + 0.5) + 0.2; }

MarchPush push_of(const Frame& frame, const MarchParams& params) {
    const double near = double(frame.view.near);
    double share = params.phase == phase_xray ? view_factor(frame) : 1;
    share *= params.normalization == normalization_steps ? double(params.intensity) : 0.25 / std::numbers::pi;
    return {.radiance = vec3(glm::dvec3(frame.sun.irradiance) * share),
            .far = float(std::max(double(frame.sun.shadow_distance), 2 * near)),
            .to_sun = vec3(to_sun(frame)),
            .asymmetry = float(phase_asymmetries.at(params.asymmetry))};
}

/// What every step that asks where rays end is given.
ComputeStep read_rays(ComputeStep builder, const FrameImages& frame, const MarchParams& params) {
    return builder.samples("depth_layers", frame.depth_layers)
        .push(push_of(*frame.recorded, params))
        .fixes("normalization", params.normalization)
        .fixes("phase", params.phase);
}

Image upsample(Graph& graph, const FrameImages& frame, const MarchParams& params, const Image& shares) {
    const Shape shape{.extent = frame.extent, .format = Format::rgba16f, .layers = frame.samples};
    Image shafts = graph.create("shafts", shape);
    sample_edges(read_rays(graph.compute("sun_shafts/upsample.comp"), frame, params), frame)
        .samples("shares", shares)
        .stores("shafts", shafts)
        .over({shape.extent.width, shape.extent.height, shape.layers});
    return shafts;
}

Image show_lit_share(Graph& graph, FrameImages& frame, const Settings& settings) {
    Image picture = graph.create("shown lit share", {.extent = frame.extent, .format = Format::rgba32f});
    if (!frame.shafts) {
        graph.clear(picture, {});
        return picture;
    }
    read_rays(graph.compute("sun_shafts/show.comp"), frame, settings.as<MarchParams>())
        .samples("shafts", frame.shafts)
        .stores("shown", picture)
        .over(frame.extent);
    return picture;
}

/// What the march of a frame is declared with.
struct MarchWork {
    const FrameImages& frame;
    const MarchParams params;
    const MarchShader& shader;
};

/// An image that the march stores.
struct Stored {
    const char* name;
    std::uint32_t divisor = 1, layers = 1;
    std::uint32_t shows_decided = 0;  ///< 1: the share of decided steps in place of shafts
    bool keeps_share = false;         ///< the lit share in place of radiance
};

Image stored(Graph& graph, const MarchWork& work, const Stored& what) {
    const auto& [frame, params, shader] = work;
    const auto cells = [&](std::uint32_t pixels) { return (pixels + what.divisor - 1) / what.divisor; };
    const Extent extent{cells(frame.extent.width), cells(frame.extent.height)};
    Image image = graph.create(what.name, {.extent = extent, .format = Format::rgba16f, .layers = what.layers});
    ComputeStep march = read_rays(graph.compute(shader.name), frame, params);
    sample_edges(march, frame);
    if (shader.bounds) {
        fix_shadow_bounds(march, shader.bounds->settings).samples("shadow_bounds", shader.bounds->image);
        sample_bounds_nodes(march, shader.bounds->nodes);
    }
    march.samples("shadow_maps", has_sun_maps(frame) ? frame.shadow_maps : Image{})
        .stores("shafts", image)
        .fixes("steps", params.steps)
        .fixes("taps", params.taps)
        .fixes("stepping", params.stepping)
        .fixes("jitter", params.jitter)
        .fixes("extinction", params.extinction)
        .fixes("cascade", params.cascade)
        .fixes("divisor", what.divisor)
        .fixes("has_maps", has_sun_maps(frame) ? 1u : 0u)
        .fixes("allocation", frame.shadow_filter.allocation)
        .fixes("shows_decided", what.shows_decided)
        .fixes("keeps_share", what.keeps_share ? 1u : 0u)
        .fixes("segment", shader.bounds ? shader.bounds->segment : 1u)
        .over({extent.width, extent.height, what.layers});
    return image;
}

Image blur(Graph& graph, const MarchWork& work, const Image& shares) {
    const bool is_half = work.params.resolution == resolution_half;
    const Shape shape = graph.shape(shares);
    Image blurred = graph.create(is_half ? "blurred shares" : "shafts", shape);
    sample_edges(read_rays(graph.compute("sun_shafts/blur.comp"), work.frame, work.params), work.frame)
        .samples("shares", shares)
        .stores("blurred", blurred)
        .fixes("steps", work.params.steps)
        .fixes("divisor", is_half ? 2u : 1u)
        .over({shape.extent.width, shape.extent.height, shape.layers});
    return blurred;
}

}  // namespace

bool has_shafts(const FrameImages& frame) {
    const Frame& recorded = *frame.recorded;
    return recorded.sun.shafts && recorded.sun.irradiance != glm::vec3(0) && recorded.fog.density > 0 && frame.depth_layers;
}

bool has_sun_maps(const FrameImages& frame) { return frame.recorded->sun.shadow.casts && frame.shadow_maps; }

void march_shafts(Graph& graph, FrameImages& frame, const Settings& settings, const MarchShader& shader) {
    const MarchWork march{frame, settings.as<MarchParams>(), shader};
    const bool is_half = march.params.resolution == resolution_half, blurs = march.params.blur != 0;
    Image shafts = stored(graph, march,
                          {.name = is_half || blurs ? "lit shares" : "shafts",
                           .divisor = is_half ? 2u : 1u,
                           .layers = is_half ? 1 : frame.samples,
                           .keeps_share = is_half || blurs});
    if (blurs) shafts = blur(graph, march, shafts);
    if (is_half) shafts = upsample(graph, frame, march.params, shafts);
    frame.shafts = shafts;
}

Image show_decided(Graph& graph, FrameImages& frame, const Settings& settings, const MarchShader& shader) {
    const MarchWork march{frame, settings.as<MarchParams>(), shader};
    return stored(graph, march, {.name = "decided steps", .shows_decided = 1});
}

std::vector<Param> march_params() {
    return {
        param<&MarchParams::steps>({.name = "shaft_steps",
                                    .low = 8,
                                    .high = 128,
                                    .fallback = 32,
                                    .help = "steps per ray; more: less noise and fewer missed shadows, in proportion to time"}),
        param<&MarchParams::taps>(
            {.name = "shaft_taps", .fallback = taps_4, .help = "texels of the shadow map per step", .choices = tap_counts}),
        param<&MarchParams::stepping>({.name = "shaft_stepping",
                                       .fallback = stepping_stratified,
                                       .help = "places of steps: one in each stratum, or X-Ray's, from the surface to the eye",
                                       .choices = steppings}),
        param<&MarchParams::jitter>({.name = "shaft_jitter",
                                     .fallback = jitter_interleaved,
                                     .help = "offset of a pixel's steps: none, a fixed gradient, a hash of pixel and frame, or a "
                                             "4x4 pattern",
                                     .choices = jitters}),
        param<&MarchParams::resolution>({.name = "shaft_resolution",
                                         .fallback = resolution_full,
                                         .help = "half marches one of 2x2 pixels and upsamples by depth",
                                         .choices = resolutions}),
        param<&MarchParams::blur>(
            {.name = "shaft_blur",
             .fallback = 1,
             .help = "averages alike lit shares over 5x5 texels of similar depth; removes the interleaved pattern",
             .choices = switches}),
        param<&MarchParams::extinction>(
            {.name = "shaft_extinction",
             .fallback = extinction_integrated,
             .help = "weight of a step: extinction integrated over its stratum, or sampled at its place",
             .choices = extinctions}),
        param<&MarchParams::normalization>(
            {.name = "shaft_normalization",
             .fallback = normalization_physical,
             .help = "physical: scattering per meter; steps: X-Ray's mean over steps, whatever the ray's length",
             .choices = normalizations}),
        param<&MarchParams::phase>(
            {.name = "shaft_phase",
             .fallback = phase_isotropic,
             .help = "phase function: isotropic, X-Ray's factor of the angle between view axis and sun, or Henyey-Greenstein's",
             .choices = phases}),
        param<&MarchParams::cascade>({.name = "shaft_cascade",
                                      .fallback = cascade_of_step,
                                      .help = "shadow cascade of a step: that of its depth, or the last one for all",
                                      .choices = cascade_rules}),
        param<&MarchParams::intensity>(
            {.name = "shaft_intensity",
             .low = 0,
             .high = 1,
             .fallback = 0.05,
             .help = "radiance of a fully lit ray by the sun's irradiance (shaft_normalization=steps)"}),
        param<&MarchParams::asymmetry>(
            {.name = "shaft_asymmetry",
             .fallback = 2,
             .help = "mean cosine of scattering angles (shaft_phase=henyey_greenstein); higher: brighter towards the sun",
             .choices = asymmetries})};
}

std::vector<Counter> march_counters() {
    return {counter<&MarchCounters::rays>({.name = "rays", .help = "rays marched"}),
            counter<&MarchCounters::kilosteps>({.name = "kilosteps", .help = "march steps of all rays, in units of 1024"}),
            counter<&MarchCounters::kilofetches>(
                {.name = "kilofetches", .help = "shadow-map texels read by all march steps, in units of 1024"})};
}

std::vector<DebugView> march_views() {
    return {{.name = "lit share",
             .help = "share of the light scattered along each ray that shadows leave: 1 where the ray is lit throughout",
             .declare = show_lit_share}};
}

std::string_view truth_of_phase(const Settings& settings) {
    const auto params = settings.as<MarchParams>();
    if (params.phase == phase_xray) return xray_phase_truth;
    return params.phase == phase_henyey_greenstein ? asymmetric_truths.at(params.asymmetry) : std::string_view{};
}

}  // namespace strata::sun_shafts
