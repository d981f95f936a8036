// Every fragment in a list of its sample, sorted, composited: the reference on the device. Exact but for float.
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/lists/pixel_lists.h"

namespace strata::transparency {

ImageSet sorted_lists_model(const StageInput&, const Settings&);  // model.cpp

namespace {

struct SortedListsParams {
    float pool;  ///< million fragments kept at a time
};

void declare(Graph& graph, FrameImages& images, const Settings& settings) {
    const Image behind = undistorted(graph, images);
    PixelLists lists = create_lists(graph, images, settings.as<SortedListsParams>().pool);
    for (const Band& band : lists.bands) {
        make_lists(graph, images, lists, band, list_order_depth);
        read_lists(graph.compute("transparency/sorted_lists/resolve.comp"), lists, band)
            .updates("color", images.color)
            .loads("Offsets", lists.offsets)
            .samples("behind", behind)
            .fixes("distorts", behind ? 1u : 0u)
            .fixes("per_iteration", fragments_per_iteration(lists))
            .over(over(band));
    }
}

}  // namespace

Technique sorted_lists() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/sorted_lists",
        .aliases = {"ppll"},
        .title = "Sorted lists",
        .source = "Yang, Hensley, Gruen and Thibieroz 2010, EGSR; Carpenter 1984 (A-buffer)",
        .summary =
            "Stores every fragment, sorts and composites: exact; memory and time grow with depth complexity without limit.",
        .params = {param<&SortedListsParams::pool>(pool_row)},
        .counters = list_counters(),
        .counter_bytes = sizeof(ListCounters),
        .views = {layers_view_row},
        .abilities = {.stands_in_for_truth = true},
        .declare = declare,
        .model = sorted_lists_model,
        .tolerance =
            {.rmse = 1e-5,
             .worst = 5e-3,
             .because =
                 "lit, filtered and composited in float: 4e-7 and 1.4e-5 measured on lavapipe; a highlight of alpha 0.002, clear "
                 "glass, turns the 1e-6 of an interpolated normal into 2e-3 (GlassVaseFlowers at 640 x 360: 2.2e-3)"},
    };
}

}  // namespace strata::transparency
