// Multi-layer alpha blending: a few nodes per sample; where they do not suffice the two farthest become one.
#include <cmath>

#include "passes/graph/graph.h"
#include "passes/scene/scene_facts.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/lists/pixel_lists.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/multi_layer/multi_layer.shared.h"
#include "passes/transparency/multi_layer/multi_layer_params.h"

namespace strata::transparency {

ImageSet multi_layer_model(const StageInput&, const Settings&);  // model.cpp

namespace {

/// Push constants of the blend, which has their names without a struct: what reads lists asks for `band`.
struct MultiLayerPush {
    Band band;
    float log_nearest;      ///< where the first bucket begins, in ln meters
    float buckets_per_log;  ///< buckets are equal in ln z
    std::uint32_t bucket;   ///< the one that is blended
};

void declare(Graph& graph, FrameImages& images, const Settings& settings) {
    distort_background(graph, images);
    const auto params = settings.as<MultiLayerParams>();
    const DepthRange range = images.facts->transparent_depths();
    const float per_log = float(params.buckets) / std::log(range.farthest / range.nearest);
    PixelLists lists = create_lists(graph, images, params.pool);
    for (const Band& band : lists.bands) {
        make_lists(graph, images, lists, band, list_order_submission);
        for (std::uint32_t bucket = params.buckets; bucket-- > 0;)  // far to near: each over what is behind it
            read_lists(graph.compute("transparency/multi_layer/blend.comp"), lists, band)
                .updates("color", images.color)
                .fixes("layers", params.layers)
                .fixes("buckets", params.buckets)
                .fixes("per_iteration", fragments_per_iteration(lists))
                .push(MultiLayerPush{band, std::log(range.nearest), per_log, bucket})
                .over(over(band));
    }
}

std::vector<Counter> counters() {
    std::vector<Counter> rows = list_counters();
    rows.push_back(
        counter<&MultiLayerCounters::merged>({.name = "merged", .help = "fragments that caused two nodes to be merged"}));
    return rows;
}

}  // namespace

Technique multi_layer() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/multi_layer",
        .aliases = {"mlab"},
        .title = "Multi-layer alpha blending",
        .source = "Salvi and Vaidyanathan 2014, I3D; depth buckets: Kern et al. 2020, TVCG",
        .summary =
            "Blends into a few sorted nodes per sample in one pass and merges the farthest two. Later fragments cannot get "
            "between merged layers: the result depends on the order of drawing.",
        .params = {param<&MultiLayerParams::layers>(
                       {.name = "layers",
                        .low = 2,
                        .high = most_layers,
                        .fallback = 4,
                        .help = "nodes per sample and bucket; more: fewer layers are merged, more memory and time"}),
                   param<&MultiLayerParams::buckets>(
                       {.name = "buckets",
                        .low = 1,
                        .high = 8,
                        .fallback = 1,
                        .help = "depth ranges with separate nodes, of equal size in the logarithm of depth"}),
                   param<&MultiLayerParams::pool>(pool_row)},
        .variants = {"layers=2", "layers=8", "layers=16", "layers=4 buckets=2", "layers=4 buckets=4"},
        .counters = counters(),
        .counter_bytes = sizeof(MultiLayerCounters),
        .views = {layers_view_row},
        .claims = {.failures = {{"H5", 0.121, "what comes later cannot get between merged layers"}}},
        .declare = declare,
        .model = multi_layer_model,
        .tolerance = {.rmse = 1e-5,
                      .worst = 5e-3,
                      .because =
                          "lit, filtered and composited in float; a highlight of clear glass turns the 1e-6 of an interpolated "
                          "normal into 2e-3"},
    };
}

}  // namespace strata::transparency
