// The first fragments of a sample to arrive, stored in small formats and sorted; later ones become one layer behind them.
#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/a_buffer/a_buffer.shared.h"
#include "passes/transparency/a_buffer/a_buffer_params.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/fragment_draw.h"

namespace strata::transparency {

ImageSet a_buffer_model(const StageInput&, const Settings&);  // model.cpp

Image a_buffer_overflow_view(Graph&, FrameImages&, const Settings&);  // views.cpp

namespace {

constexpr auto layouts = choice_names({{layout_automatic, "automatic"}, {layout_mono, "mono"}, {layout_rgb, "rgb"}});

struct Layers {
    Image colors, transmittances, depths;
    Buffer counts;
};

struct Merged {
    Image sum, through;
};

/// Of the recorded frame, whatever features are forced on: those change no pixel, and another format would.
bool is_chromatic(const FrameImages& images, std::uint32_t stored_as) {
    if (stored_as != layout_automatic) return stored_as == layout_rgb;
    return images.facts->features().has(Feature::chromatic);
}

ABufferPush push_of(const FrameImages& images, const Settings& settings) {
    const auto params = settings.as<ABufferParams>();
    return {params.layers, is_chromatic(images, params.stored_as) ? 1u : 0u};
}

Layers create_layers(Graph& graph, const FrameImages& images, const ABufferPush& push) {
    const auto slots = [&](const char* name, Format format) {
        return graph.create(name, Shape{.extent = images.extent, .format = format, .layers = push.layers * images.samples});
    };
    const std::uint64_t samples = std::uint64_t{images.extent.width} * images.extent.height * images.samples;
    Layers layers{
        .colors = slots("a_buffer colors", Format::r11g11b10f),
        .transmittances = slots("a_buffer transmittances", push.chromatic ? Format::r11g11b10f : Format::r8_unorm),
        .depths = slots("a_buffer depths", Format::r16f),
        .counts = graph.create("a_buffer counts", (samples + 3) / 4 * sizeof(std::uint32_t)),
    };
    graph.clear(layers.counts, 0);
    return layers;
}

/// Floats: the product of 290 transmittances and light of any brightness.
Merged create_merged(Graph& graph, const FrameImages& images, const ABufferPush& push) {
    Shape shape{.extent = images.extent, .format = Format::rgba32f, .samples = images.samples};
    Merged merged{.sum = graph.create("a_buffer merged sum", shape)};
    if (!push.chromatic) shape.format = Format::r32f;
    merged.through = graph.create("a_buffer merged transmittance", shape);
    graph.clear(merged.sum, {});
    graph.clear(merged.through, {{1, 1, 1, 1}});
    return merged;
}

void declare(Graph& graph, FrameImages& images, const Settings& settings) {
    distort_background(graph, images);
    const ABufferPush push = push_of(images, settings);
    Layers layers = create_layers(graph, images, push);
    Merged merged = create_merged(graph, images, push);
    draw_fragments(graph, "transparency/a_buffer/store", images.transparent, images)
        .adds_to(merged.sum)
        .multiplies(merged.through)
        .stores("colors", layers.colors)
        .stores("transmittances", layers.transmittances)
        .stores("depths", layers.depths)
        .updates("Counts", layers.counts)
        .fixes("tells_helpers", tells_helpers(images))
        .push(push);

    const Image sum = by_sample(graph, merged.sum);
    const Image through = by_sample(graph, merged.through);
    graph.compute("transparency/a_buffer/resolve.comp")
        .updates("color", images.color)
        .samples("colors", layers.colors)
        .samples("transmittances", layers.transmittances)
        .samples("depths", layers.depths)
        .samples("merged_sum", sum)
        .samples("merged_through", through)
        .loads("Counts", layers.counts)
        .push(push)
        .over({images.extent.width, images.extent.height, images.samples});
}

}  // namespace

Technique a_buffer() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/a_buffer",
        .aliases = {"abuffer"},
        .title = "Bounded A-buffer",
        .source = "Carpenter 1984, SIGGRAPH; nine layers as in Black Ops 4: Drobot, SIGGRAPH Advances in Real-Time Rendering",
        .summary =
            "Sorts the first K fragments drawn and merges later ones behind them, near or far: the result depends on the order "
            "of drawing.",
        .params = {param<&ABufferParams::layers>(
                       {.name = "layers",
                        .low = 1,
                        .high = 16,
                        .fallback = 9,
                        .help = "fragments stored and sorted per sample: 7 bytes each, 10 with layout=rgb"}),
                   param<&ABufferParams::stored_as>({.name = "layout",
                                                     .low = 0,
                                                     .high = 2,
                                                     .fallback = layout_automatic,
                                                     .help = "format of transmittance; mono: 8 bits; rgb: R11G11B10F; automatic: "
                                                             "rgb if the frame has colored transmittance",
                                                     .choices = layouts})},
        .variants = {"layers=4", "layers=16", "layout=rgb"},
        .counters = {counter<&ABufferCounters::fragments>({.name = "fragments", .help = "visible transparent fragments shaded"}),
                     counter<&ABufferCounters::overflow>(
                         {.name = "overflow", .help = "fragments beyond the stored layers, merged into one"}),
                     counter<&ABufferCounters::atomics>({.name = "atomics", .help = "compare-and-swaps of byte counts"}),
                     counter<&ABufferCounters::unfinished>(unfinished_row)},
        .counter_bytes = sizeof(ABufferCounters),
        .views = {{.name = "overflow",
                   .help = "visible fragments merged per pixel, in the sample that has the most",
                   .unit = "fragments",
                   .low = 0,
                   .high = 32,
                   .declare = a_buffer_overflow_view,
                   .if_zero = "no pixel overflows"}},
        .claims = {.failures = {{"H5", 0.126, "nine layers are sorted, 191 merged behind them"},
                                {"H10b", 0.00625, "alpha is kept in bytes"}}},
        .declare = declare,
        .model = a_buffer_model,
        .tolerance = {.rmse = 1.5e-4,
                      .worst = 2e-2,
                      .because =
                          "both round to the stored formats; where a float's last bits decide, one is a step off, up to 2^-6, "
                          "in blue 2^-5: 7e-5 and 1.1e-2 (LightsPunctualLamp) measured on lavapipe"},
    };
}

}  // namespace strata::transparency
