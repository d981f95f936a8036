// Moment-based transparency: T(z) of a texel from a few sums of powers of depth, or of its multiples as phases.
#include <cmath>

#include "passes/choice_names.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/functions/draw.h"
#include "passes/transparency/functions/motion.h"
#include "passes/transparency/lists/pixel_lists.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/moments/moments.shared.h"
#include "passes/transparency/moments/moments_params.h"

namespace strata::transparency {

ImageSet moments_model(const StageInput&, const Settings&);  // model.cpp

namespace {

constexpr auto kinds = choice_names({{moments_power4, "power4"},
                                     {moments_power6, "power6"},
                                     {moments_power8, "power8"},
                                     {moments_trig2, "trig2"},
                                     {moments_trig3, "trig3"},
                                     {moments_trig4, "trig4"}});
constexpr auto storages = choice_names({{storage_single, "single"}, {storage_half, "half"}, {storage_normalized, "normalized"}});
constexpr auto compensations = choice_names({{compensation_none, "none"}, {compensation_own, "own"}});

/// What a texel keeps; layer = channel.
struct Moments {
    Image total, head, tail;
};

/// The bias Muenstermann et al. publish for a kind and a storage; 5e-3 for FP16 sums, which the paper does not have.
double published_bias(const MomentsParams& params) {
    static constexpr double single[] = {5e-7, 5e-6, 5e-5, 4e-7, 8e-7, 1.5e-6};
    static constexpr double normalized[] = {6e-5, 6e-4, 2.5e-3, 4e-4, 6.5e-4, 8.5e-4};
    if (params.storage == storage_half) return 5e-3;
    return (params.storage == storage_normalized ? normalized : single)[params.kind];
}

std::uint32_t reals(const MomentsParams& params) { return 4 + 2 * (params.kind % 3); }

MomentsPush push_of(const MomentsParams& params, const FrameImages& images) {
    const DepthRange range = images.facts->transparent_depths();
    return {.log_nearest = std::log(range.nearest),
            .per_log = 2 / std::log(range.farthest / range.nearest),
            .bias = static_cast<float>(double(params.bias) * published_bias(params)),
            .overestimation = params.overestimation,
            .compensation = params.compensation,
            .channels = channel_count(params.channels, *images.features)};
}

Moments create_moments(Graph& graph, const FrameImages& low, const MomentsParams& params) {
    const bool half = params.storage == storage_half, fixed = params.storage == storage_normalized;
    const auto created = [&](const char* name, Format single, Format half_float) {
        const Format format = half ? half_float : fixed && single != Format::r32f ? Format::rgba16_unorm : single;
        return graph.create(
            name, Shape{.extent = low.extent, .format = format, .layers = channel_count(params.channels, *low.features)});
    };
    Moments moments{.total = created("moment 0", Format::r32f, Format::r16f),
                    .head = created("moments 1 to 4", Format::rgba32f, Format::rgba16f)};
    if (reals(params) == 6) moments.tail = created("moments 5 and 6", Format::rg32f, Format::rg16f);
    if (reals(params) == 8) moments.tail = created("moments 5 to 8", Format::rgba32f, Format::rgba16f);
    return moments;
}

void add_up(Graph& graph, const FrameImages& low, const MomentsParams& params, const MomentsPush& push, Moments& moments) {
    graph.clear(moments.total, {});
    graph.clear(moments.head, {});
    if (moments.tail) graph.clear(moments.tail, {});
    for (std::uint32_t channel = 0; channel < push.channels; ++channel) {
        DrawStep draw = draw_fragments(graph, "transparency/moments/project", low.transparent, low);
        draw.adds_to(moments.total, {.layer = channel}).adds_to(moments.head, {.layer = channel});
        if (moments.tail) draw.adds_to(moments.tail, {.layer = channel});
        draw.drops_other_colors().fixes("kind", params.kind).fixes("channel", push.channels == 1 ? 3u : channel).push(push);
    }
}

void quantize(Graph& graph, const FrameImages& low, const MomentsParams& params, const MomentsPush& push, Moments& moments) {
    struct BandAndMoments {
        Band band;
        MomentsPush push;
    };
    PixelLists lists = create_lists(graph, low, params.pool);
    // Four moments have no others; the shader names them still.
    Image others = moments.tail ? moments.tail : graph.create("no moments", Shape{.format = Format::rgba16_unorm});
    for (const Band& band : lists.bands) {
        make_lists(graph, low, lists, band, list_order_submission);
        read_lists(graph.compute("transparency/moments/quantize.comp"), lists, band)
            .stores("total", moments.total)
            .stores("head", moments.head)
            .stores("tail", others)
            .fixes("kind", params.kind)
            .fixes("per_iteration", push.channels * fragments_per_iteration(lists))
            .push(BandAndMoments{band, push})
            .over(over(band));
    }
    if (moments.tail) moments.tail = others;
}

FunctionSums sums(Graph& graph, FrameImages& images, const Settings& settings, Offsets offsets) {
    const auto params = settings.as<MomentsParams>();
    const MomentsPush push = push_of(params, images);
    const FrameImages low = prepass_images(graph, images, divisor_of(params.resolution));
    Moments moments = create_moments(graph, low, params);
    if (params.storage == storage_normalized) {
        quantize(graph, low, params, push, moments);
    } else {
        add_up(graph, low, params, push, moments);
    }
    FunctionSums drawn = create_sums(graph, images, {.accumulation = params.accumulation, .offsets = offsets});
    draw_into(graph, "transparency/moments/accumulate", images, drawn, [&](DrawStep& draw, Resolution resolution) {
        const PrepassRead read = prepass_read(images, params.resolution, resolution);
        draw.samples("total", moments.total, read.filter)
            .samples("head", moments.head, read.filter)
            .samples("tail", moments.tail, read.filter)
            .fixes("filters_in_shader", read.in_shader)
            .fixes("kind", params.kind)
            .fixes("storage", params.storage)
            .push(push);
    });
    return drawn;
}

std::vector<Counter> counters() {
    std::vector<Counter> rows = function_counters_with_lists();
    rows.push_back(counter<&MomentsCounters::repaired>(
        {.name = "repaired", .help = "transmittances that were NaN or infinite and were replaced by exp(-b0 / 2)"}));
    return rows;
}

std::vector<Param> params() {
    return {
        param<&MomentsParams::kind>(
            {.name = "kind",
             .low = 0,
             .high = 5,
             .fallback = moments_power4,
             .help = "4, 6 or 8 power moments, or 2, 3 or 4 trigonometric moments; more: more accurate, more memory",
             .choices = kinds}),
        param<&MomentsParams::storage>(
            {.name = "storage",
             .low = 0,
             .high = 2,
             .fallback = storage_single,
             .help =
                 "single: FP32, blended; half: FP16, blended; normalized: 16-bit normalized moments, updated in order of drawing",
             .choices = storages}),
        param<&MomentsParams::bias>(
            {.name = "bias",
             .low = 0.01,
             .high = 1000,
             .fallback = 1,
             .help = "factor on the published bias for kind and storage; larger: T(z) is smoother and leaks",
             .scale = Scale::logarithmic}),
        param<&MomentsParams::overestimation>(
            {.name = "overestimation",
             .low = 0,
             .high = 1,
             .fallback = 0.25,
             .help = "share of the absorbance at a fragment's depth that counts as in front of it; larger: darker"}),
        param<&MomentsParams::compensation>({.name = "compensation",
                                             .low = 0,
                                             .high = 1,
                                             .fallback = compensation_none,
                                             .help = "own: corrects each fragment for hiding itself through overestimation",
                                             .choices = compensations}),
        param<&MomentsParams::channels>(channels_row),
        param<&MomentsParams::resolution>(resolution_row),
        param<&MomentsParams::accumulation>(accumulation_row),
        param<&MomentsParams::pool>(pool_row),
    };
}

}  // namespace

Technique moments() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/moments",
        .aliases = {"mboit"},
        .title = "Moment-based",
        .source = "Muenstermann, Krumpen, Klein and Peters 2018, I3D; half resolution: Sharpe 2018, HPG",
        .summary =
            "Reconstructs T(z) from a few additive moments of depth: order independent, fixed memory, good in smoke; leaks "
            "between "
            "near-opaque cards, and every further layer bends the whole curve.",
        .params = params(),
        .variants = {"kind=power6", "kind=power8", "kind=trig2", "kind=trig3", "kind=trig4", "storage=half", "storage=normalized",
                     "kind=power8 storage=normalized", "overestimation=0", "compensation=own", "resolution=half",
                     "resolution=quarter", "resolution=eighth"},
        .counters = counters(),
        .counter_bytes = sizeof(MomentsCounters),
        .views = {normalization_row<sums>(), motion_row<sums>()},
        .claims = {.failures = {{"H1c", 0.043, "the cards are closer than the bias can tell apart"},
                                {"H2", 0.144, "four moments serve up to three depths; every further card bends the curve"},
                                {"H4", 0.115, "the panes are closer than the bias can tell apart"},
                                {"H5", 0.0203, "four moments of 200 layers"},
                                {"H13", 0.134, "the panes are closer than the bias can tell apart"},
                                {"H14b", 0.469,
                                 "a quarter of the card's own optical depth hides it: compensation=own or overestimation=0"}}},
        .declare = add_function<sums>,
        .model = moments_model,
        .tolerance = {.rmse = 2e-3,
                      .worst = 4e-2,
                      .because =
                          "sums are a few of their steps finer than the bias: where two depths are about its root apart in w "
                          "(7e-4 of power4), one step moves T by up to .04 in FP32; measured on smoke_grenade up to 640x360: "
                          ".0014 (power8), .002 (power6), .0025 (power4), .027 (normalized: one step of 16 bits)"},
    };
}

}  // namespace strata::transparency
