// Weighted blended order-independent transparency: one additive pass, no order at all.
#include "passes/choice_names.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/weighted/weighted.shared.h"

namespace strata::transparency {

ImageSet weighted_model(const StageInput&, const Settings&);  // model.cpp

namespace {

constexpr auto weights = choice_names({{weight_w7, "w7"},
                                       {weight_w8, "w8"},
                                       {weight_w9, "w9"},
                                       {weight_w10, "w10"},
                                       {weight_blog, "blog"},
                                       {weight_2015, "w2015"},
                                       {weight_2015_plain, "w2015_plain"},
                                       {weight_constant, "constant"}});
constexpr auto forms = choice_names({{form_normalized, "normalized"}, {form_average, "average"}, {form_sum, "sum"}});

/// What fragments of one resolution are added and multiplied in.
struct Targets {
    Image sum, reveal;
};

Targets accumulate(Graph& graph, const FrameImages& images, const WeightedParams& params, Resolution resolution,
                   const std::string& prefix) {
    const bool counts = params.form == form_average, chromatic = images.features->has(Feature::chromatic) && !counts;
    const auto create = [&](const char* name, Format format, double value) {
        Image image = graph.create(prefix + name, Shape{.extent = images.extent, .format = format, .samples = images.samples});
        graph.clear(image, {{value, value, value, value}});
        return image;
    };
    Targets targets{create("sum", Format::rgba16f, 0),
                    create("reveal", chromatic ? Format::rgba16f : Format::r16f, counts ? 0 : 1)};
    for (const DrawList& list : drawn_at(images, resolution)) {
        DrawStep draw = draw_fragments(graph, "transparency/weighted/accumulate", list, images);
        draw.adds_to(targets.sum).push(params);
        if (counts) {
            draw.adds_to(targets.reveal);
        } else {
            draw.multiplies(targets.reveal);
        }
    }
    return targets;
}

void declare(Graph& graph, FrameImages& images, const Settings& settings) {
    distort_background(graph, images);
    const auto params = settings.as<WeightedParams>();
    const Targets full = accumulate(graph, images, params, Resolution::full, "weighted ");
    const bool has_low = images.features->has(Feature::low_resolution);
    Targets low;
    if (has_low) low = accumulate(graph, prepass_images(graph, images, 2), params, Resolution::low, "weighted low ");

    const Image sum_layers = by_sample(graph, full.sum);
    const Image reveal_layers = by_sample(graph, full.reveal);
    graph.compute("transparency/weighted/resolve.comp")
        .samples("sum", sum_layers)
        .samples("reveal", reveal_layers)
        .samples("low_sum", low.sum)
        .samples("low_reveal", low.reveal)
        .updates("color", images.color)
        .fixes("chromatic", images.features->has(Feature::chromatic) && params.form != form_average ? 1u : 0u)
        .fixes("low_resolution", has_low ? 1u : 0u)
        .push(params)
        .over({images.extent.width, images.extent.height, images.samples});
}

}  // namespace

Technique weighted() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/weighted",
        .aliases = {"wboit"},
        .title = "Weighted blended",
        .source =
            "McGuire and Bavoil 2013, JCGT 2(2); colored: McGuire and Mara 2016, I3D; average: Bavoil and Myers 2008; sum: "
            "Meshkin 2007",
        .summary =
            "Averages all fragments with weights that fall with depth: one pass, fixed memory; nearly opaque layers show what is "
            "behind them.",
        .params = {param<&WeightedParams::weight>({.name = "weight",
                                                   .low = 0,
                                                   .high = 7,
                                                   .fallback = weight_w7,
                                                   .help = "weight function; w7 to w10: equations 7 to 10 of the 2013 paper; "
                                                           "w2015_plain and constant average without regard to depth",
                                                   .choices = weights}),
                   param<&WeightedParams::scale>(
                       {.name = "scale",
                        .low = 0.01,
                        .high = 100,
                        .fallback = 1,
                        .help = "factor on view depth before weighting; the weight functions are tuned for depths of 0.1 to 500",
                        .scale = Scale::logarithmic}),
                   param<&WeightedParams::form>({.name = "form",
                                                 .low = 0,
                                                 .high = 2,
                                                 .fallback = form_normalized,
                                                 .help = "how sums are resolved; normalized: weighted average; average: plain "
                                                         "average; sum: unnormalized; the last two use no weights",
                                                 .choices = forms})},
        .variants = {"weight=w9", "weight=w10", "weight=w2015", "form=average", "form=sum"},
        .counters = {counter<&WeightedCounters::fragments>(
                         {.name = "fragments", .help = "visible transparent fragments blended"}),
                     counter<&WeightedCounters::weights_differ>(
                         {.name = "weights differ",
                          .help = "1 if the nearest fragment weighs more than the farthest; 0: the result is a plain average"})},
        .counter_bytes = sizeof(WeightedCounters),
        .cannot = {Feature::additive},
        .claims = {.failures = {{"H1a", 0.531, "it averages and hides nothing"},
                                {"H1b", 0.64, "it averages and hides nothing"},
                                {"H1c", 0.666, "it averages and hides nothing: a third for each of three cards"},
                                {"H2", 0.2255, "it averages and hides nothing"},
                                {"H3", 0.64, "it averages and hides nothing: the front card has little more than a third"},
                                {"H4", 0.125, "panes at one weight are averaged: the value of a tie"},
                                {"H5", 0.156, "w7 weighs far layers with almost nothing, and half floats cut what is added"},
                                {"H6c", 0.124, "it averages and hides nothing: w7 leaves the far wall an eighth"},
                                {"H8", 0.998, "sums end at 65504, and their ratio with them"},
                                {"H9", 0.0417, "weights end at .01: what is beyond is averaged"},
                                {"H12a", 0.081, "it averages and hides nothing"},
                                {"H12b", 0.581, "one scalar coverage serves three channels"},
                                {"H13", 0.338, "at 150 m all weights are alike"},
                                {"H14b", 0.0687, "w7 weighs the smoke in front too much"}}},
        .declare = declare,
        .model = weighted_model,
        .tolerance =
            {.rmse = 5e-4,
             .worst = 3e-3,
             .because =
                 "sums and products are rounded to half floats at every blend, in the model, too, but a last float bit of a "
                 "term can turn the rounding of each"},
    };
}

}  // namespace strata::transparency
