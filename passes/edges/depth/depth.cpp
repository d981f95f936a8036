// Edges are pixels whose depths lie on no one plane.
#include "passes/choice_names.h"
#include "passes/edges/depth/depth.shared.h"
#include "passes/edges/depth/depth_params.h"
#include "passes/edges/surface_tests.h"
#include "passes/edges/views/edge_views.h"
#include "passes/frame_images.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::edges {

ImageSet depth_model(const StageInput&, const Settings&);

namespace {

constexpr auto companions = choice_names({{depth_alone, "nothing"},
                                          {depth_and_normal, "normal"},
                                          {depth_and_material, "material"},
                                          {depth_and_both, "normal_and_material"}});

std::uint32_t tests_of(std::uint32_t paired_with) {
    const bool has_normal = paired_with == depth_and_normal || paired_with == depth_and_both;
    const bool has_material = paired_with == depth_and_material || paired_with == depth_and_both;
    return (has_normal ? test_normal : 0) | (has_material ? test_material : 0);
}

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!has_samples(frame)) return;
    const auto params = settings.as<DepthParams>();
    test_surfaces(mark_edges(graph, frame, "edges/depth/mark.comp"), frame, tests_of(params.paired_with))
        .samples("depth_layers", frame.depth_layers)
        .push(DepthPush{.limits = surface_limits(params.normal_angle, depth_step_row.fallback, params.color_step),
                        .residual = params.residual});
}

}  // namespace

Technique depth() {
    return {.stage = Stage::edges,
            .name = "edges/depth",
            .title = "Depths that are not on one plane",
            .source = "docs/algorithms/deferred.md 3.2, D4: hardware depth is affine on the screen",
            .summary =
                "Compares the depths of opposite samples: reads little, and misses creases and paint on one plane unless paired.",
            .params = {param<&DepthParams::paired_with>({.name = "paired_with",
                                                         .high = depth_and_both,
                                                         .fallback = depth_and_both,
                                                         .help = added_tests_help,
                                                         .choices = companions}),
                       param<&DepthParams::residual>(
                           {.name = "residual",
                            .low = 1e-7,
                            .high = 0.1,
                            .fallback = 1e-5,
                            .help = "largest distance of four depths from one plane, relative to depth; larger: fewer edges",
                            .scale = Scale::logarithmic}),
                       param<&DepthParams::normal_angle>(normal_angle_row), param<&DepthParams::color_step>(color_step_row)},
            .variants = {"paired_with=nothing", "paired_with=normal", "residual=0.001"},
            .counters = edge_counters(),
            .counter_bytes = sizeof(EdgeCounters),
            .views = edge_views(),
            .tables = edge_tables(),
            .declare = declare,
            .model = depth_model,
            .tolerance = {.rmse = 0, .worst = 0, .because = "pixels that a float may move across a limit are undecided"}};
}

}  // namespace strata::edges
