// The K nearest fragments of a sample, kept in order by 64-bit atomics; what is behind them becomes a tail.
#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/k_buffer/k_buffer.shared.h"

namespace strata::transparency {

ImageSet k_buffer_model(const StageInput&, const Settings&);  // model.cpp

Image k_buffer_beyond_view(Graph&, FrameImages&, const Settings&);  // views.cpp

namespace {

constexpr auto tails = choice_names({{tail_drop, "drop"}, {tail_blend, "blend"}, {tail_hybrid, "hybrid"}});
constexpr const char* keeping_shaders[] = {"transparency/k_buffer/keep_and_drop", "transparency/k_buffer/keep_and_blend",
                                           "transparency/k_buffer/keep_and_average"};

/// What fell out. No image where it is dropped.
struct Tail {
    Image color, count;
};

/// Drawn with the frame's samples, read by sample. Floats: light of any brightness and 200 layers of .01 add up in it.
Image create_target(Graph& graph, const FrameImages& images, std::string name, Format format, ClearValue value) {
    Image target = graph.create(std::move(name), Shape{.extent = images.extent, .format = format, .samples = images.samples});
    graph.clear(target, value);
    return target;
}

Tail create_tail(Graph& graph, const FrameImages& images, std::uint32_t kind) {
    Tail tail;
    if (kind == tail_drop) return tail;
    const ClearValue nothing = kind == tail_blend ? ClearValue{{0, 0, 0, 1}} : ClearValue{};
    tail.color = create_target(graph, images, "k_buffer tail", Format::rgba32f, nothing);
    if (kind == tail_hybrid) tail.count = create_target(graph, images, "k_buffer tail count", Format::r32f, {});
    return tail;
}

/// Keeps what is nearest in the slots and adds the rest to the tail.
void keep(Graph& graph, const FrameImages& images, const KBufferParams& params, Buffer& slots, Tail& tail) {
    DrawStep draw = draw_fragments(graph, keeping_shaders[params.tail], images.transparent, images);
    draw.updates("Slots", slots).push(params);
    if (params.tail == tail_blend) draw.composites(tail.color);
    if (params.tail == tail_hybrid) draw.adds_to(tail.color).adds_to(tail.count);
}

void declare(Graph& graph, FrameImages& images, const Settings& settings) {
    distort_background(graph, images);
    const auto params = settings.as<KBufferParams>();
    const std::uint64_t samples = std::uint64_t{images.extent.width} * images.extent.height * images.samples;
    Buffer slots = graph.create("k_buffer slots", samples * params.layers * sizeof(std::uint64_t));
    graph.clear(slots, 0xffffffffu);
    Tail tail = create_tail(graph, images, params.tail);
    keep(graph, images, params, slots, tail);

    const Image color = by_sample(graph, tail.color);
    const Image count = by_sample(graph, tail.count);
    graph.compute("transparency/k_buffer/resolve.comp")
        .updates("color", images.color)
        .loads("Slots", slots)
        .samples("tail", color)
        .samples("tail_count", count)
        .push(params)
        .over({images.extent.width, images.extent.height, images.samples});
}

std::optional<Error> beyond_device(const FrameImages& images, const Settings& settings) {
    if (settings.as<KBufferParams>().tail != tail_blend || has(images.capabilities, Capability::dual_source_blending))
        return std::nullopt;
    return fail(Fault::device_lacks, "device.lacks_feature",
                "{technique} needs {feature} for {setting}, which this device does not have", "transparency/k_buffer",
                "dual_source_blending", "tail=blend");
}

}  // namespace

Technique k_buffer() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/k_buffer",
        .aliases = {"kbuffer"},
        .title = "K-buffer",
        .source =
            "Bavoil et al. 2007, I3D; hybrid tail: Maule, Comba, Torchelsen and Bastos 2013, I3D; 64-bit chain of "
            "atomicMin: nvpro vk_order_independent_transparency",
        .summary =
            "Sorts the K nearest fragments and approximates the rest as a tail: wrong where much shows behind the nearest; "
            "coverage has 8 bits.",
        .params =
            {param<&KBufferParams::layers>(
                 {.name = "layers", .low = 1, .high = 16, .fallback = 8, .help = "fragments kept per sample, 8 bytes each"}),
             param<&KBufferParams::tail>(
                 {.name = "tail",
                  .low = 0,
                  .high = 2,
                  .fallback = tail_hybrid,
                  .help =
                      "fragments behind the kept layers; drop: lost; blend: blended in the order of drawing; hybrid: averaged",
                  .choices = tails})},
        .variants = {"layers=2", "layers=4", "layers=16", "layers=4 tail=drop", "layers=4 tail=blend"},
        .counters = {counter<&KBufferCounters::fragments>({.name = "fragments", .help = "visible transparent fragments shaded"}),
                     counter<&KBufferCounters::displaced>(
                         {.name = "displaced", .help = "fragments not among the nearest layers: the tail"}),
                     counter<&KBufferCounters::atomics>({.name = "atomics", .help = "64-bit atomics issued"})},
        .counter_bytes = sizeof(KBufferCounters),
        .views = {{.name = "beyond",
                   .help = "visible fragments per pixel behind the kept layers, in the sample that has the most",
                   .unit = "fragments",
                   .low = 0,
                   .high = 32,
                   .declare = k_buffer_beyond_view,
                   .if_zero = "every visible fragment is kept"}},
        .needs = {Capability::buffer_int64_atomics},
        .beyond_device = beyond_device,
        .cannot = {Feature::chromatic},
        .claims = {.failures = {{"H5", 0.067, "alpha is kept in 1/256: .01 is .0117"},
                                {"H15", 0.25, "of equal depths the bits of color decide which is in front"}}},
        .declare = declare,
        .model = k_buffer_model,
        .tolerance = {.rmse = 1e-4,
                      .worst = 1e-2,
                      .because =
                          "both round to the key's codes; where a float's last bits decide, one is a code off, 2^-8 of the "
                          "brightest channel or of the coverage: 9e-6 and 2.2e-3 measured on lavapipe"},
    };
}

}  // namespace strata::transparency
