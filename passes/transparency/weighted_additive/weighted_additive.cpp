// Weighted blending that knows how additive a pixel is: one buffer set for alpha and for light, at full and half resolution.
#include <array>
#include <cassert>

#include "passes/choice_names.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/weighted_additive/weighted_additive.shared.h"

namespace strata::transparency {

ImageSet weighted_additive_model(const StageInput&, const Settings&);  // model.cpp

namespace {

constexpr auto reveals = choice_names({{reveal_r8, "r8"}, {reveal_r16f, "r16f"}});
constexpr auto normalizations = choice_names({{normalization_published, "published"}, {normalization_corrected, "corrected"}});
constexpr auto tiles = choice_names({{tiles_written, "written"}, {tiles_all, "all"}});

/// What fragments of one resolution are summed in. `emitted` exists where the normalization keeps it apart.
struct Targets {
    Image sum, reveal, additiveness, emitted;
};

bool is_apart(const WeightedAdditiveParams& params) { return params.normalization == normalization_corrected; }

Targets create_targets(Graph& graph, const FrameImages& images, const WeightedAdditiveParams& params, const std::string& prefix) {
    const bool chromatic = images.features->has(Feature::chromatic), bytes = params.reveal == reveal_r8;
    const auto create = [&](std::string_view name, Format format, double value) {
        Image image =
            graph.create(prefix + std::string(name), Shape{.extent = images.extent, .format = format, .samples = images.samples});
        graph.clear(image, {{value, value, value, value}});
        return image;
    };
    const Format one = bytes ? Format::r8_unorm : Format::r16f, three = bytes ? Format::rgba8_unorm : Format::rgba16f;
    return {.sum = create("sum", Format::rgba16f, 0),
            .reveal = create("reveal", chromatic ? three : one, 1),
            .additiveness = create("additiveness", one, 0),
            .emitted = is_apart(params) ? create("emitted", Format::rgba16f, 0) : Image{}};
}

void accumulate(Graph& graph, const FrameImages& images, Targets& targets, Buffer& written, const WeightedAdditiveParams& params,
                Resolution resolution) {
    const std::string shader = is_apart(params) ? "accumulate_apart" : "accumulate";
    for (const DrawList& list : drawn_at(images, resolution)) {
        DrawStep draw = draw_fragments(graph, "transparency/weighted_additive/" + shader, list, images);
        draw.adds_to(targets.sum)
            .multiplies(targets.reveal)
            .adds_to(targets.additiveness)
            .updates("Written", written)
            .fixes("low_resolution", resolution == Resolution::low ? 1u : 0u)
            .push(params);
        if (is_apart(params)) draw.adds_to(targets.emitted);
    }
}

Targets by_sample(Graph& graph, const Targets& targets) {
    return {by_sample(graph, targets.sum), by_sample(graph, targets.reveal), by_sample(graph, targets.additiveness),
            by_sample(graph, targets.emitted)};
}

void declare(Graph& graph, FrameImages& images, const Settings& settings) {
    distort_background(graph, images);
    const auto params = settings.as<WeightedAdditiveParams>();
    const bool has_low = images.features->has(Feature::low_resolution);
    const std::uint64_t tile_columns = (images.extent.width + tile_edge - 1) / tile_edge,
                        tile_rows = (images.extent.height + tile_edge - 1) / tile_edge;
    Buffer written =
        graph.create("weighted_additive written tiles", (tile_columns * tile_rows + 31) / 32 * sizeof(std::uint32_t));
    graph.clear(written, 0);

    Targets full = create_targets(graph, images, params, "weighted_additive "), low;
    accumulate(graph, images, full, written, params, Resolution::full);
    if (has_low) {
        const FrameImages half = prepass_images(graph, images, 2);
        low = create_targets(graph, half, params, "weighted_additive low ");
        accumulate(graph, half, low, written, params, Resolution::low);
    }

    const Targets layers = by_sample(graph, full);
    graph.compute("transparency/weighted_additive/composite.comp")
        .updates("color", images.color)
        .samples("sum", layers.sum)
        .samples("reveal", layers.reveal)
        .samples("additiveness", layers.additiveness)
        .samples("emitted", layers.emitted)
        .samples("low_sum", low.sum)
        .samples("low_reveal", low.reveal)
        .samples("low_additiveness", low.additiveness)
        .samples("low_emitted", low.emitted)
        .loads("Written", written)
        .fixes("chromatic", images.features->has(Feature::chromatic) ? 1u : 0u)
        .fixes("low_resolution", has_low ? 1u : 0u)
        .push(params)
        .over({images.extent.width, images.extent.height, images.samples});
}

std::vector<Param> params() {
    return {
        param<&WeightedAdditiveParams::far>({.name = "far",
                                             .low = 10,
                                             .high = 10000,
                                             .fallback = 300,
                                             .help = "view depth in meters beyond which weights no longer fall",
                                             .scale = Scale::logarithmic}),
        param<&WeightedAdditiveParams::feather_start>(
            {.name = "feather_start",
             .low = 0.01,
             .high = 1,
             .fallback = 0.3333,
             .help =
                 "exposed emission at which a fragment gets full weight; smaller: halos; larger: the background shows through",
             .scale = Scale::logarithmic}),
        param<&WeightedAdditiveParams::reveal>({.name = "reveal",
                                                .low = 0,
                                                .high = 1,
                                                .fallback = reveal_r8,
                                                .help = "format of the targets for transmittance and additiveness; r16f: twice "
                                                        "the memory, not limited to 8 additive layers",
                                                .choices = reveals}),
        param<&WeightedAdditiveParams::normalization>({.name = "normalization",
                                                       .low = 0,
                                                       .high = 1,
                                                       .fallback = normalization_published,
                                                       .help = "published: as in the talk, stacks of covering layers are too "
                                                               "dark; corrected: averages scattered and emitted light separately",
                                                       .choices = normalizations}),
        param<&WeightedAdditiveParams::tiles>({.name = "tiles",
                                               .low = 0,
                                               .high = 1,
                                               .fallback = tiles_written,
                                               .help = "8x8 tiles that are composited: those with fragments, or all",
                                               .choices = tiles}),
    };
}

constexpr std::string_view bytes_stall = "bytes of what shows through stall under 200 layers of .01";
constexpr std::array exceptions = {ToleranceException{"", "two_hundred_layers", 6e-2, .2, bytes_stall},
                                   ToleranceException{"", "H5 thin layers", 6e-2, .3, bytes_stall},
                                   ToleranceException{"normalization=corrected", "H5 thin layers", 6e-2, .3, bytes_stall}};

}  // namespace

Technique weighted_additive() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/weighted_additive",
        .title = "Weighted with additiveness",
        .source = "Kircher 2018, Rendering Technology of Agents of Mayhem, GDC; after McGuire and Bavoil 2013, JCGT 2(2)",
        .summary =
            "Averages covering and additive fragments in one set of targets, at two resolutions. Stacks of covering layers are "
            "too dark; light saturates at 8 additive layers.",
        .params = params(),
        .variants = {"normalization=corrected", "normalization=corrected reveal=r16f"},
        .counters = {counter<&WeightedAdditiveCounters::fragments>(
                         {.name = "fragments", .help = "visible transparent fragments blended, at both resolutions"}),
                     counter<&WeightedAdditiveCounters::tiles_skipped>(
                         {.name = "tiles skipped", .help = "8x8 tiles of the frame without fragments, not composited"})},
        .counter_bytes = sizeof(WeightedAdditiveCounters),
        .claims = {.failures = {{"H1a", 0.578, "it averages and hides nothing"},
                                {"H1b", 0.65, "it averages and hides nothing"},
                                {"H1c", 0.666, "it averages and hides nothing: a third for each of three cards"},
                                {"H2", 0.6405, "it averages and hides nothing"},
                                {"H3", 0.662, "it averages and hides nothing: the front card has little more than a third"},
                                {"H4", 0.25, "premultiplied colors are averaged: stacks of alpha are too dark"},
                                {"H5", 0.293, "premultiplied colors are averaged, and bytes of reveal stall"},
                                {"H6c", 0.225, "it averages and hides nothing"},
                                {"H7", 0.19, "additiveness ends at 8 layers"},
                                {"H8", 0.989, "an infinite sum is shown as 100"},
                                {"H9", 0.0831, "beyond 300 m all weights are alike"},
                                {"H12a", 0.2342, "it averages and hides nothing"},
                                {"H12b", 0.7095, "premultiplied colors are averaged, over all channels"},
                                {"H13", 0.38, "beyond 50 m all weights are alike"},
                                {"H14b", 0.0961, "the card's weight is twenty times the smoke's"},
                                {"H15", 0.25, "premultiplied colors are averaged: stacks of alpha are too dark"}}},
        .declare = declare,
        .model = weighted_additive_model,
        .tolerance = {.rmse = 8e-3,
                      .worst = 6.5e-2,
                      .because = "llvmpipe rounds what it multiplies bytes with to a byte, too: 4e-3 and .03 measured",
                      .exceptions = exceptions},
    };
}

}  // namespace strata::transparency
