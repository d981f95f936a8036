// Edges are pixels whose samples differ visibly: in direction, depth or material.
#include "passes/edges/tolerant/tolerant_params.h"

#include "passes/edges/surface_tests.h"
#include "passes/edges/views/edge_views.h"
#include "passes/frame_images.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::edges {

ImageSet tolerant_model(const StageInput&, const Settings&);

namespace {

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!has_samples(frame)) return;
    const auto params = settings.as<TolerantParams>();
    test_surfaces(mark_edges(graph, frame, "edges/tolerant/mark.comp"), frame, test_normal | test_depth | test_material)
        .push(surface_limits(params.normal_angle, params.depth_step, params.color_step));
}

}  // namespace

Technique tolerant() {
    return {
        .stage = Stage::edges,
        .name = "edges/tolerant",
        .title = "Surfaces that differ visibly",
        .source =
            "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, GDC 2009; limits of docs/algorithms/deferred.md 3.2",
        .summary = "Compares decoded normals, depths and materials against limits: fewer edges, and faint ones stay jagged.",
        .params = {param<&TolerantParams::normal_angle>(normal_angle_row), param<&TolerantParams::depth_step>(depth_step_row),
                   param<&TolerantParams::color_step>(color_step_row)},
        .variants = {"normal_angle=1 depth_step=0.001 color_step=0.01", "normal_angle=2", "normal_angle=37 depth_step=0.05",
                     "color_step=0.5"},
        .counters = edge_counters(),
        .counter_bytes = sizeof(EdgeCounters),
        .views = edge_views(),
        .tables = edge_tables(),
        .declare = declare,
        .model = tolerant_model,
        .tolerance = {.rmse = 0, .worst = 0, .because = "pixels that a float may move across a limit are undecided"}};
}

}  // namespace strata::edges
