// The step function itself, from sorted lists, through the draw and the resolve of all function techniques: what they cost and
// how exact they can be when T(z) is.
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/exact_function/exact_function_params.h"
#include "passes/transparency/functions/draw.h"
#include "passes/transparency/functions/motion.h"
#include "passes/transparency/lists/pixel_lists.h"

namespace strata::transparency {

ImageSet exact_function_model(const StageInput&, const Settings&);  // model.cpp

namespace {

FunctionSums sums(Graph& graph, FrameImages& images, const Settings& settings, Offsets offsets) {
    const auto params = settings.as<ExactFunctionParams>();
    PixelLists lists = create_lists(graph, images, params.pool);
    FunctionSums drawn = create_sums(graph, images, {.accumulation = params.accumulation, .offsets = offsets});
    for (const Band& band : lists.bands) {
        make_lists(graph, images, lists, band, list_order_depth);
        read_places(graph.compute("transparency/exact_function/products.comp"), lists, band)
            .loads("Keys", lists.keys)
            .updates("Fragments", lists.fragments)
            .fixes("per_iteration", fragments_per_iteration(lists))
            .over(over(band));
        draw_into(graph, "transparency/exact_function/accumulate", images, drawn, [&](DrawStep& draw, Resolution resolution) {
            read_lists(draw, lists, band).in_rows(rows_of(band, resolution == Resolution::low ? 2 : 1));
        });
    }
    return drawn;
}

/// The sums of half floats that the others share would end the function's exactness: of 20,000 layers they are off by .107.
Param exact_accumulation() {
    Param row = accumulation_row;
    row.fallback = accumulation_single;
    return row;
}

}  // namespace

Technique exact_function() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/exact_function",
        .title = "Exact transmittance function",
        .source = "Salvi, Montgomery and Lefohn 2011, HPG, section 3: the step function that the others compress",
        .summary =
            "Finds the exact T(z) of each fragment in sorted lists and adds the fragment: shows what the shared draw and resolve "
            "cost in "
            "accuracy; fragments of equal depth do not hide each other.",
        .params = {param<&ExactFunctionParams::pool>(pool_row), param<&ExactFunctionParams::accumulation>(exact_accumulation())},
        .variants = {"accumulation=half", "accumulation=packed"},
        .counters = function_counters_with_lists(),
        .counter_bytes = sizeof(FunctionCounters),
        .views = {layers_view_row, normalization_row<sums>(), motion_row<sums>()},
        .declare = add_function<sums>,
        .model = exact_function_model,
        .tolerance = {.rmse = 1e-3,
                      .worst = 2e-2,
                      .because =
                          "sums are rounded to half floats at every blend, in the model, too, but a last float bit of a term "
                          "can turn the rounding of each: 5.7e-4 and 1.4e-2 measured, of packed colors"},
    };
}

}  // namespace strata::transparency
