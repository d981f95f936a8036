// The lens of a camera: exposure, depth of field, distortion and bloom, each where the frame asks for it. Light is measured
// before the lens; defocus and distortion happen in the lens, and what it scatters is scattered from the picture that they made.
#include "capture_format/frame/frame.h"
#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/lens/bloom/glow.h"
#include "passes/lens/camera/views.h"
#include "passes/lens/depth_of_field/focus.h"
#include "passes/lens/distortion/radial.h"
#include "passes/lens/exposure/adaptation.h"
#include "passes/lens/lens.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::lens {

ImageSet camera_model(const StageInput&, const Settings&);

namespace {

constexpr auto exposures = choice_names({{exposure_exponential, "exponential"}, {exposure_xray, "xray"}, {exposure_off, "off"}});
constexpr auto blooms = choice_names({{bloom_pyramid, "pyramid"}, {bloom_xray, "xray"}, {bloom_off, "off"}});
constexpr auto focuses = choice_names({{focus_gather, "gather"}, {focus_xray, "xray"}, {focus_off, "off"}});
constexpr auto tap_counts =
    choice_names({{focus_taps_16, "16"}, {focus_taps_64, "64"}, {focus_taps_128, "128"}, {focus_taps_256, "256"}});
constexpr auto distortions = choice_names({{distortion_radial, "radial"}, {distortion_off, "off"}});

/// A feature may be forced on a frame that does not record it: then nothing may change.
bool adapts(const FrameImages& frame, const LensParams& params) {
    return frame.recorded->lens.auto_exposure && params.exposure != exposure_off;
}

/// Exposure goes on from the frame before: what that left is read before the stage, so that the stage's input says it.
void recall(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (adapts(frame, settings.as<LensParams>())) recall_exposure(graph, frame);
}

void expose(Graph& graph, FrameImages& frame, const LensParams& params) {
    if (adapts(frame, params)) adapt_exposure(graph, frame, params);
    else keep_exposure(graph, frame);
}

bool distorts(const FrameImages& frame, const LensParams& params) {
    return frame.recorded->lens.distortion && params.distortion != distortion_off && params.k1 != 0;
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<LensParams>();
    const Features& wanted = *frame.features;
    const Image found = frame.color;
    if (wanted.has(Feature::auto_exposure)) expose(graph, frame, params);
    if (blurs(frame, params)) blur_by_depth(graph, frame, params);
    if (distorts(frame, params)) distort(graph, frame, params);
    if (glows(frame, params)) add_bloom(graph, frame, params);
    const bool wants_color =
        wanted.has(Feature::depth_of_field) || wanted.has(Feature::lens_distortion) || wanted.has(Feature::bloom);
    if (!wants_color || frame.color != found) return;
    // Every effect is switched off: the stage still has a result, which is compared with its truth.
    Image kept = graph.create("color", graph.shape(found));
    graph.copy(found, kept);
    frame.color = kept;
}

std::vector<Param> params() {
    return {
        param<&LensParams::exposure>({.name = "exposure",
                                      .group = "exposure",
                                      .fallback = exposure_exponential,
                                      .help = "adaptation: independent of the frame rate, X-Ray's as published, or off",
                                      .choices = exposures}),
        param<&LensParams::exposure_amount>({.name = "exposure_amount",
                                             .low = 0,
                                             .high = 1,
                                             .fallback = 0.7,
                                             .help = "how far exposure follows the mean luminance; 0: not at all"}),
        param<&LensParams::exposure_grey>({.name = "exposure_grey",
                                           .low = 0.05,
                                           .high = 4,
                                           .fallback = 1,
                                           .help = "mean luminance that a fully adapted picture is brought to",
                                           .scale = Scale::logarithmic}),
        param<&LensParams::bloom>({.name = "bloom",
                                   .group = "bloom",
                                   .fallback = bloom_pyramid,
                                   .help = "glow: energy-conserving pyramid, X-Ray's 256x256 blur with its gain and clip, or off",
                                   .choices = blooms}),
        param<&LensParams::bloom_reach>({.name = "bloom_reach",
                                         .low = 0.005,
                                         .high = 0.5,
                                         .fallback = 0.12,
                                         .help = "standard deviation of the widest glow, as a share of the picture's height",
                                         .scale = Scale::logarithmic}),
        param<&LensParams::focus>({.name = "focus",
                                   .group = "depth of field",
                                   .fallback = focus_gather,
                                   .help = "blur: layered gather by a thin lens, X-Ray's 12 taps as published, or off",
                                   .choices = focuses}),
        param<&LensParams::focus_taps>({.name = "focus_taps",
                                        .fallback = focus_taps_128,
                                        .help = "taps per sample (focus=gather); more: less noise, in proportion to time",
                                        .choices = tap_counts}),
        param<&LensParams::focus_reach>({.name = "focus_reach",
                                         .low = 0.002,
                                         .high = 0.25,
                                         .fallback = 0.1,
                                         .help = "largest radius of blur (focus=gather), as a share of the picture's height",
                                         .scale = Scale::logarithmic}),
        param<&LensParams::distortion>({.name = "distortion",
                                        .group = "distortion",
                                        .fallback = distortion_radial,
                                        .help = "resample the picture through a radial polynomial, or leave it straight",
                                        .choices = distortions}),
        param<&LensParams::k1>({.name = "k1",
                                .low = -0.3,
                                .high = 1,
                                .fallback = 0.1,
                                .help = "distortion at half the diagonal: above 0 barrel, below 0 pincushion"})};
}

Claims claims() {
    const auto ratio = [](std::string_view name, std::string_view of, std::string_view against, std::string_view part) {
        return TimeRatio{.name = name, .of = of, .against = against, .steps = {part}, .scenario = "lamp_at_night"};
    };
    return {.ratios = {ratio("bloom: pyramid, against X-Ray's at 256x256", "", "bloom=xray", "lens/bloom"),
                       ratio("depth of field: 64 taps, against 16", "focus_taps=64", "focus_taps=16", "lens/depth_of_field"),
                       ratio("depth of field: 128 taps, against 64", "", "focus_taps=64", "lens/depth_of_field"),
                       ratio("depth of field: 128 taps, against X-Ray's 12", "", "focus=xray", "lens/depth_of_field")}};
}

}  // namespace

