// Two-phase occlusion culling: what was visible the last time is drawn into a depth of its own, what that depth does not hide is
// drawn after it, and what the depth of both does not hide is what the frame draws.
#include <algorithm>

#include "passes/choice_names.h"
#include "passes/culling/draw_command.shared.h"
#include "passes/culling/hiz_two_phase/hiz_two_phase.shared.h"
#include "passes/culling/hiz_two_phase/hiz_two_phase_params.h"
#include "passes/culling/hiz_two_phase/views.h"
#include "passes/culling/visible_image.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::culling {

ImageSet hiz_two_phase_model(const StageInput&, const Settings&);  // model.cpp

namespace {

constexpr auto phases = choice_names({{phases_one, "one"}, {phases_two, "two"}});

/// What the steps hand each other.
struct Culling {
    HizPush push;
    DrawList all;
    Buffer history, draws, work, pyramid;
    Image depth;
};

Extent half(const Extent& extent) { return {(extent.width + 1) / 2, (extent.height + 1) / 2}; }

std::uint64_t pyramid_texels(Extent level) {
    std::uint64_t texels = std::uint64_t{level.width} * level.height;
    while (level.width > 1 || level.height > 1) {
        level = half(level);
        texels += std::uint64_t{level.width} * level.height;
    }
    return texels;
}

Buffer zeros(Graph& graph, const char* name, std::uint64_t size) {
    Buffer buffer = graph.create(name, size);
    graph.clear(buffer, 0);
    return buffer;
}

Culling prepared(Graph& graph, const FrameImages& frame, const HizParams& params) {
    const DrawList& all = frame.all_opaque;
    const std::uint64_t history_bytes = std::uint64_t{all.count} * sizeof(std::uint32_t);
    Culling c{.push = {all.first, all.count, params.occluders, params.across, params.phases},
              .all = all,
              .history = params.phases == phases_two ? graph.remember("hiz visible before", history_bytes)
                                                     : zeros(graph, "no history", history_bytes),
              .draws = graph.create(draws_name, std::uint64_t{all.count} * sizeof(HizDraw)),
              .work = zeros(graph, "hiz work", sizeof(HizWork)),
              .pyramid = graph.create(pyramid_name, pyramid_texels(frame.extent) * sizeof(float)),
              .depth = graph.create("hiz depth", {.extent = frame.extent, .format = Format::d32f, .samples = frame.samples})};
    graph.clear(c.depth, {});
    graph.compute("culling/hiz_two_phase/measure.comp")
        .loads("AllCommands", all.commands)
        .loads("History", c.history)
        .stores("HizDraws", c.draws)
        .updates("Work", c.work)
        .push(c.push)
        .over({all.count});
    return c;
}

std::uint64_t command_bytes(const Culling& c) { return std::uint64_t{c.push.count} * sizeof(DrawCommand); }

/// Packed commands: those after the last are empty. They are not counted on the device, because lavapipe 22.3.6 keeps the count
/// of a counted draw for later indirect ones that have none.
void draw_depth(Graph& graph, Culling& c, const Buffer& commands) {
    graph.draw("culling/hiz_two_phase/occluder", {commands, c.all.indices, 0, c.push.count}).writes_depth(c.depth);
}

void build_pyramid(Graph& graph, Culling& c) {
    const Image layers = spread(graph, c.depth, "hiz depth by sample");
    Extent level = graph.shape(layers).extent;
    std::uint32_t from = 0;
    do {
        graph.compute("culling/hiz_two_phase/pyramid.comp")
            .samples("depth_layers", layers)
            .updates("Pyramid", c.pyramid)
            .fixes("from", from)
            .groups({(level.width + pyramid_group - 1) / pyramid_group, (level.height + pyramid_group - 1) / pyramid_group});
        for (std::uint32_t made = 0; made < levels_per_dispatch; ++made, ++from) level = half(level);
    } while (level.width > 1 || level.height > 1);
}

void first_phase(Graph& graph, Culling& c) {
    Buffer commands = zeros(graph, "hiz first commands", command_bytes(c));
    graph.compute("culling/hiz_two_phase/choose.comp")
        .loads("AllCommands", c.all.commands)
        .updates("Commands", commands)
        .updates("HizDraws", c.draws)
        .updates("Work", c.work)
        .push(c.push)
        .over({c.push.count});
    draw_depth(graph, c, commands);
    build_pyramid(graph, c);
}

void second_phase(Graph& graph, Culling& c) {
    Buffer commands = zeros(graph, "hiz second commands", command_bytes(c));
    graph.compute("culling/hiz_two_phase/find_new.comp")
        .loads("AllCommands", c.all.commands)
        .updates("Commands", commands)
        .updates("HizDraws", c.draws)
        .updates("Work", c.work)
        .loads("Pyramid", c.pyramid)
        .push(c.push)
        .over({c.push.count});
    draw_depth(graph, c, commands);
    build_pyramid(graph, c);
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<HizParams>();
    const Extent extent{visible_width, visible_rows(frame.all_opaque.count)};
    frame.visible = graph.create("visible", {.extent = extent, .format = Format::r32ui});
    frame.opaque = frame.all_opaque;
    if (frame.all_opaque.count == 0) {
        graph.clear(frame.visible, {});
        return;
    }
    Culling c = prepared(graph, frame, params);
    first_phase(graph, c);
    if (params.phases == phases_two) second_phase(graph, c);
    frame.opaque.commands = graph.create("hiz commands", command_bytes(c));
    frame.opaque.first = 0;
    graph.compute("culling/hiz_two_phase/decide.comp")
        .loads("AllCommands", c.all.commands)
        .stores("Commands", frame.opaque.commands)
        .updates("HizDraws", c.draws)
        .stores("History", c.history)
        .loads("Pyramid", c.pyramid)
        .stores("visible", frame.visible)
        .push(c.push)
        .over(extent);
}

std::vector<Param> params() {
    return {
        param<&HizParams::phases>(
            {.name = "phases",
             .fallback = phases_two,
             .help = "occluders; two: the draws visible in the last frame, then also those newly visible; one: the largest draws",
             .choices = phases}),
        param<&HizParams::occluders>({.name = "occluders",
                                      .low = 1,
                                      .high = 65536,
                                      .fallback = 64,
                                      .help = "number of largest draws that occlude, with phases=one or without a last frame; "
                                              "more: more is culled, more depth is drawn",
                                      .scale = Scale::logarithmic}),
        param<&HizParams::across>({.name = "across",
                                   .low = 2,
                                   .high = 16,
                                   .fallback = 4,
                                   .help = "largest width and height of a lookup in the pyramid, in texels; larger: finer levels "
                                           "are read and more is culled"}),
        param<&HizParams::level>({.name = "level",
                                  .low = 0,
                                  .high = 14,
                                  .fallback = 3,
                                  .help = "pyramid level that the view 'pyramid' shows; 0 is the finest"})};
}

std::vector<Counter> counters() {
    return {
        counter<&HizCounters::in_view>({.name = "in view", .help = "opaque draws whose bounding sphere reaches into the view"}),
        counter<&HizCounters::drawn_first>({.name = "drawn first", .help = "draws that occlude in phase 1"}),
        counter<&HizCounters::tested>({.name = "tested", .help = "draws in view that phase 2 tests: those not drawn in phase 1"}),
        counter<&HizCounters::newly_visible>(
            {.name = "newly visible", .help = "tested draws that are not hidden by those of phase 1"}),
        counter<&HizCounters::occluded>({.name = "occluded", .help = "draws in view that are culled because others hide them"}),
        counter<&HizCounters::pyramid_texels>(
            {.name = "pyramid texels", .help = "pyramid texels written, summed over levels and phases"})};
}

std::vector<TimeRatio> ratios() {
    const std::vector<Stage> stages = {Stage::culling, Stage::gbuffer};
    return {{.name = "culling and G-buffer: two phases, against the planes of the view alone",
             .of = "",
             .against = "frustum",
             .scenario = "city_of_boxes",
             .counters = {"in view", "drawn first", "newly visible", "occluded", "culled"},
             .stages = stages},
            {.name = "culling and G-buffer: two phases, against one",
             .of = "",
             .against = "phases=one",
             .scenario = "city_of_boxes",
             .counters = {"drawn first", "newly visible", "occluded"},
             .stages = stages},
            {.name = "the pyramid: twice, against once",
             .of = "",
             .against = "phases=one",
             .steps = {"/pyramid"},
             .scenario = "city_of_boxes",
             .counters = {"pyramid texels"}}};
}

}  // namespace

