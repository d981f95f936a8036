// Screen-space ambient occlusion: horizons with a cosine-weighted closed form, and X-Ray's taps on rings.
#include <string_view>

#include "passes/choice_names.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/surface_at.h"
#include "passes/occlusion/radii.h"
#include "passes/occlusion/ssao/ssao.shared.h"
#include "passes/occlusion/ssao/ssao_params.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::occlusion {

ImageSet ssao_model(const StageInput&, const Settings&);

namespace {

constexpr auto forms = choice_names({{form_horizon, "horizon"}, {form_xray, "xray"}});
constexpr auto tap_counts = choice_names({{taps_8, "8"}, {taps_12, "12"}, {taps_24, "24"}, {taps_96, "96"}});
constexpr auto resolutions = choice_names({{resolution_full, "full"}, {resolution_half, "half"}});
constexpr auto edge_stops = choice_names({{edge_stop_plane, "plane"}, {edge_stop_depth, "depth"}});
constexpr auto noises = choice_names({{noise_none, "none"}, {noise_interleaved, "interleaved"}, {noise_hash, "hash"}});
constexpr auto material_rules = choice_names({{material_product, "product"}, {material_min, "min"}});

/// Directions and taps along each. A slice has taps on both sides, and few slices with many taps are better than many with few:
/// the blur averages slices of other pixels, but no average finds a missed occluder. Rings: docs/algorithms/deferred.md 8.4.
struct Kernel {
    std::uint32_t directions, steps;
};
constexpr Kernel horizon_kernels[] = {{1, 4}, {1, 6}, {2, 6}, {4, 12}};
constexpr Kernel xray_kernels[] = {{4, 2}, {4, 3}, {8, 3}, {16, 6}};

/// What the steps of a frame share.
struct Ssao {
    const FrameImages& frame;
    const SsaoParams params;