Technique camera() {
    return {.stage = Stage::lens,
            .name = "lens/camera",
            .title = "Exposure, depth of field, distortion, bloom",
            .source =
                "Lobanchikov, Gruen: S.T.A.L.K.E.R.: Clear Sky, GDC 2009 (xray); Potmesil, Chakravarty: A Lens and Aperture "
                "Camera Model, SIGGRAPH 1981; Jimenez: Next Generation Post Processing in Call of Duty, SIGGRAPH 2014",
            .summary =
                "Adapts exposure, blurs what is out of focus, bends and glows, each where the frame asks for it; what is hidden "
                "behind a blurred surface is guessed from beside it.",
            .params = params(),
            .variants = {"exposure=xray", "exposure=off", "exposure_amount=1 exposure_grey=0.2", "bloom=xray", "bloom=off",
                         "bloom_reach=0.03", "focus=xray", "focus=off", "focus_taps=16", "focus_taps=64", "focus_taps=256",
                         "focus_reach=0.03", "distortion=off", "k1=-0.2", "bloom=off focus=off distortion=off",
                         "exposure=xray bloom=xray focus=xray distortion=off"},
            .views = camera_views(),
            .tables = camera_tables(),
            .abilities = {.is_time_unit = true},
            .claims = claims(),
            .declare = declare,
            .at_other_stages = {{.at = Stage::transparency, .declare = recall}},
            .model = camera_model,
            .tolerance = {.rmse = 1e-4,
                          .worst = 4e-3,
                          .because = "half floats of undefined rounding in up to nine images of the glow, 2^-10 each"}};
}

}  // namespace strata::lens