Technique hiz_two_phase() {
    return {.stage = Stage::culling,
            .name = "culling/hiz_two_phase",
            .title = "Two-phase occlusion culling",
            .source =
                "Haar, Aaltonen: GPU-Driven Rendering Pipelines, SIGGRAPH 2015; Karis, Stubbe, Wihlidal: A Deep Dive into "
                "Nanite Virtualized Geometry, SIGGRAPH 2021; bounds of Mara, McGuire: 2D Polyhedral Bounds of a Clipped, "
                "Perspective-Projected 3D Sphere, JCGT 2013",
            .summary =
                "Drops draws whose bounding sphere is behind the depth of occluders. Never drops a visible draw; keeps hidden "
                "ones whose sphere reaches above the wall in front.",
            .params = params(),
            .variants = {"phases=one", "across=2", "across=8"},
            .counters = counters(),
            .counter_bytes = sizeof(HizCounters),
            .views = hiz_two_phase_views(),
            .claims = {.ratios = ratios()},
            .declare = declare,
            .model = hiz_two_phase_model,
            .tolerance = {.rmse = 0,
                          .worst = 0,
                          .because = "a yes or no per draw; what hangs on float rounding of spheres, on coverage or on depth is "
                                     "undecided"}};
}

}  // namespace strata::culling
