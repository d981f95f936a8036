// Objects from back to front, each blended over what is there: what most renderers do.
#include "passes/frame_images.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/alpha_blend/alpha_blend.shared.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/fragment_draw.h"

namespace strata::transparency {

ImageSet alpha_blend_model(const StageInput&, const Settings&);  // model.cpp

namespace {

void declare(Graph& graph, FrameImages& images, const Settings&) {
    distort_background(graph, images);
    Image color = gather(graph, images.color, "alpha_blend color");
    if (has(images.capabilities, Capability::dual_source_blending)) {
        draw_fragments(graph, "transparency/alpha_blend/composite", images.back_to_front, images).composites(color);
    } else {
        draw_fragments(graph, "transparency/alpha_blend/composite_gray", images.back_to_front, images).composites_gray(color);
    }
    images.color = spread(graph, color, graph.record(images.color).name);
}

std::optional<Error> beyond_device(const FrameImages& images, const Settings&) {
    if (has(images.capabilities, Capability::dual_source_blending) || !images.features->has(Feature::chromatic))
        return std::nullopt;
    return fail(Fault::device_lacks, "device.lacks_feature",
                "{technique} blends colored transmittance with {feature}, which this device does not have",
                "transparency/alpha_blend", "dual_source_blending");
}

}  // namespace

Technique alpha_blend() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/alpha_blend",
        .title = "Object-sorted alpha blending",
        .source = "Porter and Duff 1984, SIGGRAPH; painter's order by object",
        .summary =
            "Blends objects from far to near in one draw: cheapest; wrong where objects interpenetrate, contain each other or "
            "overlap themselves.",
        .counters = {counter<&AlphaBlendCounters::fragments>(
            {.name = "fragments", .help = "visible transparent fragments blended"})},
        .counter_bytes = sizeof(AlphaBlendCounters),
        .abilities = {.is_time_unit = true, .sorts_objects = true},
        .beyond_device = beyond_device,
        .declare = declare,
        .model = alpha_blend_model,
        .tolerance =
            {.rmse = 1e-5,
             .worst = 5e-3,
             .because =
                 "lit, filtered and blended in float: 4e-7 and 1.4e-5 measured on lavapipe; a highlight of alpha 0.002 "
                 "turns the 1e-6 of an interpolated normal into 2e-3, and one drawn too early is larger than what remains of it "
                 "(LightsPunctualLamp: 2.2e-3)"},
    };
}

}  // namespace strata::transparency
