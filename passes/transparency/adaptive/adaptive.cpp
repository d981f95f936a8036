// Adaptive transparency: T(z) of a sample as a step curve of a few nodes, compressed as fragments come.
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/adaptive/adaptive.shared.h"
#include "passes/transparency/adaptive/adaptive_params.h"
#include "passes/transparency/functions/draw.h"
#include "passes/transparency/functions/motion.h"
#include "passes/transparency/lists/pixel_lists.h"

namespace strata::transparency {

ImageSet adaptive_model(const StageInput&, const Settings&);  // model.cpp

namespace {

constexpr std::string_view node_counts[] = {"4", "8", "16"};

std::uint32_t curve_nodes(const AdaptiveParams& params) { return 4u << params.nodes; }

// Every device binds so much at once.
constexpr std::uint64_t most_curve_bytes = 128ull << 20;

FunctionSums sums(Graph& graph, FrameImages& images, const Settings& settings, Offsets offsets) {
    const auto params = settings.as<AdaptiveParams>();
    const std::uint32_t nodes = curve_nodes(params);
    const std::uint64_t bytes_of_curve = nodes * sizeof(CurveNode);
    PixelLists lists = create_lists(graph, images, params.pool, most_curve_bytes / bytes_of_curve);
    Buffer curves = graph.create("adaptive curves", most_cells(lists) * bytes_of_curve);
    FunctionSums drawn = create_sums(graph, images, {.accumulation = params.accumulation, .offsets = offsets});
    for (const Band& band : lists.bands) {
        make_lists(graph, images, lists, band, list_order_submission);
        read_lists(graph.compute("transparency/adaptive/compress.comp"), lists, band)
            .updates("Curves", curves)
            .fixes("curve_nodes", nodes)
            .fixes("per_iteration", fragments_per_iteration(lists))
            .over(over(band));
        draw_into(graph, "transparency/adaptive/accumulate", images, drawn, [&](DrawStep& draw, Resolution resolution) {
            draw.loads("Curves", curves)
                .push(band)
                .in_rows(rows_of(band, resolution == Resolution::low ? 2 : 1))
                .fixes("curve_nodes", nodes);
        });
    }
    return drawn;
}

}  // namespace

Technique adaptive() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/adaptive",
        .aliases = {"aoit"},
        .title = "Adaptive transparency",
        .source = "Salvi, Montgomery and Lefohn 2011, HPG",
        .summary =
            "Compresses each sample's T(z) to a few steps, then weights a second draw by it. Fragments behind a removed step are "
            "too dark; the result depends on the order of drawing.",
        .params = {param<&AdaptiveParams::nodes>(
                       {.name = "nodes",
                        .low = 0,
                        .high = 2,
                        .fallback = 1,
                        .help = "steps kept of each sample's T(z); more: more accurate, more memory and time",
                        .choices = node_counts}),
                   param<&AdaptiveParams::accumulation>(accumulation_row), param<&AdaptiveParams::pool>(pool_row)},
        .variants = {"nodes=4", "nodes=16", "nodes=8 accumulation=packed"},
        .counters = function_counters_with_lists(),
        .counter_bytes = sizeof(FunctionCounters),
        .views = {layers_view_row, normalization_row<sums>(), motion_row<sums>()},
        .declare = add_function<sums>,
        .model = adaptive_model,
        .tolerance = {.rmse = 1e-3,
                      .worst = 3e-2,
                      .because =
                          "sums are rounded to half floats at every blend, and of equal areas a last float bit decides which "
                          "step is removed: 4.7e-4 and 1.5e-2 measured, of 8 nodes"},
    };
}

}  // namespace strata::transparency