    bool is_half() const { return params.resolution == resolution_half; }
    bool blurs() const { return params.blur != 0; }
    std::uint32_t divisor() const { return is_half() ? 2 : 1; }
    /// One layer at half resolution, where the first sample of a pixel stands for all of four.
    Shape estimated() const {
        const Extent& full = frame.extent;
        const std::uint32_t d = divisor();
        return {.extent = {(full.width + d - 1) / d, (full.height + d - 1) / d},
                .format = Format::r16f,
                .layers = is_half() ? 1 : frame.samples};
    }
    Shape whole() const { return {.extent = frame.extent, .format = Format::r16f, .layers = frame.samples}; }
};

ComputeStep read_places(ComputeStep builder, const FrameImages& frame) {
    return sample_edges(sample_gbuffer(builder, frame), frame);
}

Extent threads(const Shape& shape) { return {shape.extent.width, shape.extent.height, shape.layers}; }

/// Which occlusion a step stores: the last one asks the material.
std::uint32_t rule_of(const Ssao& ssao, bool is_last) { return is_last ? ssao.params.material : material_product; }

Image estimate(Graph& graph, const Ssao& ssao, std::string_view name, bool is_last) {
    const SsaoParams& params = ssao.params;
    const bool is_xray = params.form == form_xray;
    const Kernel& kernel = (is_xray ? xray_kernels : horizon_kernels)[params.taps];
    Image visibility = graph.create(std::string(name), ssao.estimated());
    read_places(graph.compute("occlusion/ssao/estimate.comp"), ssao.frame)
        .stores("visibility", visibility)
        .push(SsaoPush{.radius = float(radii[params.radius]), .depth_error = params.depth_error, .bias = params.bias})
        .fixes("form", params.form)
        .fixes("directions", kernel.directions)
        .fixes("steps", kernel.steps)
        .fixes("noise", params.noise)
        .fixes("divisor", ssao.divisor())
        .fixes("material_rule", rule_of(ssao, is_last))
        .over(threads(ssao.estimated()));
    return visibility;
}

Image blur(Graph& graph, const Ssao& ssao, const Image& visibility, std::string_view name, bool is_last) {
    Image blurred = graph.create(std::string(name), ssao.estimated());
    read_places(graph.compute("occlusion/ssao/blur.comp"), ssao.frame)
        .samples("visibility", visibility)
        .stores("blurred", blurred)
        .fixes("divisor", ssao.divisor())
        .fixes("edge_stop", ssao.params.edge_stop)
        .fixes("material_rule", rule_of(ssao, is_last))
        .over(threads(ssao.estimated()));
    return blurred;
}

Image upsample(Graph& graph, const Ssao& ssao, const Image& visibility, std::string_view name) {
    Image occlusion = graph.create(std::string(name), ssao.whole());
    read_places(graph.compute("occlusion/ssao/upsample.comp"), ssao.frame)
        .samples("visibility", visibility)
        .stores("occlusion", occlusion)
        .fixes("edge_stop", ssao.params.edge_stop)
        .fixes("material_rule", rule_of(ssao, true))
        .over(threads(ssao.whole()));
    return occlusion;
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    constexpr std::string_view last = "occlusion";
    const Ssao ssao{frame, settings.as<SsaoParams>()};
    const bool only_estimates = !ssao.is_half() && !ssao.blurs();
    Image visibility = estimate(graph, ssao, only_estimates ? last : "estimated visibility", only_estimates);
    if (ssao.blurs()) visibility = blur(graph, ssao, visibility, ssao.is_half() ? "blurred visibility" : last, !ssao.is_half());
    if (ssao.is_half()) visibility = upsample(graph, ssao, visibility, last);
    frame.occlusion = visibility;
}

Image shown(Graph& graph, const FrameImages& frame, const Image& visibility) {
    Image picture = graph.create("shown visibility", {.extent = frame.extent, .format = Format::rgba32f});
    graph.compute("occlusion/ssao/show.comp").samples("visibility", visibility).stores("shown", picture).over(frame.extent);
    return picture;
}

Image show_occlusion(Graph& graph, FrameImages& frame, const Settings&) { return shown(graph, frame, frame.occlusion); }

Image show_estimate(Graph& graph, FrameImages& frame, const Settings& settings) {
    const Ssao ssao{frame, settings.as<SsaoParams>()};
    return shown(graph, frame, estimate(graph, ssao, "estimate to be shown", false));
}

std::string_view approximates(const Settings& settings) {
    const auto params = settings.as<SsaoParams>();
    return truth_name(params.radius, params.material == material_min ? MaterialRule::darker : MaterialRule::product);
}

std::vector<Param> params() {
    return {param<&SsaoParams::form>({.name = "ao_form",
                                      .fallback = form_horizon,
                                      .help = "estimator: cosine-weighted horizons, or X-Ray's taps on rings as published",
                                      .choices = forms}),
            param<&SsaoParams::taps>(
                {.name = "ao_taps",
                 .fallback = taps_24,
                 .help = "depth taps per estimate; more: less noise and fewer missed occluders, in proportion to time",
                 .choices = tap_counts}),
            param<&SsaoParams::radius>({.name = "ao_radius",
                                        .fallback = default_radius,
                                        .help = "distance in world space beyond which surfaces do not occlude",
                                        .choices = radius_names}),
            param<&SsaoParams::resolution>(
                {.name = "ao_resolution",
                 .fallback = resolution_full,
                 .help = "half: estimates one pixel of each 2x2 and fills the others from neighbors on the same surface",
                 .choices = resolutions}),
            param<&SsaoParams::blur>(
                {.name = "ao_blur",
                 .fallback = 1,
                 .help = "bilateral blur: averages visibility over 5x5 texels of one surface; removes interleaved noise",
                 .choices = switches}),
            param<&SsaoParams::edge_stop>({.name = "ao_edge_stop",
                                           .fallback = edge_stop_plane,
                                           .help = "surfaces that blur and upsampling mix: in one plane, or at similar depth "
                                                   "(X-Ray)",
                                           .choices = edge_stops}),
            param<&SsaoParams::noise>({.name = "ao_noise",
                                       .fallback = noise_interleaved,
                                       .help = "turns taps per pixel: a fixed 4x4 pattern, or a hash of pixel, seed and frame",
                                       .choices = noises}),
            param<&SsaoParams::material>(
                {.name = "ao_material",
                 .fallback = material_product,
                 .help = "rule that joins screen-space and material occlusion: product, or min: the darker of both",
                 .choices = material_rules}),
            param<&SsaoParams::depth_error>({.name = "ao_depth_error",
                                             .low = 1e-7,
                                             .high = 1e-2,
                                             .fallback = 1e-4,
                                             .help = "relative error of the G-buffer's depth; heights within it do not occlude",
                                             .scale = Scale::logarithmic}),
            param<&SsaoParams::bias>(
                {.name = "ao_bias",
                 .low = 0,
                 .high = 0.5,
                 .fallback = 1e-3,
                 .help = "horizon bias: sine of the elevation below which a tap does not occlude; hides errors of normals"})};
}

Claims claims() {
    const auto ratio = [](std::string_view name, std::string_view of, std::string_view against) {
        return TimeRatio{.name = name, .of = of, .against = against, .scenario = "corners", .counters = {"samples", "taps"}};
    };
    return {.ratios = {ratio("half resolution, against full", "ao_resolution=half", ""),
                       ratio("24 taps, against 8", "", "ao_taps=8"), ratio("96 taps, against 24", "ao_taps=96", ""),
                       ratio("horizons, against X-Ray's rings with as many taps", "", "ao_form=xray"),
                       ratio("with a blur, against none", "", "ao_blur=off")}};
}

}  // namespace

