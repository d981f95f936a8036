// View frustum culling of opaque draws by their bounding spheres, on the device.
#include "passes/culling/frustum/frustum.shared.h"

#include "passes/culling/draw_command.shared.h"
#include "passes/culling/visible_image.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::culling {

ImageSet frustum_model(const StageInput&, const Settings&);

namespace {

void declare(Graph& graph, FrameImages& frame, const Settings&) {
    const DrawList& all = frame.all_opaque;
    const Extent extent{visible_width, visible_rows(all.count)};
    frame.visible = graph.create("visible", {.extent = extent, .format = Format::r32ui});
    frame.opaque = all;
    if (all.count == 0) {
        graph.clear(frame.visible, {});
        return;
    }
    frame.opaque.commands = graph.create("frustum commands", std::uint64_t(all.count) * sizeof(DrawCommand));
    frame.opaque.first = 0;
    graph.compute("culling/frustum/cull.comp")
        .loads("AllCommands", all.commands)
        .stores("Commands", frame.opaque.commands)
        .stores("visible", frame.visible)
        .push(FrustumList{.first = all.first, .count = all.count})
        .over(extent);
}

}  // namespace

Technique frustum() {
    return {.stage = Stage::culling,
            .name = "culling/frustum",
            .title = "Frustum culling",
            .source = "Gribb, Hartmann: Fast Extraction of Viewing Frustum Planes from the World-View-Projection Matrix, 2001",
            .summary =
                "Drops draws whose bounding sphere lies outside a side of the view or in front of the near plane; keeps draws "
                "that others hide.",
            .counters = {counter<&FrustumCounters::tested>({.name = "tested", .help = "opaque draws tested"}),
                         counter<&FrustumCounters::culled>({.name = "culled", .help = "opaque draws outside the view"})},
            .counter_bytes = sizeof(FrustumCounters),
            .abilities = {.is_time_unit = true},
            .declare = declare,
            .model = frustum_model,
            .tolerance = {
                .rmse = 0, .worst = 0, .because = "a yes or no per draw; spheres that hang on float rounding are undecided"}};
}

}  // namespace strata::culling