Technique ssao() {
    return {
        .stage = Stage::occlusion,
        .name = "occlusion/ssao",
        .title = "Screen-space ambient occlusion",
        .source =
            "Jimenez, Wu, Pesce, Jarabo: Practical Realtime Strategies for Accurate Indirect Occlusion, SIGGRAPH 2016; "
            "Lobanchikov, Gruen: S.T.A.L.K.E.R.: Clear Sky, GDC 2009 (ao_form=xray)",
        .summary =
            "Darkens ambient light by what the depth buffer shows around a pixel; surfaces off the screen or behind others "
            "do not occlude, and thin ones occlude as if they were infinitely thick.",
        .params = params(),
        .variants = {"ao_taps=8", "ao_taps=12", "ao_taps=96", "ao_taps=96 ao_blur=off", "ao_blur=off",
                     "ao_blur=off ao_noise=none", "ao_noise=hash", "ao_resolution=half", "ao_resolution=half ao_taps=8",
                     "ao_edge_stop=depth", "ao_radius=1m", "ao_radius=2m", "ao_radius=4m", "ao_material=min",
                     "ao_form=xray ao_radius=2m", "ao_form=xray ao_radius=2m ao_taps=8", "ao_form=xray ao_radius=2m ao_taps=96",
                     "ao_form=xray ao_radius=2m ao_edge_stop=depth ao_resolution=half"},
        .counters = {counter<&SsaoCounters::samples>(
                         {.name = "samples", .help = "samples for which ambient visibility was estimated from taps"}),
                     counter<&SsaoCounters::taps>({.name = "taps", .help = "depth taps read by all estimates"}),
                     counter<&SsaoCounters::out_of_reach>(
                         {.name = "out_of_reach", .help = "samples with no tap within the radius: nothing occludes them"}),
                     counter<&SsaoCounters::unfit>(
                         {.name = "unfit",
                          .help = "samples without a fitting neighbor at half resolution: the nearest is taken"})},
        .counter_bytes = sizeof(SsaoCounters),
        .views = {{.name = "ambient visibility",
                   .help = "ambient visibility of each pixel's first sample: the factor that combine applies to ambient light",
                   .declare = show_occlusion},
                  {.name = "estimated visibility",
                   .help = "ambient visibility of each pixel's first sample before blur and upsampling: shows the noise",
                   .declare = show_estimate}},
        .abilities = {.is_time_unit = true},
        .claims = claims(),
        .declare = declare,
        .approximates = approximates,
        .model = ssao_model,
        .tolerance = {.rmse = 1e-3,
                      .worst = 3e-3,
                      .because = "half floats of undefined rounding in up to three images, 5e-4 each; arc cosines of 2e-4"}};
}

}  // namespace strata::occlusion
